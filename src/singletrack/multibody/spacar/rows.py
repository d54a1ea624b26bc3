"""Which rows of deformation rates determine the rates of all coordinates, and solving with them.

The unknown rates are those of all coordinates that are not fixed. Rows are the constraints (fixed deformations,
rolling, unit length of Euler parameters), then what is prescribed, then the generalised coordinates. Of redundant
constraints an independent set is chosen; the rest agrees with it or the model cannot be drawn.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from scipy import linalg

from singletrack.arrays import Array
from singletrack.errors import ModelError
from singletrack.multibody.spacar.layout import Layout

__all__ = ["Rows", "Solver", "choose", "names", "names_of", "solver_at"]

RANK = 1e-9
SINGULAR = 1e-13
_getrf, _getrs, _gecon = linalg.get_lapack_funcs(("getrf", "getrs", "gecon"), (np.zeros((1, 1)),))


@dataclass(frozen=True, eq=False)
class Rows:
    """Chosen rows.

    Attributes
    ----------
    layout
        What they belong to.
    free
        Coordinates that are not fixed, (u,).
    constraints
        Independent deformations that are constraints, (c,).
    prescribed_e, prescribed_x, dynamic_x, dynamic_e
        Indices of prescribed and dynamic deformations and coordinates.
    """

    layout: Layout
    free: Array
    constraints: Array
    prescribed_e: Array
    prescribed_x: Array
    dynamic_x: Array
    dynamic_e: Array

    @property
    def freedoms(self) -> int:
        """How many generalised coordinates there are."""
        return len(self.dynamic_x) + len(self.dynamic_e)

    def stack(self, of_e: Array, of_x: Array) -> Array:
        """Return values of deformations (m, ...) and coordinates (n, ...) in the order of the rows.

        Parameters
        ----------
        of_e : array, shape (m, ...)
        of_x : array, shape (n, ...)
        """
        return np.concatenate(
            [
                of_e[self.constraints],
                of_e[self.prescribed_e],
                of_x[self.prescribed_x],
                of_x[self.dynamic_x],
                of_e[self.dynamic_e],
            ]
        )

    def matrix(self, rows: Array) -> Array:
        """Return the square matrix (u, u) of the chosen rows, given those of all deformations (m, n)."""
        return self.stack(rows, np.eye(rows.shape[1]))[:, self.free]

    def generalised(self, of_e: Array, of_x: Array) -> Array:
        """Return values of the generalised coordinates, out of those of all deformations and coordinates.

        Shape (q, ...).

        Parameters
        ----------
        of_e : array, shape (m, ...)
        of_x : array, shape (n, ...)
        """
        return np.concatenate([of_x[self.dynamic_x], of_e[self.dynamic_e]])

    def names(self) -> tuple[str, ...]:
        """Return names of the generalised coordinates, such as ``x 2 1`` and ``e 6 1``."""
        return names(self.layout, self.dynamic_x, self.dynamic_e)


def names(layout: Layout, x: Array, e: Array) -> tuple[str, ...]:
    """Return names of coordinates and deformations by index.

    Parameters
    ----------
    layout : Layout
        The model as arrays.
    x, e : array of int, shape (k,)
        Indices, each of a k of its own.
    """
    x_keys, e_keys = list(layout.x_index), list(layout.e_index)
    return (*(f"x {x_keys[i][0]} {x_keys[i][1]}" for i in x), *(f"e {e_keys[i][0]} {e_keys[i][1]}" for i in e))


def names_of(layout: Layout, kind: str) -> tuple[str, ...]:
    """Return the names of the coordinates and deformations of a kind, such as ``kinematic``.

    Parameters
    ----------
    layout : Layout
        The model as arrays.
    kind : str
        ``fixed``, ``calculated``, ``dynamic``, ``prescribed`` or ``kinematic``.
    """
    return names(layout, np.flatnonzero(layout.x_is == kind), np.flatnonzero(layout.e_is == kind))


class Solver:
    """The chosen rows at a configuration, factored.

    Raises
    ------
    ModelError
        Where the configuration is singular.
    """

    def __init__(self, rows: Rows, of_all: Array) -> None:
        self.rows = rows
        matrix = rows.matrix(of_all)
        if not np.all(np.isfinite(matrix)):
            raise ModelError("the motion is not finite")
        self.factors: Any = None
        if not matrix.size:
            return
        factors, pivots, _ = _getrf(matrix)
        self.factors = (factors, pivots)
        if _gecon(factors, abs(matrix).sum(axis=0).max())[0] < SINGULAR:
            raise ModelError(f"{rows.layout.description.where}: the mechanism is in a singular configuration")

    def solve(self, right: Array) -> Array:
        """Return the coordinates' rates (n, ...) of what the rows shall be (u, ...).

        Parameters
        ----------
        right : array, shape (u, ...)
        """
        result = np.zeros((len(self.rows.layout.drawn), *right.shape[1:]))
        if self.factors is not None:
            result[self.rows.free] = _getrs(*self.factors, right)[0]
        return result

    def transfer(self) -> Array:
        """Return the first-order geometric transfer function (n, q): rates of coordinates from generalised rates."""
        q, size = self.rows.freedoms, len(self.rows.free)
        return self.solve(np.eye(size)[:, size - q :])

    def balance(self, forces: Array) -> tuple[Array, Array]:
        """Return the rows' forces that balance forces on coordinates: on deformations (m,), on coordinates (n,)."""
        rows = self.rows
        of_e, of_x = np.zeros(len(rows.layout.e_is)), np.zeros(len(forces))
        if self.factors is None:
            return of_e, of_x
        multipliers = _getrs(*self.factors, -forces[rows.free], trans=1)[0]
        start = 0
        for index, target in (
            (rows.constraints, of_e),
            (rows.prescribed_e, of_e),
            (rows.prescribed_x, of_x),
            (rows.dynamic_x, of_x),
            (rows.dynamic_e, of_e),
        ):
            target[index] = multipliers[start : start + len(index)]
            start += len(index)
        return of_e, of_x


