"""Accelerations and constraint forces in minimal speeds, projected numerically."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import casadi as ca
import numpy as np

from singletrack.errors import ModelError, unknown_name
from singletrack.multibody.model import span_of

if TYPE_CHECKING:
    from collections.abc import Mapping

    from singletrack.arrays import Array
    from singletrack.multibody.model import Model, State
    from singletrack.multibody.partition import Partition
    from singletrack.multibody.system import System

__all__ = ["Response", "accelerations", "reduced"]

MASSLESS = 1e-13


@dataclass(frozen=True, eq=False)
class Response:
    """What the machine does in a state: accelerations a (n,) and multipliers (rows,) of the constraints, N or N m.

    Multipliers of redundant constraints are zero: the others carry the load.
    """

    a: Array
    multipliers: Array


def input_vector(system: System, values: Mapping[str, float] | None) -> Array:
    """Return the inputs (inputs,) for some given by name; the others are zero."""
    names = [given.name for given in system.inputs]
    vector = np.zeros(len(names))
    for name, value in (values or {}).items():
        if name not in names:
            raise ModelError(unknown_name("input", name, names))
        vector[names.index(name)] = value
    return vector


def reduced(model: Model, parts: Partition) -> ca.Function:
    """Return the compiled function (q, u_i, f, p) -> u (n,), a (n,), multipliers (rows,).

    u_i are the independent speeds. With T from C T = 0 and b from C b = -c, the accelerations obey
    ``T^T M T a_i = -T^T (h + M b)``; the linear systems are solved numerically in every evaluation.
    """
    key = ("reduced", parts)
    if key not in model.cache:
        model.cache[key] = _reduced(model, parts)
    function: ca.Function = model.cache[key]
    return function


def _solve(matrix: Any, right: Any) -> Any:
    return ca.solve(matrix, right, "lapacklu") if matrix.shape[0] > 1 else right / matrix


def _reduced(model: Model, parts: Partition) -> ca.Function:
    system, equations = model.system, model.equations
    n, rows = len(system.coordinates), list(parts.rows)
    free, dependent = list(parts.independent_speeds), list(parts.dependent_speeds)
    q, p = ca.MX.sym("q", n), ca.MX.sym("p", len(equations.parameter_names))
    ui, f = ca.MX.sym("ui", len(free)), ca.MX.sym("f", len(system.inputs))
    order = np.argsort(free + dependent).tolist()
    jacobian, mass = equations.kinetics(q, p)
    if dependent:
        kept = jacobian[rows, :]
        own = kept[:, dependent]
        span = ca.vertcat(ca.MX.eye(len(free)), -_solve(own, kept[:, free]))[order, :]
    else:
        span = ca.MX.eye(n)[free, :].T
    u = span @ ui
    h, c = equations.bias(q, u, f, p)
    b = ca.MX(n, 1)
    if dependent:
        b = ca.vertcat(ca.MX(len(free), 1), -_solve(own, c[rows]))[order]
    push = -(h + mass @ b)
    ai = _solve(span.T @ (mass @ span), span.T @ push) if free else ca.MX(0, 1)
    a = span @ ai + b
    multipliers = ca.MX(len(system.rows), 1)
    if dependent:
        multipliers[rows] = _solve(own.T, (mass @ a + h)[dependent])
    return ca.Function("reduced", [q, ui, f, p], [u, a, ca.densify(multipliers)])


def accelerations(state: State, inputs: Mapping[str, float] | None = None) -> Response:
    """Return the accelerations and constraint forces of a state under constant inputs.

    Raises
    ------
    ModelError
        Where a freedom has no mass, or the joint angles are singular (gimbal lock).

    Examples
    --------
    >>> from singletrack.multibody import Body, System, assemble, build, revolute
    >>> bob = Body("bob", 1.0, (0, 0, 2))
    >>> model = build(System([bob], [revolute("swing", "ground", "bob", (0, 0, 0), (0, 1, 0))]))
    >>> round(float(accelerations(assemble(model, {"swing": 0.5235987755982988})).a[0]), 12)
    -2.4525
    """
    f = input_vector(state.model.system, inputs)
    _refuse_massless(state)
    function = reduced(state.model, state.partition)
    ui = state.u[list(state.partition.independent_speeds)]
    _, a, multipliers = function(state.q, ui, f, state.parameters)
    a, multipliers = a.full().ravel(), multipliers.full().ravel()
    return Response(a, multipliers)


def _refuse_massless(state: State) -> None:
    """Refuse a state in which some independent speed, or a combination of them, moves no mass."""
    jacobian, mass = state.model.kinetics(state.q, state.parameters)
    span = span_of(state.partition, jacobian)
    carried = span.T @ mass @ span
    size = np.sqrt(np.diag(carried))
    if not len(size):
        return
    if np.all(size > 0.0) and np.linalg.eigvalsh(carried / np.outer(size, size))[0] > MASSLESS:
        return
    raise ModelError(
        "the accelerations are not determined: a freedom has no mass, or the joint angles are singular here "
        f"(independent speeds: {', '.join(state.freedoms)})"
    )
