"""What is watched for during a simulation, and when within a step it happens, twice if need be."""

from __future__ import annotations

import itertools
from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from singletrack.arrays import Array
from singletrack.multibody.engine.dynamics import split_wheel_forces
from singletrack.multibody.engine.limits import Reach
from singletrack.multibody.engine.model import State

if TYPE_CHECKING:
    from collections.abc import Sequence


__all__ = ["Event", "Moment", "Passage", "Watched", "default_ends", "passages", "watched"]

FLAT = float(np.cos(np.radians(85.0)))
FRACTIONS = (0.0, 0.03, 0.3, 0.65, 0.97, 1.0)


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


@dataclass(frozen=True, eq=False)
class Moment:
    """A state at a time (s), with the multipliers (rows,) of its constraints."""

    time: float
    state: State
    multipliers: Array


@dataclass(frozen=True, eq=False)
class Watched:
    """An event with its value for a moment, and what to say of it."""

    saying: Callable[[State], str]
    value: Callable[[Moment], float]
    terminal: bool = True
    direction: int = -1


@dataclass(frozen=True)
class Passage:
    """An event that happened, at a time (s)."""

    event: Watched
    time: float


def watched(event: Event) -> Watched:
    """Return a user's event as it is watched."""
    return Watched(
        lambda _: event.name,
        lambda moment: float(event.value(moment.time, moment.state)),
        event.terminal,
        event.direction,
    )


def default_ends(state: State) -> list[Watched]:
    """Return what ends a simulation by itself: wheels that leave the ground or lie flat, and the machine's limits.

    Parameters
    ----------
    state : State
        At the start.
    """
    system = state.model.system
    found: list[Watched] = []
    holonomic, wheels = len(system.holonomic_rows), len(system.wheels)
    for i, wheel in enumerate(system.wheels):
        if holonomic - wheels + i in state.partition.rows:
            found.append(Watched(_always(f"{wheel.name} off the ground"), _normal_force(i)))
        found.append(Watched(_always(f"{wheel.name} lies flat"), _upright(i)))
    for limit in system.limits:
        if isinstance(limit, Reach):
            found.append(Watched(_gives_way(limit), _reach(state, limit), direction=0))
            continue
        place = system.coordinates.index(limit.coordinate)
        found.append(Watched(_always(limit.below), _above(place, limit.low)))
        found.append(Watched(_always(limit.above), _below(place, limit.high)))
    return found


def _always(saying: str) -> Callable[[State], str]:
    return lambda _: saying


def _normal_force(i: int) -> Callable[[Moment], float]:
    return lambda moment: float(split_wheel_forces(moment.state.model.system, moment.multipliers[None])[0, i, 2])


def _upright(i: int) -> Callable[[Moment], float]:
    def value(moment: Moment) -> float:
        level = moment.state.model.equations.contacts(moment.state.q, moment.state.parameters)[2]
        return float(level[i]) - FLAT

    return value


def _above(place: int, low: float) -> Callable[[Moment], float]:
    return lambda moment: float(moment.state.q[place]) - low


def _below(place: int, high: float) -> Callable[[Moment], float]:
    return lambda moment: high - float(moment.state.q[place])


def _reach(state: State, limit: Reach) -> Callable[[Moment], float]:
    rows, columns = reach_block(state, limit)

    def value(moment: Moment) -> float:
        gradient = moment.state.model.holonomic(moment.state.q, moment.state.parameters)[1]
        return float(np.linalg.det(gradient[np.ix_(rows, columns)]))

    return value


def reach_block(state: State, limit: Reach) -> tuple[list[int], list[int]]:
    """Return rows and columns of the constraint Jacobian by which loops determine a limb."""
    system = state.model.system
    return system.rows_of(limit.loops), [system.coordinates.index(name) for name in limit.coordinates]


def _gives_way(limit: Reach) -> Callable[[State], str]:
    """Say which loop is at the end of its reach: the one with the least hold."""

    def saying(state: State) -> str:
        system, (rows, columns) = state.model.system, reach_block(state, limit)
        left, _, _ = np.linalg.svd(state.model.holonomic(state.q, state.parameters)[1][np.ix_(rows, columns)])
        worst = system.holonomic_rows[rows[int(np.argmax(abs(left[:, -1])))]]
        return limit.saying.format(loop=next(c.name for c in system.closures if worst in c.rows))

    return saying


def passages(
    events: Sequence[Watched], at: Callable[[float], Moment | None], start: float, stop: float
) -> list[Passage]:
    """Return the passages of all events from a time to a later one, in order, up to the first that ends the run.

    Each event is looked at in six moments; between any two of one sign a dip towards zero is followed to its
    bottom, so that a double passage is found too.

    Parameters
    ----------
    events : sequence of Watched
    at : callable
        The motion at a time; None where there is none.
    start, stop : float
        In s.
    """
    if not events:
        return []
    times = [start + fraction * (stop - start) for fraction in FRACTIONS]
    moments = [(t, moment) for t in times if (moment := at(t)) is not None]
    found: list[Passage] = []
    for event in events:
        values = [(t, event.value(moment)) for t, moment in moments]
        found.extend(Passage(event, t) for t in _crossings(event, values, at))
    found.sort(key=lambda passage: passage.time)
    last = next((i for i, passage in enumerate(found) if passage.event.terminal), len(found))
    return found[: last + 1]


def _crossings(event: Watched, values: list[tuple[float, float]], at: Callable[[float], Moment | None]) -> list[float]:
    from scipy.optimize import brentq  # slow to import

    def value(t: float) -> float:
        moment = at(t)
        return np.nan if moment is None else event.value(moment)

    found = []
    for (low, at_low), (high, at_high) in _with_dips(values, value):
        rises, falls = at_low < 0.0 <= at_high, at_low > 0.0 >= at_high
        if (rises and event.direction >= 0) or (falls and event.direction <= 0):
            found.append(high if at_high == 0.0 else float(brentq(value, low, high, xtol=1e-13)))
    return found


def _with_dips(
    values: list[tuple[float, float]], value: Callable[[float], float]
) -> list[tuple[tuple[float, float], tuple[float, float]]]:
    """Return the consecutive pairs of samples, with the bottoms of dips that reach across zero among the samples."""
    from scipy.optimize import minimize_scalar  # slow to import

    refined = list(values)
    for (before, f0), (middle, f1), (after, f2) in zip(values, values[1:], values[2:], strict=False):
        side = np.sign(f1)
        if not (side and side * f0 > side * f1 < side * f2):
            continue
        left, right = (f1 - f0) / (middle - before), (f2 - f1) / (after - middle)
        curve = side * (right - left) / (after - before)
        slope = side * (left * (after - middle) + right * (middle - before)) / (after - before)
        bottom_of_parabola = side * f1 - slope**2 / (4.0 * curve)
        if bottom_of_parabola < 0.5 * side * f1 or side * f1 < 0.5 * min(side * f0, side * f2):
            bottom = minimize_scalar(lambda t, s=side: s * value(t), bounds=(before, after), method="bounded")
            if bottom.fun < 0.0:
                refined.append((float(bottom.x), float(side * bottom.fun)))
    refined.sort()
    return list(itertools.pairwise(refined))
