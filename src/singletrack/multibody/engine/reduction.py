"""The projected equations as one expression: elimination by hand, so that all that is common is computed once.

The dependent block of the constraints is eliminated symbolically in an order of pivots that was found numerically
where the independent speeds were chosen; :func:`pivot_growth` tells when that order is no good any more, and another
choice is due. Entries that are structurally zero take no part. With T from C T = 0 and b from C b = -c,

    T^T M T a_i = -T^T (h + M b),    a = T a_i + b,    C_d^T m = (M a + h)_d.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import casadi as ca
import numpy as np

if TYPE_CHECKING:
    from collections.abc import Sequence

    from singletrack.arrays import Array
    from singletrack.multibody.engine.equations import Equations
    from singletrack.multibody.engine.partition import Partition

__all__ = ["elimination_operations", "is_short", "pivot_growth", "reduced_expression"]

MOST_ROWS, MOST_COORDINATES = 24, 40
MOST_OPERATIONS, MOST_PASSES = 5000, 400
"""Larger systems are solved numerically, if not many zeros make their expressions shorter than a solver's loops."""


def _entries(matrix: Any) -> list[list[Any]]:
    return [[matrix[i, j] for j in range(matrix.shape[1])] for i in range(matrix.shape[0])]


def _factor(a: list[list[Any]]) -> list[list[Any]]:
    """Return L below the diagonal and U on and above it, without pivoting."""
    a = [list(row) for row in a]
    count = len(a)
    for k in range(count):
        for i in range(k + 1, count):
            if a[i][k].is_zero():
                continue
            a[i][k] = a[i][k] / a[k][k]
            for j in range(k + 1, count):
                if not a[k][j].is_zero():
                    a[i][j] = a[i][j] - a[i][k] * a[k][j]
    return a


def _solved(lu: list[list[Any]], right: Sequence[Any]) -> list[Any]:
    """Return x with L U x = right."""
    x, count = list(right), len(lu)
    for i in range(count):
        for j in range(i):
            if not (lu[i][j].is_zero() or x[j].is_zero()):
                x[i] = x[i] - lu[i][j] * x[j]
    for i in reversed(range(count)):
        for j in range(i + 1, count):
            if not (lu[i][j].is_zero() or x[j].is_zero()):
                x[i] = x[i] - lu[i][j] * x[j]
        if not x[i].is_zero():
            x[i] = x[i] / lu[i][i]
    return x


def _solved_transposed(lu: list[list[Any]], right: Sequence[Any]) -> list[Any]:
    """Return x with (L U)^T x = right."""
    x, count = list(right), len(lu)
    for i in range(count):
        for j in range(i):
            if not (lu[j][i].is_zero() or x[j].is_zero()):
                x[i] = x[i] - lu[j][i] * x[j]
        if not x[i].is_zero():
            x[i] = x[i] / lu[i][i]
    for i in reversed(range(count)):
        for j in range(i + 1, count):
            if not (lu[j][i].is_zero() or x[j].is_zero()):
                x[i] = x[i] - lu[j][i] * x[j]
    return x


