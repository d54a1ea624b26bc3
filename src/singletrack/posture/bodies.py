"""The rider's segments and how they move with the freedoms; what springs and dampers at the joints add."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from singletrack.arrays import Array, as_arrays, is_concrete, stack
from singletrack.arrays.faults import Fault, refuse_single
from singletrack.errors import PostureError
from singletrack.parameters.flexible import FRAME_TORSION, soft_hinges
from singletrack.posture.mechanism import HANDLEBAR
from singletrack.posture.motion import rider_motion
from singletrack.posture.seated import Joint
from singletrack.posture.twists import Motion, designs_last

if TYPE_CHECKING:
    from singletrack.parameters import Bicycle
    from singletrack.posture.seated import Posture

__all__ = ["SlavedBodies", "slaved_bodies"]

#: Motions of a segment per unit of a free joint that are less than this (m, rad) are none.
_STILL = 1e-9


@dataclass(frozen=True, eq=False)
class SlavedBodies:
    """Bodies that move relative to the rear frame with f freedoms d: the steer angle first, then free joints.

    n bodies on the axis before the last. A body's centre moves by sum J_i d_i + sum H_ij d_i d_j / 2, its first-order
    rotation is sum w_i d_i. The p pairs of freedoms are (0, 0), (0, 1), ..., (1, 1), ...

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
    faults : tuple of Fault
        Designs of a batch that cannot sit or steer.
    freedoms : tuple of str
        Names of the free joints.
    damping, stiffness : array, shape (..., f, f), or None
        Of dampers and springs at the rider's joints, in N m s and N m per rad; None without any.
    moving : tuple of int, optional
        Which bodies move at all; None: any may.
    """

    mass: Array
    centre: Array
    inertia: Array
    rotation: Array
    displacement: Array
    curvature: Array
    faults: tuple[Fault, ...] = ()
    freedoms: tuple[str, ...] = ()
    damping: Array | None = None
    stiffness: Array | None = None
    moving: tuple[int, ...] | None = None


def slaved_bodies(posture: Posture, bicycle: Bicycle) -> SlavedBodies:
    """Return the rider's segments and how they move with the steer and the free joints.

    Parameters
    ----------
    posture : Posture
    bicycle : Bicycle

    Raises
    ------
    PostureError
        As in :func:`singletrack.posture.motion.rider_motion`; for a free joint that moves no mass.

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
        return SlavedBodies(
            mass, centre, inertia, still, still, still, posture.skeleton.faults + posture.faults, moving=()
        )
    posture = _carried_by_soft_frame(posture, bicycle)
    motion = rider_motion(posture, bicycle)
    xp, (points,) = designs_last([centre], motion.shape)
    carries = posture.tree.carries
    rotation, first = motion.first(carries, points)
    second = motion.second(carries, points, rotation, first)
    damping, stiffness = _laws(posture, motion)
    turned, displaced, bent = (
        xp.moveaxis(values.reshape(*values.shape[:3], *motion.shape), (0, 1, 2), (-1, -2, -3))
        for values in (rotation, first, second)
    )
    return SlavedBodies(
        mass,
        centre,
        inertia,
        turned,
        displaced,
        bent,
        posture.skeleton.faults + posture.faults + motion.faults + _massless(posture, turned, displaced),
        posture.freedoms,
        damping=damping,
        stiffness=stiffness,
        moving=tuple(np.flatnonzero(carries.any(axis=1)).tolist()),
    )


def _carried_by_soft_frame(posture: Posture, bicycle: Bicycle) -> Posture:
    """Return a posture in which the twist of a soft frame is one more free joint, that which carries the handlebar."""
    hinge = next((hinge for hinge in soft_hinges(bicycle) if hinge.name == FRAME_TORSION), None)
    if hinge is None or all(loop.to != HANDLEBAR for loop in posture.loops):
        return posture
    return replace(posture, joints=(*posture.joints, Joint(hinge.name, "", hinge.point, hinge.axis, free=True)))


def _massless(posture: Posture, rotation: Array, displacement: Array) -> tuple[Fault, ...]:
    """Return a fault for each free joint that neither moves nor turns a segment."""
    if not posture.freedoms or not is_concrete(rotation):
        return ()
    motions = np.concatenate([np.asarray(rotation), np.asarray(displacement)], axis=-1)
    moves = np.asarray((abs(motions) > _STILL).any(axis=(-1, -2)))
    text = "posture {posture}: joint {joint} is free and moves no mass: hang a segment on it, or take free away"
    return refuse_single(
        Fault(~moves[..., i], text.format(posture=posture.name, joint=name), {}, PostureError)
        for i, name in enumerate(posture.freedoms, start=1)
    )


def _laws(posture: Posture, motion: Motion) -> tuple[Array | None, Array | None]:
    """Return what dampers and springs of the joints add to C0 and S0, (..., f, f) each; None without any.

    The potential of a joint's spring is k s^2 / 2 - p s, with s = sum U_i d_i + sum U_ij d_i d_j / 2.
    """
    tree = posture.tree
    found: list[Array | None] = []
    count = 1 + len(posture.freedoms)
    for law in ("damping", "stiffness"):
        added = None
        for k, joint in enumerate(posture.joints):
            value = getattr(joint, law)
            if not is_concrete(value) or np.any(np.asarray(value)):
                rates = _by_design(motion, motion.rates[k])
                term = as_arrays(value)[1][0][..., None, None] * rates[..., :, None] * rates[..., None, :]
                added = term if added is None else added + term
            if law == "stiffness" and not joint.free and np.any(np.asarray(joint.preload)):
                bends = _by_design(motion, motion.bends[k])
                square = np.zeros((count, count), dtype=int)
                square[tree.first, tree.second] = square[tree.second, tree.first] = range(len(tree.first))
                term = -as_arrays(joint.preload)[1][0][..., None, None] * bends[..., square]
                added = term if added is None else added + term
        found.append(added)
    return found[0], found[1]


def _by_design(motion: Motion, values: Array) -> Array:
    """Return values (k, N) of one joint as (..., k)."""
    xp, (values,) = as_arrays(values)
    return xp.moveaxis(values.reshape(values.shape[0], *motion.shape), 0, -1)
