"""Numbers of a ride or a turn: finite, and no further out than anything that is ridden."""

from __future__ import annotations

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


def within(**values: float | None) -> None:
    """Raise InputError for the first of these that is beyond its bounds, or not finite; None is nothing.

    Parameters
    ----------
    values
        By the names of :data:`MOST`.

    Examples
    --------
    >>> within(speed=5.0, radius=None)
    >>> within(speed=1e308)
    Traceback (most recent call last):
    singletrack.errors.InputError: speed: found 1e+308 m/s, must be a number from -1000 to 1000 m/s
    """
    for name, value in values.items():
        most, unit = MOST[name]
        if value is not None and not abs(value) <= most:
            allowed = f"a number from -{most:g} to {most:g} {unit}"
            text = f"{name}: found {value:g} {unit}, must be {allowed}"
            raise InputError(text, parameters=(name,), found=value, allowed=allowed)
