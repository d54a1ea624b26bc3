"""Statics: equilibrium under load, natural frequencies at rest, loads at which the equilibrium buckles.

Stiffness is that of :func:`small_motions` without velocities: of the springs, of the stresses (geometric stiffness) and
of the loads; all exact.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np
from scipy import linalg

from singletrack.arrays import Array
from singletrack.errors import ModelError
from singletrack.multibody.spacar.evaluate import inertia, load, strains
from singletrack.multibody.spacar.linearise import small_motions
from singletrack.multibody.spacar.rows import solver_at
from singletrack.multibody.spacar.springs import spring_stresses, spring_tangent
from singletrack.multibody.spacar.state import Motion, State, configure

if TYPE_CHECKING:
    from singletrack.multibody.spacar.rows import Rows

__all__ = ["Buckling", "buckling", "equilibrium", "frequencies", "held"]

MOST_ITERATIONS = 50
MOST_HALVINGS = 12
MOST_STEPS = 100


@dataclass(frozen=True, eq=False)
class Buckling:
    """Factors (k,) of the given loads at which the drawn equilibrium buckles, and the modes (k, q) by freedom."""

    factors: Array
    modes: Array


def held(rows: Rows, state: State, factor: float = 1.0) -> tuple[Motion, Array]:
    """Return a state at rest, held where it is, and the generalised forces (q,) that hold it.

    Its stresses are those of springs and constraints; what holds the generalised coordinates is not among them.

    Parameters
    ----------
    rows : Rows
        The chosen constraints and generalised coordinates.
    state : State
    factor : float
        Of the given forces.
    """
    layout = rows.layout
    still = replace(state, v=np.zeros_like(state.x))
    _, matrix = strains(layout, still.x)
    solver = solver_at(rows, matrix)
    rows = solver.rows
    _, weight = inertia(layout, still.x, still.v)
    stress = spring_stresses(layout, still.e)
    total = weight - load(layout, still.x, factor) + matrix.T @ stress
    of_e, of_x = solver.balance(total)
    needed = -rows.generalised(of_e, of_x)
    of_e[rows.dynamic_e] = 0.0
    zero_e, zero_x = np.zeros(len(layout.e_is)), np.zeros(len(still.x))
    return Motion(still, zero_e, zero_e, zero_x, stress + of_e, np.zeros(rows.freedoms)), needed


def _stiffness(rows: Rows, motion: Motion, factor: float = 1.0) -> tuple[Array, Array]:
    """Return mass and stiffness (q, q) about a motion at rest."""
    small = small_motions(rows, motion, factor, massless=True)
    return small.M, small.K[:, : len(small.M)]


def equilibrium(rows: Rows, start: State, factor: float = 1.0) -> Motion:
    """Return the equilibrium under the constant loads (and weight), from a configuration near it or by steps of load.

    Parameters
    ----------
    rows, start
        The model, and where to start.
    factor
        Of the given loads; weight is always whole.

    Raises
    ------
    ModelError
        Where no equilibrium is found.
    """
    state, reached, step = start, 0.0, factor
    if not rows.freedoms:
        return held(rows, start, factor)[0]
    for _ in range(MOST_STEPS):
        target = factor if abs(factor - reached) <= abs(step) * (1 + 1e-12) else reached + step
        found = _newton(rows, state, target)
        if found is not None:
            if target == factor:
                return held(rows, found, factor)[0]
            state, reached, step = found, target, 1.5 * step
            continue
        step /= 2.0
        if abs(step) < abs(factor) / 2**MOST_HALVINGS or factor == 0.0:
            break
    raise ModelError(
        f"{rows.layout.description.where}: no equilibrium is found beyond {reached:.4g} of the loads;"
        " does it buckle, or can a freedom move without a spring?"
    )


def _newton(rows: Rows, state: State, factor: float) -> State | None:
    layout = rows.layout
    given_e = np.flatnonzero(np.isin(layout.e_is, ("prescribed", "dynamic", "kinematic")))
    given_x = np.flatnonzero(np.isin(layout.x_is, ("prescribed", "dynamic", "kinematic")))
    of_x = state.x.copy()
    of_e = state.e.copy()
    size = np.inf
    for _ in range(MOST_ITERATIONS):
        motion, needed = held(rows, state, factor)
        # Held with what it needs, so that the stiffness is that of the held state.
        _, stiffness = _stiffness(rows, _with(rows, motion, -needed), factor)
        if not np.all(np.isfinite(stiffness)):
            return None
        try:
            step = np.linalg.solve(stiffness, -needed)
        except np.linalg.LinAlgError:
            return None
        new = float(np.max(abs(step)))
        if not np.isfinite(new) or (new > 10.0 * size and new > 1e-6):
            return None
        scale = min(1.0, 1.0 / max(new, 1e-300))
        of_x, of_e = state.x.copy(), state.e.copy()
        count = len(rows.dynamic_x)
        of_x[rows.dynamic_x] += scale * step[:count]
        of_e[rows.dynamic_e] += scale * step[count:]
        try:
            state = configure(rows, state, of_e, of_x, given_e, given_x)
        except ModelError:
            return None
        if new <= 1e-12 * max(1.0, float(np.max(abs(rows.generalised(of_e, of_x))))) or (
            new >= size / 2 and new < 1e-9
        ):
            return state
        size = new
    return None


def _with(rows: Rows, motion: Motion, forces: Array) -> Motion:
    """Return a motion with forces on the generalised deformations among its stresses."""
    stresses = motion.stresses.copy()
    stresses[rows.dynamic_e] += forces[len(rows.dynamic_x) :]
    return replace(motion, stresses=stresses)


def frequencies(rows: Rows, motion: Motion, factor: float = 1.0) -> tuple[Array, Array]:
    """Return natural frequencies, rad/s, (q,), sorted, and modes (q, q), one a column, about an equilibrium.

    An unstable mode has an imaginary frequency; it comes first, as a negative number.

    Parameters
    ----------
    rows : Rows
        The chosen constraints and generalised coordinates.
    motion : Motion
        At rest, in equilibrium.
    factor : float
        Of the given forces.
    """
    mass, stiffness = _stiffness(rows, motion, factor)
    try:
        values, modes = linalg.eigh((stiffness + stiffness.T) / 2, mass)
    except linalg.LinAlgError:
        raise ModelError(f"{rows.layout.description.where}: a freedom moves no mass") from None
    return np.sign(values) * np.sqrt(abs(values)), modes


def buckling(rows: Rows, start: State) -> Buckling:
    """Return the factors of the given loads at which the drawn equilibrium buckles: linear before buckling.

    Parameters
    ----------
    rows, start
        The model and the drawn configuration.

    Raises
    ------
    ModelError
        Where there are no loads, or the unloaded model has no stiffness.
    """
    base, needed_0 = held(rows, start, 0.0)
    loaded, needed_1 = held(rows, start, 1.0)
    _, k_0 = _stiffness(rows, base, 0.0)
    if not np.any(needed_1 - needed_0) and np.allclose(base.stresses, loaded.stresses):
        raise ModelError(f"{rows.layout.description.where}: no loads that stress it; buckling needs FORCE")
    try:
        displaced = np.linalg.solve(k_0, -(needed_1 - needed_0))
    except np.linalg.LinAlgError:
        raise ModelError(
            f"{rows.layout.description.where}: without loads it has no stiffness against some freedom"
        ) from None
    # The stresses of springs follow from the small displacements under the loads; constraints balance the rest.
    layout = rows.layout
    _, matrix = strains(layout, start.x)
    solver = solver_at(rows, matrix)
    stress = spring_tangent(layout, start.e) @ (matrix @ (solver.transfer() @ displaced))
    total = load(layout, start.x, 0.0) - load(layout, start.x, 1.0) + matrix.T @ stress
    of_e, _ = solver.balance(total)
    of_e[rows.dynamic_e] = 0.0
    state = replace(base, stresses=base.stresses + stress + of_e)
    _, k_1 = _stiffness(rows, state, 1.0)
    geometric = k_1 - k_0
    values, modes = linalg.eig(-geometric, k_0)
    order = [
        i for i in np.argsort(-abs(values)) if abs(values[i].imag) < 1e-9 * abs(values[i]) and abs(values[i]) > 1e-12
    ]
    return Buckling(1.0 / values[order].real, modes[:, order].real.T)
