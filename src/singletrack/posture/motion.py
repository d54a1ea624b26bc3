"""How the rider's segments move with the steer angle and the free joints, to second order.

Each joint has a twist, the velocity field of what it carries for its unit rate: w x r + v at a point r, with
(w, v) = (a, p x a) for a hinge about a through p and (0, a) for a slider. A link's twist is the sum of those of the
joints below it. Along the freedoms d = (steer, free joints), with rates U_i of all joints, twists T_i = sum t_j U_ji
are first derivatives. A joint is carried by its parent, so that the second derivatives are

    T_ij = sum over joints of  (T_i(parent) x t_j + T_j(parent) x t_i) / 2 + t U_ij

with the product (w, v) x (s, m) = (w x s, w x m + v x s), and a point's second derivative is w_ij x r + v_ij +
(w_i x r_j + w_j x r_i) / 2, where r_i is its first. Loops give U_i and U_ij from linear equations of the same matrix.

Arrays run along (x y z, joint or body, freedom or pair of freedoms, designs): designs last, side by side in memory.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from singletrack.arrays import Array, as_arrays, is_concrete, is_jax, stack
from singletrack.arrays.faults import Fault, refuse_single
from singletrack.errors import PostureError
from singletrack.posture.seated import steer_axis
from singletrack.posture.tree import Tree

if TYPE_CHECKING:
    from singletrack.parameters import Bicycle
    from singletrack.posture.seated import Posture
    from singletrack.posture.tree import LoopEnds

__all__ = ["Motion", "joint_motion", "rider_motion"]

#: Loops whose matrix (of sines of angles, arms scaled to their mean) is closer to singular than this cannot move.
_SINGULAR = 1e-6


@dataclass(frozen=True, eq=False)
class Motion:
    """First and second derivatives of a rider's joints and links, f freedoms (steer first), N designs.

    Attributes
    ----------
    tree : Tree
    shape : tuple of int
        Of the batch of N designs.
    rates : array, shape (n, f, N)
        U, of the joints.
    bends : array, shape (n, pairs, N)
        U_ij, of the joints, for the tree's pairs of freedoms.
    twist, spin : array, shape (3, n, f, N)
        The joints' own twists along each freedom, translation at the origin and rotation; sum them over the joints
        below a body for that of the body.
    bend_twist, bend_spin : array, shape (3, n, pairs, N)
        Likewise of second order.
    faults : tuple of Fault
        Designs whose loops cannot follow the steer.
    """

    tree: Tree
    shape: tuple[int, ...]
    rates: Array
    bends: Array
    twist: Array
    spin: Array
    bend_twist: Array
    bend_spin: Array
    faults: tuple[Fault, ...] = ()

    def first(self, carries: Array, points: Array) -> tuple[Array, Array]:
        """Return rotation and displacement (3, k, f, N) of points (3, k, N), moved by the joints of rows (k, n)."""
        spin = _sum(carries, self.spin)
        return spin, _cross(spin, points[:, :, None]) + _sum(carries, self.twist)

    def second(self, carries: Array, points: Array, spin: Array, first: Array) -> Array:
        """Return the second derivatives (3, k, pairs, N) of points, given their first ones."""
        turning = _cross(_sum(carries, self.bend_spin), points[:, :, None]) + _sum(carries, self.bend_twist)
        return turning + _symmetric(self.tree, spin, first)


def _cross(a: Array, b: Array) -> Array:
    return stack(
        [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]], -max(a.ndim, b.ndim)
    )


def _dot(a: Array, b: Array) -> Array:
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def _sum(rows: Array, values: Array) -> Array:
    """Return sums of values (3, n, f, N) over the joints of each row (k, n), shape (3, k, f, N)."""
    xp, (values,) = as_arrays(values)
    flat = xp.matmul(xp.asarray(rows, dtype=values.dtype), values.reshape(3, rows.shape[1], -1))
    return flat.reshape(3, rows.shape[0], *values.shape[2:])


def _symmetric(tree: Tree, a: Array, b: Array) -> Array:
    """Return (a_i x b_j + a_j x b_i) / 2 for the pairs of freedoms, of arrays (3, k, f, N)."""
    i, j = tree.first, tree.second
    return (_cross(a[:, :, i], b[:, :, j]) + _cross(a[:, :, j], b[:, :, i])) / 2


def designs_last(arrays: list[Array], shape: tuple[int, ...]) -> tuple[Any, list[Array]]:
    """Return the namespace and vectors (..., k, 3), broadcast to a batch's shape, as (3, k, N)."""
    xp, same = as_arrays(*arrays)
    moved = []
    for array in same:
        full = array if array.shape[:-2] == shape else xp.broadcast_to(array, (*shape, *array.shape[-2:]))
        moved.append(xp.moveaxis(full, (-1, -2), (0, 1)).reshape(3, full.shape[-2], -1))
    return xp, moved


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
    spin, twist = axes, _cross(at, axes)
    if not tree.turns.all():
        turns = tree.turns[:, None]
        spin, twist = spin * turns, twist * turns + axes * (1 - turns)
    loops = _Loops(tree, bar[:, 0], bar[:, 1], *_of_loops(arrays[3:], bool(points), bool(pairs)))
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


