"""Steps of a simulation: taken, checked, repeated with other independent speeds where the choice was bad."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from singletrack.arrays import Array
from singletrack.errors import ModelError
from singletrack.multibody.engine.assembly import span_of
from singletrack.multibody.engine.dynamics import by_hand
from singletrack.multibody.engine.evaluation import Evaluator, slope_jacobian
from singletrack.multibody.engine.events import Moment, Watched, passages
from singletrack.multibody.engine.inputs import Signal
from singletrack.multibody.engine.model import State
from singletrack.multibody.engine.passing import NEAR, best_choice, continue_through
from singletrack.multibody.engine.prescribed import Drives
from singletrack.multibody.engine.reduction import pivot_growth
from singletrack.multibody.engine.results import Snapshot
from singletrack.multibody.engine.singular import RankLoss, Usual, find_rank_loss, firmness, weakest

__all__ = ["HaltError", "Run", "advance"]

WORSE = 4.0
HOPELESS = 1e9
SHORTEST = 1e-12
MOST_TRIES = 100
CRAWLING, MOST_CRAWLED = 1e-8, 20
GIVES_WAY = "the constraints lose rank, the loops can move in more than one way"
IMPLICIT = ("Radau", "BDF", "LSODA")


class HaltError(Exception):
    """The simulation cannot go on; says why."""


@dataclass(eq=False)
class Run:
    """A simulation under way."""

    state: State
    signals: Sequence[Signal]
    events: Sequence[Watched]
    times: Array
    method: str
    options: dict[str, Any]
    passes: bool
    steps_left: int
    progress: Callable[[float], object] | None = None
    drives: Drives = field(default_factory=Drives)
    first_step: float | None = None
    time: float = field(init=False)
    usual: Usual = field(init=False)
    snapshots: list[Snapshot] = field(default_factory=list)
    happened: list[tuple[str, float]] = field(default_factory=list)
    passed: list[RankLoss] = field(default_factory=list)
    next_sample: int = 1
    ended: str = ""
    firm: tuple[float, State] = field(init=False)
    crawled: int = 0

    def __post_init__(self) -> None:
        self.time = float(self.times[0])
        self.snapshots.append(Snapshot(self.time, self.state))
        self.usual = Usual.of(self.state)
        self.firm = self.time, self.state

    def rewind(self) -> None:
        """Go back to the last state that was far from a singular position."""
        self.time, self.state = self.firm
        self.snapshots = [self.snapshots[0], *(s for s in self.snapshots[1:] if s.time <= self.time)]
        self.next_sample = int(np.searchsorted(self.times, self.time, side="right"))
        self.happened = [(name, t) for name, t in self.happened if t <= self.time]
        self.first_step = None


def quality(state: State) -> tuple[float, float]:
    """Return how bad the choice of independent speeds is, and a sign that changes where it fails.

    Bad is what makes other coordinates much faster than the independent ones, or the equations ill-conditioned. The
    sign is that of the determinant of the dependent columns of the constraints.
    """
    parts = state.partition
    if not parts.rows:
        return 1.0, 1.0
    jacobian, _ = state.model.kinetics(state.q, state.parameters)
    dependent = jacobian[np.ix_(list(parts.rows), list(parts.dependent_speeds))]
    dependent = dependent / np.linalg.norm(jacobian[list(parts.rows)], axis=1, keepdims=True)
    eliminated = dependent[[parts.rows.index(row) for row in parts.pivots]]
    growth = pivot_growth(eliminated) if by_hand(state.model, parts) else 1.0
    try:
        fastest = float(np.max(abs(span_of(parts, jacobian)), initial=1.0))
        return max(fastest, float(np.linalg.cond(dependent)), growth), float(np.linalg.slogdet(dependent)[0])
    except (ModelError, np.linalg.LinAlgError):
        return np.inf, 0.0


def advance(run: Run, stop: float, bounds: tuple[float, float]) -> None:
    """Integrate with one choice of independent speeds for as long as it is a good one, at most up to a time.

    Parameters
    ----------
    run
        The simulation; its state and time are moved on.
    stop
        Where to stop, s.
    bounds
        The interval in which the inputs are smooth, s.

    Raises
    ------
    HaltError
        Where the machine becomes singular, or the steps go to nothing.
    """
    evaluator = Evaluator(run.state, run.signals, *bounds, drives=run.drives)
    solver = _solver(run, evaluator, stop)
    at_first, side = quality(run.state)
    condition = at_first
    while solver.status == "running" and condition <= WORSE * at_first and not run.ended:
        if not _try(solver):
            return _repeat(run, bounds, solver)
        after, dense = evaluator.project(solver.t, solver.y), solver.dense_output()
        motion = _motion(evaluator, dense)
        loss = find_rank_loss(run.state, motion, dense, (run.time, float(solver.t)), run.usual)
        if loss is not None:
            return _at_singular(run, loss, bounds)
        condition, now = quality(after) if after is not None else (np.inf, 0.0)
        if after is None or now != side or condition > HOPELESS:
            return _repeat(run, bounds, solver)
        _accept(run, after, float(solver.t), motion)
        _carry_on(solver, evaluator, after)
    if condition > WORSE * at_first and not run.ended:
        _choose_anew(run)
    return None


def _accept(run: Run, after: State, t: float, motion: Callable[[float], Moment | None]) -> None:
    """Take a step: move the run on, note what happened."""
    start, run.state, run.time, run.first_step = run.time, after, t, None
    if run.usual.now > 2.0 * NEAR * run.usual.firmness:
        run.firm = run.time, run.state
    _note(run, start, motion)
    run.steps_left -= 1
    if run.drives.names and not run.ended:
        _refuse_crawling(run, run.time - start)
    if run.steps_left <= 0 and not run.ended:
        raise HaltError(f"gave up at t = {run.time:.6g} s: all steps used up, the last of {run.time - start:.3g} s")


def _refuse_crawling(run: Run, step: float) -> None:
    """Stop where a prescribed motion drives loops into a position that they cannot pass: ever faster, ever shorter."""
    run.crawled = run.crawled + 1 if step < CRAWLING * max(1.0, abs(run.time)) else 0
    if run.crawled > MOST_CRAWLED:
        loops = ", ".join(weakest(run.state, len(run.state.partition.rows), run.usual))
        raise HaltError(
            f"at t = {run.time:.6g} s {loops} cannot follow: {', '.join(run.drives.names)} is prescribed beyond what "
            "the loops allow"
        )


def _carry_on(solver: Any, evaluator: Evaluator, after: State) -> None:
    """Let the integrator go on from the state put back onto the constraints."""
    moved = np.concatenate([after.q, solver.y[len(after.q) :]])
    if np.any(moved != solver.y):
        solver.y = moved
        if hasattr(solver, "f"):
            solver.f = evaluator.slope(solver.t, moved)


def _solver(run: Run, evaluator: Evaluator, stop: float) -> Any:
    import scipy.integrate  # slow to import

    y = np.concatenate([run.state.q, run.state.u[evaluator.free]])
    options = dict(run.options)
    if run.first_step is not None:
        options["first_step"] = min(run.first_step, stop - run.time)
    if run.method in IMPLICIT and not run.drives.names:
        options["jac"] = slope_jacobian(evaluator)
    if not np.all(np.isfinite(evaluator.slope(run.time, y))):
        raise HaltError(_stuck(run))
    try:
        return getattr(scipy.integrate, run.method)(evaluator.slope, run.time, y, stop, **options)
    except (ValueError, ArithmeticError, np.linalg.LinAlgError, RuntimeError):
        raise HaltError(_stuck(run)) from None


def _try(solver: Any) -> bool:
    """Take a step; tell whether it succeeded."""
    try:
        with np.errstate(all="ignore"):  # what is not finite is seen below
            solver.step()
    except (ValueError, ArithmeticError, np.linalg.LinAlgError, RuntimeError):
        return False
    return solver.status != "failed" and bool(np.all(np.isfinite(solver.y)))


def _motion(evaluator: Evaluator, dense: Callable[[float], Array]) -> Callable[[float], Moment | None]:
    def at(t: float) -> Moment | None:
        state = evaluator.project(t, dense(t))
        return None if state is None else Moment(t, state, evaluator.multipliers.copy())

    return at


def _note(run: Run, start: float, at: Callable[[float], Moment | None]) -> None:
    """Note what happened in a step that ends at the run's time, and keep the results due."""
    stop = run.time
    for passage in passages(run.events, at, start, stop):
        there = at(passage.time)
        state = run.state if there is None else there.state
        run.happened.append((passage.event.saying(state), passage.time))
        if passage.event.terminal:
            run.ended, run.time, run.state = passage.event.saying(state), passage.time, state
    while run.next_sample < len(run.times) and run.times[run.next_sample] <= run.time:
        t = run.times[run.next_sample]
        there = at(t)
        run.snapshots.append(Snapshot(t, run.state if there is None else there.state))
        run.next_sample += 1
    if run.ended and run.snapshots[-1].time < run.time:
        run.snapshots.append(Snapshot(run.time, run.state))
    if run.progress is not None:
        run.progress(run.time)


