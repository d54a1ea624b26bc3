"""Numbers with a standard deviation, ``0.0686+/-0.0017``, as the files of this field write them."""

from __future__ import annotations

import math
import re

from singletrack.errors import InputError
from singletrack.parameters.units import Quantity

__all__ = ["format_number", "parse_number"]

_NUMBER = r"[+-]?(?:[0-9]++\.?[0-9]*+|\.[0-9]++)(?:[eE][+-]?[0-9]++)?"  # no digits of other scripts
_ONE = re.compile(rf"\s*(?P<value>{_NUMBER})\s*(?:(?:\+/-|±|\+-)\s*(?P<deviation>{_NUMBER})\s*)?")
_LONGEST = 1000
#: A whole number, a comma, a digit: 1,5 is more likely one number than two.
_DECIMAL_COMMA = re.compile(r"(?<![0-9.])[0-9]{1,20},[0-9]")


def parse_number(text: str) -> Quantity:
    """Return a number with its standard deviation; of several, separated by commas, their mean.

    Parameters
    ----------
    text : str

    Raises
    ------
    InputError
        If it is no such thing, or not finite.

    Examples
    --------
    >>> parse_number("0.0686+/-0.0017")
    Quantity(value=0.0686, deviation=0.0017)
    >>> parse_number("1.0, 3.0").value
    2.0
    >>> parse_number("10, 10, 13").value
    11.0
    >>> parse_number("nan")
    Traceback (most recent call last):
    ...
    singletrack.errors.InputError: found 'nan', must be a finite number such as 0.0686 or 0.0686+/-0.0017
    """
    if not text.strip():
        raise InputError("has no value, must be a number such as 0.0686 or 0.0686+/-0.0017")
    if _DECIMAL_COMMA.search(text):
        raise InputError(
            f"found {text.strip()[:60]!r}, must have a decimal point (commas with a space separate values to average)"
        )
    matches = [_ONE.fullmatch(part) for part in text.split(",")] if len(text) <= _LONGEST else [None]
    found = [(match["value"], match["deviation"]) for match in matches if match is not None]
    values = [float(value) for value, _ in found]
    deviations = [0.0 if deviation is None else float(deviation) for _, deviation in found]
    if len(found) < len(matches) or not all(map(math.isfinite, (*values, *deviations))) or min(deviations) < 0:
        raise InputError(f"found {text.strip()[:60]!r}, must be a finite number such as 0.0686 or 0.0686+/-0.0017")
    known = any(deviation is not None for _, deviation in found)
    count = len(values)
    return Quantity(math.fsum(values) / count, math.hypot(*deviations) / count if known else None)


def format_number(value: float, deviation: float | None = None, separator: str = "+/-") -> str:
    """Return the shortest text that reads back as the same double.

    Parameters
    ----------
    value, deviation : float
        Of any unit.
    separator : str
        Between them.

    Examples
    --------
    >>> format_number(0.0686, 0.0017)
    '0.0686+/-0.0017'
    """
    number = repr(float(value))
    return number if deviation is None else f"{number}{separator}{float(deviation)!r}"
