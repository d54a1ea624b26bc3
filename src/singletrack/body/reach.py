"""How far the limbs of a seated rider are stretched."""

from __future__ import annotations

from typing import TYPE_CHECKING

from singletrack.arrays import Array, as_arrays, dot
from singletrack.body.skeleton import Skeleton, skeleton
from singletrack.parameters.plausibility import Oddity

if TYPE_CHECKING:
    from collections.abc import Mapping

    from singletrack.arrays import Number
    from singletrack.parameters import Bicycle, Rider

__all__ = ["reach", "reach_oddities", "seat_oddities"]

# The paper's Rider A rides the Stratos with arms stretched to 0.9946 of their length.
_STRETCHED = 0.997
# End points of each limb and the two lengths between.
_LIMBS = {
    "arm": (21, 19, "upper_arm_length", "lower_arm_length"),
    "leg": (13, 5, "upper_leg_length", "lower_leg_length"),
}


def reach(points: Skeleton, rider: Rider) -> dict[str, Array]:
    """Return for ``arm`` and ``leg`` the distance that is spanned as a fraction of the limb's length, shape (...).

    Parameters
    ----------
    points : Skeleton
        The seated rider's joints.
    rider : Rider
        Whose limbs' lengths are compared with.

    Examples
    --------
    >>> from singletrack import load_bicycle, load_rider
    >>> bicycle, rider = load_bicycle("stratos"), load_rider("rider-a")
    >>> round(float(reach(skeleton(bicycle, rider), rider)["arm"]), 3)
    0.995
    """
    found = {}
    for limb, (start, end, first, second) in _LIMBS.items():
        xp, (span, length) = as_arrays(points[end] - points[start], getattr(rider, first) + getattr(rider, second))
        found[limb] = xp.sqrt(dot(span, span)) / length
    return found


def seat_oddities(bicycle: Bicycle, rider: Rider) -> tuple[Oddity, ...]:
    """Return what looks odd about a rider on a bicycle: limbs that barely reach.

    Raises
    ------
    PostureError
        If they do not reach at all.

    Examples
    --------
    >>> from singletrack import load_bicycle, load_rider
    >>> seat_oddities(load_bicycle("stratos"), load_rider("rider-a"))
    ()
    """
    return reach_oddities(reach(skeleton(bicycle, rider), rider))


def reach_oddities(shares: Mapping[str, Number]) -> tuple[Oddity, ...]:
    """Return what looks odd about how far limbs are stretched.

    Parameters
    ----------
    shares : mapping of str to number
        Of a single design, as :func:`reach` gives them.
    """
    targets = {"arm": "grip", "leg": "pedal"}
    return tuple(
        Oddity(
            "forward_lean_angle" if limb == "arm" else "seat_post_length",
            f"the {targets[limb]} is barely within reach: the {limb} is stretched to {float(share):.1%} of its length",
            float(share),
            f"a limb stretched to at most {_STRETCHED:.1%} of its length",
        )
        for limb, share in shares.items()
        if share > _STRETCHED
    )
