"""The skeleton with the handlebar turned and free joints moved, for drawing."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from singletrack.arrays import Array, as_arrays, cross, stack
from singletrack.body.skeleton import POINT_NAMES
from singletrack.errors import InputError, unknown_name
from singletrack.posture.motion import rider_motion
from singletrack.posture.seated import steer_axis
from singletrack.posture.twists import designs_last

if TYPE_CHECKING:
    from singletrack.parameters import Bicycle
    from singletrack.posture.seated import Posture

__all__ = ["lateral_work", "moved_skeleton", "steered_skeleton"]

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

    Points of the rider's moving segments follow their joints, points of the front frame turn about the steer axis; free
    joints stay where they are.

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
    xp, (angle,) = as_arrays(steer)
    others = [0.0 * angle] * len(posture.freedoms)
    return moved_skeleton(posture, bicycle, xp.stack([angle, *others], axis=-1))


def moved_skeleton(posture: Posture, bicycle: Bicycle, freedoms: Array) -> Array:
    """Return the skeleton points (..., 31, 3) in m at freedoms (..., f), steer first, then the free joints (rad).

    Exact to second order; lean, which moves all points alike, is left to the reader.

    Examples
    --------
    >>> import numpy as np
    >>> from singletrack import load_bicycle, load_rider
    >>> from singletrack.posture import Options, seat
    >>> bicycle = load_bicycle("stratos")
    >>> posture = seat(bicycle, load_rider("rider-a"), Options("rigid", torso_lean=True))
    >>> moved = moved_skeleton(posture, bicycle, np.array([0.0, 0.1]))
    >>> (moved - posture.skeleton.points)[[0, 24]].round(2).tolist()  # contact, head
    [[0.0, 0.0, 0.0], [0.0, 0.05, 0.0]]
    """
    _, (angles,) = as_arrays(freedoms)
    foot, axis = steer_axis(bicycle)
    carried = posture.carried_by or {}
    links = []
    for number in range(1, 32):
        segments = _SEGMENTS_OF_POINT.get(number, ())
        links.append(next((carried[name] for name in segments if name in carried), ""))
    shifts = _shifts(posture, bicycle, links, angles)
    steer = angles[..., 0]
    moved = []
    for number in range(1, 32):
        point, shift = posture.skeleton[number], shifts[..., number - 1, :]
        if number in _FRONT_POINTS:
            velocity = cross(axis, point - foot)
            shift = steer[..., None] * velocity + steer[..., None] ** 2 / 2 * cross(axis, velocity)
        moved.append(point + shift)
    return stack(moved, -2)


def lateral_work(posture: Posture, bicycle: Bicycle, point: str) -> Array:
    """Return the work (..., 1 + f), m, of a unit force to the right at a point, on lean, steer and the free joints.

    Parameters
    ----------
    posture : Posture
        With f freedoms, the steer first.
    bicycle : Bicycle
    point : str
        A point of the skeleton by its name, which moves with its segment.

    Raises
    ------
    InputError
        For an unknown point.
    """
    if point not in POINT_NAMES:
        raise InputError(unknown_name("point", point, POINT_NAMES))
    place, count = POINT_NAMES.index(point), 1 + len(posture.freedoms)
    trail, tilt, base = bicycle.trail, bicycle.steer_axis_tilt, bicycle.wheel_base
    _xp, (mu,) = as_arrays(trail * as_arrays(tilt)[0].cos(tilt) / base)
    at = posture.skeleton.points[..., place, :]
    # The moved skeleton is exact to second order: half the difference of both ways is the first order to rounding.
    own = [
        (moved_skeleton(posture, bicycle, sign) - moved_skeleton(posture, bicycle, -sign))[..., place, 1] / 2
        for sign in np.eye(count)
    ]
    return stack([-at[..., 2], mu * at[..., 0] + own[0], *own[1:]], -1)


def _shifts(posture: Posture, bicycle: Bicycle, links: list[str], angles: Array) -> Array:
    """Return how far points (..., 31, 3) on the links named move with freedoms (..., f), to second order."""
    points = posture.skeleton.points
    if not posture.joints:
        return 0.0 * points
    motion, tree = rider_motion(posture, bicycle), posture.tree
    place = {joint.name: i for i, joint in enumerate(posture.joints)}
    none = np.zeros(len(place))
    carries = np.array([tree.within[place[link]] if link else none for link in links])
    xp, (at,) = designs_last([points], motion.shape)
    _, first = motion.first(carries, at)
    second = motion.second(carries, at)

    def by_design(values: Array) -> Array:
        shaped = values.reshape(3, len(links), values.shape[2], *motion.shape)
        return xp.moveaxis(shaped, (0, 1, 2), (-2, -3, -1))

    pairs = angles[..., tree.first] * angles[..., tree.second] * np.where(tree.first == tree.second, 0.5, 1.0)
    linear = (by_design(first) * angles[..., None, None, :]).sum(-1)
    shifts: Array = linear + (by_design(second) * pairs[..., None, None, :]).sum(-1)
    return shifts
