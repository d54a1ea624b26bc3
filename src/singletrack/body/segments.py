"""The rider's segments as rigid bodies: cylinders, a sphere and a prism of uniform density (Moore et al. 2009)."""

from __future__ import annotations

from dataclasses import dataclass, replace
from math import pi
from typing import TYPE_CHECKING, Any

import numpy as np

from singletrack.arrays import Array, Number, as_arrays, dot, unit_vector
from singletrack.mechanics.rigid import RigidBody, combine
from singletrack.mechanics.solids import cylinder_inertia, gyration_inertia, prism_inertia, sphere_inertia

if TYPE_CHECKING:
    from collections.abc import Sequence

    from singletrack.body.skeleton import Skeleton
    from singletrack.parameters import Rider

__all__ = ["Segment", "rider_segments"]


@dataclass(frozen=True, eq=False)
class Segment(RigidBody):
    """A body segment: a rigid body with its solid's shape, for drawing.

    Attributes
    ----------
    start, end : array, shape (..., 3)
        Ends of the solid's axis in m (for the head, both its centre).
    radius : array, shape (...)
        Of the cylinder or sphere; half the width of the torso, in m.
    """

    start: Array
    end: Array
    radius: Number


def _limbs(mass: Number, circumference: Number, length: Number, ends: Sequence[Array]) -> tuple[Segment, Segment]:
    """Return the right and the left limb, from start to end each: mirror images."""
    _, (mass, radius, length) = as_arrays(mass, circumference / (2 * pi), length)
    inertia = cylinder_inertia(mass, radius, length, unit_vector(ends[1] - ends[0]))
    right, left = (Segment(mass, (start + end) / 2, inertia, start, end, radius) for start, end in (ends[:2], ends[2:]))
    return right, replace(left, inertia=inertia * _MIRROR)


def _straight_arms(rider: Rider, points: Skeleton) -> tuple[Segment, Segment]:
    """Return the right and the left arm as one straight uniform cylinder each, from shoulder to grip."""
    ends = [points[number] for number in (21, 19, 22, 20)]
    line = ends[1] - ends[0]
    xp, (line, upper, lower) = as_arrays(line, rider.upper_arm_length, rider.lower_arm_length)
    around = (rider.upper_arm_circumference * upper + rider.lower_arm_circumference * lower) / (upper + lower)
    mass = (rider.upper_arm_mass_fraction + rider.lower_arm_mass_fraction) * rider.rider_mass
    return _limbs(mass, around, xp.sqrt(dot(line, line)), ends)


def _shaped_straight_arms(rider: Rider, points: Skeleton) -> tuple[Segment, Segment]:
    """Return straight arms of a rider whose arms' shapes are known: both parts in line, as one body."""
    arms = []
    _, (upper, lower) = as_arrays(rider.upper_arm_length, rider.lower_arm_length)
    for start, end in ((21, 19), (22, 20)):
        shoulder, grip = points[start], points[end]
        elbow = shoulder + (upper / (upper + lower))[..., None] * (grip - shoulder)
        parts = []
        for kind, ends in (("upper_arm", (shoulder, elbow)), ("lower_arm", (elbow, grip))):
            fraction, around, length = (
                getattr(rider, f"{kind}_{what}") for what in ("mass_fraction", "circumference", "length")
            )
            part, _ = _limbs(fraction * rider.rider_mass, around, length, [*ends, *ends])
            parts.append(_reshaped(part, kind, rider, unit_vector(grip - shoulder)))
        whole = combine(parts)
        radius = (parts[0].radius * upper + parts[1].radius * lower) / (upper + lower)
        arms.append(Segment(whole.mass, whole.centre, whole.inertia, shoulder, grip, radius))
    return arms[0], arms[1]


