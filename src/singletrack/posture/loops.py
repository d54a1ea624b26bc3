"""Loops of a mechanism: the linear equations that keep them closed, to first and second order."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from singletrack.arrays import Array, as_arrays, is_concrete, is_jax, stack
from singletrack.arrays.faults import Fault, refuse_single
from singletrack.errors import PostureError
from singletrack.posture.tree import Tree
from singletrack.posture.twists import cross3, dot3, summed, symmetric

if TYPE_CHECKING:
    from singletrack.posture.seated import Posture
    from singletrack.posture.tree import LoopEnds
    from singletrack.posture.twists import Motion

__all__ = ["Loops", "inverse_of"]

#: Loops whose matrix (of sines of angles, arms scaled to their mean) is closer to singular than this cannot move.
_SINGULAR = 1e-6


@dataclass(frozen=True, eq=False)
class Loops:
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
            parting = which * (cross3(spin[:, None], self.points[:, :, None]) + twist[:, None])
            rows.append(parting.reshape(-1, *parting.shape[2:]))
        if self.near is not None:
            across = cross3(self.near, self.far)
            rows.append(_signs(self.tree.angles)[:, :, None] * dot3(spin[:, None], across[:, :, None]))
        return rows[0] if len(rows) == 1 else xp.concat(rows, axis=0)

    def steering(self, xp: Any) -> Array:
        """Return the rates (rows, N) of the handlebar's side of all conditions for a unit rate of steer."""
        rows = []
        if self.points is not None:
            moved = cross3(self.axis[:, None], self.points - self.foot[:, None]) * self.tree.points.bar[:, None]
            rows.append(moved.reshape(-1, moved.shape[-1]))
        if self.near is not None:
            rows.append(dot3(self.axis[:, None], cross3(self.near, self.far)) * self.tree.angles.bar[:, None])
        return rows[0] if len(rows) == 1 else xp.concat(rows, axis=0)

    def bending(self, xp: Any, motion: Motion) -> Array:
        """Return the second derivatives (rows, pairs, N) of all conditions that the given motion leaves."""
        rows = []
        if self.points is not None:
            parting = 0.0
            for which, sign in ((self.tree.points.near, 1.0), (self.tree.points.far, -1.0)):
                if which.any():
                    parting = parting + sign * motion.second(which, self.points, *motion.first(which, self.points))
            bar = self.tree.points.bar[:, None]
            moved = cross3(self.axis[:, None], self.points - self.foot[:, None]) * bar
            parting = parting - self._steer_only(cross3(self.axis[:, None], moved))
            if (self.tree.points.far * bar).any():  # the steer is carried by a joint
                carried = summed(self.tree.points.far, motion.spin)
                parting = parting - self._with_steer(cross3(carried, moved[:, :, None]))
            rows.append(parting.reshape(-1, *parting.shape[2:]))
        if self.near is not None:
            rows.append(self._bending_angles(motion))
        return rows[0] if len(rows) == 1 else xp.concat(rows, axis=0)

    def _steer_only(self, values: Array) -> Array:
        """Return values (3, k, N) as those of the pair (steer, steer), zero for the others."""
        count = len(self.tree.first)
        return stack([values, *[0.0 * values] * (count - 1)], -2) if count > 1 else values[:, :, None]

    def _with_steer(self, values: Array) -> Array:
        """Return values (3, k, f, N) as those of the pairs (steer, freedom), zero for the others."""
        pairs = zip(self.tree.first, self.tree.second, strict=True)
        return stack([values[:, :, j] if i == 0 < j else 0.0 * values[:, :, 0] for i, j in pairs], -2)

    def _bending_angles(self, motion: Motion) -> Array:
        """Return the second derivatives (Q, pairs, N) of the products of directions."""
        ends, tree = self.tree.angles, self.tree
        spins, turns = [], []
        for which, direction in ((ends.near, self.near), (ends.far, self.far)):
            spin, bend = summed(which, motion.spin), summed(which, motion.bend_spin)
            if which is ends.far:  # the handlebar turns with the steer alone
                bar = (self.axis[:, None] * ends.bar[:, None])[:, :, None]
                if (ends.far * ends.bar[:, None]).any():
                    bend = bend + self._with_steer(cross3(spin, bar)) / 2
                spin = stack([spin[:, :, 0] + bar[:, :, 0], *(spin[:, :, k] for k in range(1, spin.shape[2]))], -2)
            first = cross3(spin, direction[:, :, None])  # type: ignore[index]
            second = cross3(bend, direction[:, :, None]) + symmetric(tree, spin, first)  # type: ignore[index]
            spins.append(first)
            turns.append(second)
        i, j = tree.first, tree.second
        mixed = dot3(spins[0][:, :, i], spins[1][:, :, j]) + dot3(spins[0][:, :, j], spins[1][:, :, i])
        return dot3(turns[0], self.far[:, :, None]) + mixed + dot3(turns[1], self.near[:, :, None])  # type: ignore[index]


def _signs(ends: LoopEnds) -> Array:
    return ends.near - ends.far


def inverse_of(matrix: Array, posture: Posture, shape: tuple[int, ...]) -> tuple[Array, tuple[Fault, ...]]:
    """Return the inverses of the loops' matrices (N, rows, joints), NaN where they cannot move, and these faults."""
    xp, (matrix,) = as_arrays(matrix)
    if not is_concrete(matrix):
        return xp.linalg.inv(matrix), ()
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
