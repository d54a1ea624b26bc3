"""The 31 points of bicycle and rider: Table 4 of Schwab and Kooijman (after Moore et al. 2009, Table 10)."""

from __future__ import annotations

from dataclasses import dataclass
from math import pi
from typing import TYPE_CHECKING, Any

from singletrack.arrays import Array, as_arrays, is_concrete, namespace, stack, vector
from singletrack.arrays.faults import Fault, refuse_single
from singletrack.body.limbs import elbow_aside, other_leg, two_link_joint
from singletrack.errors import InputError

if TYPE_CHECKING:
    from singletrack.parameters import Bicycle, Rider

__all__ = ["POINT_NAMES", "Skeleton", "frame_faults", "frame_points", "skeleton"]

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
        """Return the unit normal (..., 3) to the plane of an arm, towards the right.

        Parameters
        ----------
        side : {"right", "left"}

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


def require_geometry(bicycle: Bicycle) -> None:
    """Raise InputError if a bicycle has no frame geometry, with the names that are missing.

    Parameters
    ----------
    bicycle : Bicycle
    """
    missing = bicycle.missing_geometry()
    if missing:
        raise InputError(
            f"{bicycle.name or 'bicycle'}: cannot seat a rider without frame geometry; missing: {', '.join(missing)}",
            parameters=missing,
        )


def frame_points(bicycle: Bicycle) -> dict[int, Array]:
    """Return points 1 to 12 and 16: wheels, frame, stem top.

    By number, each of shape (..., 3), in m, in the bicycle's frame.

    Parameters
    ----------
    bicycle : Bicycle
        With its frame geometry.
    """
    values = {name: value for name, value in bicycle.values().items() if "mass" not in name and "inertia" not in name}
    xp, arrays = as_arrays(*values.values())
    b: dict[str, Any] = dict(zip(values, arrays, strict=True))
    rear, front = b["rear_wheel_radius"], b["front_wheel_radius"]
    sin, cos = xp.sin(b["steer_axis_tilt"]), xp.cos(b["steer_axis_tilt"])
    seat_cos, seat_sin = xp.cos(b["seat_tube_angle"]), xp.sin(b["seat_tube_angle"])

    p: dict[int, Array] = {1: vector(0.0, 0.0, 0.0), 2: vector(0.0, 0.0, -rear)}
    p[3], p[4] = (p[2] + vector(0.0, side * b["rear_hub_width"] / 2, 0.0) for side in (1, -1))
    drop = rear - b["bottom_bracket_height"]
    p[5] = vector(other_leg(xp, b["chain_stay_length"], drop), 0.0, -b["bottom_bracket_height"])
    p[6] = vector(b["wheel_base"], 0.0, 0.0)
    p[7] = p[6] + vector(0.0, 0.0, -front)
    p[8], p[9] = (p[7] + vector(0.0, side * b["front_hub_width"] / 2, 0.0) for side in (1, -1))
    up_seat_tube = vector(-seat_cos, 0.0, -seat_sin)
    p[10] = p[5] + b["seat_tube_length"][..., None] * up_seat_tube
    # The head tube angle is 90 deg minus the steer axis tilt: its cosine is the tilt's sine.
    offset = front * sin - b["trail"] * cos
    along = other_leg(xp, b["fork_length"], offset)
    p[11] = p[7] + vector(-offset * cos - along * sin, 0.0, offset * sin - along * cos)
    p[12] = vector(p[11][..., 0] - (p[11][..., 2] - p[10][..., 2]) * sin / cos, 0.0, p[10][..., 2])
    p[13] = p[10] + b["seat_post_length"][..., None] * up_seat_tube
    p[16] = p[12] + vector(-b["stem_length"] * sin, 0.0, -b["stem_length"] * cos)
    # Still in the middle: how far apart the grips are may be the rider's matter.
    p[19] = p[16] + vector(-b["handlebar_length"], 0.0, b.get("handlebar_drop", 0.0))
    return p


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
    p[14], leg = two_link_joint(hip, bracket, rider.upper_leg_length, rider.lower_leg_length, 1.0, "leg")
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
        elbow, arm = two_link_joint(p[15], grip, rider.upper_arm_length, rider.lower_arm_length, -1.0, "arm")
        p[23], p[24] = elbow + right_shoulder, elbow + left_shoulder
    else:
        p[23], axis, arm = elbow_aside(p[21], p[19], rider)
        p[24] = p[23] * vector(1.0, -1.0, 1.0)
    p[25] = p[15] + head[..., None] * up_torso
    p[26], p[27] = bracket + right_hip, bracket + left_hip
    p[28], p[29] = p[14] + right_hip, p[14] + left_hip
    p[30], p[31] = hip + right_hip, hip + left_hip
    return p, axis, [fault for fault in (*frame_faults(frame, bicycle), *leg, *arm) if is_concrete(fault.bad)]


def frame_faults(frame: dict[int, Array], bicycle: Bicycle) -> list[Fault]:
    """Return faults of frame geometry: tubes too short to span their distance.

    Parameters
    ----------
    frame : dict of int to array, shape (..., 3)
        As :func:`frame_points` makes them.
    bicycle : Bicycle
    """
    xp = namespace(frame[5], frame[11])
    drop = bicycle.rear_wheel_radius - bicycle.bottom_bracket_height
    return [
        Fault(
            xp.isnan(frame[5][..., 0]),
            "chain_stay_length = {chain_stay_length:.4f} m does not span the height {drop:.4f} m "
            "between rear hub and bottom bracket, must be more",
            {"chain_stay_length": bicycle.chain_stay_length, "drop": xp.abs(drop)},
            InputError,
            ("chain_stay_length",),
            "more than the height between rear hub and bottom bracket",
        ),
        Fault(
            xp.isnan(frame[11][..., 0]),
            "fork_length = {fork_length:.4f} m is less than the offset of the front hub from the steer "
            "axis, must be more",
            {"fork_length": bicycle.fork_length},
            InputError,
            ("fork_length",),
            "more than the offset of the front hub from the steer axis",
        ),
    ]
