"""Units at the edge: text such as ``"63.9 deg"`` or ``"0.0563 +/- 0.0017 m"`` to SI numbers, once, on the way in.

pint does the conversion, with a registry of only those units that lengths, masses, angles and inertias are given in.
"""

from __future__ import annotations

import functools
import re
from dataclasses import dataclass
from math import isinf
from typing import Any

from singletrack.errors import InputError, shown

__all__ = ["Quantity", "parse_quantity", "unit_registry", "written_parts"]

_DEFINITIONS = """
milli- = 1e-3 = m-
centi- = 1e-2 = c-
deci- = 1e-1 = d-
kilo- = 1e3 = k-
meter = [length] = m = metre
second = [time] = s = sec
gram = [mass] = g
radian = [angle] = rad
degree = 0.017453292519943295 * radian = deg = ° = degrees
inch = 0.0254 * meter = in
foot = 0.3048 * meter = ft
pound = 0.45359237 * kilogram = lb = lbs
newton = kilogram * meter / second ** 2 = N
minute = 60 * second = min
hour = 3600 * second = h
hertz = 1 / second = Hz
percent = 0.01 = % = pct
"""

# Not \d, which takes digits of all scripts: nobody who reads a file would notice a ৪ among them.
_NUMBER = r"[+-]?(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][+-]?[0-9]+)?|[+-]?(?:nan|inf|infinity)"
_QUANTITY = re.compile(
    rf"\s*(?P<value>{_NUMBER})\s*(?:(?:\+/-|±|\+-)\s*(?P<deviation>{_NUMBER})\s*)?(?P<unit>[^\d\s+-].*)?",
    re.IGNORECASE | re.ASCII,  # digits and letters of other scripts are no numbers
)
#: Names with powers up to 3, joined by signs. Stricter than pint, which would evaluate m**9**9**9.
_ATOM = r"(?:1(?=\s*/)|[A-Za-z°%]+(?:(?:\^|\*\*)?-?[1-3]|[²³])?)"
_UNIT_TEXT = re.compile(rf"{_ATOM}(?:(?:\s*(?:\*|·|/)\s*|\s+){_ATOM}){{0,5}}")
_LONGEST = 200


@dataclass(frozen=True)
class Quantity:
    """A number in SI with the standard deviation it was given with (None if without)."""

    value: float
    deviation: float | None = None


@functools.cache
def unit_registry() -> Any:
    """Return the pint registry of the units accepted in files and on the command line."""
    import pint  # lazy: only needed where a unit was written

    registry: Any = pint.UnitRegistry(None)
    registry.load_definitions(_DEFINITIONS.strip().splitlines())
    return registry


def parse_quantity(found: object, unit: str) -> Quantity:
    """Return what a file or a command line says, in SI.

    Parameters
    ----------
    found : str, int or float
        A bare number (SI), or text: a number, optionally ``+/-`` a standard deviation, optionally a unit.
    unit : str
        The SI unit wanted, as pint writes it; "" for a plain number.

    Raises
    ------
    InputError
        If it is no such thing, or its unit does not convert to ``unit``. NaN and infinity pass: the record that is
        made from the number refuses them, with the parameter's name.

    Examples
    --------
    >>> parse_quantity("290 mm", "m")
    Quantity(value=0.29, deviation=None)
    >>> parse_quantity("0.0563 +/- 0.0017 m", "m")
    Quantity(value=0.0563, deviation=0.0017)
    >>> parse_quantity("5 kg", "m")
    Traceback (most recent call last):
    ...
    singletrack.errors.InputError: '5 kg' has a unit that is no length; allowed: a number in m, or one with ...
    """
    if isinstance(found, bool) or not isinstance(found, str | int | float):
        raise _refusal(found, f"{shown(found)} is not a number", unit)
    if not isinstance(found, str):
        return Quantity(_to_float(found, unit))
    if _is_foreign(found[:_LONGEST]):
        raise _refusal(found, f"{found[:60]!r} has digits other than 0 to 9", unit)
    match = _QUANTITY.fullmatch(found.strip()) if len(found) <= _LONGEST else None
    if match is None:
        raise _refusal(found, f"{found[:60]!r} is not a number with an optional unit", unit)
    factor = 1.0 if match["unit"] is None else _factor(found, match["unit"].strip(), unit)
    value = _scaled(float(match["value"]), factor)
    if isinf(value) and "inf" not in match["value"].lower():
        raise _refusal(found, f"{found!r} is too large", unit)
    deviation = None if match["deviation"] is None else _scaled(float(match["deviation"]), factor)
    if deviation is not None and not 0 <= deviation < float("inf"):
        reason = f"{found!r} has a standard deviation that is not a finite number of zero or more"
        raise InputError(reason, found=found, allowed="a standard deviation of zero or more")
    return Quantity(value, deviation)


