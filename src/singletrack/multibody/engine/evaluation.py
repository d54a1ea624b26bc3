"""Fast evaluation of the equations of motion: accelerations, projection onto the constraints, exact Jacobians."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import casadi as ca
import numpy as np

from singletrack.multibody.engine.dynamics import expression, reduced
from singletrack.multibody.engine.model import State

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from singletrack.arrays import Array
    from singletrack.multibody.engine.inputs import Signal
    from singletrack.multibody.engine.prescribed import Drives

__all__ = ["Evaluator", "right_side", "slope_jacobian"]

NEWTON_STEPS = 8
CLOSED = 1e-14
CLOSE = 1e-9


class Evaluator:
    """The equations of motion for one choice of independent speeds, on memory of its own.

    Not to be used from several threads. What cannot be computed (a singular configuration) comes out as NaN.
    """

    def __init__(
        self,
        state: State,
        driven: Sequence[Signal] = (),
        start: float = -np.inf,
        stop: float = np.inf,
        drives: Drives | None = None,
    ) -> None:
        """Take the machine, its parameters and partition from a state; inputs are those inside start to stop, s."""
        self.state, self.driven = state, list(driven)
        parts, n, system = state.partition, len(state.q), state.model.system
        self.free = np.array(parts.independent_speeds, dtype=int)
        self.low, self.high = np.nextafter(start, np.inf), np.nextafter(stop, -np.inf)
        self.y, self.f = np.empty(n + len(self.free)), np.zeros(len(system.inputs))
        self.q, self.u_i = self.y[:n], self.y[n:]
        self.u, self.a, self.multipliers = np.empty(n), np.empty(n), np.empty(len(system.rows))
        buffer: Any
        buffer, self._evaluate = reduced(state.model, parts).buffer()
        for i, given in enumerate((self.q, self.u_i, self.f, state.parameters)):
            buffer.set_arg(i, memoryview(given.data))
        for i, result in enumerate((self.u, self.a, self.multipliers)):
            buffer.set_res(i, memoryview(result.data))
        count = len(system.holonomic_rows)
        self.placed, self.phi, self.columns = np.empty(n), np.empty(count), np.empty((n, count))
        closing: Any
        closing, self._hold = state.model.equations.holonomic.buffer()
        for i, given in enumerate((self.placed, state.parameters)):
            closing.set_arg(i, memoryview(given.data))
        for i, result in enumerate((self.phi, self.columns.reshape(-1))):
            closing.set_res(i, memoryview(result.data))
        self._buffers = buffer, closing  # must live as long as the memory is used
        self.rows = np.array(parts.rows[: parts.holonomic_count], dtype=int)
        self.dependent = np.array(parts.dependent_coordinates, dtype=int)
        self.drives = drives if drives and drives.names else None
        self.led = list(drives.places) if drives else []
        self.led_speeds = [parts.independent_speeds.index(place) for place in self.led]

    def inputs(self, t: float) -> Array:
        """Return the inputs at a time, seen from inside the interval.

        Shape (inputs,), N or N m.

        Parameters
        ----------
        t : float
            In s.
        """
        if self.driven:
            inside = min(max(t, self.low), self.high)
            for i, signal in enumerate(self.driven):
                self.f[i] = signal(inside)
        return self.f

    def respond(self, t: float, q: Array, u_i: Array) -> None:
        """Fill ``u``, ``a`` and ``multipliers`` for a time, coordinates and independent speeds.

        Parameters
        ----------
        t : float
            In s.
        q : array, shape (n,)
            Coordinates, m or rad.
        u_i : array, shape (m,)
            Independent speeds.
        """
        self.q[:], self.u_i[:] = q, u_i
        self._respond(t)

    def _respond(self, t: float) -> None:
        self.inputs(t)
        try:
            if self.drives is None:
                self._evaluate()
            else:
                self._drive(t, self.drives)
        except RuntimeError:  # the linear solver's word for an exactly singular matrix
            self.u[:] = self.a[:] = self.multipliers[:] = np.nan

    def _drive(self, t: float, drives: Drives) -> None:
        """Evaluate with the prescribed coordinates where they should be, and the forces that it takes."""
        value, rate, acceleration = self._wanted(t, drives)
        self.q[self.led], self.u_i[self.led_speeds] = value, rate
        drives.solve(self._evaluate, acceleration, self.led, self)

    def _wanted(self, t: float, drives: Drives) -> Array:
        return drives.at(min(max(t, self.low), self.high))

    def slope(self, t: float, y: Array) -> Array:
        """Return ``y' = [u, a_i]`` for ``y = [q, u_i]``.

        Parameters
        ----------
        t : float
            In s.
        y : array, shape (n + m,)
        """
        self.y[:] = y
        self._respond(t)
        return np.concatenate((self.u, self.a.take(self.free)))

    def close(self, q: Array) -> Array | None:
        """Return the coordinates with the dependent ones put back onto the constraints; None where that fails.

        Parameters
        ----------
        q : array, shape (n,)
            Close to the constraints.
        """
        if not len(self.rows):
            return q
        q, last = q.copy(), np.inf
        for _ in range(NEWTON_STEPS):
            self.placed[:] = q
            self._hold()
            phi, gradient = self.phi, self.columns.T
            left = float(np.max(abs(phi[self.rows])))
            if left < CLOSED or (left < CLOSE and left > 0.5 * last):  # as near as rounding lets it come
                return q
            last = left
            try:
                step = np.linalg.solve(gradient[self.rows[:, None], self.dependent], phi[self.rows])
            except np.linalg.LinAlgError:
                return None
            if not np.all(np.isfinite(step)):
                return None
            q[self.dependent] -= step
        return q if left < CLOSE * max(1.0, float(np.max(abs(q)))) else None

    def project(self, t: float, y: Array) -> State | None:
        """Return the state of ``y = [q, u_i]`` put back onto the constraints; None where that fails.

        Parameters
        ----------
        t : float
            In s.
        y : array, shape (n + m,)
            Close to the constraints.
        """
        n = len(self.q)
        if self.drives is not None:
            y = y.copy()
            y[self.led] = self._wanted(t, self.drives)[0]
        q = self.close(y[:n]) if np.all(np.isfinite(y)) else None
        if q is None:
            return None
        self.respond(t, q, y[n:])
        if not np.all(np.isfinite(self.a)):
            return None
        return State(self.state.model, self.state.parameters, self.state.partition, q, self.u.copy())


def slope_jacobian(evaluator: Evaluator) -> Callable[[float, Array], Array]:
    """Return the exact derivative, shape (n + m, n + m), of the right side by ``y = [q, u_i]``, for any t, y.

    By algorithmic differentiation of the equations, linear solutions included.

    Parameters
    ----------
    evaluator : Evaluator
        Of n coordinates and m independent speeds.
    """
    model, parts = evaluator.state.model, evaluator.state.partition
    key = ("slope jacobian", parts)
    if key not in model.cache:
        n, m = len(evaluator.q), len(evaluator.free)
        q, u_i = ca.MX.sym("q", n), ca.MX.sym("ui", m)
        f, p = ca.MX.sym("f", len(evaluator.f)), ca.MX.sym("p", len(model.equations.parameter_names))
        u, a, _ = expression(model, parts)(q, u_i, f, p)
        slope = ca.vertcat(u, a[evaluator.free.tolist()] if m else ca.MX(0, 1))
        model.cache[key] = ca.Function("j", [q, u_i, f, p], [ca.densify(ca.jacobian(slope, ca.vertcat(q, u_i)))])
    function, n = model.cache[key], len(evaluator.q)

    def jacobian(t: float, y: Array) -> Array:
        try:
            return function(y[:n], y[n:], evaluator.inputs(t), evaluator.state.parameters).full()
        except RuntimeError:
            return np.full((len(y), len(y)), np.nan)

    return jacobian


def right_side(
    state: State, driven: Sequence[Signal] = (), start: float = -np.inf, stop: float = np.inf
) -> Callable[[float, Array], Array]:
    """Return the right side of the ordinary differential equations of motion, for any integrator.

    The function returned takes a time and ``y = [q, u_i]``, all coordinates (n,) and the independent speeds (m,) of
    the state's partition, and returns ``y' = [u, a_i]``. It is fast, and not to be called from several threads.

    Parameters
    ----------
    state
        Gives the machine, its parameters and the independent speeds.
    driven
        One signal for each input; zero without.
    start, stop
        Inputs are those inside this interval of time, s: at an end that is a break, those next to it.

    Examples
    --------
    >>> from singletrack.multibody import Body, System, assemble, build, revolute
    >>> bob = Body("bob", 1.0, (0, 0, 1))
    >>> model = build(System([bob], [revolute("swing", "ground", "bob", (0, 0, 0), (0, 1, 0))], gravity=2.0))
    >>> right_side(assemble(model))(0.0, np.array([np.pi / 2, 3.0])).round(12).tolist()
    [3.0, -2.0]
    """
    return Evaluator(state, driven, start, stop).slope
