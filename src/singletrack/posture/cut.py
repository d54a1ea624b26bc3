"""A rider whose loops are cut: every joint is free, and what the loops held is told as conditions on the joints.

A loop's condition g (a component of how far two points are apart, or the product of two directions) varies with the
joints s by its gradient, and to second order by its second derivatives: the force (or moment) m that keeps it does the
work m dg on the rider. What loops carry follows from the equations of the joints that they held.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from singletrack.arrays import Array, Fault
from singletrack.posture.motion import loops_of, rider_motion
from singletrack.posture.seated import Posture
from singletrack.posture.segment_motion import carried_by_soft_frame
from singletrack.posture.twists import motion_of

if TYPE_CHECKING:
    from singletrack.parameters import Bicycle

__all__ = ["CutLoops", "cut_loops"]


@dataclass(frozen=True, eq=False)
class CutLoops:
    """A seated rider with cut loops, n joints, c conditions.

    Attributes
    ----------
    posture : Posture
        The rider without loops, every joint free; the twist of a soft frame that carries the handlebar is one of them.
    names : tuple of str
        What keeps each condition: ``right hand force x``, ``... y``, ``... z``; ``NAME moment`` of two directions.
    gradient : array, shape (..., c, n)
        Of the conditions with respect to the joints: near end less far end.
    bending : array, shape (..., c, n, 1 + n)
        Their second derivatives: by the joints, and by the steer and the joints.
    held : array of int, shape (c,)
        The joints that follow from the loops, as many as conditions.
    freedoms : tuple of str
        What is free beside the steer while the loops are whole, f - 1 names.
    following : array, shape (..., n, f)
        How the joints follow the steer and these while the loops are whole.
    faults : tuple of Fault
        Designs whose loops cannot follow.
    """

    posture: Posture
    names: tuple[str, ...]
    gradient: Array
    bending: Array
    held: np.ndarray
    freedoms: tuple[str, ...]
    following: Array
    faults: tuple[Fault, ...]


def cut_loops(posture: Posture, bicycle: Bicycle, shape: tuple[int, ...] | None = None) -> CutLoops:
    """Return a seated rider with its loops cut.

    Parameters
    ----------
    posture : Posture
        With a loop at least.
    bicycle : Bicycle
    shape : tuple of int, optional
        Of a batch that is larger than that of the skeleton; by default the skeleton's.

    Examples
    --------
    >>> from singletrack import load_bicycle, load_rider
    >>> from singletrack.posture import seat
    >>> bicycle = load_bicycle("stratos")
    >>> cut = cut_loops(seat(bicycle, load_rider("rider-a"), "leaned"), bicycle)
    >>> cut.names[:4:2], cut.gradient.shape, len(cut.posture.freedoms)
    (('right hand force x', 'right hand force y'), (6, 6), 6)
    """
    posture = carried_by_soft_frame(posture, bicycle)
    xp, shape, loops, (spin, twist) = loops_of(posture, bicycle, shape)
    opened = replace(posture, joints=tuple(replace(joint, free=True) for joint in posture.joints), loops=())
    tree, n = opened.tree, len(posture.joints)
    gradient = loops.matrix(xp, spin, np.arange(n))
    alone = np.broadcast_to(np.eye(n, 1 + n, 1)[..., None], (n, 1 + n, spin.shape[-1]))
    motion = motion_of(tree, shape, spin, twist, xp.asarray(alone, dtype=spin.dtype), ())
    pairs = replace(loops, tree=replace(posture.tree, first=tree.first, second=tree.second)).bending(xp, motion)
    square = np.zeros((1 + n, 1 + n), dtype=int)
    square[tree.first, tree.second] = square[tree.second, tree.first] = np.arange(len(tree.first))

    def by_design(values: Array) -> Array:
        return xp.moveaxis(values, -1, 0).reshape(*shape, *values.shape[:-1])

    closed = rider_motion(posture, bicycle, shape)
    bending = by_design(pairs[:, square[1:].ravel()])
    names = [f"{posture.loops[k].name} force {axis}" for axis in "xyz" for k in posture.tree.points.index]
    names += [f"{posture.loops[k].name} moment" for k in posture.tree.angles.index]
    return CutLoops(
        opened,
        tuple(names),
        by_design(gradient),
        bending.reshape(*bending.shape[:-1], n, 1 + n),
        posture.tree.dependent,
        posture.freedoms,
        by_design(closed.rates),
        closed.faults,
    )