def written_parts(text: str) -> tuple[str, str]:
    """Return number and unit of a text that :func:`parse_quantity` takes, as they were written.

    Parameters
    ----------
    text : str

    Examples
    --------
    >>> written_parts("0.0563 +/- 0.0017 m")
    ('0.0563', 'm')
    """
    match = _QUANTITY.fullmatch(text.strip())
    if match is None:
        raise _refusal(text, f"{text[:60]!r} is not a number with an optional unit", "")
    return match["value"], (match["unit"] or "").strip()


def _is_foreign(text: str) -> bool:
    """Tell whether a text has digits other than 0 to 9."""
    return any(character.isdigit() and not character.isascii() and character not in "²³" for character in text)


def _refusal(found: object, reason: str, unit: str) -> InputError:
    return InputError(f"{reason}; allowed: {_allowed(unit)}", found=found, allowed=_allowed(unit))


def _to_float(found: float, unit: str) -> float:
    try:
        return float(found)
    except OverflowError:
        digits = int(found).bit_length() * 30103 // 100000 + 1
        raise _refusal(found, f"a whole number of {digits} digits is too large", unit) from None


def _scaled(value: float, factor: float) -> float:
    """Multiply so that decimal prefixes stay exact: 290 mm is 0.29 m to the last digit."""
    inverse = round(1 / factor) if 0 < factor < 1 else 0
    return value / inverse if inverse and abs(factor * inverse - 1) < 1e-15 else value * factor


#: Factors of the usual spellings, by (written, wanted): pint, slow to import, is then not needed (tested against it).
COMMON_FACTORS = {
    ("m", "m"): 1.0,
    ("cm", "m"): 0.01,
    ("mm", "m"): 0.001,
    ("kg", "kg"): 1.0,
    ("g", "kg"): 0.001,
    ("rad", "rad"): 1.0,
    ("deg", "rad"): 0.017453292519943295,
    ("kg*m^2", "kg*m**2"): 1.0,
    ("N/kg", "m/s**2"): 1.0,
    ("m/s^2", "m/s**2"): 1.0,
    ("m/s", "m/s"): 1.0,
    ("km/h", "m/s"): 1 / 3.6,
}


def _factor(found: str, text: str, unit: str) -> float:
    if (text, unit) in COMMON_FACTORS:
        return COMMON_FACTORS[text, unit]
    return pint_factor(found, text, unit)


def pint_factor(found: str, text: str, unit: str) -> float:
    """Return the factor from a unit as written to the SI unit wanted, by pint (``found`` is for the message).

    >>> pint_factor("12 in", "in", "m")
    0.0254
    """
    import pint  # lazy: heavy

    unknown = _refusal(found, f"{found!r} has an unknown unit {text!r}", unit)
    if not _UNIT_TEXT.fullmatch(text):
        raise unknown
    registry = unit_registry()
    plain = re.sub(r"([A-Za-z])(-?[1-3])", r"\1**\2", text.replace("²", "2").replace("³", "3"))
    plain = plain.replace("·", "*").replace("^", "**")
    try:
        source = registry.parse_units(plain)
        return float(registry.Quantity(1.0, source).to(unit).magnitude)
    except pint.DimensionalityError:
        raise _refusal(found, f"{found!r} has a unit that is {_kind(unit)}", unit) from None
    except (pint.PintError, AttributeError, ValueError):
        raise unknown from None


def _kind(unit: str) -> str:
    kinds = {"m": "no length", "kg": "no mass", "rad": "no angle", "": "not a plain number's"}
    return kinds.get(unit, f"not one of {unit}")


def _allowed(unit: str) -> str:
    if not unit:
        return "a plain number"
    return f"a number in {unit}, or one with a unit that converts to {unit}"
