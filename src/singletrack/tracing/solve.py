"""Small linear systems unrolled: pivots are chosen once, by nominal values; the user of a program checks its result."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    from singletrack.tracing.graph import Graph

__all__ = ["lu", "permutation", "triangular_solve"]


def _minus_product(graph: Graph, a: int, b: int, c: int) -> int:
    return graph.apply("sub", a, graph.apply("mul", b, c))


def lu(graph: Graph, matrices: np.ndarray) -> list[np.ndarray]:
    """Return the triangular factors, pivots and permutations of matrices (..., n, n) of nodes of a graph.

    Columns are eliminated in order; of the rows left, the one with the largest nominal entry becomes the next.
    """
    *batch, n, _ = matrices.shape
    factors = matrices.reshape(-1, n, n).copy()
    pivots, orders = np.zeros((len(factors), n), dtype=int), np.tile(np.arange(n), (len(factors), 1))
    for which, matrix in enumerate(factors):
        for k in range(n):
            sizes = [abs(graph.nodes[int(node)].value) for node in matrix[k:, k]]
            chosen = k + int(np.argmax(sizes))
            pivots[which, k] = chosen
            matrix[[k, chosen]] = matrix[[chosen, k]]
            orders[which, [k, chosen]] = orders[which, [chosen, k]]
            for i in range(k + 1, n):
                matrix[i, k] = graph.apply("div", int(matrix[i, k]), int(matrix[k, k]))
                for j in range(k + 1, n):
                    matrix[i, j] = _minus_product(graph, int(matrix[i, j]), int(matrix[i, k]), int(matrix[k, j]))
    numbers = [np.vectorize(graph.constant, otypes=[np.intp])(a.reshape(*batch, n)) for a in (pivots, orders)]
    return [factors.reshape(matrices.shape), *numbers]


def permutation(graph: Graph, pivots: np.ndarray, size: int) -> np.ndarray:
    """Return the permutations (..., size) that row exchanges, pivots (..., k), amount to: constants of a graph."""
    flat = pivots.reshape(-1, pivots.shape[-1])
    orders = np.tile(np.arange(size), (len(flat), 1))
    for order, exchanges in zip(orders, flat, strict=True):
        for k, node in enumerate(exchanges):
            other = int(graph.nodes[int(node)].value)
            order[[k, other]] = order[[other, k]]
    nodes: np.ndarray = np.vectorize(graph.constant, otypes=[np.intp])(orders)
    return nodes.reshape(*pivots.shape[:-1], size)


def triangular_solve(graph: Graph, a: np.ndarray, b: np.ndarray, params: dict[str, Any]) -> np.ndarray:
    """Return x with a x = b (or x a = b), a (..., n, n), b (..., n, k), nodes of a graph; params are JAX's."""
    if not params["left_side"]:
        turned = {**params, "left_side": True, "transpose_a": not params["transpose_a"]}
        return triangular_solve(graph, a, b.swapaxes(-1, -2), turned).swapaxes(-1, -2)
    if params["transpose_a"]:
        a = a.swapaxes(-1, -2)
    lower = bool(params["lower"]) != bool(params["transpose_a"])
    n = a.shape[-1]
    order = range(n) if lower else range(n - 1, -1, -1)
    matrices, sides = a.reshape(-1, n, n), b.reshape(-1, *b.shape[-2:]).copy()
    for matrix, side in zip(matrices, sides, strict=True):
        for place, i in enumerate(order):
            for column in range(side.shape[1]):
                value = int(side[i, column])
                for j in list(order)[:place]:
                    value = _minus_product(graph, value, int(matrix[i, j]), int(side[j, column]))
                side[i, column] = value if params["unit_diagonal"] else graph.apply("div", value, int(matrix[i, i]))
    return sides.reshape(b.shape)
