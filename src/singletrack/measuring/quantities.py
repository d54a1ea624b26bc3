"""Raw measurements of a bicycle: what is measured, in which unit, what is allowed (Moore 2012, after Kooijman 2006)."""

from __future__ import annotations

import math
import re
from dataclasses import dataclass
from typing import TYPE_CHECKING

from singletrack.errors import InputError, unknown
from singletrack.measuring.geometry import HEIGHTS, HUB_TO_HANDLEBAR

if TYPE_CHECKING:
    from collections.abc import Container, Iterable, Mapping

__all__ = [
    "MEASURED_QUANTITIES",
    "MeasuredQuantity",
    "check_measurements",
    "is_split",
    "needed_quantities",
    "orientations",
]

_MOST = 1e6


@dataclass(frozen=True)
class MeasuredQuantity:
    """One measurement: its unit in the file, what it is, the open interval of what is allowed.

    Attributes
    ----------
    unit, meaning : str
    low, high : float
    needed : bool
        Whether every bicycle needs it.
    usual : bool
        Whether a file to fill in asks for it, or offers it.
    """

    unit: str
    meaning: str
    low: float = 0.0
    high: float = math.inf
    needed: bool = True
    usual: bool = True


def _wheel(letter: str, which: str) -> dict[str, MeasuredQuantity]:
    return {
        f"d{letter}": MeasuredQuantity("m", f"distance the {which} wheel rolls in n{letter} turns, loaded"),
        f"n{letter}": MeasuredQuantity("", f"turns of the {which} wheel"),
        f"m{letter}": MeasuredQuantity("kg", f"mass of the {which} wheel"),
        f"l{letter}": MeasuredQuantity("m", f"{which} wheel's centre below the knife edge it swings on"),
        f"Tc{letter}1": MeasuredQuantity("s", f"period of the {which} wheel as a compound pendulum"),
        f"Tt{letter}1": MeasuredQuantity("s", f"period of the {which} wheel as a torsional pendulum, axle horizontal"),
    }


def _assembly(letter: str, which: str, axis: str, usual: bool = True) -> dict[str, MeasuredQuantity]:
    needed = {"needed": usual, "usual": usual}
    found = {
        f"m{letter}": MeasuredQuantity("kg", f"mass of the {which}", **needed),
        f"Tc{letter}1": MeasuredQuantity("s", f"period of the {which} swinging about {axis}", **needed),
    }
    for i in range(1, 10):
        extra = {"needed": usual and i <= 3, "usual": usual and i <= 3}
        text = f"{which} hung in orientation {i}"
        found[f"alpha{letter}{i}"] = MeasuredQuantity(
            "deg", f"steer axis (upwards) from the horizontal, {text}", -360, 720, **extra
        )
        found[f"a{letter}{i}"] = MeasuredQuantity("m", f"plumb line to wheel centre, {text}", -math.inf, **extra)
        found[f"Tt{letter}{i}"] = MeasuredQuantity("s", f"torsional period, {text}", **extra)
    return found


_OPTIONAL = {
    "hbb": MeasuredQuantity("m", "bottom bracket height", needed=False),
    "lcs": MeasuredQuantity("m", "chain stay length", needed=False),
    "lsp": MeasuredQuantity("m", "seat post length", needed=False),
    "lst": MeasuredQuantity("m", "seat tube length", needed=False),
    "lamst": MeasuredQuantity("rad", "seat tube angle from the ground", 0.0, math.pi / 2, needed=False),
    "whb": MeasuredQuantity("m", "width of the handlebar, hand to hand", needed=False),
    "LhbR": MeasuredQuantity("m", "rear hub to hand", needed=False),
    "LhbF": MeasuredQuantity("m", "front hub to hand", needed=False),
    "lf": MeasuredQuantity("m", "front hub to fork crown", needed=False),
    "wfh": MeasuredQuantity("m", "front hub width between the drop-outs", needed=False),
    "wrh": MeasuredQuantity("m", "rear hub width between the drop-outs", needed=False),
}


def _unusual(meaning: str, low: float = 0.0) -> MeasuredQuantity:
    return MeasuredQuantity("m", meaning, low, needed=False, usual=False)


_REAR, _FRONT = (f"of what the {end} hub's distance from the steer axis follows from" for end in ("rear", "front"))
_BAR = "of what the place of the handlebar on its fork follows from"
#: Instead of wheel base, head angle and fork offset, and for the handlebar of a split fork: heights above a table,
#: diameters of what was touched, and two lengths (their use is in singletrack.measuring.geometry).
_BY_HEIGHTS = {
    **{name: _unusual(f"height, {_REAR}") for name in ("h1", "h2", "h3")},
    **{name: _unusual(f"height, {_FRONT}") for name in ("h4", "h5")},
    **{name: _unusual(f"diameter, {_REAR}") for name in ("d1", "d2")},
    **{name: _unusual(f"diameter, {_FRONT}") for name in ("d3", "d4")},
    "d": _unusual("from axle to axle, the fork reversed"),
    **{name: _unusual(f"height, {_BAR}") for name in ("h6", "h7")},
    **{name: _unusual(f"diameter, {_BAR}") for name in ("d5", "d6")},
    "l": _unusual("over front axle and handlebar"),
}
#: In files of others, and of other things than the bicycle's parameters.
_UNUSED = {
    name: _unusual("place of an instrument or a tether (not used here)", -math.inf)
    for name in ("xcl", "zcl", "ds1", "ds2", "ds3")
}