@dataclass(frozen=True, eq=False)
class _Loops:
    """The loops' ends in numbers: points (3, L, N), perpendicular directions (3, Q, N) each, and the steer axis."""

    tree: Tree
    foot: Array
    axis: Array
    points: Array | None
    near: Array | None
    far: Array | None

    def matrix(self, xp: Any, spin: Array, twist: Array) -> Array:
        """Return the rates (rows, n, N) of all conditions for unit rates of the joints, spin and twist (3, n, N)."""
        rows = []
        if self.points is not None:
            which = _signs(self.tree.points)[:, :, None]
            parting = which * (_cross(spin[:, None], self.points[:, :, None]) + twist[:, None])
            rows.append(parting.reshape(-1, *parting.shape[2:]))
        if self.near is not None:
            across = _cross(self.near, self.far)
            rows.append(_signs(self.tree.angles)[:, :, None] * _dot(spin[:, None], across[:, :, None]))
        return rows[0] if len(rows) == 1 else xp.concat(rows, axis=0)

    def steering(self, xp: Any) -> Array:
        """Return the rates (rows, N) of the handlebar's side of all conditions for a unit rate of steer."""
        rows = []
        if self.points is not None:
            moved = _cross(self.axis[:, None], self.points - self.foot[:, None]) * self.tree.points.bar[:, None]
            rows.append(moved.reshape(-1, moved.shape[-1]))
        if self.near is not None:
            rows.append(_dot(self.axis[:, None], _cross(self.near, self.far)) * self.tree.angles.bar[:, None])
        return rows[0] if len(rows) == 1 else xp.concat(rows, axis=0)

    def bending(self, xp: Any, motion: Motion) -> Array:
        """Return the second derivatives (rows, pairs, N) of all conditions that the given motion leaves."""
        rows = []
        if self.points is not None:
            parting = 0.0
            for which, sign in ((self.tree.points.near, 1.0), (self.tree.points.far, -1.0)):
                if which.any():
                    parting = parting + sign * motion.second(which, self.points, *motion.first(which, self.points))
            turned = _cross(self.axis[:, None], _cross(self.axis[:, None], self.points - self.foot[:, None]))
            parting = parting - self._steer_only(turned * self.tree.points.bar[:, None])
            rows.append(parting.reshape(-1, *parting.shape[2:]))
        if self.near is not None:
            rows.append(self._bending_angles(motion))
        return rows[0] if len(rows) == 1 else xp.concat(rows, axis=0)

    def _steer_only(self, values: Array) -> Array:
        """Return values (3, k, N) as those of the pair (steer, steer), zero for the others."""
        count = len(self.tree.first)
        return stack([values, *[0.0 * values] * (count - 1)], -2) if count > 1 else values[:, :, None]

    def _bending_angles(self, motion: Motion) -> Array:
        """Return the second derivatives (Q, pairs, N) of the products of directions."""
        ends, tree = self.tree.angles, self.tree
        spins, turns = [], []
        for which, direction in ((ends.near, self.near), (ends.far, self.far)):
            spin, bend = _sum(which, motion.spin), _sum(which, motion.bend_spin)
            if which is ends.far:  # the handlebar turns with the steer alone
                bar = (self.axis[:, None] * ends.bar[:, None])[:, :, None]
                spin = stack([spin[:, :, 0] + bar[:, :, 0], *(spin[:, :, k] for k in range(1, spin.shape[2]))], -2)
            first = _cross(spin, direction[:, :, None])  # type: ignore[index]
            second = _cross(bend, direction[:, :, None]) + _symmetric(tree, spin, first)  # type: ignore[index]
            spins.append(first)
            turns.append(second)
        i, j = tree.first, tree.second
        mixed = _dot(spins[0][:, :, i], spins[1][:, :, j]) + _dot(spins[0][:, :, j], spins[1][:, :, i])
        return _dot(turns[0], self.far[:, :, None]) + mixed + _dot(turns[1], self.near[:, :, None])  # type: ignore[index]


