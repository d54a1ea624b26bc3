"""What people call things that our records give in another way, and how to give them."""

from __future__ import annotations

from typing import TYPE_CHECKING

from singletrack.errors import InputError, unknown

if TYPE_CHECKING:
    from collections.abc import Iterable

__all__ = ["unknown_parameter"]

_TILT = "give steer_axis_tilt = 90 deg - head angle"
_TRAIL = "give trail = (front_wheel_radius * sin(steer_axis_tilt) - fork offset) / cos(steer_axis_tilt)"
_OTHERWISE = {
    **dict.fromkeys(("head_angle", "head_tube_angle", "headangle", "head_tube", "steering_angle"), _TILT),
    **dict.fromkeys(("fork_offset", "fork_rake", "rake", "offset"), _TRAIL),
}


def unknown_parameter(kind: str, name: str, known: Iterable[str]) -> InputError:
    """Return the error for a parameter that a record has not; where it has another for the same, that is said.

    Parameters
    ----------
    kind : str
        Of the record.
    name : str
    known : iterable of str
        The parameters it has.

    Examples
    --------
    >>> print(unknown_parameter("bicycle", "head_angle", ["seat_tube_angle", "steer_axis_tilt"]))
    unknown bicycle parameter 'head_angle'; give steer_axis_tilt = 90 deg - head angle
    """
    known = list(known)
    otherwise = _OTHERWISE.get(name.lower().replace("-", "_")) if kind != "rider" else None
    if otherwise is None:
        return unknown(f"{kind} parameter", name, known)
    text = f"unknown {kind} parameter {name[:80]!r}; {otherwise}"
    return InputError(text, parameters=(name,), found=name, allowed=tuple(known))
