"""How the rider's joints move with the steer angle and the free joints, to second order.

Loops give the rates of the joints that are not free, and their second derivatives, from linear equations of the same
matrix (:mod:`singletrack.posture.loops`); twists of links are explained in :mod:`singletrack.posture.twists`.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from singletrack.arrays import Array, is_jax, stack
from singletrack.posture.loops import Loops, inverse_of
from singletrack.posture.seated import steer_axis
from singletrack.posture.twists import Motion, cross3, designs_last, summed, symmetric

if TYPE_CHECKING:
    from singletrack.arrays import Fault
    from singletrack.parameters import Bicycle
    from singletrack.posture.seated import Posture

__all__ = ["joint_motion", "rider_motion"]


def rider_motion(posture: Posture, bicycle: Bicycle) -> Motion:
    """Return how the rider's joints move with the steer and the free joints.

    Parameters
    ----------
    posture : Posture
    bicycle : Bicycle

    Raises
    ------
    PostureError
        If the loops of a single design cannot follow the steer (an arm stretched or folded in its own plane), naming
        the joint that is not determined.

    Examples
    --------
    The leaned rider's torso twists with the steer, and pitches only to second order:

    >>> from singletrack import load_bicycle, load_rider
    >>> from singletrack.posture import seat
    >>> bicycle = load_bicycle("stratos")
    >>> posture = seat(bicycle, load_rider("rider-a"), "leaned")
    >>> motion = rider_motion(posture, bicycle)
    >>> [joint.name for joint in posture.joints][:2]
    ['torso pitch', 'torso twist']
    >>> abs(motion.rates[:2, 0, 0]).round(3).tolist(), bool(abs(motion.bends[0, 0, 0]) > 0.01)
    ([0.0, 0.482], True)
    """
    tree, shape = posture.tree, posture.skeleton.points.shape[:-2]
    foot, axis = steer_axis(bicycle)
    points = [loop.point for loop in posture.loops if loop.directions is None]
    pairs = [loop.directions for loop in posture.loops if loop.directions is not None]
    listed = [
        stack([joint.axis for joint in posture.joints], -2),
        stack([joint.point for joint in posture.joints], -2),
        stack([foot, axis], -2),
    ]
    if points:
        listed.append(stack(points, -2))
    if pairs:
        listed += [stack([pair[k] for pair in pairs], -2) for k in (0, 1)]
    xp, arrays = designs_last(listed, shape)
    axes, at, bar = arrays[:3]
    spin, twist = axes, cross3(at, axes)
    if not tree.turns.all():
        turns = tree.turns[:, None]
        spin, twist = spin * turns, twist * turns + axes * (1 - turns)
    loops = Loops(tree, bar[:, 0], bar[:, 1], *_of_loops(arrays[3:], bool(points), bool(pairs)))
    return _solve(xp, posture, loops, spin, twist, shape)


def joint_motion(posture: Posture, bicycle: Bicycle) -> tuple[dict[str, Array], dict[str, Array], tuple[Fault, ...]]:
    """Return the joint angles' first and second derivatives (...) with respect to the steer angle, by joint.

    Parameters and errors as for :func:`rider_motion`; the third are the faults of designs of a batch.
    """
    if not posture.joints:
        return {}, {}, ()
    motion = rider_motion(posture, bicycle)
    first, second = (values[:, 0].reshape(-1, *motion.shape) for values in (motion.rates, motion.bends))
    names = [joint.name for joint in posture.joints]
    return dict(zip(names, first, strict=True)), dict(zip(names, second, strict=True)), motion.faults


def _of_loops(arrays: list[Array], with_points: bool, with_pairs: bool) -> tuple[Array | None, Array, Array]:
    points = arrays[0] if with_points else None
    near, far = arrays[-2:] if with_pairs else (None, None)
    return points, near, far


def _solve(xp: Any, posture: Posture, loops: Loops, spin: Array, twist: Array, shape: tuple[int, ...]) -> Motion:
    """Return the motion that keeps the loops closed, from the joints' twists (3, n, N)."""
    tree = posture.tree
    free, dependent = tree.free, tree.dependent
    designs = spin.shape[-1]
    inverse: Array | None = None
    faults: tuple[Fault, ...] = ()
    if len(dependent):
        matrix = loops.matrix(xp, spin, twist)
        inverse, faults = inverse_of(xp.moveaxis(matrix[:, dependent], -1, 0), posture, shape)
        right = [loops.steering(xp), *(-matrix[:, i] for i in free)]
    rates = xp.zeros((len(posture.joints), 1 + len(free), designs), dtype=spin.dtype)
    own = xp.asarray([[float(k == i + 1) for k in range(1 + len(free))] for i in range(len(free))], dtype=spin.dtype)
    rates = _fill(rates, free, own[:, :, None]) if len(free) else rates
    if inverse is not None:
        rates = _fill(rates, dependent, _apply(xp, inverse, stack(right, -2)))
    own_spin, own_twist = spin[:, :, None] * rates, twist[:, :, None] * rates
    below_spin, below_twist = summed(tree.above, own_spin), summed(tree.above, own_twist)
    bend_spin = symmetric(tree, below_spin, own_spin)
    bend_twist = symmetric(tree, below_spin, own_twist) + symmetric(tree, below_twist, own_spin)
    bends = xp.zeros((len(posture.joints), len(tree.first), designs), dtype=spin.dtype)
    if inverse is not None:
        first = Motion(tree, shape, rates, bends, own_twist, own_spin, bend_twist, bend_spin)
        bends = _fill(bends, dependent, -_apply(xp, inverse, loops.bending(xp, first)))
        bend_spin = bend_spin + spin[:, :, None] * bends
        bend_twist = bend_twist + twist[:, :, None] * bends
    return Motion(tree, shape, rates, bends, own_twist, own_spin, bend_twist, bend_spin, faults)


def _fill(whole: Array, index: Array, rows: Array) -> Array:
    """Return an array with some of its rows (k, ..., N) replaced."""
    if is_jax(whole, rows):
        from jax import numpy as jnp

        return jnp.asarray(whole).at[index].set(rows)
    whole = whole.astype(rows.dtype) if rows.dtype != whole.dtype and rows.dtype.kind == "c" else whole
    whole[index] = rows
    return whole


def _apply(xp: Any, inverse: Array, right: Array) -> Array:
    """Return the joints' rates (n, f, N) of inverses (N, n, rows) times right sides (rows, f, N)."""
    return xp.moveaxis(xp.matmul(inverse, xp.moveaxis(right, -1, 0)), 0, -1)
