"""Exact directional derivatives of the whole constrained motion.

Let q0, u0 be a state, a0 its accelerations and m0 its multipliers. Along a change of the independent coordinates the
dependent ones follow by the gradient of the constraints, ``dq = T_q dq_i``; the speeds follow from ``C du = -d(C u)``
and the accelerations from ``C da = -d(C a + c)``. Put into the equations of motion with the multipliers held, and
projected on the allowed speeds T, their change is

    T^T (M da + dR) = T^T df,

because ``T^T C^T = 0`` removes the unknown change of the multipliers, while the term ``d(C^T) m0`` inside dR keeps
what the loads on curved constraints do (geometric stiffness). The directional derivatives
are exact: forward algorithmic differentiation of the expressions.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from singletrack.arrays import Array
from singletrack.multibody.engine.assembly import span_of

if TYPE_CHECKING:
    from singletrack.multibody.engine.dynamics import Response
    from singletrack.multibody.engine.model import State

__all__ = ["Variations", "vary"]


@dataclass(frozen=True, eq=False)
class Variations:
    """Derivatives of the motion of a machine with n coordinates, k of them independent, and m independent speeds.

    Attributes
    ----------
    span
        Speeds for each independent speed alone, T (n, m).
    M, C, K
        ``M da_i + C du_i + K dq_i = T^T df``, shapes (m, m), (m, m), (m, k).
    coordinate_directions
        How all coordinates follow the independent ones, T_q (n, k).
    speed_changes
        How the speeds follow the independent coordinates while the independent speeds are held, (n, k).
    acceleration_changes, residual_changes
        How accelerations and the equations' residual R change with the independent coordinates and speeds while the
        independent accelerations and the multipliers are held, (n, k + m) each.
    """

    span: Array
    M: Array
    coordinate_directions: Array
    K: Array
    C: Array
    speed_changes: Array
    acceleration_changes: Array
    residual_changes: Array


def _change(state: State, response: Response, f: Array, dq: Array, du: Array) -> tuple[Array, Array, Array]:
    """Return the changes of R, C u and C a + c along one direction."""
    out = state.model.equations.tangent(state.q, state.u, response.a, response.multipliers, f, dq, du, state.parameters)
    residual, rate, acceleration = (value.full().ravel() for value in out)
    return residual, rate, acceleration


def _follow(state: State, jacobian: Array, right: Array) -> Array:
    """Return changes x (n,) with C x = -right and no change of the independent speeds."""
    parts = state.partition
    dependent, rows = list(parts.dependent_speeds), list(parts.rows)
    x = np.zeros(len(state.q))
    if dependent:
        x[dependent] = -np.linalg.solve(jacobian[np.ix_(rows, dependent)], right[rows])
    return x


def _coordinate_directions(state: State, jacobian: Array) -> Array:
    """Return T_q (n, independent coordinates): how the dependent coordinates follow the independent ones."""
    parts = state.partition
    dependent, free = list(parts.dependent_coordinates), list(parts.independent_coordinates)
    directions = np.zeros((len(state.q), len(free)))
    directions[free, range(len(free))] = 1.0
    if dependent:
        gradient = jacobian[list(parts.rows[: parts.holonomic_count])]
        directions[dependent] = -np.linalg.solve(gradient[:, dependent], gradient[:, free])
    return directions


def vary(state: State, response: Response, f: Array) -> Variations:
    """Return the exact derivatives of the motion in a state, under inputs f (inputs,), with its response.

    See the module's text.
    """
    jacobian, mass = state.model.kinetics(state.q, state.parameters)
    span = span_of(state.partition, jacobian)
    directions = _coordinate_directions(state, jacobian)
    zero = np.zeros(len(state.q))
    stiffness, speed_changes, followed, left = [], [], [], []
    for dq in directions.T:
        _, rate, _ = _change(state, response, f, dq, zero)
        du = _follow(state, jacobian, rate)
        residual, _, acceleration = _change(state, response, f, dq, du)
        da = _follow(state, jacobian, acceleration)
        stiffness.append(span.T @ (residual + mass @ da))
        speed_changes.append(du)
        followed.append(da)
        left.append(residual)
    damping = []
    for du in span.T:
        residual, _, acceleration = _change(state, response, f, zero, du)
        da = _follow(state, jacobian, acceleration)
        damping.append(span.T @ (residual + mass @ da))
        followed.append(da)
        left.append(residual)
    columns = np.array(speed_changes).reshape(-1, len(zero)).T
    m, k = span.shape[1], directions.shape[1]
    stiff, damped = np.array(stiffness).reshape(k, m).T, np.array(damping).reshape(m, m).T
    changes = [np.array(part).reshape(-1, len(zero)).T for part in (followed, left)]
    return Variations(span, span.T @ mass @ span, directions, stiff, damped, columns, *changes)