def rider_segments(rider: Rider, points: Skeleton, arms: str = "bent") -> dict[str, Segment]:
    """Return the segments of a seated rider, by name, upright and straight ahead.

    Parameters
    ----------
    rider : Rider
    points : Skeleton
        Of this rider on a bicycle.
    arms : {"bent", "straight"}
        Straight: each arm is one uniform cylinder from shoulder to grip with the mass of the whole arm, its radius
        the mean of both parts' weighted by their lengths.

    Returns
    -------
    dict of str to Segment
        ``head, torso`` and ``upper_arm, lower_arm`` (straight: ``arm``), ``upper_leg, lower_leg`` with ``right_`` and
        ``left_`` before.

    Examples
    --------
    >>> from singletrack import load_bicycle, load_rider
    >>> from singletrack.body import skeleton
    >>> bicycle, rider = load_bicycle("stratos"), load_rider("rider-a")
    >>> segments = rider_segments(rider, skeleton(bicycle, rider))
    >>> round(float(sum(segment.mass for segment in segments.values())), 9)
    72.0
    """
    hip, shoulder, mass = points[13], points[15], rider.rider_mass
    width, thickness = rider.torso_section
    _, (head_mass, head_radius, torso_mass, half_width) = as_arrays(
        rider.head_mass_fraction * mass,
        rider.head_circumference / (2 * pi),
        rider.torso_mass_fraction * mass,
        width / 2,
    )
    head = Segment(head_mass, points[25], sphere_inertia(head_mass, head_radius), points[25], points[25], head_radius)
    torso_inertia = prism_inertia(torso_mass, rider.torso_length, width, thickness, unit_vector(shoulder - hip))
    torso = Segment(torso_mass, (hip + shoulder) / 2, torso_inertia, hip, shoulder, half_width)
    segments = {"head": head, "torso": torso}
    straight = arms == "straight"
    if straight:
        shaped = {"upper_arm", "lower_arm"} & set(rider.shapes)
        make = _shaped_straight_arms if shaped else _straight_arms
        segments["right_arm"], segments["left_arm"] = make(rider, points)
    for limb, ends in _LIMB_ENDS.items():
        if straight and "arm" in limb:
            continue
        segments[f"right_{limb}"], segments[f"left_{limb}"] = _limbs(
            getattr(rider, f"{limb}_mass_fraction") * mass,
            getattr(rider, f"{limb}_circumference"),
            getattr(rider, f"{limb}_length"),
            [points[end] for end in ends],
        )
    return {name: _reshaped(segment, name, rider, unit_vector(shoulder - hip)) for name, segment in segments.items()}


def _reshaped(segment: Segment, name: str, rider: Rider, up_torso: Array) -> Segment:
    """Return a segment with its mass spread as the rider's shapes say, if they do."""
    kind = name.removeprefix("right_").removeprefix("left_")
    length: Any
    shape = rider.shapes.get(kind)
    if shape is None:
        return segment
    if kind == "head":
        length, axis = segment.radius, up_torso
        start = segment.centre - length[..., None] * axis
    else:
        axis, start = unit_vector(segment.end - segment.start), segment.start
        _, (length,) = as_arrays(getattr(rider, f"{kind}_length"))
    radii = (shape.gyration_along * length, shape.gyration_sideways * length, shape.gyration_across * length)
    centre = start + (shape.centre * length)[..., None] * axis
    inertia = gyration_inertia(segment.mass, *radii, axis)
    return Segment(segment.mass, centre, inertia, segment.start, segment.end, segment.radius)


# Signs of an inertia tensor's entries in the mirror image of a body.
_MIRROR = np.array([[1.0, -1.0, 1.0], [-1.0, 1.0, -1.0], [1.0, -1.0, 1.0]])
# Skeleton points at the start and end of each limb, right and left.
_LIMB_ENDS = {
    "upper_arm": (21, 23, 22, 24),
    "lower_arm": (23, 19, 24, 20),
    "upper_leg": (30, 28, 31, 29),
    "lower_leg": (28, 26, 29, 27),
}
