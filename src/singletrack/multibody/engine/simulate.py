"""Simulation in minimal speeds, with the coordinates projected back onto the constraints after every step."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from itertools import pairwise
from typing import TYPE_CHECKING, Any

import numpy as np

from singletrack.arrays import Array
from singletrack.errors import ModelError, unknown_name
from singletrack.multibody.engine.assembly import span_of
from singletrack.multibody.engine.dynamics import reduced, right_side
from singletrack.multibody.engine.inputs import Signal, signals
from singletrack.multibody.engine.model import State
from singletrack.multibody.engine.partition import partition
from singletrack.multibody.engine.results import Snapshot, gather

if TYPE_CHECKING:
    from collections.abc import Mapping

    import xarray as xr

    from singletrack.multibody.engine.inputs import Given

__all__ = ["Event", "simulate"]

WORSE = 30.0
SINGULAR = 1e8
GIVES_WAY = "the constraints lose rank, the loops can move in more than one way"


@dataclass(frozen=True, eq=False)
class Event:
    """Something to watch for: the moments when ``value(time, state)`` goes through zero.

    ``direction`` +1 counts only rising, -1 only falling passages; ``terminal`` ends the simulation.

    >>> Event("fallen", lambda time, state: abs(state["lean"]) - 1.0, terminal=True).name
    'fallen'
    """

    name: str
    value: Callable[[float, State], float]
    terminal: bool = False
    direction: int = 0


@dataclass(eq=False)
class _Run:
    """A simulation under way."""

    state: State
    signals: list[Signal]
    events: Sequence[Event]
    times: Array
    options: dict[str, Any]
    solver: Any
    samples: list[Snapshot] = field(default_factory=list)
    passages: list[tuple[str, float]] = field(default_factory=list)
    next_sample: int = 0
    ended: bool = False


def simulate(
    state: State,
    times: Array,
    inputs: Mapping[str, Given] | None = None,
    *,
    events: Sequence[Event] = (),
    method: str = "DOP853",
    rtol: float = 1e-10,
    atol: float = 1e-11,
    max_step: float = np.inf,
) -> xr.Dataset:
    """Simulate the full nonlinear motion.

    Parameters
    ----------
    state
        Where it starts (see :func:`assemble` and :func:`move`); it satisfies the constraints by construction.
    times
        Times of the results, s, increasing, (k,); the first is the start.
    inputs
        Inputs over time, by name: numbers, functions of time, :class:`Pulse` or :class:`Sampled`. Steps end where
        an input is not smooth.
    events
        What to watch for; the moments are in the result's ``event_time``.
    method
        Integrator of scipy: DOP853 or RK45, or Radau for stiff machines.
    rtol, atol
        Relative and absolute tolerance of a step.
    max_step
        Longest step, s.

    Returns
    -------
    xarray.Dataset
        See :mod:`singletrack.multibody.engine.results`.

    Raises
    ------
    ModelError
        For times that do not increase, or where the machine becomes singular; the time is named.

    Examples
    --------
    >>> from singletrack.multibody import Body, System, assemble, build, revolute
    >>> bob = Body("bob", 1.0, (0, 0, 9.81))
    >>> model = build(System([bob], [revolute("swing", "ground", "bob", (0, 0, 0), (0, 1, 0))]))
    >>> run = simulate(assemble(model, {"swing": 1e-5}), np.linspace(0, np.pi, 5))
    >>> round(float(run.q.sel(coordinate="swing")[-1] * 1e5), 6)
    -1.0
    """
    import scipy.integrate  # slow to import

    known = ("DOP853", "RK45", "RK23", "Radau", "BDF", "LSODA")
    if method not in known:
        raise ModelError(unknown_name("method", method, known))
    times = np.asarray(times, dtype=float)
    if times.ndim != 1 or len(times) < 2 or not np.all(np.diff(times) > 0.0):
        raise ModelError("times: at least two, increasing")
    driven = signals(state.model.system, inputs)
    longest = min([max_step, *(signal.max_step for signal in driven)])
    options = {"rtol": rtol, "atol": atol, "max_step": longest}
    run = _Run(state, driven, events, times, options, getattr(scipy.integrate, method))
    breaks = {b for signal in driven for b in signal.breaks if times[0] < b < times[-1]}
    edges = [times[0], *sorted(breaks), times[-1]]
    for start, stop in pairwise(edges):
        if not run.ended:
            _segment(run, start, stop)
    return gather(state, driven, times, run.samples, run.passages)


def _segment(run: _Run, start: float, stop: float) -> None:
    """Integrate from one break of the inputs to the next."""
    t = start
    while t < stop and not run.ended:
        t = _stretch(run, t, stop)


def _stretch(run: _Run, start: float, stop: float) -> float:
    """Integrate with one choice of independent speeds for as long as it is a good one; return the time reached."""
    state = run.state
    free = list(state.partition.independent_speeds)
    slope = right_side(state, run.signals, start, stop)
    solver = run.solver(slope, start, np.concatenate([state.q, state.u[free]]), stop, **run.options)
    first_condition, side = _condition(state)
    while solver.status == "running":
        message = solver.step()
        if solver.status == "failed" or not np.all(np.isfinite(solver.y)):
            raise ModelError(f"the simulation cannot go on at t = {solver.t:.6g} s: {message or 'not finite'}")
        before, run.state = run.state, _project(state, solver.y)
        dense = solver.dense_output()
        end = _watch(run, solver.t_old, solver.t, dense, before)
        _record(run, end, dense)
        if run.ended:
            return end
        moved = np.concatenate([run.state.q, solver.y[len(state.q) :]])
        if np.any(moved != solver.y):
            solver.y = moved
            if hasattr(solver, "f"):
                solver.f = slope(solver.t, moved)
        condition, now = _condition(run.state)
        if now != side:
            raise ModelError(f"singular between t = {solver.t_old:.6g} and {solver.t:.6g} s: {GIVES_WAY}")
        if condition > WORSE * first_condition:
            run.state = _repartition(run.state, solver.t)
            return float(solver.t)
    return float(solver.t)


def _project(state: State, y: Array) -> State:
    """Return the state with its dependent coordinates put back onto the constraints."""
    n, parts = len(state.q), state.partition
    q = y[:n].copy()
    rows, dependent = list(parts.rows[: parts.holonomic_count]), list(parts.dependent_coordinates)
    for _ in range(4 if rows else 0):
        phi, gradient = state.model.holonomic(q, state.parameters)
        if np.max(abs(phi[rows])) < 1e-14:
            break
        q[dependent] -= np.linalg.solve(gradient[np.ix_(rows, dependent)], phi[rows])
    function = reduced(state.model, parts)
    no_input = np.zeros(len(state.model.system.inputs))
    u = function(q, y[n:], no_input, state.parameters)[0].full().ravel()
    return State(state.model, state.parameters, parts, q, u)


def _condition(state: State) -> tuple[float, float]:
    """Return how bad the choice of independent speeds is, and a sign that changes at singularities.

    Bad is what makes others much faster than the independent speeds, or their equations ill-conditioned.
    The sign is that of the determinant of the dependent columns of the constraints. Where it changes, the
    constraints have lost their rank in between: a bad choice of speeds is given up before.
    """
    parts = state.partition
    if not parts.rows:
        return 1.0, 1.0
    jacobian, _ = state.model.kinetics(state.q, state.parameters)
    dependent = jacobian[np.ix_(list(parts.rows), list(parts.dependent_speeds))]
    fastest = float(np.max(abs(span_of(parts, jacobian)), initial=1.0))
    return max(fastest, float(np.linalg.cond(dependent))), float(np.linalg.slogdet(dependent)[0])


def _repartition(state: State, t: float) -> State:
    """Choose independent speeds anew, the best there are here."""
    jacobian, _ = state.model.kinetics(state.q, state.parameters)
    try:
        parts = partition(state.model.system.replace(independent=None), jacobian)
    except ModelError as error:
        raise ModelError(f"singular at t = {t:.6g} s: {error}") from None
    moved = State(state.model, state.parameters, parts, state.q, state.u)
    if len(parts.rows) != len(state.partition.rows) or _condition(moved)[0] > SINGULAR:
        raise ModelError(f"singular at t = {t:.6g} s: {GIVES_WAY}")
    return moved


def _watch(run: _Run, start: float, stop: float, dense: Any, before: State) -> float:
    """Note the passages of events in a step; return where it ends, which a terminal event may bring forward."""
    from scipy.optimize import brentq  # slow to import

    found = []
    for event in run.events:

        def value(t: float, event: Event = event) -> float:
            return float(event.value(t, _project(run.state, dense(t))))

        low, high = float(event.value(start, before)), float(event.value(stop, run.state))
        rises = low < 0.0 <= high
        falls = low > 0.0 >= high
        if (rises and event.direction >= 0) or (falls and event.direction <= 0):
            moment = float(brentq(value, start, stop, xtol=1e-13)) if high != 0.0 else stop
            found.append((moment, event))
    for moment, event in sorted(found, key=lambda item: item[0]):
        run.passages.append((event.name, moment))
        if event.terminal:
            run.ended = True
            run.state = _project(run.state, dense(moment))
            return moment
    return stop


def _record(run: _Run, stop: float, dense: Any) -> None:
    """Keep the results due up to a time, and the last moment if the simulation ends there."""
    while run.next_sample < len(run.times) and run.times[run.next_sample] <= stop:
        t = run.times[run.next_sample]
        run.samples.append(Snapshot(t, _project(run.state, dense(t))))
        run.next_sample += 1
    if run.ended and run.samples[-1].time < stop:
        run.samples.append(Snapshot(stop, run.state))
