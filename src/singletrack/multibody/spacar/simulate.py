"""Forward dynamics: all coordinates and the generalised rates are integrated, and put back on the constraints."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np
from scipy import integrate, linalg

from singletrack.errors import ModelError
from singletrack.multibody.spacar.evaluate import strains
from singletrack.multibody.spacar.linearise import small_motions
from singletrack.multibody.spacar.rows import solver_at
from singletrack.multibody.spacar.state import State, accelerate, prescribed, rates, unwrapped

if TYPE_CHECKING:
    from singletrack.arrays import Array
    from singletrack.multibody.spacar.rows import Rows, Solver
    from singletrack.multibody.spacar.state import Motion

__all__ = ["simulate"]

#: The most evaluations of a motion: this, and more for every step asked for.
MOST_EVALUATIONS, MORE_EVALUATIONS = 20_000, 400
#: Above this ratio of the fastest frequency to the steps asked for, an implicit method is used.
STIFF = 2_000.0


class _Equations:
    """The equations as a first-order system in y = (free coordinates, angles beyond a turn, generalised rates)."""

    def __init__(self, rows: Rows, start: State, forces: Array | None) -> None:
        self.rows, self.start, self.forces = rows, start, forces
        self.layout = rows.layout
        self.u, self.k = len(rows.free), len(self.layout.angles)
        self.count, self.most = 0, MOST_EVALUATIONS

    def pack(self, state: State) -> Array:
        _, matrix = strains(self.layout, state.x)
        moving = self.rows.generalised(matrix @ state.v, state.v)
        return np.concatenate([state.x[self.rows.free], state.e[self.layout.angles], moving])

    def unpack(self, time: float, y: Array) -> tuple[State, Solver, Array]:
        x = self.start.x.copy()
        x[self.rows.free] = y[: self.u]
        e, matrix = strains(self.layout, x)
        near = np.zeros_like(e)
        near[self.layout.angles] = y[self.u : self.u + self.k]
        solver = solver_at(self.rows, matrix)
        v = rates(solver, time, y[self.u + self.k :])
        return State(time, x, v, unwrapped(self.layout, e, near)), solver, matrix

    def slope(self, time: float, y: Array) -> Array:
        self.count += 1
        if self.count > self.most:
            raise ModelError(
                f"{self.layout.description.where}: at {time:.6g} s the motion had taken {self.most} evaluations;"
                " make what is very stiff or almost massless fixed, or ask for more steps or a shorter time"
            )
        if not np.all(np.isfinite(y)):
            raise ModelError(f"{self.layout.description.where}: the motion is not finite at {time:.6g} s")
        state, solver, matrix = self.unpack(time, y)
        motion = accelerate(self.rows, state, self.forces, solver, matrix)
        return np.concatenate([state.v[self.rows.free], motion.rates[self.layout.angles], motion.generalised])

    def project(self, time: float, y: Array) -> Array:
        """Return y with its coordinates put back on constraints and on what is prescribed, by the least change."""
        layout = self.layout
        of_e, of_x = prescribed(layout, time, 0)
        index = np.flatnonzero(((layout.e_is == "fixed") | (layout.e_is == "prescribed")) & layout.holonomic)
        given = self.rows.prescribed_x
        x = self.start.x.copy()
        x[self.rows.free] = y[: self.u]
        x[given] = of_x[given]
        columns = np.setdiff1d(self.rows.free, given)
        for _ in range(6):
            strain, matrix = strains(layout, x)
            miss = unwrapped(layout, strain, of_e)[index] - of_e[index]
            if np.max(abs(miss), initial=0.0) < 1e-14 * max(1.0, float(np.max(abs(x), initial=0.0))):
                break
            part = matrix[np.ix_(index, columns)]
            if not part.size:
                break
            x[columns] -= linalg.lstsq(part, miss, lapack_driver="gelsy", cond=1e-11, check_finite=False)[0]
        result = y.copy()
        result[: self.u] = x[self.rows.free]
        near = np.zeros(len(layout.e_is))
        near[layout.angles] = y[self.u : self.u + self.k]
        result[self.u : self.u + self.k] = unwrapped(layout, strains(layout, x)[0], near)[layout.angles]
        return result


def simulate(rows: Rows, start: State, times: Array, forces: Array | None = None) -> list[Motion]:
    """Return the motion at given times.

    Parameters
    ----------
    rows, start
        The model and where it starts.
    times
        Times, s, increasing from the start's.
    forces
        Constant generalised forces, (q,).

    Raises
    ------
    ModelError
        Where the motion runs into a singular configuration, or is too stiff to follow.
    """
    equations = _Equations(rows, start, forces)
    equations.most += MORE_EVALUATIONS * len(times)
    settings = rows.layout.description.settings
    tolerance = min(max(settings.get("EPSINT", 1e-9), 1e-13), 1e-2)
    solver_class = integrate.Radau if _stiff(equations, start, times) else integrate.DOP853
    options: dict[str, Any] = {"rtol": max(tolerance, 3e-14), "atol": tolerance * 1e-2}
    if "HMAX" in settings:
        options["max_step"] = settings["HMAX"]
    y = equations.pack(start)
    found = [_at(equations, times[0], y)]
    solver = solver_class(equations.slope, times[0], y, times[-1], **options) if len(times) > 1 and y.size else None
    for time in times[1:]:
        while solver is not None and solver.t < time:
            if solver.step() is not None and solver.status == "failed":
                raise ModelError(
                    f"{rows.layout.description.where}: the motion could not be followed beyond {solver.t:.6g} s"
                )
            if solver_class is integrate.DOP853:
                interpolant = solver.dense_output()
                solver.y = equations.project(solver.t, solver.y)
                solver.f = equations.slope(solver.t, solver.y)
            else:
                interpolant = solver.dense_output()
        if solver is None:
            found.append(_at(equations, time, y))
        else:
            now = solver.y if solver.t == time else interpolant(time)
            found.append(_at(equations, time, equations.project(time, now)))
    return found


def _at(equations: _Equations, time: float, y: Array) -> Motion:
    state, solver, matrix = equations.unpack(float(time), y)
    strain, _ = strains(equations.layout, state.x)
    return accelerate(
        equations.rows, replace(state, e=unwrapped(equations.layout, strain, state.e)), equations.forces, solver, matrix
    )


def _stiff(equations: _Equations, start: State, times: Array) -> bool:
    """Tell whether elastic frequencies would force an explicit method to steps far shorter than those asked for."""
    if not equations.rows.freedoms or not (np.any(equations.layout.elastic) or np.any(equations.layout.viscous)):
        return False
    fastest = float(
        np.max(abs(small_motions(equations.rows, accelerate(equations.rows, start)).eigenvalues()), initial=0.0)
    )
    return bool(fastest * (times[-1] - times[0]) > STIFF * 10)
