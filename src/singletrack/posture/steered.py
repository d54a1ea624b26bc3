"""The skeleton with the handlebar turned and free joints moved, for drawing."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from singletrack.arrays import Array, as_arrays, cross, stack
from singletrack.posture.motion import designs_last, rider_motion
from singletrack.posture.seated import steer_axis

if TYPE_CHECKING:
    from singletrack.parameters import Bicycle
    from singletrack.posture.seated import Posture

__all__ = ["steered_skeleton"]

#: Points of the front frame, and the segments on which each of the rider's points may lie.
_FRONT_POINTS = (6, 7, 8, 9, 11, 12, 16, 17, 18, 19, 20)
_SEGMENTS_OF_POINT = {
    13: (),
    15: ("torso",),
    21: ("torso",),
    22: ("torso",),
    25: ("head",),
    23: ("right_upper_arm", "right_arm"),
    24: ("left_upper_arm", "left_arm"),
    26: ("right_lower_leg",),
    27: ("left_lower_leg",),
    28: ("right_upper_leg",),
    29: ("left_upper_leg",),
}


def steered_skeleton(posture: Posture, bicycle: Bicycle, steer: Array) -> Array:
    """Return the skeleton points (..., 31, 3) in m at a steer angle (...) in rad, exact to second order.

    Points of the rider's moving segments follow their joints, points of the front frame turn about the steer axis.

    Examples
    --------
    A hand stays on its grip, up to terms of third order:

    >>> import numpy as np
    >>> from singletrack import load_bicycle, load_rider
    >>> from singletrack.posture import seat
    >>> bicycle = load_bicycle("browser")
    >>> steered_skeleton(seat(bicycle, load_rider("rider-a"), "upright"), bicycle, np.array(0.1)).shape
    (31, 3)
    """
    foot, axis = steer_axis(bicycle)
    _, (angle,) = as_arrays(steer)
    carried = posture.carried_by or {}
    joint_of = {}
    for point, segments in _SEGMENTS_OF_POINT.items():
        joint_of[point] = next((carried[name] for name in segments if name in carried), "")
    first, second = _moved(posture, bicycle, [joint_of.get(number, "") for number in range(1, 32)])
    moved = []
    for number in range(1, 32):
        point = posture.skeleton[number]
        velocity, acceleration = first[..., number - 1, :], second[..., number - 1, :]
        if number in _FRONT_POINTS:
            velocity = cross(axis, point - foot)
            acceleration = cross(axis, velocity)
        moved.append(point + angle[..., None] * velocity + angle[..., None] ** 2 / 2 * acceleration)
    return stack(moved, -2)


def _moved(posture: Posture, bicycle: Bicycle, links: list[str]) -> tuple[Array, Array]:
    """Return first and second derivatives (..., 31, 3) with respect to steer of points on the links named."""
    points = posture.skeleton.points
    if not posture.joints:
        return 0.0 * points, 0.0 * points
    motion = rider_motion(posture, bicycle)
    place = {joint.name: i for i, joint in enumerate(posture.joints)}
    none = np.zeros(len(place))
    carries = np.array([posture.tree.within[place[link]] if link else none for link in links])
    xp, (at,) = designs_last([points], motion.shape)
    spin, first = motion.first(carries, at)
    second = motion.second(carries, at, spin, first)

    def by_design(values: Array) -> Array:
        return xp.moveaxis(values[:, :, 0].reshape(3, len(links), *motion.shape), (0, 1), (-1, -2))

    return by_design(first), by_design(second)