def solver_at(rows: Rows, of_all: Array) -> Solver:
    """Return the factored rows at a configuration.

    Where constraints are redundant and those chosen elsewhere have become a bad choice here, others are chosen.

    Parameters
    ----------
    rows : Rows
        Those chosen elsewhere.
    of_all : array, shape (m, n)
        The rows of all deformations at the configuration.

    Raises
    ------
    ModelError
        Where the configuration is singular.
    """
    try:
        return Solver(rows, of_all)
    except ModelError:
        if not np.all(np.isfinite(of_all)) or len(rows.constraints) == np.sum(rows.layout.e_is == "fixed"):
            raise
    return Solver(choose(rows.layout, of_all), of_all)


def choose(layout: Layout, of_all: Array) -> Rows:
    """Return the rows that determine the motion, given the rows of all deformations in the drawing.

    Parameters
    ----------
    layout : Layout
        The model as arrays.
    of_all : array, shape (m, n)
        How the deformations vary with the coordinates.

    Raises
    ------
    ModelError
        Where freedoms are left that nothing determines, or generalised coordinates that cannot move.
    """
    d = layout.description
    free = np.flatnonzero(layout.x_is != "fixed")
    fixed = np.flatnonzero(layout.e_is == "fixed")
    matrix = of_all[np.ix_(fixed, free)]
    constraints = fixed[_independent(matrix)]
    by_kind = [
        np.flatnonzero(what == kind)
        for kind, what in (
            ("prescribed", layout.e_is),
            ("prescribed", layout.x_is),
            ("dynamic", layout.x_is),
            ("dynamic", layout.e_is),
        )
    ]
    rows = Rows(layout, free, constraints, *by_kind)
    square = rows.matrix(of_all)
    rank = len(_independent(square))
    if rank < len(square):
        count = len(free) - len(constraints)
        given = names(
            layout,
            np.concatenate([rows.prescribed_x, rows.dynamic_x]),
            np.concatenate([rows.prescribed_e, rows.dynamic_e]),
        )
        raise ModelError(
            f"{d.where}: the constraints leave {count} freedoms, but {len(given)} are dynamic or prescribed that"
            f" cannot all move by themselves: {', '.join(given[:8])}"
        )
    if rank < len(free):
        raise ModelError(
            f"{d.where}: {len(free) - rank} freedoms are left that nothing determines, in which"
            f" {_moving(layout, square, free)} move;"
            " make them dynamic (DYNE, DYNX), prescribed (INPUTE, INPUTX) or fixed (FIX)"
        )
    return rows


def _independent(matrix: Array) -> Array:
    """Return which rows are independent, in order."""
    if not matrix.size:
        return np.zeros(0, dtype=int)
    scale = np.linalg.norm(matrix, axis=1, keepdims=True)
    triangle, pivots = linalg.qr((matrix / np.where(scale > 0.0, scale, 1.0)).T, mode="r", pivoting=True)
    size = abs(np.diagonal(triangle))
    return np.sort(pivots[: int(np.sum(size > RANK * max(size[0], 1e-300)))])


def _moving(layout: Layout, matrix: Array, free: Array) -> str:
    """Return the nodes that move most in the motions that the rows leave."""
    space = linalg.null_space(matrix) if len(matrix) else np.eye(len(free))
    size = np.linalg.norm(space, axis=1)
    keys = list(layout.x_index)
    nodes = list(dict.fromkeys(keys[free[i]][0] for i in np.argsort(-size) if size[i] > 1e-6 * np.max(size)))
    listed = ", ".join(map(str, sorted(nodes[:6])))
    return f"node{'s' if len(nodes) > 1 else ''} {listed}{' and more' if len(nodes) > 6 else ''}"
