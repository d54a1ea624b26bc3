"""What people call things that our records give in another way, and how to give them."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from singletrack.errors import InputError, unknown

if TYPE_CHECKING:
    from collections.abc import Iterable

__all__ = ["unknown_parameter"]

_TRAIL = "give trail = (front_wheel_radius * sin(steer_axis_tilt) - fork offset) / cos(steer_axis_tilt)"
#: What geometry sheets and other programs say (as written there, without blanks, dashes and underscores), and what to
#: give instead.
_OTHERWISE = {
    **dict.fromkeys(
        ("headangle", "headtubeangle", "headtube", "hta", "ha", "steeringangle", "steeraxisangle"),
        "give steer_axis_tilt = 90 deg - head angle",
    ),
    **dict.fromkeys(("forkoffset", "forkrake", "rake", "offset"), _TRAIL),
    **dict.fromkeys(
        ("mechanicaltrail", "normaltrail", "steeringarm"),
        "give trail = mechanical trail / cos(steer_axis_tilt), which is along the ground",
    ),
    **dict.fromkeys(("wheelbase", "wb"), "wheel_base"),
    **dict.fromkeys(
        ("frontcenter", "frontcentre"),
        "give wheel_base = front centre, horizontally + sqrt(chain_stay_length^2 - (rear_wheel_radius - "
        "bottom_bracket_height)^2)",
    ),
    **dict.fromkeys(
        ("stack", "reach"),
        "stack and reach say where the head tube ends; give fork_length, seat_tube_length, stem_length along the steer "
        "axis and handlebar_length, which say where the hands are",
    ),
    **dict.fromkeys(("bbdrop", "bottombracketdrop"), "give bottom_bracket_height = rear_wheel_radius - drop"),
    **dict.fromkeys(("bbheight", "bottombracket"), "bottom_bracket_height"),
    **dict.fromkeys(("chainstay", "chainstaylength", "rearcenter", "rearcentre"), "chain_stay_length"),
    **dict.fromkeys(
        ("seatangle", "seattube", "sta"), "give seat_tube_angle (from the ground) or seat_tube_length (its length)"
    ),
    **dict.fromkeys(("axletocrown", "axlecrown", "a2c"), "fork_length"),
    **dict.fromkeys(
        ("wheeldiameter", "wheelsize", "tyresize", "tiresize", "wheelradius"),
        "give rear_wheel_radius and front_wheel_radius, hub to ground",
    ),
}


def unknown_parameter(kind: str, name: str, known: Iterable[str]) -> InputError:
    """Return the error for a parameter that a record has not; where it has another for the same, that is said.

    Parameters
    ----------
    kind : str
        Of the record; "" for either.
    name : str
    known : iterable of str
        The parameters it has.

    Examples
    --------
    >>> print(unknown_parameter("bicycle", "head_angle", ["seat_tube_angle", "steer_axis_tilt"]))
    unknown bicycle parameter 'head_angle'; give steer_axis_tilt = 90 deg - head angle
    """
    known, what = list(known), f"{kind} parameter".strip()
    otherwise = _OTHERWISE.get(re.sub(r"[\s_-]", "", name[:80].lower())) if kind != "rider" else None
    if otherwise is None:
        return unknown(what, name, known)
    advice = f"did you mean {otherwise}?" if otherwise in known else otherwise
    text = f"unknown {what} {name[:80]!r}; {advice}"
    return InputError(text, parameters=(name,), found=name, allowed=tuple(known))
