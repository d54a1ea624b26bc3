"""By how much the hands miss their grips: the check of a motion that was solved with pivots chosen beforehand."""

from __future__ import annotations

from typing import TYPE_CHECKING

from singletrack.arrays import Array, as_arrays, cross, stack
from singletrack.posture.motion import rider_motion
from singletrack.posture.seated import steer_axis
from singletrack.posture.twists import designs_last

if TYPE_CHECKING:
    from singletrack.parameters import Bicycle
    from singletrack.posture.seated import Posture

__all__ = ["loop_residual"]


def loop_residual(posture: Posture, bicycle: Bicycle) -> Array:
    """Return the largest distance (...) in m per rad by which a loop's point parts from its place with any freedom.

    Zero but for rounding where the loops' equations were solved well. Loops that hold directions are left out.

    Examples
    --------
    >>> from singletrack import load_bicycle, load_rider
    >>> from singletrack.posture import seat
    >>> bicycle = load_bicycle("stratos")
    >>> bool(loop_residual(seat(bicycle, load_rider("rider-a"), "leaned"), bicycle) < 1e-12)
    True
    """
    points = [loop.point for loop in posture.loops if loop.directions is None]
    if not points:
        _, (zero,) = as_arrays(0.0 * posture.skeleton.points[..., 0, 0])
        return zero
    motion, ends = rider_motion(posture, bicycle), posture.tree.points
    foot, axis = steer_axis(bicycle)
    turned = stack([cross(axis, point - foot) for point in points], -2)
    xp, (at, bar) = designs_last([stack(points, -2), turned], motion.shape)
    parting = motion.first(ends.near, at)[1] - motion.first(ends.far, at)[1]
    of_steer = parting[:, :, 0] - bar * ends.bar[:, None]
    largest = xp.max(xp.abs(of_steer), axis=(0, 1))
    for freedom in range(1, parting.shape[2]):
        largest = xp.maximum(largest, xp.max(xp.abs(parting[:, :, freedom]), axis=(0, 1)))
    return largest.reshape(motion.shape)
