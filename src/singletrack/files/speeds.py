"""Forward speeds, and ranges of parameters, as people type them."""

from __future__ import annotations

import re

import numpy as np

from singletrack.errors import InputError
from singletrack.parameters.units import parse_quantity

__all__ = ["parse_range", "parse_speeds"]

_MOST = 1_000_000
_ALLOWED = (
    "must be START:STOP:COUNT in m/s with 0 <= START < STOP and 2 <= COUNT <= 1000000, or one speed, or a list "
    'such as "4, 6, 8"; with a unit where it is another: "5 km/h:40 km/h:8"'
)


def parse_speeds(text: str, name: str = "--speeds") -> np.ndarray:
    """Return the speeds (n,) in m/s that START:STOP:COUNT, a single value or a list stands for.

    Parameters
    ----------
    text : str
        Each number may have a unit of speed.
    name : str
        What the text was given for, for the message.

    Raises
    ------
    InputError
        If the text is nothing of the kind, or a speed is negative or not finite.

    Examples
    --------
    >>> parse_speeds("0:10:5").tolist(), parse_speeds("18 km/h, 6").tolist()
    ([0.0, 2.5, 5.0, 7.5, 10.0], [5.0, 6.0])
    """
    wrong = f"{name} {text[:80]!r}: {_ALLOWED}"
    parts = text.split(":")
    if len(parts) == 1:
        cells = text.split(",")
        if len(cells) > _MOST:
            raise _refused(wrong, text)
        return np.array([_speed(cell, name, wrong, text) for cell in cells])
    count = parts[2].strip() if len(parts) == 3 else ""
    if not re.fullmatch(r"[0-9]{1,7}", count):  # no digits of other scripts, no underscores
        raise _refused(wrong, text)
    start, stop = (_speed(part, name, wrong, text) for part in parts[:2])
    if not start < stop or not 2 <= int(count) <= _MOST:
        raise _refused(wrong, text)
    return np.linspace(start, stop, int(count))


def parse_range(text: str, unit: str) -> np.ndarray:
    """Return the numbers (n,) in SI that START:STOP:COUNT stands for.

    Parameters
    ----------
    text : str
        START and STOP may have a unit.
    unit : str
        The SI unit wanted, as pint writes it.

    Raises
    ------
    InputError
        If the text is nothing of the kind.

    Examples
    --------
    >>> parse_range("40mm:80 mm:3", "m").tolist()
    [0.04, 0.06, 0.08]
    """
    parts = text.split(":")
    if len(parts) != 3 or not re.fullmatch(r"[0-9]{1,4}", parts[2].strip()) or int(parts[2]) < 2:
        raise InputError(f"{text[:80]!r}: must be START:STOP:COUNT with a COUNT from 2 to 9999, e.g. 40mm:80mm:9")
    start, stop = (parse_quantity(part.strip(), unit).value for part in parts[:2])
    if not np.isfinite([start, stop]).all() or start == stop:
        raise InputError(f"{text[:80]!r}: START and STOP must be finite and differ")
    return np.linspace(start, stop, int(parts[2]))


def _speed(cell: str, name: str, wrong: str, text: str) -> float:
    try:
        quantity = parse_quantity(cell.strip(), "m/s")
    except InputError as error:
        raise _refused(f"{name}: {error.reason}" if cell.strip() else wrong, text) from None
    if not np.isfinite(quantity.value) or quantity.deviation is not None:
        raise _refused(wrong, text)
    if quantity.value < 0:
        reason = f"{name}: found {quantity.value:g} m/s, must be zero or more (modes are named for riding forward)"
        raise _refused(reason, text)
    return quantity.value


def _refused(reason: str, text: str) -> InputError:
    return InputError(reason, parameters=("speeds",), found=text, allowed=_ALLOWED)