def _signs(ends: LoopEnds) -> Array:
    return ends.near - ends.far


def _solve(xp: Any, posture: Posture, loops: _Loops, spin: Array, twist: Array, shape: tuple[int, ...]) -> Motion:
    """Return the motion that keeps the loops closed, from the joints' twists (3, n, N)."""
    tree = posture.tree
    free, dependent = tree.free, tree.dependent
    designs = spin.shape[-1]
    inverse: Array | None = None
    faults: tuple[Fault, ...] = ()
    if len(dependent):
        matrix = loops.matrix(xp, spin, twist)
        inverse, faults = _inverse(xp.moveaxis(matrix[:, dependent], -1, 0), posture, shape)
        right = [loops.steering(xp), *(-matrix[:, i] for i in free)]
    rates = xp.zeros((len(posture.joints), 1 + len(free), designs), dtype=spin.dtype)
    own = xp.asarray([[float(k == i + 1) for k in range(1 + len(free))] for i in range(len(free))], dtype=spin.dtype)
    rates = _fill(rates, free, own[:, :, None]) if len(free) else rates
    if inverse is not None:
        rates = _fill(rates, dependent, _apply(xp, inverse, stack(right, -2)))
    own_spin, own_twist = spin[:, :, None] * rates, twist[:, :, None] * rates
    below_spin, below_twist = _sum(tree.above, own_spin), _sum(tree.above, own_twist)
    bend_spin = _symmetric(tree, below_spin, own_spin)
    bend_twist = _symmetric(tree, below_spin, own_twist) + _symmetric(tree, below_twist, own_spin)
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


def _inverse(matrix: Array, posture: Posture, shape: tuple[int, ...]) -> tuple[Array, tuple[Fault, ...]]:
    """Return the inverses of the loops' matrices (N, rows, joints), NaN where they cannot move, and these faults."""
    xp, (matrix,) = as_arrays(matrix)
    if not is_concrete(matrix):
        return xp.linalg.inv(matrix), ()
    import numpy as np

    numbers = np.asarray(matrix)
    try:
        inverse = np.linalg.inv(numbers)
        # |A| |A⁻¹| (Frobenius) is at least σmax / σmin: enough to clear nearly all, at a tenth of the cost.
        condition = np.linalg.norm(numbers, axis=(-2, -1)) * np.linalg.norm(inverse, axis=(-2, -1))
    except np.linalg.LinAlgError:  # one of them is singular to the last bit
        condition = np.full(numbers.shape[:-2], np.inf)
    finite = np.isfinite(numbers).all(axis=(-2, -1))
    suspect = finite & ~(condition * _SINGULAR < 1)
    bad = np.zeros(finite.shape, dtype=bool)
    if suspect.any():
        singular_values = np.linalg.svd(numbers[suspect], compute_uv=False)
        bad[suspect] = singular_values[..., -1] <= _SINGULAR * singular_values[..., 0]
    faults = refuse_single([_singular(posture, numbers, bad, shape)]) if bad.any() else ()
    if is_jax(matrix) or suspect.any():
        inverse = xp.linalg.inv(xp.where(xp.asarray(bad)[..., None, None], xp.nan, matrix))
    return inverse, faults


def _singular(posture: Posture, matrices: Array, bad: Array, shape: tuple[int, ...]) -> Fault:
    """Return the fault of loops that cannot follow, with the joint and the loop that it shows in."""
    import numpy as np

    tree = posture.tree
    left, _, right = np.linalg.svd(matrices[np.flatnonzero(bad)[0]])
    joint = posture.joints[tree.dependent[int(np.argmax(abs(right[-1])))]].name
    rows = [*tree.points.index, *tree.points.index, *tree.points.index, *tree.angles.index]
    loop = posture.loops[rows[int(np.argmax(abs(left[:, -1])))]].name
    text = (
        f"posture {posture.name}: the hands cannot follow the grips when steering, because the loops through the arms "
        f"are singular (an arm is stretched straight, or its axes line up): joint {joint} is not determined by the "
        f"loops, loop {loop} cannot move all ways"
    )
    return Fault(bad.reshape(shape), text, {}, PostureError)
