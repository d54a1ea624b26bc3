"""How the rider's joints and what they carry move with the steer angle and the free joints, to second order.

A joint's twist is the velocity field of what it carries for its unit rate, w x r + v at a point r: (w, v) = (a, p x a)
for a hinge about a through p, (0, a) for a slider. Let U_b,i be the rate of joint b along freedom i (the steer first),
U_b,ij its second derivative. A joint is carried by the joints below it, so that for a point with c_b = w_b x r + v_b

    first derivatives    r_i  = sum over its joints of  c_b U_b,i
    second derivatives   r_ij = sum of  X_b,i x c_b U_b,j + X_b,j x c_b U_b,i + c_b U_b,ij
                         X_b,i = (sum over the joints a below b of  w_a U_a,i) + w_b U_b,i / 2

and likewise for directions, with c_b = w_b x direction (docs/theory/closed-form.md).

Arrays run along (x y z, joint or body, freedom or pair of freedoms, designs): designs last, side by side in memory.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from singletrack.arrays import Array, as_arrays, stack
from singletrack.arrays.faults import Fault
from singletrack.posture.tree import Tree

__all__ = ["Motion", "cross3", "designs_last", "dot3", "motion_of", "summed"]


@dataclass(frozen=True, eq=False)
class Motion:
    """First and second derivatives of a rider's joints, n joints, f freedoms, p pairs of them, N designs.

    Attributes
    ----------
    tree : Tree
    shape : tuple of int
        Of the batch of N designs.
    spin, twist : array, shape (3, n, N)
        w and v of the joints.
    rates, bends : array, shape (n, f, N), (n, p, N)
        U_b,i and U_b,ij.
    carried_spin, carried_twist : array, shape (3, n, f, N)
        X, and the same sum of v.
    turning : array, shape (3, n, p, N)
        X_b,i U_b,j + X_b,j U_b,i.
    faults : tuple of Fault
        Designs whose loops cannot follow the steer.
    """

    tree: Tree
    shape: tuple[int, ...]
    spin: Array
    twist: Array
    rates: Array
    bends: Array
    carried_spin: Array
    carried_twist: Array
    turning: Array
    faults: tuple[Fault, ...] = ()

    def columns(self, points: Array) -> Array:
        """Return c (3, k, n, N) of points, for all joints whether they carry them or not.

        Parameters
        ----------
        points : array, shape (3, k, N)
        """
        return cross3(self.spin[:, None], points[:, :, None]) + self.twist[:, None]

    def first(self, carries: Array, points: Array) -> tuple[Array, Array]:
        """Return rotations and displacements (3, k, f, N) of points.

        Parameters
        ----------
        carries : array, shape (k, n)
            One where a joint moves a point.
        points : array, shape (3, k, N)
        """
        return self.spins(carries), along(self.columns(points) * carries[:, :, None], self.rates)

    def second(self, carries: Array, points: Array) -> Array:
        """Return the second derivatives (3, k, p, N) of points.

        Parameters
        ----------
        carries : array, shape (k, n)
            One where a joint moves a point.
        points : array, shape (3, k, N)
        """
        columns = self.columns(points) * carries[:, :, None]
        return turned(self.turning[:, None], columns) + along(columns, self.bends)

    def spins(self, carries: Array) -> Array:
        """Return the rotations (3, k, f, N) of bodies.

        Parameters
        ----------
        carries : array, shape (k, n)
            One where a joint moves a body.
        """
        return summed(carries, self.spin[:, :, None] * self.rates)


def motion_of(
    tree: Tree, shape: tuple[int, ...], spin: Array, twist: Array, rates: Array, faults: tuple[Fault, ...]
) -> Motion:
    """Return the motion of joints with given rates, still without second derivatives of their angles.

    Parameters
    ----------
    tree : Tree
    shape : tuple of int
        Of the batch of N designs.
    spin, twist : array, shape (3, n, N)
    rates : array, shape (n, f, N)
    faults : tuple of Fault
    """
    carried = summed(tree.halfway, spin[:, :, None] * rates), summed(tree.halfway, twist[:, :, None] * rates)
    i, j = tree.first, tree.second
    turning = carried[0][:, :, i] * rates[:, j] + carried[0][:, :, j] * rates[:, i]
    return Motion(tree, shape, spin, twist, rates, 0.0 * rates[:, i], *carried, turning, faults)


def cross3(a: Array, b: Array) -> Array:
    """Return cross products, components first.

    Parameters
    ----------
    a, b : array, shape (3, ...)
    """
    parts = [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
    return stack(parts, -max(a.ndim, b.ndim))


def dot3(a: Array, b: Array) -> Array:
    """Return inner products, components first.

    Parameters
    ----------
    a, b : array, shape (3, ...)
    """
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def summed(rows: Array, values: Array) -> Array:
    """Return sums (m, k, ..., N) of values over the joints of each row.

    Parameters
    ----------
    rows : array, shape (k, n)
    values : array, shape (m, n, ..., N)
    """
    xp, (values,) = as_arrays(values)
    flat = xp.matmul(xp.asarray(rows, dtype=values.dtype), values.reshape(values.shape[0], rows.shape[1], -1))
    return flat.reshape(values.shape[0], rows.shape[0], *values.shape[2:])


def along(columns: Array, rates: Array) -> Array:
    """Return sums over the joints of columns times rates, shape (3, k, f, N).

    Parameters
    ----------
    columns : array, shape (3, k, n, N)
    rates : array, shape (n, f, N)
    """
    xp, (columns, rates) = as_arrays(columns, rates)
    return stack([xp.sum(columns * rates[:, i], axis=2) for i in range(rates.shape[1])], -2)


def turned(turning: Array, columns: Array) -> Array:
    """Return sums over the joints of turning x columns, shape (3, ..., p, N).

    Parameters
    ----------
    turning : array, shape (3, ..., n, p, N)
    columns : array, shape (3, ..., n, N)
    """
    xp, (turning, columns) = as_arrays(turning, columns)
    return xp.sum(cross3(turning, columns[..., None, :]), axis=-3)


def designs_last(arrays: list[Array], shape: tuple[int, ...]) -> tuple[Any, list[Array]]:
    """Return the namespace and vectors, broadcast to a batch's shape, as (3, k, N).

    Parameters
    ----------
    arrays : list of arrays, shape (..., k, 3)
    shape : tuple of int
        Of the batch of N designs.
    """
    xp, same = as_arrays(*arrays)
    moved = []
    for array in same:
        full = array if array.shape[:-2] == shape else xp.broadcast_to(array, (*shape, *array.shape[-2:]))
        moved.append(xp.moveaxis(full, (-1, -2), (0, 1)).reshape(3, full.shape[-2], -1))
    return xp, moved
