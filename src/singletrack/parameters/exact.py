"""Numbers exactly as they were written: decimals and units as fractions, degrees as fractions of pi."""

from __future__ import annotations

import math
import re
from dataclasses import dataclass
from fractions import Fraction
from math import pi
from typing import TYPE_CHECKING

from singletrack.errors import InputError
from singletrack.parameters.units import COMMON_FACTORS, parse_quantity, written_parts

if TYPE_CHECKING:
    from singletrack.parameters.record import Record

__all__ = ["Exact", "exact_of_double", "exact_quantity", "exact_value"]

#: Units by name: their size in SI, and the power of pi that goes with it.
_UNITS: dict[str, tuple[str, int]] = {
    **dict.fromkeys(("", "m", "s", "sec", "kg", "rad", "N", "Hz", "metre", "meter", "second", "radian"), ("1", 0)),
    **dict.fromkeys(("mm", "g", "ms", "gram"), ("0.001", 0)),
    **dict.fromkeys(("cm", "%", "pct", "percent"), ("0.01", 0)),
    **dict.fromkeys(("km", "kN"), ("1000", 0)),
    **dict.fromkeys(("deg", "°", "degree", "degrees"), ("1/180", 1)),
    **dict.fromkeys(("in", "inch"), ("0.0254", 0)),
    **dict.fromkeys(("lb", "lbs", "pound"), ("0.45359237", 0)),
    **dict.fromkeys(("ft", "foot"), ("0.3048", 0)),
    "dm": ("0.1", 0),
    "min": ("60", 0),
    "h": ("3600", 0),
}
_ATOM = re.compile(r"(?P<sign>[*·/]?)\s*(?P<name>1|[A-Za-z°%]+)(?:\^|\*\*)?(?P<power>-?[1-3]|[²³])?\s*")
#: Exponents of ten beyond these are no numbers of bicycles, and would make very long fractions.
_LARGEST_EXPONENT = 400


@dataclass(frozen=True)
class Exact:
    """fraction times pi to a power, in SI; ``text`` is how it was written."""

    fraction: Fraction
    pi: int = 0
    text: str = ""

    def __float__(self) -> float:
        return float(self.fraction) * pi**self.pi


def exact_of_double(value: float) -> Exact:
    """Return a double as the shortest decimal that reads as it.

    Parameters
    ----------
    value : float

    Examples
    --------
    >>> exact_of_double(0.1).fraction
    Fraction(1, 10)
    """
    text = repr(float(value))
    return Exact(Fraction(text), 0, text)


def exact_quantity(text: str, unit: str) -> Exact:
    """Return what a file or a command line says, exactly (a standard deviation is left out).

    Parameters
    ----------
    text : str
    unit : str
        The SI unit wanted.

    Raises
    ------
    InputError
        As :func:`~singletrack.parameters.units.parse_quantity`, and for what is not finite.

    Examples
    --------
    >>> exact_quantity("18.5 deg", "rad")
    Exact(fraction=Fraction(37, 360), pi=1, text='18.5 deg')
    >>> exact_quantity("55 mm", "m").fraction
    Fraction(11, 200)
    """
    value = parse_quantity(text, unit).value
    if not math.isfinite(value):
        raise InputError(f"{text!r} is not finite, must be a finite number", found=text, allowed="a finite number")
    number, written = written_parts(text)
    exponent = re.search(r"[eE]([+-]?\d+)$", number)
    factor = _factor(written)
    if factor is None or (exponent and abs(int(exponent[1])) > _LARGEST_EXPONENT):  # rounded to a double first
        return Exact(exact_of_double(value).fraction, 0, text)
    return Exact(Fraction(number) * factor.fraction, factor.pi, text)


def _factor(unit: str) -> Exact | None:
    """Return the size of a unit in SI, None if it has parts that are not in the table."""
    if unit and any(written == unit and factor == 1.0 for (written, _), factor in COMMON_FACTORS.items()):
        return Exact(Fraction(1))
    size, power_of_pi, place = Fraction(1), 0, 0
    while place < len(unit):
        found = _ATOM.match(unit, place)
        if found is None or found["name"] not in {*_UNITS, "1"}:
            return None
        written, of_pi = _UNITS.get(found["name"], ("1", 0))
        power = int((found["power"] or "1").replace("²", "2").replace("³", "3")) * (-1 if found["sign"] == "/" else 1)
        size, power_of_pi, place = size * Fraction(written) ** power, power_of_pi + of_pi * power, found.end()
    return Exact(size, power_of_pi)


def exact_value(record: Record, name: str) -> Exact:
    """Return a parameter of a single design: as it was written, if it was and has not been changed since.

    Parameters
    ----------
    record : Bicycle or Rider
    name : str

    Examples
    --------
    >>> from singletrack import load_bicycle
    >>> bicycle = load_bicycle("stratos")
    >>> exact_value(bicycle, "steer_axis_tilt").fraction, exact_value(bicycle.replace(trail=0.06), "trail").fraction
    (Fraction(169, 1800), Fraction(3, 50))
    """
    value, unit = float(getattr(record, name)), record.descriptions()[name].unit
    for key, text in record.written.items():
        if key != name and not key.startswith(f"{name} on "):
            continue
        try:
            if parse_quantity(text, unit).value == value:
                return exact_quantity(text, unit)
        except InputError:
            continue
    return exact_of_double(value)
