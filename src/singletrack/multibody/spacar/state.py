"""States: all coordinates and rates that belong to given generalised coordinates, rates and time; accelerations."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np
from scipy import linalg

from singletrack.arrays import Array
from singletrack.errors import ModelError
from singletrack.multibody.spacar.evaluate import convective_rates, inertia, load, strains
from singletrack.multibody.spacar.rows import Rows, Solver, solver_at
from singletrack.multibody.spacar.springs import spring_stresses

if TYPE_CHECKING:
    from singletrack.multibody.spacar.layout import Layout

__all__ = ["Motion", "State", "accelerate", "configure", "prescribed", "rates", "unwrapped"]

MOST_ITERATIONS = 40
TURN = 2.0 * np.pi
_potrf, _potrs = linalg.get_lapack_funcs(("potrf", "potrs"), (np.zeros((1, 1)),))


@dataclass(frozen=True, eq=False)
class State:
    """Coordinates x (n,), their rates v (n,), deformations e (m,), angles counted on beyond a turn, at a time, s."""

    time: float
    x: Array
    v: Array
    e: Array


@dataclass(frozen=True, eq=False)
class Motion:
    """A state with its accelerations.

    Attributes
    ----------
    state
        The state.
    rates, accelerations
        Of the deformations, (m,).
    a
        Accelerations of the coordinates, (n,).
    stresses
        Forces dual to the deformations (m,): elastic, viscous and what keeps constraints, less what is applied.
    generalised
        Accelerations of the generalised coordinates, (q,).
    """

    state: State
    rates: Array
    accelerations: Array
    a: Array
    stresses: Array
    generalised: Array


def prescribed(layout: Layout, time: float, order: int) -> tuple[Array, Array]:
    """Return prescribed values (order 0), rates (1) or accelerations (2) of deformations (m,) and coordinates (n,).

    What is prescribed moves with constant acceleration: value + rate t + acceleration t^2 / 2.

    Parameters
    ----------
    layout : Layout
        The model as arrays.
    time : float
        t, in s.
    order : int
        Of the derivative by time.
    """
    weights = ((1.0, time, time**2 / 2), (0.0, 1.0, time), (0.0, 0.0, 1.0))[order]
    return np.dot(weights, layout.e_motion), np.dot(weights, layout.x_motion)


def unwrapped(layout: Layout, e: Array, near: Array) -> Array:
    """Return deformations whose angles are counted on so that they lie nearest to given ones.

    Parameters
    ----------
    layout : Layout
        The model as arrays.
    e, near : array, shape (m,)
        Deformations, and those that they lie near.
    """
    i = layout.angles
    result = e.copy()
    result[i] += TURN * np.round((near[i] - e[i]) / TURN)
    return result


def configure(rows: Rows, state: State, of_e: Array, of_x: Array, wanted_e: Array, wanted_x: Array) -> State:
    """Return a state whose holonomic deformations and coordinates are as wanted; the others follow.

    Parameters
    ----------
    rows
        The chosen rows.
    state
        Where to start; its rates are kept as they are.
    of_e, of_x
        Values of deformations (m,) and coordinates (n,).
    wanted_e, wanted_x
        Which of them shall be reached, indices; the rest follows. All constraints are kept.

    Raises
    ------
    ModelError
        Where there is no such configuration.
    """
    layout = rows.layout
    tolerance = layout.description.settings.get("EPSKIN", 1e-12)
    keep = np.flatnonzero((layout.e_is == "fixed") & layout.holonomic)
    wanted_e = np.concatenate([keep, wanted_e[layout.holonomic[wanted_e]]]).astype(int)
    target = of_e.copy()
    target[keep] = 0.0
    x, e = state.x.copy(), state.e
    x[wanted_x] = of_x[wanted_x]
    columns = np.setdiff1d(rows.free, wanted_x)
    for _ in range(MOST_ITERATIONS):
        strain, matrix = strains(layout, x)
        e = unwrapped(layout, strain, target)
        miss = e[wanted_e] - target[wanted_e]
        if not np.all(np.isfinite(miss)):
            break
        part = matrix[np.ix_(wanted_e, columns)]
        if np.max(abs(miss), initial=0.0) <= tolerance * 1e-1 or not part.size:
            break
        step = linalg.lstsq(part, -miss, lapack_driver="gelsy", cond=1e-11, check_finite=False)[0]
        longest = np.max(abs(step), initial=0.0)
        x[columns] += step * min(1.0, 0.3 * _extent(layout) / max(longest, 1e-300))
        if longest <= 1e-15 * _extent(layout):
            break
    strain, _ = strains(layout, x)
    e = unwrapped(layout, strain, target)
    miss = abs(e[wanted_e] - target[wanted_e])
    if not np.max(miss, initial=0.0) <= max(1e-9, 10 * tolerance):
        raise ModelError(
            f"{layout.description.where}: there is no configuration near the last one that keeps"
            f" {_worst(layout, wanted_e, miss)}"
        )
    others = np.setdiff1d(layout.angles, wanted_e)
    e[others] = unwrapped(layout, strain, state.e)[others]
    return replace(state, x=x, e=e)


def _extent(layout: Layout) -> float:
    return max(1.0, float(np.max(abs(layout.drawn), initial=0.0)))


def _worst(layout: Layout, index: Array, miss: Array) -> str:
    miss = np.where(np.isfinite(miss), miss, np.inf)
    worst = int(index[np.argmax(miss)])
    keys = list(layout.e_index)
    if worst >= len(keys):
        return "the length of Euler parameters"
    return f"deformation {keys[worst][1]} of element {keys[worst][0]}"


def rates(solver: Solver, time: float, generalised: Array) -> Array:
    """Return the rates of all coordinates (n,) of generalised rates (q,).

    Parameters
    ----------
    solver : Solver
        The chosen rows at the configuration.
    time : float
        For what is prescribed, s.
    generalised : array, shape (q,)
    """
    rows = solver.rows
    right = rows.stack(*prescribed(rows.layout, time, 1))
    if rows.freedoms:
        right[-rows.freedoms :] = generalised
    return solver.solve(right)


def accelerate(
    rows: Rows, state: State, forces: Array | None = None, solver: Solver | None = None, matrix: Array | None = None
) -> Motion:
    """Return the accelerations of a state.

    Parameters
    ----------
    rows, state
        The model and its state.
    forces
        Applied generalised forces, (q,).
    solver, matrix
        The factored rows and the rows of all deformations, where they are known.

    Raises
    ------
    ModelError
        Where a freedom moves no mass.
    """
    layout = rows.layout
    if solver is None or matrix is None:
        _, matrix = strains(layout, state.x)
        solver = solver_at(rows, matrix)
    rows = solver.rows
    transfer = solver.transfer()
    mass, convective = inertia(layout, state.x, state.v)
    c = convective_rates(layout, state.x, state.v)
    e_rates = matrix @ state.v
    stress = spring_stresses(layout, state.e) + layout.viscous @ e_rates
    e_wanted, x_wanted = prescribed(layout, state.time, 2)
    bound = solver.solve(rows.stack(e_wanted - c, x_wanted))
    total = convective - load(layout, state.x) + matrix.T @ stress
    reduced = transfer.T @ mass @ transfer
    right = -transfer.T @ (total + mass @ bound) + (0.0 if forces is None else forces)
    q = _divide(rows, reduced, right)
    a = bound + transfer @ q
    of_e, _ = solver.balance(total + mass @ a)
    accelerations = matrix @ a + c
    accelerations[rows.dynamic_e] = q[len(rows.dynamic_x) :]
    return Motion(state, e_rates, accelerations, a, stress + of_e, q)


def _divide(rows: Rows, mass: Array, right: Array) -> Array:
    if not len(mass):
        return right
    diagonal = mass.diagonal()
    scale = np.sqrt(np.where(diagonal > 0.0, diagonal, 1.0))
    factors, failed = _potrf(mass / (scale[:, None] * scale), lower=1)
    if failed or factors.diagonal().min() ** 2 < 1e-14:
        values, vectors = np.linalg.eigh(mass / np.outer(scale, scale))
        worst = rows.names()[int(np.argmax(abs(vectors[:, 0])))]
        reason = "moves no mass" if values[0] < 1e-13 * max(values[-1], 1e-300) else "is badly scaled"
        raise ModelError(
            f"{rows.layout.description.where}: the freedom {worst} {reason};"
            " give it mass, or make it fixed or prescribed"
        )
    return _potrs(factors, right / scale, lower=1)[0] / scale
