"""The options of every command that makes a model, and the model that they ask for."""

from __future__ import annotations

import importlib
import warnings
from dataclasses import dataclass, replace
from enum import StrEnum
from typing import Annotated

import typer

from singletrack.body.oddities import warn_of_oddities
from singletrack.errors import InputError, OddityWarning, unknown_name
from singletrack.library import load_bicycle, load_rider
from singletrack.library.load import override
from singletrack.parameters import Bicycle, Rider
from singletrack.parameters.bicycle import FRAME_GEOMETRY
from singletrack.parameters.units import parse_quantity
from singletrack.posture import ARMS, POSTURES, SHOULDERS, Options, mechanism_of, named_posture
from singletrack.public import CoefficientMatrices

__all__ = ["Made", "ModelOptions", "model_from", "seated"]


class EngineName(StrEnum):
    """The two independent derivations, by the names of their rooms."""

    closed_form = "closed-form"
    multibody = "multibody"


@dataclass(frozen=True)
class ModelOptions:
    """The options of a command that makes a model: one parameter of its ``run``."""

    rider: Annotated[
        str | None, typer.Option("--rider", metavar="RIDER", help="A shipped name or a file; without: no rider.")
    ] = None
    posture: Annotated[
        str,
        typer.Option(
            "--posture", metavar="NAME|FILE", help=f"{', '.join(POSTURES)} or a mechanism file; rigid: hands free."
        ),
    ] = POSTURES[0]
    shoulder: Annotated[
        str | None,
        typer.Option(
            "--shoulder",
            metavar="NAME",
            help=f"Second shoulder axis: {', '.join(SHOULDERS)}; by default as the posture has it.",
        ),
    ] = None
    arms: Annotated[
        str | None,
        typer.Option("--arms", metavar="NAME", help=f"Of the leaned posture: {', '.join(ARMS)} (default: {ARMS[0]})."),
    ] = None
    torso_lean: Annotated[
        bool, typer.Option("--torso-lean", help="Let the torso lean sideways: one more coordinate.")
    ] = False
    springs: Annotated[
        list[str] | None,
        typer.Option("--spring", metavar="JOINT=VALUE", help='At a joint, steer or hands, e.g. "steer=3 N*m/rad".'),
    ] = None
    dampers: Annotated[
        list[str] | None,
        typer.Option("--damper", metavar="JOINT=VALUE", help='Likewise, e.g. "torso lean=10 N*m*s/rad".'),
    ] = None
    engine: Annotated[EngineName, typer.Option("--engine", help="Which derivation to use.")] = EngineName.closed_form
    settings: Annotated[
        list[str] | None,
        typer.Option("--set", metavar="NAME=VALUE", help='Change a parameter, e.g. "steer_axis_tilt=18.5 deg".'),
    ] = None

    @property
    def sitting(self) -> Options:
        """How the rider sits, as the makers of models take it."""
        plain = Options(named_posture(self.posture), self.shoulder, self.arms, self.torso_lean)
        if not self.springs and not self.dampers:
            return plain
        hands = {"hands", *(loop.name for loop in mechanism_of(plain).loops)}
        springs = _laws("--spring", self.springs, "N*m/rad", "N/m", hands)
        return replace(plain, springs=springs, dampers=_laws("--damper", self.dampers, "N*m*s/rad", "N*s/m", hands))


@dataclass(frozen=True)
class Made:
    """A model, what it was made from, and a heading that says so."""

    model: CoefficientMatrices
    bicycle: Bicycle
    rider: Rider | None
    title: str


def model_from(bicycle: str, options: ModelOptions) -> Made:
    """Return the model that a command's arguments ask for, after warning of what looks odd.

    Parameters
    ----------
    bicycle : str
        A shipped name or a file.
    options : ModelOptions

    Raises
    ------
    SingletrackError
        If there is no such thing, or a value is not allowed.
    """
    record, rider, changed = seated(load_bicycle(bicycle), options)
    maker = importlib.import_module(f"singletrack.{options.engine.name}")  # a door: the engine's libraries are heavy
    model = CoefficientMatrices.of(maker.coefficients(record, rider, options.sitting))
    rider = None if rider is None else rider.on(record)
    warn_of_oddities(record, rider)
    who = "" if rider is None else f" with {rider.name or 'rider'}, {options.sitting.title}"
    return Made(model, record, rider, f"{record.name}{who}{changed}")


def seated(bicycle: Bicycle, options: ModelOptions) -> tuple[Bicycle, Rider | None, str]:
    """Return bicycle and rider with what ``--set`` changes, and the changes in words, for headings.

    Parameters
    ----------
    bicycle : Bicycle
        As loaded.
    options : ModelOptions

    Raises
    ------
    SingletrackError
        If a name is unknown or given twice, or a value is not allowed.
    """
    rider = None if options.rider is None else load_rider(options.rider)
    changes = _changes(options.settings)
    own = bicycle.descriptions()
    theirs = Rider.descriptions()
    for name in changes:
        if rider is None and name in theirs:
            raise InputError(f"--set {name}: is a parameter of a rider, and there is no --rider")
        if name not in own and name not in theirs:
            raise InputError(f"--set: {unknown_name('parameter', name, [*own, *(theirs if rider else [])])}")
        if rider is None and name in FRAME_GEOMETRY:
            _warn(f"--set {name}: changes no equation without a --rider (frame geometry says where a rider sits)")
    bicycle = override(bicycle, {name: text for name, text in changes.items() if name in own})
    if rider is not None:
        rider = override(rider, {name: text for name, text in changes.items() if name not in own})
    return bicycle, rider, "".join(f", {name} = {text}" for name, text in changes.items())


def _changes(settings: list[str] | None, option: str = "--set", example: str = "trail=0.06") -> dict[str, str]:
    changes: dict[str, str] = {}
    for setting in settings or []:
        name, sign, value = setting.partition("=")
        name, value = name.strip(), value.strip()
        if not sign or not value:
            raise InputError(f"{option} {setting!r}: found no value; must be NAME=VALUE, e.g. {option} {example}")
        if name in changes:
            raise InputError(f"{option} {name}: is given twice, as {changes[name]!r} and as {value!r}")
        changes[name] = value
    return changes


def _laws(option: str, settings: list[str] | None, turning: str, sliding: str, hands: set[str]) -> dict[str, float]:
    """Return stiffness or damping in SI by joint; the unit is that of a hinge, or of a point where hands are held."""
    found = {}
    for joint, text in _changes(settings, option, f'"steer=3 {turning}"').items():
        try:
            found[joint] = parse_quantity(text, sliding if joint in hands else turning).value
        except InputError as error:
            raise InputError(f"{option} {joint}: {error}") from None
    return found


def _warn(text: str) -> None:
    warnings.warn(text, OddityWarning, stacklevel=3)
