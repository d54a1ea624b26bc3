"""Loops of a mechanism: the linear equations that keep them closed, to first and second order."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from singletrack.arrays import Array, stack
from singletrack.posture.tree import Tree
from singletrack.posture.twists import cross3, dot3, turned

if TYPE_CHECKING:
    import numpy as np

    from singletrack.posture.twists import Motion

__all__ = ["Loops"]


@dataclass(frozen=True, eq=False)
class Loops:
    """The loops' ends in numbers.

    Attributes
    ----------
    tree : Tree
    foot, axis : array, shape (3, N)
        A point on the steer axis, and its direction.
    points : array, shape (3, L, N), or None
        Of loops that hold a point.
    columns : array, shape (3, L, k, N), or None
        How far the two sides of each part for a unit rate of each joint of its chain.
    near, far : array, shape (3, Q, N), or None
        Directions that stay perpendicular.
    """

    tree: Tree
    foot: Array
    axis: Array
    # Arrays; the first two are None without points, the others without directions.
    points: Any
    columns: Any
    near: Any
    far: Any

    def matrix(self, xp: Any, spin: Array, joints: np.ndarray) -> Array:
        """Return the rates (rows, k, N) of all conditions for unit rates of some joints.

        Parameters
        ----------
        xp : namespace
        spin : array, shape (3, n, N)
        joints : array of int, shape (k,)
        """
        rows = []
        if self.columns is not None:
            ends = self.tree.points
            places = xp.asarray(ends.places[:, joints], dtype=self.columns.dtype)
            placed = xp.matmul(places, self.columns)
            rows.append(placed.reshape(-1, *placed.shape[2:]))
        if self.near is not None:
            across, ends = cross3(self.near, self.far), self.tree.angles
            rows.append((ends.near - ends.far)[:, joints, None] * dot3(spin[:, None, joints], across[:, :, None]))
        return rows[0] if len(rows) == 1 else xp.concat(rows, axis=0)

    def steering(self, xp: Any) -> Array:
        """Return the rates (rows, N) of the handlebar's side of all conditions for a unit rate of steer.

        Parameters
        ----------
        xp : namespace
        """
        rows = []
        if self.points is not None:
            moved = self.turned_bar()
            rows.append(moved.reshape(-1, moved.shape[-1]))
        if self.near is not None:
            rows.append(dot3(self.axis[:, None], cross3(self.near, self.far)) * self.tree.angles.bar[:, None])
        return rows[0] if len(rows) == 1 else xp.concat(rows, axis=0)

    def turned_bar(self) -> Array:
        """Return the rates (3, L, N) of the points on the handlebar, zero for the others."""
        return cross3(self.axis[:, None], self.points - self.foot[:, None]) * self.tree.points.bar[:, None]

    def bending(self, xp: Any, motion: Motion) -> Array:
        """Return the second derivatives (rows, p, N) of all conditions that the joints' rates alone cause.

        Parameters
        ----------
        xp : namespace
        motion : Motion
        """
        rows = []
        if self.columns is not None:
            parting = self.bending_points(motion)
            rows.append(parting.reshape(-1, *parting.shape[2:]))
        if self.near is not None:
            rows.append(self._bending_angles(motion))
        return rows[0] if len(rows) == 1 else xp.concat(rows, axis=0)

    def bending_points(self, motion: Motion) -> Array:
        """Return the second derivatives (3, L, p, N) by which points part.

        Parameters
        ----------
        motion : Motion
        """
        ends, moved = self.tree.points, self.turned_bar()
        parting = turned(motion.turning[:, ends.chain], self.columns)
        parting = parting - self._steer_only(cross3(self.axis[:, None], moved))
        if (ends.far * ends.bar[:, None]).any():  # the steer is carried by a joint
            parting = parting - self._with_steer(cross3(motion.spins(ends.far), moved[:, :, None]))
        return parting

    def _steer_only(self, values: Array) -> Array:
        """Return values (3, k, N) as those of the pair (steer, steer), zero for the others."""
        count = len(self.tree.first)
        return stack([values, *[0.0 * values] * (count - 1)], -2) if count > 1 else values[:, :, None]

    def _with_steer(self, values: Array) -> Array:
        """Return values (3, k, f, N) as those of the pairs (steer, freedom), zero for the others."""
        pairs = zip(self.tree.first, self.tree.second, strict=True)
        return stack([values[:, :, j] if i == 0 < j else 0.0 * values[:, :, 0] for i, j in pairs], -2)

    def _bending_angles(self, motion: Motion) -> Array:
        """Return the second derivatives (Q, p, N) of the products of directions."""
        ends, tree = self.tree.angles, self.tree
        firsts, seconds = [], []
        for which, direction in ((ends.near, self.near), (ends.far, self.far)):
            columns = cross3(motion.spin[:, None], direction[:, :, None]) * which[:, :, None]
            first = cross3(motion.spins(which), direction[:, :, None])
            second = turned(motion.turning[:, None], columns)
            if which is ends.far:  # the handlebar turns with the steer alone
                bar = cross3(self.axis[:, None], direction) * ends.bar[:, None]
                first = stack([first[:, :, 0] + bar, *(first[:, :, k] for k in range(1, first.shape[2]))], -2)
                second = second + self._steer_only(cross3(self.axis[:, None], bar))
                if (ends.far * ends.bar[:, None]).any():
                    second = second + self._with_steer(cross3(motion.spins(ends.far), bar[:, :, None]))
            firsts.append(first)
            seconds.append(second)
        i, j = tree.first, tree.second
        mixed = dot3(firsts[0][:, :, i], firsts[1][:, :, j]) + dot3(firsts[0][:, :, j], firsts[1][:, :, i])
        return dot3(seconds[0], self.far[:, :, None]) + mixed + dot3(seconds[1], self.near[:, :, None])
