"""The 31 points of bicycle and rider: Table 4 of Schwab and Kooijman (after Moore et al. 2009, Table 10)."""

from __future__ import annotations

from dataclasses import dataclass
from math import pi
from typing import TYPE_CHECKING

from singletrack.arrays import Array, as_arrays, cross, dot, is_concrete, stack, unit_vector, vector
from singletrack.arrays.faults import Fault, refuse_single
from singletrack.errors import PostureError

if TYPE_CHECKING:
    from singletrack.parameters import Bicycle, Rider

__all__ = ["POINT_NAMES", "Skeleton", "skeleton"]

#: What the points 1 to 31 are. Right is positive y; the table's own comment calls points 21 and 23 left.
POINT_NAMES = (
    "rear contact",
    "rear hub",
    "rear hub, right end",
    "rear hub, left end",
    "bottom bracket",
    "front contact",
    "front hub",
    "front hub, right end",
    "front hub, left end",
    "seat tube top",
    "fork crown",
    "head tube top",
    "hip centre",
    "knee centre",
    "shoulder centre",
    "stem top",
    "handlebar, right end",
    "handlebar, left end",
    "right grip",
    "left grip",
    "right shoulder",
    "left shoulder",
    "right elbow",
    "left elbow",
    "head",
    "right foot",
    "left foot",
    "right knee",
    "left knee",
    "right hip",
    "left hip",
)


@dataclass(frozen=True, eq=False)
class Skeleton:
    """The points of a rider seated on a bicycle.

    Attributes
    ----------
    points : array, shape (..., 31, 3)
        In m, in the bicycle's frame; NaN where a limb does not reach.
    faults : tuple of Fault
        Designs of a batch whose limbs do not reach.
    right_elbow_axis : array, shape (..., 3), optional
        Unit normal to the plane of the right arm, towards the right; None: y, both arms in planes x-z.
    """

    points: Array
    faults: tuple[Fault, ...] = ()
    right_elbow_axis: Array | None = None

    def __getitem__(self, number: int) -> Array:
        """Return point ``number`` (1 to 31, as in the table), shape (..., 3), in m."""
        return self.points[..., number - 1, :]

    def elbow_axis(self, side: str) -> Array:
        """Return the unit normal (..., 3) to the plane of the ``right`` or ``left`` arm, towards the right.

        Parameters
        ----------
        side : str
            ``right`` or ``left``.

        Examples
        --------
        >>> from singletrack import load_bicycle, load_rider
        >>> skeleton(load_bicycle("stratos"), load_rider("rider-a")).elbow_axis("left").tolist()
        [0.0, 1.0, 0.0]
        """
        axis = self.right_elbow_axis
        if axis is None:
            return vector(0.0, 1.0, 0.0)
        return axis if side == "right" else axis * vector(-1.0, 1.0, -1.0)


def skeleton(bicycle: Bicycle, rider: Rider) -> Skeleton:
    """Seat a rider on a bicycle.

    Parameters
    ----------
    bicycle : Bicycle
        With frame geometry.
    rider : Rider
        With a forward lean angle on this bicycle.

    Raises
    ------
    InputError
        If the bicycle has no frame geometry (the missing names are listed) or the rider no forward lean angle.
    PostureError
        If arms or legs of a single design do not reach; a batch keeps the others and lists the faults.

    Examples
    --------
    >>> from singletrack import load_bicycle, load_rider
    >>> skeleton(load_bicycle("stratos"), load_rider("rider-a"))[13].round(4).tolist()
    [0.2677, 0.0, -0.942]
    """
    require_geometry(bicycle)
    rider = rider.on(bicycle)
    frame = frame_points(bicycle)
    body, elbow_axis, faults = _rider_points(frame, bicycle, rider)
    points = frame | body
    where = " on ".join(name for name in (rider.name, bicycle.name) if name)
    return Skeleton(stack([points[number] for number in range(1, 32)], -2), refuse_single(faults, where), elbow_axis)


def _rider_points(
    frame: dict[int, Array], bicycle: Bicycle, rider: Rider
) -> tuple[dict[int, Array], Array | None, list[Fault]]:
    """Return points 13 to 31 but the stem top, the right elbow's axis, and the limbs that do not reach."""
    xp, (torso, lean, shoulders, hips, head) = as_arrays(
        rider.torso_length,
        rider.forward_lean_angle,
        rider.shoulder_to_shoulder,
        rider.hip_joint_to_hip_joint,
        rider.head_circumference / (2 * pi),
    )
    p: dict[int, Array] = {}
    up_torso = vector(xp.cos(lean), 0.0, -xp.sin(lean))
    p[15] = frame[13] + torso[..., None] * up_torso
    grip = frame[19]
    bracket, hip = frame[5], frame[13]
    p[14], leg = _two_link_joint(hip, bracket, rider.upper_leg_length, rider.lower_leg_length, 1.0, "leg")
    right_shoulder, left_shoulder = (vector(0.0, side * shoulders / 2, 0.0) for side in (1, -1))
    right_hip, left_hip = (vector(0.0, side * hips / 2, 0.0) for side in (1, -1))
    right_end, left_end = right_shoulder, left_shoulder
    if bicycle.handlebar_width is not None:
        _, (width,) = as_arrays(bicycle.handlebar_width)
        right_end, left_end = (vector(0.0, side * width / 2, 0.0) for side in (1, -1))
    p[17], p[18] = frame[16] + right_end, frame[16] + left_end
    p[19], p[20] = grip + right_end, grip + left_end
    p[21], p[22] = p[15] + right_shoulder, p[15] + left_shoulder
    axis = None
    if bicycle.handlebar_width is None and rider.elbow_drop_angle is None:
        elbow, arm = _two_link_joint(p[15], grip, rider.upper_arm_length, rider.lower_arm_length, -1.0, "arm")
        p[23], p[24] = elbow + right_shoulder, elbow + left_shoulder
    else:
        p[23], axis, arm = _elbow_aside(p[21], p[19], rider)
        p[24] = p[23] * vector(1.0, -1.0, 1.0)
    p[25] = p[15] + head[..., None] * up_torso
    p[26], p[27] = bracket + right_hip, bracket + left_hip
    p[28], p[29] = p[14] + right_hip, p[14] + left_hip
    p[30], p[31] = hip + right_hip, hip + left_hip
    return p, axis, [fault for fault in (*frame_faults(frame, bicycle), *leg, *arm) if is_concrete(fault.bad)]


def _two_link_joint(
    start: Array, end: Array, first: Array, second: Array, bend: float, limb: str
) -> tuple[Array, list[Fault]]:
    """Return the joint (..., 3) of a limb of two links in the x-z plane, bent to one side, and where it fails."""
    across = end - start
    xp, (dx, dz) = as_arrays(across[..., 0], across[..., 2])
    distance = xp.sqrt(dx**2 + dz**2)
    along, aside, faults = _two_links(distance, first, second, limb)
    aside = bend * aside
    joint = start + vector((along * dx + aside * dz) / distance, 0.0, (along * dz - aside * dx) / distance)
    return joint, faults


def _elbow_aside(shoulder: Array, grip: Array, rider: Rider) -> tuple[Array, Array, list[Fault]]:
    """Return the right elbow and its axis (..., 3) where the arm may leave the plane x-z, and where it fails.

    The elbow lies on a circle about the line from shoulder to grip: hanging down, in the vertical plane through the
    line, or turned outwards from there as the elbow drop angle says.
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


def _two_links(distance: Array, first: Array, second: Array, limb: str) -> tuple[Array, Array, list[Fault]]:
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
