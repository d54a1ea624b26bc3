"""How the rider's joints move with the steer angle and the free joints, to second order.

Loops give the rates of the joints that are not free, and their second derivatives, from linear equations of the same
matrix (:mod:`singletrack.posture.loops`); twists of links are explained in :mod:`singletrack.posture.twists`.
"""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Any

from singletrack.arrays import Array, Number, is_jax, stack
from singletrack.posture.inverses import solver_of
from singletrack.posture.loops import Loops
from singletrack.posture.seated import steer_axis
from singletrack.posture.twists import Motion, cross3, designs_last, motion_of

if TYPE_CHECKING:
    from singletrack.arrays import Fault
    from singletrack.parameters import Bicycle
    from singletrack.posture.seated import Posture

__all__ = ["joint_motion", "loops_of", "rider_motion"]


def rider_motion(posture: Posture, bicycle: Bicycle, shape: tuple[int, ...] | None = None) -> Motion:
    """Return how the rider's joints move with the steer and the free joints.

    Parameters
    ----------
    posture : Posture
    bicycle : Bicycle
    shape : tuple of int, optional
        Of a batch that is larger than that of the skeleton; by default the skeleton's.

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
    xp, shape, loops, joints = loops_of(posture, bicycle, shape)
    return _solve(xp, posture, loops, joints, shape)


def loops_of(
    posture: Posture, bicycle: Bicycle, shape: tuple[int, ...] | None = None
) -> tuple[Any, tuple[int, ...], Loops, tuple[Array, Array]]:
    """Return the namespace, the batch's shape, the loops, and the joints' twists w and v (3, n, N).

    Parameters
    ----------
    posture, bicycle, shape
        As for :func:`rider_motion`.
    """
    tree = posture.tree
    shape = posture.skeleton.points.shape[:-2] if shape is None else shape
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
    held = arrays[3] if points else None
    columns = None
    if held is not None:
        ends = tree.points
        parting = cross3(spin[:, ends.chain], held[:, :, None]) + twist[:, ends.chain]
        columns = parting if ends.signs.all() and (ends.signs > 0).all() else parting * ends.signs[:, :, None]
    near, far = arrays[-2:] if pairs else (None, None)
    return xp, shape, Loops(tree, bar[:, 0], bar[:, 1], held, columns, near, far), (spin, twist)


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


def _solve(xp: Any, posture: Posture, loops: Loops, joints: tuple[Array, Array], shape: tuple[int, ...]) -> Motion:
    """Return the motion that keeps the loops closed, from the joints' twists (3, n, N) each."""
    tree, (spin, twist) = posture.tree, joints
    free, dependent = tree.free, tree.dependent
    own = xp.zeros((len(posture.joints), 1 + len(free), spin.shape[-1]), dtype=spin.dtype)
    for k, joint in enumerate(free, start=1):
        own = _fill(own, (joint, k), 1.0)
    if not len(dependent):
        return motion_of(tree, shape, spin, twist, own, ())
    solve, faults = solver_of(xp, posture, loops, spin, shape)
    right = [loops.steering(xp)]
    if len(free):
        matrix = loops.matrix(xp, spin, free)
        right += [-matrix[:, k] for k in range(len(free))]
    rates = _fill(own, dependent, solve(stack(right, -2)))
    motion = motion_of(tree, shape, spin, twist, rates, faults)
    return replace(motion, bends=_fill(motion.bends, dependent, -solve(loops.bending(xp, motion))))


def _fill(whole: Array, index: Any, values: Number) -> Any:
    """Return an array with some of its entries replaced."""
    if is_jax(whole, values):
        from jax import numpy as jnp

        return jnp.asarray(whole).at[index].set(values)
    kind = getattr(values, "dtype", whole.dtype)
    whole = whole.astype(kind) if kind.kind == "c" and whole.dtype.kind != "c" else whole
    whole[index] = values
    return whole
