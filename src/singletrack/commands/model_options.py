"""The options of every command that makes a model: told once, read once."""

from __future__ import annotations

from dataclasses import dataclass, replace
from enum import StrEnum
from functools import cached_property
from pathlib import Path
from typing import Annotated

import typer

from singletrack.errors import InputError
from singletrack.files.gains import gain_unit, read_gains
from singletrack.files.source import read_text
from singletrack.parameters import Feedback
from singletrack.parameters.units import parse_quantity
from singletrack.posture import ARMS, POSTURES, SHOULDERS, Options, mechanism_of, named_posture

__all__ = ["EngineName", "ModelOptions", "pairs"]


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
            "--posture", metavar="NAME|FILE", help=f"{', '.join(POSTURES)}, or a mechanism's file; rigid: hands free."
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
        typer.Option("--arms", metavar="NAME", help=f"Of the posture leaned: {', '.join(ARMS)}; by default {ARMS[0]}."),
    ] = None
    torso_lean: Annotated[
        bool, typer.Option("--torso-lean", help="Let the torso lean sideways about the hips: one more coordinate.")
    ] = False
    springs: Annotated[
        list[str] | None,
        typer.Option("--spring", metavar="JOINT=VALUE", help='E.g. "torso lean=100 N*m/rad"; steer, or hands in N/m.'),
    ] = None
    dampers: Annotated[
        list[str] | None,
        typer.Option("--damper", metavar="JOINT=VALUE", help='E.g. "steer=2 N*m*s/rad"; or hands (N*s/m).'),
    ] = None
    fit: Annotated[
        bool, typer.Option("--fit", help="Let the torso lean so that the elbows stay as bent as before --set.")
    ] = False
    elbow_angle: Annotated[
        str | None, typer.Option("--elbow-angle", metavar="ANGLE", help='With --fit: bent so, e.g. "150 deg".')
    ] = None
    engine: Annotated[
        EngineName, typer.Option("--engine", help="Which derivation to use; turn and ride: multibody.")
    ] = EngineName.closed_form
    settings: Annotated[
        list[str] | None,
        typer.Option("--set", metavar="NAME=VALUE", help='Change a parameter, e.g. "steer_axis_tilt=18.5 deg".'),
    ] = None

    feedback: Annotated[
        list[str] | None,
        typer.Option(
            "--feedback", metavar='"INPUT: SIGNAL=GAIN"', help='Of a controller, e.g. "steer torque: lean rate=12".'
        ),
    ] = None
    gains: Annotated[
        Path | None, typer.Option("--gains", metavar="FILE", help="Feedback from a file: gains, limit, delay.")
    ] = None

    @cached_property
    def answer(self) -> Feedback | None:
        """What the rider or a machine does about it: of the options, or of the file."""
        if self.gains is not None:
            if self.feedback:
                raise InputError("--feedback and --gains: are two ways to say the same; give one of them")
            return read_gains(read_text(self.gains), str(self.gains))
        return Feedback(_fed_back(self.feedback)) if self.feedback else None

    @cached_property
    def sitting(self) -> Options:
        """How the rider sits and what is sprung, as the makers of models take it."""
        plain = Options(named_posture(self.posture), self.shoulder, self.arms, self.torso_lean)
        if not self.springs and not self.dampers:
            return plain
        hands = {"hands", *(loop.name for loop in mechanism_of(plain).loops)}
        springs = _amounts("--spring", self.springs, "N*m/rad", "N/m", hands)
        return replace(plain, springs=springs, dampers=_amounts("--damper", self.dampers, "N*m*s/rad", "N*s/m", hands))


def pairs(option: str, texts: list[str] | None) -> dict[str, str]:
    """Return what an option that is given as NAME=VALUE, any number of times, says.

    Parameters
    ----------
    option : str
        Its name, for messages.
    texts : list of str or None

    Raises
    ------
    InputError
        If a value is missing, or a name is given twice.
    """
    found: dict[str, str] = {}
    for text in texts or []:
        name, sign, value = (part.strip() for part in text.partition("="))
        if not sign or not value:
            example = "trail=0.06" if option == "--set" else '"steer=2"'
            raise InputError(f"{option} {text!r}: found no value; must be NAME=VALUE, e.g. {option} {example}")
        if name in found:
            raise InputError(f"{option} {name}: is given twice, as {found[name]!r} and as {value!r}")
        found[name] = value
    return found


def _fed_back(texts: list[str]) -> dict[tuple[str, str], float]:
    gains: dict[tuple[str, str], float] = {}
    for text in texts:
        target, colon, rest = (part.strip() for part in text.partition(":"))
        signal, equals, gain = (part.strip() for part in rest.partition("="))
        if not colon or not equals:
            raise InputError(f'--feedback {text!r}: must be "INPUT: SIGNAL=GAIN", e.g. "steer torque: lean rate=12"')
        if (target, signal) in gains:
            raise InputError(f"--feedback {target}: {signal}: is given twice")
        try:
            gains[target, signal] = parse_quantity(gain, gain_unit(signal)).value
        except InputError as error:
            raise error.at(f"--feedback {target}: {signal}") from None
    return gains


def _amounts(option: str, texts: list[str] | None, turning: str, sliding: str, hands: set[str]) -> dict[str, float]:
    """Return stiffness or damping in SI by joint; the unit is that of a hinge, or of a point where hands are held."""
    amounts = {}
    for joint, text in pairs(option, texts).items():
        try:
            amounts[joint] = parse_quantity(text, sliding if joint in hands else turning).value
        except InputError as error:
            raise error.at(f"{option} {joint}") from None
    return amounts
