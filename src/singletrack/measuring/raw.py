"""Raw measurements of a bicycle: what is measured, in which unit, what is allowed (Moore 2012, after Kooijman 2006)."""

from __future__ import annotations

import math
import re
from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterable

__all__ = ["RAW", "RawParameter", "orientations"]


@dataclass(frozen=True)
class RawParameter:
    """One measurement: its unit in the file, what it is, the open interval of what is allowed."""

    unit: str
    meaning: str
    low: float = 0.0
    high: float = math.inf
    needed: bool = True


def _wheel(letter: str, which: str) -> dict[str, RawParameter]:
    return {
        f"d{letter}": RawParameter("m", f"distance the {which} wheel rolls in n{letter} turns, loaded"),
        f"n{letter}": RawParameter("", f"turns of the {which} wheel"),
        f"m{letter}": RawParameter("kg", f"mass of the {which} wheel"),
        f"l{letter}": RawParameter("m", f"{which} wheel's centre below the knife edge it swings on"),
        f"Tc{letter}1": RawParameter("s", f"period of the {which} wheel as a compound pendulum"),
        f"Tt{letter}1": RawParameter("s", f"period of the {which} wheel as a torsional pendulum, axle horizontal"),
    }


def _assembly(letter: str, which: str) -> dict[str, RawParameter]:
    found = {
        f"m{letter}": RawParameter("kg", f"mass of the {which}"),
        f"Tc{letter}1": RawParameter("s", f"period of the {which} swinging about its wheel's axle"),
    }
    for i in range(1, 10):
        extra = {"needed": i <= 3}
        text = f"{which} hung in orientation {i}"
        found[f"alpha{letter}{i}"] = RawParameter(
            "deg", f"steer axis (upwards) from the horizontal, {text}", -360, 720, **extra
        )
        found[f"a{letter}{i}"] = RawParameter("m", f"plumb line to wheel centre, {text}", -math.inf, **extra)
        found[f"Tt{letter}{i}"] = RawParameter("s", f"torsional period, {text}", **extra)
    return found


_OPTIONAL = {
    "hbb": RawParameter("m", "bottom bracket height", needed=False),
    "lcs": RawParameter("m", "chain stay length", needed=False),
    "lsp": RawParameter("m", "seat post length", needed=False),
    "lst": RawParameter("m", "seat tube length", needed=False),
    "lamst": RawParameter("rad", "seat tube angle from the ground", 0.0, math.pi / 2, needed=False),
    "whb": RawParameter("m", "width of the handlebar, hand to hand", needed=False),
    "LhbR": RawParameter("m", "rear hub to hand", needed=False),
    "LhbF": RawParameter("m", "front hub to hand", needed=False),
    "lf": RawParameter("m", "front hub to fork crown", needed=False),
    "wfh": RawParameter("m", "front hub width between the drop-outs", needed=False),
    "wrh": RawParameter("m", "rear hub width between the drop-outs", needed=False),
}

#: Every measurement by its name in the file.
RAW = {
    "w": RawParameter("m", "wheel base"),
    "gamma": RawParameter("deg", "head tube angle from the ground", 0.0, 90.0),
    "f": RawParameter("m", "fork offset: front axle ahead of the steer axis", -math.inf),
    "g": RawParameter("m/s^2", "strength of gravity"),
    "mP": RawParameter("kg", "mass of the calibration rod"),
    "lP": RawParameter("m", "length of the calibration rod"),
    "dP": RawParameter("m", "diameter of the calibration rod"),
    "TtP1": RawParameter("s", "period of the calibration rod as a torsional pendulum"),
    **_wheel("R", "rear"),
    **_wheel("F", "front"),
    **_assembly("B", "rear frame"),
    **_assembly("H", "front frame"),
    **_OPTIONAL,
}


def orientations(names: Iterable[str], letter: str) -> list[str]:
    """Return the numbers of the orientations in which an assembly was hung, in order.

    >>> orientations(["alphaB2", "alphaB1", "aB1"], "B")
    ['1', '2']
    """
    return sorted(name[-1] for name in names if re.fullmatch(rf"alpha{letter}[1-9]", name))
