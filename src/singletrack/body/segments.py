"""The rider's segments as rigid bodies: cylinders, a sphere and a prism of uniform density (Moore et al. 2009)."""

from __future__ import annotations

from dataclasses import dataclass
from math import pi
from typing import TYPE_CHECKING

from singletrack.arrays import Array, as_arrays, unit_vector
from singletrack.mechanics.rigid import Body
from singletrack.mechanics.solids import cylinder_inertia, gyration_inertia, prism_inertia, sphere_inertia

if TYPE_CHECKING:
    from collections.abc import Sequence

    from singletrack.body.skeleton import Skeleton
    from singletrack.parameters import Rider

__all__ = ["Segment", "rider_segments"]


@dataclass(frozen=True, eq=False)
class Segment(Body):
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
    radius: Array


def _limbs(mass: Array, circumference: Array, length: Array, ends: Sequence[Array]) -> tuple[Segment, Segment]:
    """Return the right and the left limb, from start to end each: mirror images, so parallel, of one inertia."""
    _, (mass, radius, length) = as_arrays(mass, circumference / (2 * pi), length)
    inertia = cylinder_inertia(mass, radius, length, unit_vector(ends[1] - ends[0]))
    right, left = (Segment(mass, (start + end) / 2, inertia, start, end, radius) for start, end in (ends[:2], ends[2:]))
    return right, left


def rider_segments(rider: Rider, points: Skeleton) -> dict[str, Segment]:
    """Return the ten segments of a seated rider, by name, upright and straight ahead.

    Parameters
    ----------
    rider : Rider
    points : Skeleton
        Of this rider on a bicycle.

    Returns
    -------
    dict of str to Segment
        ``head, torso`` and ``upper_arm, lower_arm, upper_leg, lower_leg`` with ``right_`` and ``left_`` before.

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
    _, (head_mass, head_radius, torso_mass, half_width) = as_arrays(
        rider.head_mass_fraction * mass,
        rider.head_circumference / (2 * pi),
        rider.torso_mass_fraction * mass,
        rider.torso_width / 2,
    )
    head = Segment(head_mass, points[25], sphere_inertia(head_mass, head_radius), points[25], points[25], head_radius)
    torso_inertia = prism_inertia(
        torso_mass, rider.torso_length, rider.torso_width, rider.torso_thickness, unit_vector(shoulder - hip)
    )
    torso = Segment(torso_mass, (hip + shoulder) / 2, torso_inertia, hip, shoulder, half_width)
    segments = {"head": head, "torso": torso}
    for limb, ends in _LIMB_ENDS.items():
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


# Skeleton points at the start and end of each limb, right and left.
_LIMB_ENDS = {
    "upper_arm": (21, 23, 22, 24),
    "lower_arm": (23, 19, 24, 20),
    "upper_leg": (30, 28, 31, 29),
    "lower_leg": (28, 26, 29, 27),
}
