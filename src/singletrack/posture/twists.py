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
from typing import Any

from singletrack.arrays import Array, as_arrays, stack
from singletrack.arrays.faults import Fault
from singletrack.posture.tree import Tree

__all__ = ["Motion", "cross3", "designs_last", "dot3", "summed", "symmetric"]


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
        spin = summed(carries, self.spin)
        return spin, cross3(spin, points[:, :, None]) + summed(carries, self.twist)

    def second(self, carries: Array, points: Array, spin: Array, first: Array) -> Array:
        """Return the second derivatives (3, k, pairs, N) of points, given their first ones."""
        turning = cross3(summed(carries, self.bend_spin), points[:, :, None]) + summed(carries, self.bend_twist)
        return turning + symmetric(self.tree, spin, first)


def cross3(a: Array, b: Array) -> Array:
    """Return cross products of arrays (3, ...)."""
    return stack(
        [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]], -max(a.ndim, b.ndim)
    )


def dot3(a: Array, b: Array) -> Array:
    """Return inner products of arrays (3, ...)."""
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def summed(rows: Array, values: Array) -> Array:
    """Return sums of values (3, n, f, N) over the joints of each row (k, n), shape (3, k, f, N)."""
    xp, (values,) = as_arrays(values)
    flat = xp.matmul(xp.asarray(rows, dtype=values.dtype), values.reshape(3, rows.shape[1], -1))
    return flat.reshape(3, rows.shape[0], *values.shape[2:])


def symmetric(tree: Tree, a: Array, b: Array) -> Array:
    """Return (a_i x b_j + a_j x b_i) / 2 for the pairs of freedoms, of arrays (3, k, f, N)."""
    i, j = tree.first, tree.second
    return (cross3(a[:, :, i], b[:, :, j]) + cross3(a[:, :, j], b[:, :, i])) / 2


def designs_last(arrays: list[Array], shape: tuple[int, ...]) -> tuple[Any, list[Array]]:
    """Return the namespace and vectors (..., k, 3), broadcast to a batch's shape, as (3, k, N)."""
    xp, same = as_arrays(*arrays)
    moved = []
    for array in same:
        full = array if array.shape[:-2] == shape else xp.broadcast_to(array, (*shape, *array.shape[-2:]))
        moved.append(xp.moveaxis(full, (-1, -2), (0, 1)).reshape(3, full.shape[-2], -1))
    return xp, moved