def _repeat(run: Run, bounds: tuple[float, float], solver: Any) -> None:
    """Give a step up: choose other independent speeds and begin again from its start, with a shorter step."""
    tried = abs(float(getattr(solver, "step_size", None) or solver.h_abs))
    run.first_step = min(tried, run.first_step or np.inf) / 4.0
    run.steps_left -= 1
    if run.first_step < SHORTEST * max(1.0, abs(run.time)) or run.steps_left <= 0:
        rank = len(run.state.partition.rows)
        if rank and firmness(run.state.model, run.state.q, run.state.parameters, rank, run.usual) < 1e-3:
            _at_singular(run, RankLoss(run.time, 1.0, weakest(run.state, rank, run.usual), run.state), bounds)
        raise HaltError(_stuck(run))
    _choose_anew(run)


def _choose_anew(run: Run) -> None:
    try:
        chosen = best_choice(run.state, run.drives.names)
    except (ModelError, np.linalg.LinAlgError, ValueError) as error:
        raise HaltError(f"singular at t = {run.time:.6g} s: {error}") from None
    rank = len(run.state.partition.rows)
    if len(chosen.partition.rows) != rank or quality(chosen)[0] > HOPELESS:
        raise HaltError(
            f"singular at t = {run.time:.6g} s: {', '.join(weakest(run.state, rank, run.usual))}: {GIVES_WAY}"
        )
    run.state = chosen


