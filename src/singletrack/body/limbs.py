"""Limbs of two links: where knee and elbow are, and whether the limb reaches."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from singletrack.arrays import Array, Number, as_arrays, cross, dot, is_concrete, unit_vector, vector
from singletrack.arrays.faults import Fault
from singletrack.errors import PostureError

if TYPE_CHECKING:
    from singletrack.parameters import Rider

__all__ = ["elbow_aside", "other_leg", "two_link_joint"]


def other_leg(xp: Any, hypotenuse: Number, leg: Number) -> Array:
    """Return the other leg (...) of a right triangle, NaN where there is none.

    Parameters
    ----------
    xp : namespace
    hypotenuse, leg : array, shape (...)
    """
    square = hypotenuse**2 - leg**2
    return xp.sqrt(xp.where(xp.real(square) < 0, xp.nan, square) if is_concrete(square) else square)


def two_link_joint(
    start: Array, end: Array, first: Number, second: Number, bend: float, limb: str
) -> tuple[Array, list[Fault]]:
    """Return the joint (..., 3) of a limb of two links in the x-z plane, bent to one side, and where it fails.

    Parameters
    ----------
    start, end : array, shape (..., 3)
        In m.
    first, second : array, shape (...)
        Lengths of the links in m.
    bend : float
        1 or -1: to which side of the line from start to end.
    limb : {"arm", "leg"}
        For messages.
    """
    across = end - start
    xp, (dx, dz) = as_arrays(across[..., 0], across[..., 2])
    distance = xp.sqrt(dx**2 + dz**2)
    along, aside, faults = _two_links(distance, first, second, limb)
    aside = bend * aside
    joint = start + vector((along * dx + aside * dz) / distance, 0.0, (along * dz - aside * dx) / distance)
    return joint, faults


def elbow_aside(shoulder: Array, grip: Array, rider: Rider) -> tuple[Array, Array, list[Fault]]:
    """Return the right elbow and its axis (..., 3) where the arm may leave the plane x-z, and where it fails.

    The elbow lies on a circle about the line from shoulder to grip: hanging down, in the vertical plane through the
    line, or turned outwards from there as the elbow drop angle says.

    Parameters
    ----------
    shoulder, grip : array, shape (..., 3)
        The right ones, in m.
    rider : Rider
    """
    line = grip - shoulder
    xp, (line,) = as_arrays(line)
    distance = xp.sqrt(dot(line, line))
    along, aside, faults = _two_links(distance, rider.upper_arm_length, rider.lower_arm_length, "arm")
    ahead = line / distance[..., None]
    forward = xp.where(xp.real(ahead[..., 0]) < 0, -1.0, 1.0)
    out = unit_vector(vector(-forward * ahead[..., 1], forward * ahead[..., 0], 0.0))
    down = cross(ahead, out)
    if rider.elbow_drop_angle is not None:
        _, (drop,) = as_arrays(rider.elbow_drop_angle)
        sin, cos = xp.sin(drop)[..., None], xp.cos(drop)[..., None]
        down, out = sin * down + cos * out, sin * out - cos * down
    return shoulder + along[..., None] * ahead + aside[..., None] * down, out, faults


def _two_links(distance: Number, first: Number, second: Number, limb: str) -> tuple[Array, Array, list[Fault]]:
    """Return how far along a distance the joint of two links lies, and how far aside, and where they do not reach."""
    xp, (distance, first, second) = as_arrays(distance, first, second)
    # No angles, so that it is cheap and analytic.
    along = (distance**2 + first**2 - second**2) / (2 * distance)
    aside = other_leg(xp, first, along)
    distance, first, second = (xp.real(length) for length in (distance, first, second))
    ends, names = _LIMBS[limb]
    found = {"distance": distance, "reach": first + second, "least": xp.abs(first - second)}
    text = f"the {ends} distance is {{distance:.4f}} m, but the {limb} ({' + '.join(names)}) "
    too_far, too_near = distance > first + second, distance < xp.abs(first - second)
    return (
        along,
        aside,
        [
            Fault(too_far, text + "reaches only {reach:.4f} m", found, PostureError, names, "within reach"),
            Fault(too_near, text + "cannot fold below {least:.4f} m", found, PostureError, names, "within reach"),
        ],
    )


_LIMBS = {
    "arm": ("shoulder-grip", ("upper_arm_length", "lower_arm_length")),
    "leg": ("hip-bracket", ("upper_leg_length", "lower_leg_length")),
}
