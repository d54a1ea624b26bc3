"""Simulation in minimal speeds, with the coordinates projected back onto the constraints after every step.

Steps end where an input is not smooth. A run ends by itself where the machine stops being the one described: a wheel
leaves the ground (its normal force falls to zero) or lies flat, a coordinate leaves its
:class:`~singletrack.multibody.Limit`, a limb is at the end of its :class:`~singletrack.multibody.Reach`. For a
bicycle: lean beyond 80 deg, a hand that can follow no further. The attributes of the result say so: ``end``, in words
such as "fell to the right", and ``end_time``, s; ``singular_times`` are those of the singular positions passed.
"""

from __future__ import annotations

from itertools import pairwise
from typing import TYPE_CHECKING, Literal

import numpy as np

from singletrack.errors import ModelError, unknown_name
from singletrack.multibody.engine.evaluation import Evaluator
from singletrack.multibody.engine.events import Event, Moment, Watched, default_ends, watched
from singletrack.multibody.engine.feedback import Controller
from singletrack.multibody.engine.inputs import Signal, signals
from singletrack.multibody.engine.prescribed import driven_state
from singletrack.multibody.engine.results import Snapshot, gather
from singletrack.multibody.engine.stepping import HaltError, Run, advance

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping, Sequence

    import xarray as xr

    from singletrack.arrays import Array
    from singletrack.multibody.engine.inputs import Given, Signal
    from singletrack.multibody.engine.model import State
    from singletrack.multibody.engine.prescribed import Law, Prescribed
    from singletrack.parameters.feedback import Feedback

__all__ = ["Event", "simulate"]

METHODS = ("DOP853", "RK45", "RK23", "Radau", "BDF", "LSODA")
AT_ONCE = 1e-6


def simulate(
    state: State,
    times: Array,
    inputs: Mapping[str, Given] | None = None,
    *,
    events: Sequence[Event] = (),
    ends: bool | None = None,
    singular: Literal["stop", "pass"] = "stop",
    trouble: Literal["raise", "end"] = "raise",
    method: str = "DOP853",
    rtol: float = 1e-10,
    atol: float = 1e-11,
    max_step: float = np.inf,
    most_steps: int = 200_000,
    prescribed: Mapping[str, Prescribed | Law] | None = None,
    feedback: Feedback | None = None,
    progress: Callable[[float], object] | None = None,
) -> xr.Dataset:
    """Simulate the full nonlinear motion, and say how it ended.

    Parameters
    ----------
    state
        Where it starts (see :func:`assemble` and :func:`move`); it satisfies the constraints by construction.
    times
        Times of the results, s, increasing, (k,); the first is the start.
    inputs
        Inputs over time, by name: numbers, functions of time, :class:`Pulse` or :class:`Sampled`.
    events
        What to watch for; the moments are in the result's ``event_time``.
    ends
        Let it end where the machine stops being the one described (module's text); by default if no event is terminal.
    singular, trouble
        In a singular position ``stop``, or ``pass`` it where the branch of the motion continues; where the simulation
        cannot go on ``raise``, or ``end`` with the results so far.
    method, rtol, atol, max_step, most_steps
        Integrator of scipy (DOP853 or RK45; Radau for stiff machines), tolerances of a step, longest step, s; how many.
    prescribed
        Coordinates that move as given, by name: :class:`Prescribed`, or functions of time (s) that return value, rate
        and acceleration. The results' ``input`` has what it takes: ``steer torque``, or the ``NAME drive``.
    feedback, progress
        State feedback with gains that are numbers; what is called with the time reached, s, after every step.

    Returns
    -------
    xarray.Dataset
        See :mod:`singletrack.multibody.engine.results`; the attribute ``end`` says how it ended.

    Raises
    ------
    ModelError
        For times that do not increase, prescribed motions that do not fit the state, or where it cannot go on; time,
        place and loops are named.

    Examples
    --------
    >>> from singletrack.multibody import Body, System, assemble, build, revolute
    >>> bob = Body("bob", 1.0, (0, 0, 9.81))
    >>> model = build(System([bob], [revolute("swing", "ground", "bob", (0, 0, 0), (0, 1, 0))]))
    >>> run = simulate(assemble(model, {"swing": 1e-5}), np.linspace(0, np.pi, 5))
    >>> round(float(run.q.sel(coordinate="swing")[-1] * 1e5), 6), run.attrs["end"]
    (-1.0, 'all times reached')
    """
    times = _checked(times, method, singular, trouble)
    state, drives = driven_state(state, prescribed, float(times[0]), float(times[-1]), inputs or {})
    driven, control = _driven(state, times, inputs, feedback)
    longest = min([max_step, drives.max_step, *(signal.max_step for signal in driven)])
    options = {"rtol": rtol, "atol": atol, "max_step": longest}
    watched_by_default = not any(event.terminal for event in events)
    stops = default_ends(state) if (watched_by_default if ends is None else ends) else []
    watch = [*map(watched, events), *stops]
    run = Run(state, driven, watch, times, method, options, singular == "pass", most_steps, progress, drives)
    _end_at_once(run, stops)
    return _finish(run, _go(run, trouble, control))


