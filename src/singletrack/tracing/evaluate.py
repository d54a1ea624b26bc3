"""A traced program run on numbers of any kind, such as balls."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping, Sequence

    from singletrack.tracing.graph import Graph

__all__ = ["evaluate"]


def evaluate(
    graph: Graph,
    outputs: Sequence[np.ndarray],
    inputs: Sequence[Any],
    operations: Mapping[str, Callable[..., Any]],
    constant: Callable[[float], Any],
) -> list[np.ndarray]:
    """Return the outputs of a graph for inputs of any kind of number.

    Parameters
    ----------
    graph : Graph
    outputs : sequence of int arrays
        Of any shapes, of nodes.
    inputs : sequence, shape (n,)
        Numbers of some kind.
    operations : mapping of str to callable
        What each operation of :data:`~singletrack.tracing.graph.OPERATIONS` does to them; a KeyError for one that
        is needed and not there.
    constant : callable
        Makes such a number of a double.

    Examples
    --------
    >>> from fractions import Fraction
    >>> import operator
    >>> from singletrack.tracing.graph import Graph
    >>> graph = Graph()
    >>> x = graph.input(3.0)
    >>> third = np.array(graph.apply("div", x, graph.constant(3.0)))
    >>> evaluate(graph, [third], [Fraction(1)], {"div": operator.truediv}, Fraction)[0].item()
    Fraction(1, 3)
    """
    found: dict[int, Any] = {}
    for number in graph.needed(int(node) for array in outputs for node in np.ravel(array)):
        node = graph.nodes[number]
        if node.operation == "constant":
            found[number] = constant(node.value)
        elif node.operation == "input":
            found[number] = inputs[node.arguments[0]]
        else:
            found[number] = operations[node.operation](*(found[argument] for argument in node.arguments))
    results = []
    for array in outputs:
        result = np.empty(array.shape, dtype=object)
        for index in np.ndindex(array.shape):
            result[index] = found[int(array[index])]
        results.append(result)
    return results