def _stuck(run: Run) -> str:
    if not np.all(np.isfinite([signal(t) for signal in run.signals for t in (run.time, run.time + CRAWLING)])):
        return f"the simulation cannot go on at t = {run.time:.6g} s: an input is not finite there"
    return (
        f"the simulation cannot go on at t = {run.time:.6g} s: the steps become too short; a spring or damper may be "
        "too stiff for the method (Radau is for stiff machines), or something grows without bound"
    )


def _place(state: State) -> str:
    values = zip(state.model.system.coordinates, state.q, strict=True)
    some = [f"{name} {value:.4g}" for name, value in values]
    return ", ".join(some if len(some) <= 12 else [*some[:12], "..."])


def _at_singular(run: Run, loss: RankLoss, bounds: tuple[float, float]) -> None:
    """Go up to a singular position and pass it, or say where it is."""
    here = f"singular at t = {loss.time:.6g} s: {', '.join(loss.loops)}: {GIVES_WAY} (at {_place(loss.place)})"
    run.rewind()
    near = loss.time - NEAR * run.usual.firmness / loss.rate
    for _ in range(MOST_TRIES):
        if run.ended or run.time >= near - 1e-9 * (1.0 + abs(near)):
            break
        advance(run, near, bounds)
    if run.ended:
        return
    if not run.passes:
        raise HaltError(here)
    try:
        passed = continue_through(run.state, run.time, loss, run.signals, bounds, run.drives)
    except ModelError as error:
        raise HaltError(f"{here}; {error}") from None
    zero = np.zeros(len(run.state.model.system.rows))
    start, run.state, run.time, run.first_step = run.time, passed.after, passed.stop, None
    _note(run, start, lambda t: Moment(t, passed.at(t), zero))
    run.passed.append(loss)