def _driven(
    state: State, times: Array, inputs: Mapping[str, Given] | None, feedback: Feedback | None
) -> tuple[list[Signal], Controller | None]:
    """Return the inputs over time, and the controller that they are of, if there is feedback."""
    given = signals(state.model.system, inputs)
    if feedback is None:
        return given, None
    control = Controller(feedback, state.model.system, given, (float(times[0]), float(times[-1])))
    return control.signals, control


def _go(run: Run, trouble: str, control: Controller | None) -> str:
    """Run through the intervals in which the inputs are smooth; return what went wrong."""
    first, last = float(run.times[0]), float(run.times[-1])
    breaks = {b for signal in run.signals for b in signal.breaks} | run.drives.breaks
    breaks |= control.breaks if control else set()
    try:
        for bounds in pairwise([first, *sorted(b for b in breaks if first < b < last), last]):
            if control is not None:
                control.measure(bounds[0], run.state)
            while run.time < bounds[1] and not run.ended:
                advance(run, bounds[1], bounds)
    except HaltError as halt:
        if trouble == "raise":
            raise ModelError(str(halt)) from None
        if run.snapshots[-1].time < run.time:
            run.snapshots.append(Snapshot(run.time, run.state))
        return str(halt)
    return ""


def _finish(run: Run, reason: str) -> xr.Dataset:
    found = gather(run.snapshots, run.signals, run.happened, run.drives)
    found.attrs["end"] = reason or run.ended or "all times reached"
    found.attrs["end_time"] = run.time
    if run.passed:
        found.attrs["singular_times"] = [loss.time for loss in run.passed]
    return found


def _checked(times: Array, method: str, singular: str, trouble: str) -> Array:
    for what, found, known in (
        ("method", method, METHODS),
        ("way with singular positions", singular, ("stop", "pass")),
        ("way with trouble", trouble, ("raise", "end")),
    ):
        if found not in known:
            raise ModelError(unknown_name(what, str(found), known))
    times = np.asarray(times, dtype=float)
    if times.ndim != 1 or len(times) < 2 or not np.all(np.isfinite(times)) or not np.all(np.diff(times) > 0.0):
        raise ModelError("times: at least two, increasing, finite")
    return times


def _end_at_once(run: Run, ends: Sequence[Watched]) -> None:
    """End a run that begins where it should end."""
    evaluator = Evaluator(run.state, run.signals, drives=run.drives)
    evaluator.respond(run.time, run.state.q, run.state.u[evaluator.free])
    start = Moment(run.time, run.state, evaluator.multipliers.copy())
    for event in ends:
        if event.direction < 0 and event.value(start) < -AT_ONCE:
            run.ended = event.saying(run.state)
            run.happened.append((run.ended, run.time))
            return