def reduced_expression(equations: Equations, parts: Partition, sizes: tuple[int, int, int]) -> ca.Function:
    """Return the function (q, u_i, f, p) -> u (n,), a (n,), multipliers (rows,), for n, inputs and rows in number.

    Parameters
    ----------
    equations : Equations
        Of the machine.
    parts : Partition
        Which speeds are independent.
    sizes : tuple of int
        n, inputs and rows.
    """
    n, inputs, rows = sizes
    free, dependent, pivots = list(parts.independent_speeds), list(parts.dependent_speeds), list(parts.pivots)
    m = len(free)
    q, p = ca.SX.sym("q", n), ca.SX.sym("p", len(equations.parameter_names))
    ui, f = ca.SX.sym("ui", m), ca.SX.sym("f", inputs)
    jacobian = ca.sparsify(equations.kinetics(q, p)[0])
    kept = ca.sparsify(jacobian[pivots, :]) if pivots else jacobian
    lu = _factor(_entries(kept[:, dependent])) if dependent else []

    def whole(of_free: Sequence[Any], of_dependent: Sequence[Any]) -> Any:
        column = [ca.SX(0)] * n
        for place, value in zip([*free, *dependent], [*of_free, *of_dependent], strict=True):
            column[place] = ca.SX(value)
        return ca.sparsify(ca.vertcat(*column))

    columns = []
    for k, place in enumerate(free):
        follows = [-x for x in _solved(lu, [kept[i, place] for i in range(len(dependent))])]
        columns.append(whole([float(k == other) for other in range(m)], follows))
    span = ca.horzcat(*columns) if columns else ca.SX(n, 0)
    u = ca.densify(span @ ui) if m else ca.SX.zeros(n, 1)
    c = equations.bias(q, u, f, p)[1]
    b = whole([0.0] * m, [-x for x in _solved(lu, [c[row] for row in pivots])])
    at_rest = equations.demand(q, u, ca.densify(b), f, p)  # h + M b
    heavy = ca.horzcat(*(equations.inertia(q, ca.densify(column), p) for column in columns)) if m else ca.SX(n, 0)
    carried, pushed = (span.T @ heavy, -span.T @ at_rest) if m else (ca.SX(0, 0), ca.SX(0, 1))
    ai = _solved(_factor(_entries(carried)), [pushed[i] for i in range(m)]) if m else []
    a = ca.densify((span @ ca.vertcat(*ai) if m else 0) + b)
    multipliers = ca.SX.zeros(rows, 1)
    left = (heavy @ ca.vertcat(*ai) if m else 0) + at_rest
    for row, value in zip(pivots, _solved_transposed(lu, [left[place] for place in dependent]), strict=True):
        multipliers[row] = value
    return ca.Function("reduced", [q, ui, f, p], ca.cse([u, a, multipliers]))


def elimination_operations(pattern: Array) -> int:
    """Return how many multiplications elimination in the order of a block takes.

    Parameters
    ----------
    pattern : bool array, shape (k, k)
        Which entries are not zero.

    Examples
    --------
    >>> elimination_operations(np.eye(5, dtype=bool)), elimination_operations(np.ones((5, 5), dtype=bool))
    (0, 40)
    """
    a, count = pattern.copy(), 0
    for k in range(len(a)):
        below, right = np.flatnonzero(a[k + 1 :, k]) + k + 1, np.flatnonzero(a[k, k + 1 :]) + k + 1
        count += len(below) * (1 + len(right))
        a[np.ix_(below, right)] = True
    return count


def is_short(equations: Equations, parts: Partition, coordinates: int) -> bool:
    """Tell whether elimination by hand is shorter than a solver's loops: few rows, or nearly all entries zero.

    Chains of loops stay short however long they are, as every loop shares bodies with its neighbours alone.

    Parameters
    ----------
    equations : Equations
        Of the machine.
    parts : Partition
        Which speeds are independent.
    coordinates : int
        How many there are.
    """
    if len(parts.rows) <= MOST_ROWS and coordinates <= MOST_COORDINATES:
        return True
    if coordinates * len(parts.independent_speeds) > MOST_PASSES:
        return False
    q, p = ca.SX.sym("q", coordinates), ca.SX.sym("p", len(equations.parameter_names))
    jacobian = ca.sparsify(equations.kinetics(q, p)[0])
    pattern = np.array(ca.DM(jacobian.sparsity(), 1)) != 0
    own = pattern[np.ix_(list(parts.pivots), list(parts.dependent_speeds))]
    return elimination_operations(own) <= MOST_OPERATIONS


def pivot_growth(block: Array) -> float:
    """Return how much elimination in the order of a block (k, k) magnifies errors: its largest number over a pivot.

    >>> float(pivot_growth(np.array([[1.0, 0.0], [0.0, 0.5]])))
    2.0
    """
    a, least, most = block.copy(), np.inf, float(np.max(abs(block), initial=0.0))
    for k in range(len(a)):
        pivot = a[k, k]
        least = min(least, abs(pivot))
        if pivot == 0.0:
            return np.inf
        below = np.flatnonzero(a[k + 1 :, k]) + k + 1
        if len(below):
            a[below, k + 1 :] -= np.outer(a[below, k] / pivot, a[k, k + 1 :])
            most = max(most, float(np.max(abs(a[below, k + 1 :]), initial=0.0)))
    return most / least if len(a) else 1.0
