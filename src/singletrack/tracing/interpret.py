"""A function traced by JAX, scalar by scalar: arrays become arrays of nodes, loops over their entries unroll."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import jax
import numpy as np

from singletrack.errors import InputError
from singletrack.tracing.graph import OPERATIONS, Graph
from singletrack.tracing.moves import MOVES
from singletrack.tracing.solve import lu, permutation, triangular_solve

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

__all__ = ["trace"]

_SAME_NAME = set(OPERATIONS) - {"select", "div"}
_UNCHANGED = {"convert_element_type", "stop_gradient", "real", "copy", "copy_p", "reduce_precision"}
#: Operations that only move entries about: by NumPy, or on their positions by JAX itself.
_MOVES = {*MOVES, "expand_dims", "stack", "pad", "gather", "scatter", "dynamic_slice", "dynamic_update_slice", "split"}
#: Which operands say where, rather than being moved.
_INDICES = {"gather": {1}, "scatter": {1}, "dynamic_slice": {1, 2, 3, 4}, "dynamic_update_slice": {2, 3, 4, 5}}
_CALLS = {"jit": "jaxpr", "pjit": "jaxpr", "closed_call": "call_jaxpr", "core_call": "call_jaxpr", "remat": "jaxpr"}
_CALLS |= {"custom_jvp_call": "call_jaxpr", "custom_vjp_call": "call_jaxpr", "custom_vjp_call_jaxpr": "fun_jaxpr"}
_REDUCTIONS = {"reduce_sum": "add", "reduce_max": "max", "reduce_min": "min", "reduce_prod": "mul"}
_REDUCTIONS |= {"reduce_and": "and", "reduce_or": "or"}


def trace(function: Callable[[Any], Any], nominal: Sequence[float]) -> tuple[Graph, list[np.ndarray]]:
    """Return the expression graph of a function of one array of inputs.

    Parameters
    ----------
    function : callable
        Takes a JAX array, shape (n,); returns an array or a tuple of arrays.
    nominal : sequence of float, shape (n,)
        Inputs, of any unit, at which pivots of linear systems are chosen.

    Returns
    -------
    graph : Graph
    outputs : list of int arrays
        For each array returned, its shape, with the number of each entry's node.

    Raises
    ------
    InputError
        For an operation that cannot be written as scalar statements.

    Examples
    --------
    >>> import jax
    >>> jax.config.update("jax_enable_x64", True)
    >>> graph, (sum_of_squares,) = trace(lambda x: (x * x).sum(), [1.0, 2.0])
    >>> graph.nodes[int(sum_of_squares)].value
    5.0
    """
    closed: Any = jax.make_jaxpr(function)(np.asarray(nominal, dtype=float))
    graph = Graph()
    inputs = np.array([graph.input(value) for value in nominal], dtype=np.intp)
    return graph, _Interpreter(graph).run(closed.jaxpr, closed.consts, [inputs])


class _Interpreter:
    def __init__(self, graph: Graph) -> None:
        self.graph = graph

    def constants(self, value: Any) -> np.ndarray:
        array = np.asarray(value)
        flat = [self.graph.constant(float(entry)) for entry in array.ravel()]
        return np.array(flat, dtype=np.intp).reshape(array.shape)

    def run(self, jaxpr: Any, consts: Sequence[Any], arguments: Sequence[np.ndarray]) -> list[np.ndarray]:
        """Return the outputs of a jaxpr; arguments and outputs are arrays of nodes, of the shapes it says."""
        found: dict[Any, np.ndarray] = dict(zip(jaxpr.constvars, map(self.constants, consts), strict=True))
        found |= dict(zip(jaxpr.invars, arguments, strict=True))

        def read(atom: Any) -> np.ndarray:
            return found[atom] if atom in found else self.constants(atom.val)

        for equation in jaxpr.eqns:
            operands = [found[a] if not hasattr(a, "val") else self.constants(a.val) for a in equation.invars]
            results = self._apply(equation, operands)
            found |= dict(zip(equation.outvars, results, strict=True))
        return [found[a] if not hasattr(a, "val") else self.constants(a.val) for a in jaxpr.outvars]

    def _apply(self, equation: Any, operands: list[np.ndarray]) -> list[np.ndarray]:
        name, params = equation.primitive.name, equation.params
        if name in _SAME_NAME or name in {"div", "integer_pow", "square", "select_n", "rsqrt"}:
            return [self._elementwise(name, params, operands)]
        if name in _UNCHANGED:
            return operands[:1]
        if name in _MOVES:
            return self._moved(equation, operands)
        if name == "iota":
            return [self.constants(equation.primitive.bind(**params))]
        return self._combined(name, params, operands)

    def _combined(self, name: str, params: dict[str, Any], operands: list[np.ndarray]) -> list[np.ndarray]:
        if name in _REDUCTIONS:
            return [self._reduced(_REDUCTIONS[name], params["axes"], operands[0])]
        if name == "dot_general":
            return [self._product(params["dimension_numbers"], operands[0], operands[1])]
        return self._structured(name, params, operands)

    def _structured(self, name: str, params: dict[str, Any], operands: list[np.ndarray]) -> list[np.ndarray]:
        if name in _CALLS:
            inner = params[_CALLS[name]]
            return self.run(getattr(inner, "jaxpr", inner), getattr(inner, "consts", ()), operands)
        if name == "custom_linear_solve":
            lengths, solve = params["const_lengths"], params["jaxprs"].solve
            before = lengths.matvec + lengths.vecmat
            own = operands[before : before + lengths.solve]
            sides = operands[before + lengths.solve + lengths.transpose_solve :]
            return self.run(solve.jaxpr, solve.consts, [*own, *sides])
        if name == "lu":
            return lu(self.graph, operands[0])
        if name == "triangular_solve":
            return [triangular_solve(self.graph, operands[0], operands[1], params)]
        if name == "lu_pivots_to_permutation":
            return [permutation(self.graph, operands[0], params["permutation_size"])]
        raise InputError(f"trace: the operation {name} cannot be written as scalar statements")

    def _elementwise(self, name: str, params: dict[str, Any], operands: list[np.ndarray]) -> np.ndarray:
        apply = self.graph.apply
        one = self.graph.constant(1.0)

        def power(x: int, exponent: int) -> int:
            if exponent < 0:
                return apply("div", one, power(x, -exponent))
            half = one if exponent < 2 else power(x, exponent // 2)
            return apply("mul", apply("mul", half, half), x if exponent % 2 else one)

        special: dict[str, Callable[..., int]] = {
            "integer_pow": lambda x: power(x, params["y"]),
            "square": lambda x: apply("mul", x, x),
            "rsqrt": lambda x: apply("div", one, apply("sqrt", x)),
            "select_n": lambda condition, no, yes: apply("select", condition, no, yes),
        }
        function: Callable[..., int] = special.get(name, lambda *nodes: apply(name, *nodes))
        arrays = np.broadcast_arrays(*operands)
        flat = [function(*(int(node) for node in nodes)) for nodes in zip(*(a.ravel() for a in arrays), strict=True)]
        return np.array(flat, dtype=np.intp).reshape(arrays[0].shape)

    def _moved(self, equation: Any, operands: list[np.ndarray]) -> list[np.ndarray]:
        if equation.primitive.name in MOVES:
            return [MOVES[equation.primitive.name](*operands, **equation.params)]
        where = _INDICES.get(equation.primitive.name, set())
        moved = [operand for k, operand in enumerate(operands) if k not in where]
        start, places = 0, []
        for k, operand in enumerate(operands):
            if k in where:
                numbers = [self.graph.nodes[int(node)].value for node in operand.ravel()]
                places.append(np.array(numbers, dtype=np.int64).reshape(operand.shape))
            else:
                places.append(start + np.arange(operand.size).reshape(operand.shape))
                start += operand.size
        bind: Any = equation.primitive.bind
        result = bind(*(jax.numpy.asarray(place) for place in places), **equation.params)
        pool = np.concatenate([a.ravel() for a in moved])
        results = result if equation.primitive.multiple_results else [result]
        return [pool[np.asarray(found)] for found in results]

    def _reduced(self, operation: str, axes: tuple[int, ...], operand: np.ndarray) -> np.ndarray:
        kept = [axis for axis in range(operand.ndim) if axis not in axes]
        rows = operand.transpose(*kept, *axes).reshape(*(operand.shape[k] for k in kept), -1)
        result = rows[..., 0].copy()
        for k in range(1, rows.shape[-1]):
            result = self._elementwise(operation, {}, [result, rows[..., k]])
        return np.asarray(result)

    def _product(self, dimensions: Any, a: np.ndarray, b: np.ndarray) -> np.ndarray:
        (over_a, over_b), (batch_a, batch_b) = dimensions
        free_a = [k for k in range(a.ndim) if k not in (*over_a, *batch_a)]
        free_b = [k for k in range(b.ndim) if k not in (*over_b, *batch_b)]
        shape = [a.shape[k] for k in (*batch_a, *free_a)] + [b.shape[k] for k in free_b]
        batch = int(np.prod([a.shape[k] for k in batch_a], dtype=int))
        inner = int(np.prod([a.shape[k] for k in over_a], dtype=int))
        left = a.transpose(*batch_a, *free_a, *over_a).reshape(batch, -1, 1, inner)
        right = b.transpose(*batch_b, *free_b, *over_b).reshape(batch, 1, -1, inner)
        return self._reduced("add", (3,), self._elementwise("mul", {}, [left, right])).reshape(shape)
