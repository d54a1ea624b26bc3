"""Arguments and options of the command line: their names, kinds and help."""

from __future__ import annotations

from enum import StrEnum
from pathlib import Path
from typing import Annotated

import typer

__all__ = [
    "BicycleArgument",
    "CentreFit",
    "CsvOption",
    "EngineName",
    "EngineOption",
    "JsonOption",
    "OutputFileOption",
    "Parameterization",
    "PostureName",
    "PostureOption",
    "RecordKind",
    "RiderOption",
    "SetOption",
    "ShoulderName",
    "ShoulderOption",
    "SpeedsOption",
    "TemplateKind",
]


class PostureName(StrEnum):
    """Postures of a rider."""

    rigid = "rigid"
    leaned = "leaned"
    upright = "upright"


class ShoulderName(StrEnum):
    """Second axis of the shoulder joint."""

    abduction = "abduction"
    axial = "axial"


class EngineName(StrEnum):
    """The two independent derivations."""

    closed_form = "closed-form"
    multibody = "multibody"


class TemplateKind(StrEnum):
    """Kinds of files to fill in."""

    bicycle = "bicycle"
    rider = "rider"
    measurements = "measurements"


class RecordKind(StrEnum):
    """Kinds of parameter files."""

    bicycle = "bicycle"
    rider = "rider"


class Parameterization(StrEnum):
    """Sets of symbols of a parameter set."""

    benchmark = "benchmark"
    principal = "principal"


class CentreFit(StrEnum):
    """How a centre of mass follows from the plumb lines."""

    perpendicular = "perpendicular"
    vertical = "vertical"
    intersections = "intersections"


BicycleArgument = Annotated[str, typer.Argument(metavar="BICYCLE", help="A shipped name or a file.")]
RiderOption = Annotated[
    str | None, typer.Option("--rider", metavar="RIDER", help="A shipped name or a file; without: no rider.")
]
PostureOption = Annotated[PostureName, typer.Option("--posture", help="rigid: hands free.")]
ShoulderOption = Annotated[
    ShoulderName | None, typer.Option("--shoulder", help="Second shoulder axis; by default as the posture has it.")
]
EngineOption = Annotated[EngineName, typer.Option("--engine", help="Which derivation to use.")]
SetOption = Annotated[
    list[str] | None,
    typer.Option("--set", metavar="NAME=VALUE", help='Change a parameter, e.g. "steer_axis_tilt=18.5 deg".'),
]
SpeedsOption = Annotated[
    str, typer.Option("--speeds", metavar="START:STOP:COUNT", help="Forward speeds in m/s, or one value.")
]
JsonOption = Annotated[bool, typer.Option("--json", help="Print JSON in full precision.")]
OutputFileOption = Annotated[Path | None, typer.Option("--output", metavar="FILE", help="Write here instead.")]
CsvOption = Annotated[bool, typer.Option("--csv", help="Print CSV in full precision.")]
