"""Arguments and options that several commands share, or whose kinds need a name: told once."""

from __future__ import annotations

from enum import StrEnum
from pathlib import Path
from typing import Annotated

import typer

__all__ = [
    "BicycleArgument",
    "CentreFit",
    "CsvOption",
    "JsonOption",
    "OutputFileOption",
    "Parameterization",
    "RecordKind",
    "SpeedsOption",
    "TemplateKind",
    "ThingArgument",
    "TyresOption",
]


class TemplateKind(StrEnum):
    """Kinds of files to fill in."""

    bicycle = "bicycle"
    rider = "rider"
    measurements = "measurements"
    posture = "posture"


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


BicycleArgument = Annotated[str, typer.Argument(metavar="BICYCLE", help="A shipped name, a file, or a geometry sheet.")]
ThingArgument = Annotated[str, typer.Argument(metavar="NAME", help="A shipped name or a file in any format.")]
SpeedsOption = Annotated[
    str,
    typer.Option(
        "--speeds",
        metavar="SPEEDS",
        help='START:STOP:COUNT, a list or one value, in m/s or with a unit: "0:10:11", "4, 6, 8", "5 km/h:40 km/h:8".',
    ),
]
JsonOption = Annotated[bool, typer.Option("--json", help="Print JSON in full precision.")]
OutputFileOption = Annotated[Path | None, typer.Option("--output", metavar="FILE", help="Write here instead.")]
CsvOption = Annotated[bool, typer.Option("--csv", help="Print CSV in full precision.")]
TyresOption = Annotated[
    str | None,
    typer.Option(
        "--tyres",
        metavar="C,D,S[/C,D,S]",
        help="Tyres that slip, not rolling: cornering and camber stiffness, relaxation length, front / rear; "
        'e.g. "9 kN/rad, 500 N/rad, 0.1 m".',
    ),
]
