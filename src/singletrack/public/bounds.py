"""Numbers of a ride or a turn: finite, and no further out than anything that is ridden."""

from __future__ import annotations

import numpy as np

from singletrack.errors import InputError

__all__ = ["MOST", "within"]

#: By name: the largest size, and its unit. Beyond, numbers overflow on the way.
MOST: dict[str, tuple[float, str]] = {
    "speed": (1e3, "m/s"),
    "push": (1e3, "rad/s"),
    "lean": (1.5, "rad"),
    "radius": (1e6, "m"),
    "duration": (1e5, "s"),
}


def within(name: str, value: float) -> float:
    """Return a number in double precision; raise InputError where it is none, or beyond its bounds.

    Parameters
    ----------
    name : str
        One of :data:`MOST`.
    value : float
        A single real number of any precision.

    Examples
    --------
    >>> within("speed", 5)
    5.0
    >>> within("speed", 1e308)
    Traceback (most recent call last):
    singletrack.errors.InputError: speed: found 1e+308 m/s, must be a number from -1000 to 1000 m/s
    """
    most, unit = MOST[name]
    number = np.asarray(value)
    real = number.dtype.kind in "iuf" and number.ndim == 0 and not isinstance(value, np.ma.MaskedArray)
    if real and abs(float(number)) <= most:
        return float(number)
    allowed = f"a number from -{most:g} to {most:g} {unit}"
    found = f"{float(number):g} {unit}" if real else repr(value)[:80].partition("\n")[0]
    text = f"{name}: found {found}, must be {allowed}"
    raise InputError(text, parameters=(name,), found=value, allowed=allowed)
