"""Accelerations and constraint forces in minimal speeds, projected numerically."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import casadi as ca
import numpy as np

from singletrack.arrays import Array
from singletrack.errors import ModelError, unknown_name
from singletrack.multibody.engine.articulated import tree_expression
from singletrack.multibody.engine.assembly import SINGULAR_HERE, refuse_undefined, span_of
from singletrack.multibody.engine.kept import kept
from singletrack.multibody.engine.reduction import is_short, reduced_expression

if TYPE_CHECKING:
    from collections.abc import Mapping

    from singletrack.multibody.engine.model import Model, State
    from singletrack.multibody.engine.partition import Partition
    from singletrack.multibody.engine.system import System

__all__ = [
    "Response",
    "accelerations",
    "by_hand",
    "expression",
    "loop_forces",
    "reduced",
    "split_wheel_forces",
    "wheel_forces",
]

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

    Parameters
    ----------
    model : Model
        The machine.
    parts : Partition
        Which speeds are independent.
    """
    key = ("reduced", parts)
    if key not in model.cache:
        model.cache[key] = kept(expression(model, parts))
    function: ca.Function = model.cache[key]
    return function


def expression(model: Model, parts: Partition) -> ca.Function:
    """Return the function of :func:`reduced` as an expression, which can be differentiated.

    Parameters
    ----------
    model : Model
        The machine.
    parts : Partition
        Which speeds are independent.
    """
    key = ("expression", parts)
    if key not in model.cache:
        model.cache[key] = _reduced(model, parts)
    function: ca.Function = model.cache[key]
    return function


def by_hand(model: Model, parts: Partition) -> bool:
    """Tell whether the dependent speeds are eliminated symbolically, in the order of the partition's pivots.

    Parameters
    ----------
    model : Model
        The machine.
    parts : Partition
        Which speeds are independent.
    """
    key = ("by hand", parts)
    if key not in model.cache:
        model.cache[key] = is_short(model.equations, parts, len(model.system.coordinates))
    answer: bool = model.cache[key]
    return answer


def _solve(matrix: Any, right: Any) -> Any:
    return ca.solve(matrix, right, "lapacklu") if matrix.shape[0] > 1 else right / matrix


def _reduced(model: Model, parts: Partition) -> ca.Function:
    system = model.system
    if not system.rows and parts.independent_speeds == tuple(range(len(system.coordinates))):
        return tree_expression(system, model.equations)
    if by_hand(model, parts):
        sizes = len(system.coordinates), len(system.inputs), len(system.rows)
        return reduced_expression(model.equations, parts, sizes)
    return _reduced_numerically(model, parts)


def _reduced_numerically(model: Model, parts: Partition) -> ca.Function:
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
        followed = -_solve(own, kept[:, free]) if free else ca.MX(len(dependent), 0)
        span = ca.vertcat(ca.MX.eye(len(free)), followed)[order, :]
    else:
        span = ca.MX.eye(n)[free, :].T
    u = ca.densify(span @ ui) if free else ca.MX.zeros(n, 1)
    h, c = equations.bias(q, u, f, p)
    b = ca.MX(n, 1)
    if dependent:
        b = ca.vertcat(ca.MX(len(free), 1), -_solve(own, c[rows]))[order]
    push = -(h + mass @ b)
    ai = _solve(span.T @ (mass @ span), span.T @ push) if free else ca.MX(0, 1)
    a = span @ ai + b if free else b
    multipliers = ca.MX(len(system.rows), 1)
    if dependent:
        multipliers[rows] = _solve(own.T, (mass @ a + h)[dependent])
    return ca.Function("solved", [q, ui, f, p], [u, ca.densify(a), ca.densify(multipliers)])


def accelerations(state: State, inputs: Mapping[str, float] | None = None) -> Response:
    """Return the accelerations and constraint forces of a state under constant inputs (N, N m).

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
    try:
        _, a, multipliers = function(state.q, ui, f, state.parameters)
    except RuntimeError:  # the linear solver's word for an exactly singular matrix
        raise ModelError(SINGULAR_HERE) from None
    a, multipliers = a.full().ravel(), multipliers.full().ravel()
    if not np.all(np.isfinite(a)):
        raise ModelError(SINGULAR_HERE)
    return Response(a, multipliers)


def loop_forces(state: State, inputs: Mapping[str, float] | None = None) -> dict[str, Array]:
    """Return the force (3,) of the first body on the second of every closed loop, in the ground's frame, N.

    Parameters
    ----------
    state : State
        Whose accelerations decide the forces.
    inputs : mapping, optional
        Values of inputs by name, N or N m; those not given are zero.

    Examples
    --------
    How hard does the leaned rider press? The force of each hand on the handlebar, forward and down:

    >>> from singletrack import load_bicycle, load_rider
    >>> from singletrack.multibody import bicycle_model, ride
    >>> leaned = ride(bicycle_model(load_bicycle("stratos"), load_rider("rider-a"), "leaned"), 0.0)
    >>> forces = loop_forces(leaned)
    >>> list(forces)
    ['right hand', 'left hand']
    >>> bool(forces["left hand"][2] > 0)
    True
    """
    multipliers = accelerations(state, inputs).multipliers
    forces, _ = state.model.equations.loop_wrenches(state.q, multipliers, state.parameters)
    names = [closure.name for closure in state.model.system.closures]
    return dict(zip(names, forces.full().T, strict=True))


def wheel_forces(state: State, inputs: Mapping[str, float] | None = None) -> dict[str, Array]:
    """Return the force (longitudinal, lateral, normal) of the ground on every wheel, N.

    The normal force is positive when the wheel presses on the ground.

    By the wheels' names, each of shape (3,).

    Parameters
    ----------
    state : State
        Whose accelerations decide the forces.
    inputs : mapping, optional
        Values of inputs by name, N or N m; those not given are zero.

    Examples
    --------
    >>> from singletrack import load_bicycle
    >>> from singletrack.multibody import bicycle_model, ride
    >>> loads = wheel_forces(ride(bicycle_model(load_bicycle("benchmark")), 0.0))
    >>> round(float(sum(load[2] for load in loads.values())) / 9.81, 9)  # kg
    94.0
    """
    by_wheel = split_wheel_forces(state.model.system, accelerations(state, inputs).multipliers[None])
    return dict(zip((wheel.name for wheel in state.model.system.wheels), by_wheel[0], strict=True))


def split_wheel_forces(system: System, multipliers: Array) -> Array:
    """Return (k, wheels, 3) longitudinal, lateral and normal forces from multipliers (k, rows), N.

    Parameters
    ----------
    system : System
        The machine.
    multipliers : array, shape (k, rows)
    """
    holonomic, wheels = len(system.holonomic_rows), len(system.wheels)
    normal = -multipliers[:, holonomic - wheels : holonomic]
    rolling = multipliers[:, holonomic:].reshape(len(multipliers), wheels, 2)
    return np.concatenate([rolling, normal[:, :, None]], axis=2)


def _refuse_massless(state: State) -> None:
    """Refuse a state in which some independent speed, or a combination of them, moves no mass."""
    jacobian, mass = state.model.kinetics(state.q, state.parameters)
    refuse_undefined(state.model, state.q, state.parameters)
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
