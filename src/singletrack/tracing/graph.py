"""An expression graph of scalars: each value once, constants folded, nothing computed that changes nothing."""

from __future__ import annotations

import math
import operator
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable

__all__ = ["OPERATIONS", "Graph", "Node"]


def _sign(x: float) -> float:
    return math.copysign(1.0, x) if x else 0.0


def _divide(x: float, y: float) -> float:
    if y != 0:
        return x / y
    return math.nan if x == 0 or math.isnan(x) else math.copysign(math.inf, x) * math.copysign(1.0, y)


def _square_root(x: float) -> float:
    return math.sqrt(x) if x >= 0 else math.nan


#: What a node can do to its arguments, on numbers (a truth value is 1 or 0).
OPERATIONS: dict[str, Callable[..., float]] = {
    "add": operator.add,
    "sub": operator.sub,
    "mul": operator.mul,
    "div": _divide,
    "neg": operator.neg,
    "sqrt": _square_root,
    "sin": math.sin,
    "cos": math.cos,
    "tan": math.tan,
    "asin": lambda x: math.asin(x) if abs(x) <= 1 else math.nan,
    "acos": lambda x: math.acos(x) if abs(x) <= 1 else math.nan,
    "atan": math.atan,
    "atan2": math.atan2,
    "exp": math.exp,
    "log": lambda x: math.log(x) if x > 0 else math.nan,
    "pow": operator.pow,
    "abs": abs,
    "sign": _sign,
    "max": max,
    "min": min,
    "lt": lambda x, y: float(x < y),
    "le": lambda x, y: float(x <= y),
    "gt": lambda x, y: float(x > y),
    "ge": lambda x, y: float(x >= y),
    "eq": lambda x, y: float(x == y),
    "ne": lambda x, y: float(x != y),
    "and": lambda x, y: float(bool(x) and bool(y)),
    "or": lambda x, y: float(bool(x) or bool(y)),
    "not": lambda x: float(not x),
    "is_finite": lambda x: float(math.isfinite(x)),
    "select": lambda condition, no, yes: yes if condition else no,
}
_COMMUTATIVE = {"add", "mul", "max", "min", "eq", "ne", "and", "or"}


@dataclass(frozen=True)
class Node:
    """One scalar.

    Attributes
    ----------
    operation : str
        A key of :data:`OPERATIONS`, or "constant" or "input".
    arguments : tuple of int
        Nodes, by number; of an input, its place.
    value : float
        Of a constant, or what the node is for the nominal inputs.
    """

    operation: str
    arguments: tuple[int, ...]
    value: float


@dataclass
class Graph:
    """All scalars of a program, in an order in which they can be computed.

    Examples
    --------
    >>> graph = Graph()
    >>> x = graph.input(3.0)
    >>> same = graph.apply("add", graph.constant(0.0), x) == x
    >>> same, graph.nodes[graph.apply("mul", x, x)].value
    (True, 9.0)
    """

    nodes: list[Node] = field(default_factory=list)
    _known: dict[tuple[str, tuple[object, ...]], int] = field(default_factory=dict)
    inputs: int = 0

    def _add(self, key: tuple[str, tuple[object, ...]], node: Node) -> int:
        if key not in self._known:
            self._known[key] = len(self.nodes)
            self.nodes.append(node)
        return self._known[key]

    def constant(self, value: float) -> int:
        """Return the node of a number (value), of any unit."""
        value = float(value)
        return self._add(("constant", (value.hex(),)), Node("constant", (), value))

    def input(self, nominal: float) -> int:
        """Return the node of the next input, with its nominal value (of any unit), by which pivots are chosen."""
        place = self.inputs
        self.inputs += 1
        return self._add(("input", (place,)), Node("input", (place,), float(nominal)))

    def apply(self, operation: str, *arguments: int) -> int:
        """Return the node of an operation on nodes (operation and arguments as in :class:`Node`), simplified."""
        known = self._simplified(operation, arguments)
        if known is not None:
            return known
        found = [self.nodes[argument] for argument in arguments]
        if all(node.operation == "constant" for node in found):
            return self.constant(OPERATIONS[operation](*(node.value for node in found)))
        ordered = tuple(sorted(arguments)) if operation in _COMMUTATIVE else arguments
        value = OPERATIONS[operation](*(self.nodes[argument].value for argument in ordered))
        return self._add((operation, ordered), Node(operation, ordered, float(value)))

    def _number(self, node: int) -> float | None:
        found = self.nodes[node]
        return found.value if found.operation == "constant" else None

    def _simplified(self, operation: str, arguments: tuple[int, ...]) -> int | None:
        """Return the node that an operation comes down to, or None."""
        numbers = [self._number(argument) for argument in arguments]
        if operation == "select" and numbers[0] is not None:
            return arguments[2] if numbers[0] else arguments[1]
        if operation == "select" and arguments[1] == arguments[2]:
            return arguments[1]
        if operation == "neg" and self.nodes[arguments[0]].operation == "neg":
            return self.nodes[arguments[0]].arguments[0]
        if len(arguments) != 2:
            return None
        (x, y), (a, b) = arguments, numbers
        if operation == "sub" and x == y:
            return self.constant(0.0)
        rules: dict[str, list[tuple[bool, Callable[[], int]]]] = {
            "add": [(a == 0, lambda: y), (b == 0, lambda: x)],
            "sub": [(b == 0, lambda: x), (a == 0, lambda: self.apply("neg", y))],
            "mul": [
                (a == 0 or b == 0, lambda: self.constant(0.0)),
                (a == 1, lambda: y),
                (b == 1, lambda: x),
                (a == -1, lambda: self.apply("neg", y)),
                (b == -1, lambda: self.apply("neg", x)),
            ],
            "div": [(a == 0, lambda: self.constant(0.0)), (b == 1, lambda: x), (b == -1, lambda: self.apply("neg", x))],
        }
        return next((make() for holds, make in rules.get(operation, []) if holds), None)

    def needed(self, outputs: Iterable[int]) -> list[int]:
        """Return the nodes that the outputs need, each after its arguments."""
        wanted, todo = set(), list(outputs)
        while todo:
            node = todo.pop()
            if node not in wanted:
                wanted.add(node)
                if self.nodes[node].operation != "input":
                    todo += self.nodes[node].arguments
        return sorted(wanted)
