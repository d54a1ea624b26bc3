"""The rider's segments one by one, as they move with the steer and the free joints."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from singletrack.arrays import Array, stack
from singletrack.parameters.flexible import FRAME_TORSION, soft_hinges
from singletrack.posture.mechanism import HANDLEBAR
from singletrack.posture.motion import rider_motion
from singletrack.posture.seated import SeatedJoint
from singletrack.posture.twists import designs_last

if TYPE_CHECKING:
    from singletrack.parameters import Bicycle
    from singletrack.posture.seated import Posture

__all__ = ["SlavedBodies", "carried_by_soft_frame", "slaved_bodies"]


@dataclass(frozen=True, eq=False)
class SlavedBodies:
    """The n segments one by one, with their motion relative to the rear frame along f freedoms, the steer first.

    A segment's centre moves by sum J_i d_i + sum H_ij d_i d_j / 2, its first-order rotation is sum w_i d_i. The p pairs
    of freedoms are (0, 0), (0, 1), ..., (1, 1), ...

    Attributes
    ----------
    mass : array, shape (..., n)
        In kg.
    centre : array, shape (..., n, 3)
        At rest, in m, in the bicycle's frame.
    inertia : array, shape (..., n, 3, 3)
        About the centre, in kg m^2.
    rotation : array, shape (..., f, n, 3)
        w, in rad per rad.
    displacement : array, shape (..., f, n, 3)
        J, in m per rad.
    curvature : array, shape (..., p, n, 3)
        H, in m per rad^2.
    """

    mass: Array
    centre: Array
    inertia: Array
    rotation: Array
    displacement: Array
    curvature: Array


def slaved_bodies(posture: Posture, bicycle: Bicycle) -> SlavedBodies:
    """Return the rider's segments one by one, with their motion.

    Parameters and errors as for :func:`~singletrack.posture.slaved_mass`, which has what the equations of a rigid
    bicycle need.

    Examples
    --------
    >>> from singletrack import load_bicycle, load_rider
    >>> from singletrack.posture import seat
    >>> bicycle = load_bicycle("browser")
    >>> slaved_bodies(seat(bicycle, load_rider("rider-a"), "upright"), bicycle).displacement.shape
    (1, 10, 3)
    """
    segments = list(posture.segments.values())
    mass = stack([body.mass for body in segments], -1)
    centre = stack([body.centre for body in segments], -2)
    inertia = stack([body.inertia for body in segments], -3)
    if not posture.joints:
        still = np.zeros((1, len(segments), 3))
        return SlavedBodies(mass, centre, inertia, still, still, still)
    posture = carried_by_soft_frame(posture, bicycle)
    motion, carries = rider_motion(posture, bicycle), posture.tree.carries
    xp, (points,) = designs_last([centre], motion.shape)
    rotation, displacement = motion.first(carries, points)
    curvature = motion.second(carries, points)

    def by_design(values: Array) -> Array:
        return xp.moveaxis(values.reshape(*values.shape[:3], *motion.shape), (0, 1, 2), (-1, -2, -3))

    return SlavedBodies(mass, centre, inertia, by_design(rotation), by_design(displacement), by_design(curvature))


def carried_by_soft_frame(posture: Posture, bicycle: Bicycle) -> Posture:
    """Return a posture in which the twist of a soft frame is one more free joint, that which carries the handlebar.

    Parameters
    ----------
    posture : Posture
    bicycle : Bicycle
        Whose frame may be soft.
    """
    hinge = next((hinge for hinge in soft_hinges(bicycle) if hinge.name == FRAME_TORSION), None)
    if hinge is None or all(loop.to != HANDLEBAR for loop in posture.loops):
        return posture
    return replace(posture, joints=(*posture.joints, SeatedJoint(hinge.name, "", hinge.point, hinge.axis, free=True)))