#: Every measurement by its name in the file.
MEASURED_QUANTITIES = {
    "w": MeasuredQuantity("m", "wheel base"),
    "gamma": MeasuredQuantity("deg", "head tube angle from the ground", 0.0, 90.0),
    "f": MeasuredQuantity("m", "fork offset: front axle ahead of the steer axis", -math.inf),
    "g": MeasuredQuantity("m/s^2", "strength of gravity"),
    "mP": MeasuredQuantity("kg", "mass of the calibration rod"),
    "lP": MeasuredQuantity("m", "length of the calibration rod"),
    "dP": MeasuredQuantity("m", "diameter of the calibration rod"),
    "TtP1": MeasuredQuantity("s", "period of the calibration rod as a torsional pendulum"),
    **_wheel("R", "rear"),
    **_wheel("F", "front"),
    **_assembly("B", "rear frame", "its wheel's axle"),
    **_assembly("H", "front frame", "its wheel's axle"),
    **_assembly("G", "handlebar of a split fork", "its point of reference", usual=False),
    **_assembly("S", "fork without handlebar", "its wheel's axle", usual=False),
    **_OPTIONAL,
    **_BY_HEIGHTS,
    **_UNUSED,
}


def orientations(names: Iterable[str], letter: str) -> list[str]:
    """Return the numbers of the orientations in which an assembly was hung, in order.

    Parameters
    ----------
    names : iterable of str
        What was measured.
    letter : str
        Of the assembly.

    Examples
    --------
    >>> orientations(["alphaB2", "alphaB1", "aB1"], "B")
    ['1', '2']
    """
    return sorted(name[-1] for name in names if re.fullmatch(rf"alpha{letter}[1-9]", name))


def is_split(names: Container[str]) -> bool:
    """Tell whether handlebar (G) and fork (S) were measured apart, by the names of the measurements.

    Parameters
    ----------
    names : container of str
    """
    return "mG" in names or "mS" in names


def needed_quantities(names: Container[str]) -> list[str]:
    """Return the measurements that a bicycle follows from, as it was measured: in one of the ways there are.

    Parameters
    ----------
    names : container of str
        What was measured.

    Examples
    --------
    >>> len(needed_quantities(["w"])), len(needed_quantities(["mG"]))
    (42, 58)
    """
    always = [name for name, q in MEASURED_QUANTITIES.items() if q.needed and name not in {"w", "gamma", "f"}]
    by_heights = "w" not in names and any(name in names for name in HEIGHTS)
    geometry = list(HEIGHTS) if by_heights else ["w", "gamma", "f"]
    if is_split(names):
        front = [name for name in always if name in _assembly("H", "", "")]
        parts = [name.replace("H", letter) for letter in "GS" for name in front]
        always = [name for name in always if name not in front] + parts + list(HUB_TO_HANDLEBAR)
    return geometry + always


def check_measurements(values: Mapping[str, float], deviations: Mapping[str, float]) -> None:
    """Raise InputError for measurements that are unknown, missing or not allowed.

    Parameters
    ----------
    values, deviations : mapping of str to float
        By name, in the units of :data:`MEASURED_QUANTITIES`.
    """
    for name in values:
        if name not in MEASURED_QUANTITIES:
            raise unknown("measurement", name, MEASURED_QUANTITIES)
    for letter in ("GS" if is_split(values) else "H") + "B":
        wanted = [f"{kind}{letter}{i}" for i in orientations(values, letter) for kind in ("a", "Tt")]
        _require(wanted, values)
    _require(needed_quantities(values), values)
    for name, value in values.items():
        _check_value(name, value, deviations.get(name))


def _require(names: Iterable[str], values: Mapping[str, float]) -> None:
    missing = [name for name in names if name not in values]
    if missing:
        raise InputError(f"the measurements lacks {', '.join(missing)}", parameters=missing)


def _check_value(name: str, value: float, deviation: float | None) -> None:
    q = MEASURED_QUANTITIES[name]
    if not q.low < value < q.high or abs(value) > _MOST or (q.low == 0 and value < 1 / _MOST):
        text = f"{name} = {value:g} {q.unit}".rstrip()
        allowed = f"between {max(q.low, -_MOST):g} and {min(q.high, _MOST):g}"
        raise InputError(f"{text}, must be {allowed} ({q.meaning})", parameters=(name,), found=value, allowed=allowed)
    if deviation is not None and not 0 <= deviation <= abs(value) + 1:
        text = f"{name} has a standard deviation of {deviation:g} {q.unit}".rstrip()
        reason = f"{text}, must be less than the value's size ({q.meaning})"
        raise InputError(reason, parameters=(name,), found=deviation, allowed="less than the value's size")
