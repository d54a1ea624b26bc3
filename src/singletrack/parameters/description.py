"""What a parameter is, said once: unit, symbol in the paper, meaning, what is allowed.

Validation, file reading, templates, tables and schemas all read this description.
"""

from __future__ import annotations

import sys
from dataclasses import dataclass, field
from functools import cached_property
from math import inf, isfinite, nextafter, pi
from typing import TYPE_CHECKING, Any

import numpy as np

from singletrack.arrays.faults import Fault
from singletrack.errors import InputError

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from singletrack.arrays import Array, Number

__all__ = ["ALLOWED", "BOUNDS", "Parameter", "faults_of_value", "parameter"]

_MAX, _TINY = sys.float_info.max, nextafter(0.0, 1.0)
#: Kinds of allowed values: the words a user reads, and a test on floats and NumPy arrays (finite is tested before).
ALLOWED: dict[str, tuple[str, Callable[[Any], Any]]] = {
    "any": ("a finite number", lambda x: x == x),  # noqa: PLR0124  # true for all finite numbers
    "positive": ("greater than zero", lambda x: x > 0),
    "not negative": ("zero or more", lambda x: x >= 0),
    "angle": ("between 0 and 90 deg (a bare number is in radians)", lambda x: (x > 0) & (x < pi / 2)),
    "tilt": ("between -90 and 90 deg (a bare number is in radians)", lambda x: abs(x) < pi / 2),
    "above ground": ("less than zero (z points down, the ground is at zero)", lambda x: x < 0),
    "fraction": ("greater than 0 and less than 1", lambda x: (x > 0) & (x < 1)),
}

#: By unit: least and largest size of a value other than zero. Nothing that is ridden comes near; beyond, the numbers
#: are a mistake (of units, mostly), and nothing overflows within.
BOUNDS: dict[str, tuple[float, float]] = {
    "m": (1e-6, 100.0),
    "kg": (1e-6, 1000.0),
    "kg*m**2": (0.0, 1e5),
    "m/s**2": (1e-6, 1000.0),
    "N*m/rad": (1e-6, 1e12),
    "N*m*s/rad": (0.0, 1e12),
}
#: The least and the largest double of each kind of allowed values.
_ENDS = {
    "any": (-_MAX, _MAX),
    "positive": (_TINY, _MAX),
    "not negative": (0.0, _MAX),
    "angle": (_TINY, nextafter(pi / 2, 0)),
    "tilt": (nextafter(-pi / 2, 0), nextafter(pi / 2, 0)),
    "above ground": (-_MAX, -_TINY),
    "fraction": (_TINY, nextafter(1.0, 0)),
}
_SMALL_UNITS = {"m": "mm", "kg": "g"}


@dataclass(frozen=True)
class Parameter:
    """The description of one parameter.

    Attributes
    ----------
    unit : str
        SI unit as pint reads it, "" for a plain number.
    symbol : str
        The paper's symbol.
    meaning : str
        What it is, for templates and tables.
    allowed : str
        A key of :data:`ALLOWED`.
    group : str
        Heading under which it is listed.
    optional : bool
        Whether a record can do without it.
    most : float, optional
        Its largest size, where that is less than :data:`BOUNDS` has it for the unit.
    """

    unit: str
    symbol: str
    meaning: str
    allowed: str
    group: str
    optional: bool = False
    most: float = inf

    @property
    def bounds(self) -> tuple[float, float]:
        """Least and largest size of a value other than zero; the least only of lengths and masses that must be."""
        least, most = BOUNDS.get(self.unit, (0.0, inf))
        divides = self.allowed == "positive" or (self.allowed == "not negative" and self.unit == "m")
        return (least if divides else 0.0), min(most, self.most)

    @cached_property
    def plain(self) -> tuple[float, float]:
        """Ends of a range of doubles that are sound without any doubt; zero may be sound beside it.

        >>> parameter("m", "c", "length", group="").metadata["parameter"].plain
        (1e-06, 100.0)
        """
        (low, high), (least, most) = _ENDS[self.allowed], self.bounds
        return max(low, least if low >= 0 else -most), min(high, most)


def parameter(
    unit: str,
    symbol: str,
    meaning: str,
    allowed: str = "positive",
    *,
    group: str,
    optional: bool = False,
    most: float = inf,
) -> Any:
    """Declare a field of a record as a parameter (arguments as in :class:`Parameter`)."""
    metadata = {"parameter": Parameter(unit, symbol, meaning, allowed, group, optional, most)}
    return field(default=None, metadata=metadata)  # what is missing is told by the record, all at once


def faults_of_value(name: str, value: Number, description: Parameter) -> Iterator[Fault]:
    """Yield what is wrong with one parameter: not finite, not allowed, beyond all bounds.

    A sound float yields nothing.

    Parameters
    ----------
    name : str
        Of the parameter.
    value : None, float or array, shape (...)
        Concrete; None where it is missing, which is no fault here.
    description : Parameter
    """
    if value is None:
        return
    words, test = ALLOWED[description.allowed]
    least, most = description.bounds
    if type(value) is float and isfinite(value) and test(value) and (least <= abs(value) <= most or value == 0):
        return
    array = np.asarray(value)
    real = array.real
    finite = np.isfinite(array)
    size = np.where(finite, np.abs(real), 1.0)
    allowed = finite & test(np.where(finite, real, 1.0))
    unit = f" {description.unit}" if description.unit else ""
    found = f"{name} = {{found:.6g}}{unit}"
    values = {"found": array}
    if description.unit == "rad":
        found += " ({degrees:.6g} deg)"
        with np.errstate(over="ignore"):
            values["degrees"] = np.degrees(real)
    yield Fault(~allowed, f"{found}, must be {words}", values, InputError, (name,), words)
    beyond = allowed & (((size < least) & (real != 0)) | (size > most))
    if beyond.any():
        words = f"at most {most:g}{unit}" if not least else f"between {least:g} and {most:g}{unit}"
        small = _SMALL_UNITS.get(description.unit)
        hint = (
            f' (is it in {small}? Say "{{found:.6g}} {small}")'
            if small and _is_thousandfold(size[beyond], most)
            else ""
        )
        yield Fault(beyond, f"{found}, must be {words}{hint}", values, InputError, (name,), words)


def _is_thousandfold(sizes: Array, most: float) -> bool:
    """Tell whether sizes are too large, and would not be in a unit a thousandth of ours."""
    return bool(((sizes > most) & (sizes <= 1000 * most)).all())
