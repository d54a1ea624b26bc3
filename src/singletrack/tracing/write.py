"""A traced program as source text: one statement a scalar."""

from __future__ import annotations

from collections import Counter
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Sequence

    from singletrack.tracing.graph import Graph

__all__ = ["javascript_function", "python_function", "python_program"]

_SIGNS = {"add": "+", "sub": "-", "mul": "*", "div": "/", "lt": "<", "le": "<=", "gt": ">", "ge": ">="}
_JAVASCRIPT = {
    **{name: f"({{0}} {sign} {{1}})" for name, sign in _SIGNS.items()},
    **{
        name: f"Math.{name}({{0}})"
        for name in ("sqrt", "sin", "cos", "tan", "asin", "acos", "atan", "exp", "log", "abs", "sign")
    },
    **{name: f"Math.{name}({{0}}, {{1}})" for name in ("atan2", "pow", "max", "min")},
    "eq": "({0} === {1})",
    "ne": "({0} !== {1})",
    "and": "({0} && {1})",
    "or": "({0} || {1})",
    "not": "!{0}",
    "neg": "-{0}",
    "is_finite": "Number.isFinite({0})",
    "select": "({0} ? {2} : {1})",
}
_PYTHON = {
    **{name: f"({{0}} {sign} {{1}})" for name, sign in _SIGNS.items()},
    **{name: f"math.{name}({{0}})" for name in ("sqrt", "sin", "cos", "tan", "asin", "acos", "atan", "exp", "log")},
    "atan2": "math.atan2({0}, {1})",
    "pow": "{0} ** {1}",
    "max": "max({0}, {1})",
    "min": "min({0}, {1})",
    "eq": "({0} == {1})",
    "ne": "({0} != {1})",
    "and": "({0} and {1})",
    "or": "({0} or {1})",
    "not": "(not {0})",
    "neg": "-{0}",
    "abs": "abs({0})",
    "sign": "math.copysign(1.0, {0})",
    "is_finite": "math.isfinite({0})",
    "select": "({2} if {0} else {1})",
}

#: Without `math`: what these words mean, numbers or arrays, is settled where the program is run.
_EITHER = {
    **{name: f"({{0}} {sign} {{1}})" for name, sign in (*_SIGNS.items(), ("eq", "=="), ("ne", "!="))},
    **{name: f"{name}({{0}})" for name in ("sqrt", "sin", "cos", "tan", "asin", "acos", "atan", "exp", "log", "abs")},
    **{name: f"{name}({{0}}, {{1}})" for name in ("atan2", "pow")},
    "max": "maximum({0}, {1})",
    "min": "minimum({0}, {1})",
    "and": "({0} & {1})",
    "or": "({0} | {1})",
    "neg": "-{0}",
    "select": "where({0}, {2}, {1})",
}
_WIDTH = 108


def _statements(
    graph: Graph, outputs: Iterable[int], forms: dict[str, str], name: Callable[[int], str]
) -> list[tuple[str, str]]:
    """Return (name, expression) of all that is needed and is neither a number nor an input."""
    found = []
    for number in graph.needed(outputs):
        node = graph.nodes[number]
        if node.operation not in {"constant", "input"}:
            found.append((name(number), forms[node.operation].format(*map(name, node.arguments))))
    return found


def javascript_function(name: str, graph: Graph, outputs: list[np.ndarray]) -> str:
    """Return ``function name(p, o)``: reads the inputs p, writes the entries of all outputs to o, one after the other.

    Parameters
    ----------
    name : str
    graph : Graph
    outputs : list of int arrays
        Of any shapes; their entries are numbers of nodes, indices into the graph, written in C order.

    Examples
    --------
    >>> import numpy as np
    >>> from singletrack.tracing import Graph
    >>> graph = Graph()
    >>> x = graph.input(3.0)
    >>> print(javascript_function("square", graph, [np.array(graph.apply("mul", x, x))]))
    export function square(p, o) {
      const t1 = (p[0] * p[0]);
      o[0] = t1;
    }
    <BLANKLINE>
    """

    def word(number: int) -> str:
        node = graph.nodes[number]
        if node.operation == "constant":
            text = repr(node.value).replace("inf", "Infinity").replace("nan", "NaN")
            return f"({text})" if text.startswith("-") else text
        return f"p[{node.arguments[0]}]" if node.operation == "input" else f"t{number}"

    flat = [int(number) for array in outputs for number in np.ravel(array)]
    lines = [f"  const {target} = {source};" for target, source in _statements(graph, flat, _JAVASCRIPT, word)]
    lines += [f"  o[{k}] = {word(number)};" for k, number in enumerate(flat)]
    return "\n".join([f"export function {name}(p, o) {{", *lines, "}", ""])


def python_function(name: str, graph: Graph, outputs: list[np.ndarray]) -> str:
    """Return ``def name(p, o)`` with ``math``; graph and outputs (of any shapes) as in :func:`javascript_function`."""

    def word(number: int) -> str:
        node = graph.nodes[number]
        if node.operation == "constant":
            text = repr(node.value)
            return f"math.{text}" if text in {"inf", "nan"} else (f"({text})" if text.startswith("-") else text)
        return f"p[{node.arguments[0]}]" if node.operation == "input" else f"t{number}"

    flat = [int(number) for array in outputs for number in np.ravel(array)]
    lines = [f"    {target} = {source}" for target, source in _statements(graph, flat, _PYTHON, word)]
    lines += [f"    o[{k}] = {word(number)}" for k, number in enumerate(flat)]
    return "\n".join([f"def {name}(p, o):", *lines, ""])


def python_program(name: str, graph: Graph, outputs: list[np.ndarray], inputs: Sequence[str]) -> str:
    """Return ``def name(inputs)``, which returns the entries of all outputs in one tuple.

    What is used once stands where it is used. The functions ``sqrt, sin, cos, where, maximum, ...`` are names that the
    program's surroundings give a meaning: those of numbers, or those of arrays.

    Parameters
    ----------
    name : str
    graph : Graph
    outputs : list of int arrays
        Of any shapes; their entries are nodes, returned in C order.
    inputs : sequence of str
        A name for each input.

    Examples
    --------
    >>> import numpy as np
    >>> from singletrack.tracing import Graph
    >>> graph = Graph()
    >>> x = graph.input(3.0)
    >>> root = graph.apply("sqrt", graph.apply("mul", x, x))
    >>> print(python_program("size", graph, [np.array([root])], ["length"]))
    def size(length):
        return (
            sqrt((length * length)),
        )
    <BLANKLINE>
    """
    flat = [int(number) for array in outputs for number in np.ravel(array)]
    needed = graph.needed(flat)
    uses = Counter(flat)
    for number in needed:
        node = graph.nodes[number]
        uses.update(node.arguments if node.operation != "input" else ())
    words: dict[int, str] = {}
    lines = []
    for number in needed:
        node = graph.nodes[number]
        if node.operation == "input":
            words[number] = inputs[node.arguments[0]]
        elif node.operation == "constant":
            words[number] = f"({node.value!r})" if node.value < 0 else repr(node.value)
        else:
            text = _EITHER[node.operation].format(*(words[argument] for argument in node.arguments))
            inline = uses[number] == 1 and len(text) <= _WIDTH
            words[number] = text if inline else f"t{number}"
            lines += [] if inline else [f"    t{number} = {text}"]
    lines += ["    return (", *(f"        {words[number]}," for number in flat), "    )"]
    return "\n".join([f"def {name}({', '.join(inputs)}):", *lines, ""])
