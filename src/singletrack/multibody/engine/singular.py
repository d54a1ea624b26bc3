"""Where the constraints lose rank along a motion: how near, when, and which of them.

The measure is the smallest of the singular values that are not zero, of the constraint Jacobian with each row divided
by the greatest length it has had in the motion. Where a motion passes a singular position it goes to zero like
|t - t_s|; a determinant of dependent columns may change its sign where nothing is lost (another choice of coordinates
is due), or keep it where two ranks are lost.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from singletrack.arrays import Array
from singletrack.multibody.engine.model import State

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from singletrack.multibody.engine.events import Moment
    from singletrack.multibody.engine.model import Model

__all__ = ["RankLoss", "Usual", "find_rank_loss", "firmness", "weakest"]

LOOK = (-0.02, 0.0, 0.2, 0.4, 0.6, 0.8, 1.0, 1.02)
SUSPECT = 0.2
LOST = 3e-5


@dataclass(frozen=True, eq=False)
class RankLoss:
    """A singular position: when (s), how fast the rank vanished (1/s), the loops that give way, and the state there."""

    time: float
    rate: float
    loops: tuple[str, ...]
    place: State


@dataclass(eq=False)
class Usual:
    """What is usual in a motion: the greatest length of each row of the constraint Jacobian, the greatest firmness."""

    largest: Array
    firmness: float = 0.05
    now: float = np.inf

    @classmethod
    def of(cls, state: State) -> Usual:
        """Return that of a state."""
        return cls(np.linalg.norm(state.model.kinetics(state.q, state.parameters)[0], axis=-1))

    def scale(self, jacobian: Array) -> Array:
        """Return Jacobians (..., rows, n) scaled.

        Parameters
        ----------
        jacobian : array, shape (..., rows, n)
        """
        return jacobian / np.where(self.largest > 0.0, self.largest, 1.0)[:, None]

    def grow(self, jacobians: Array) -> None:
        """Take note of more Jacobians (k, rows, n).

        Parameters
        ----------
        jacobians : array, shape (k, rows, n)
        """
        self.largest = np.maximum(self.largest, np.max(np.linalg.norm(jacobians, axis=-1), axis=0, initial=0.0))


def firmness(model: Model, q: Array, p: Array, rank: int, usual: Usual) -> float:
    """Return the ``rank``-th singular value of the row-scaled constraint Jacobian: zero where rank is lost.

    Parameters
    ----------
    model : Model
        The machine.
    q : array, shape (n,)
        Coordinates, m or rad.
    p : array, shape (parameters,)
        Values of the parameters, gravity first.
    rank : int
        The usual rank.
    usual : Usual
        How large the rows usually are.
    """
    return float(np.linalg.svd(usual.scale(model.kinetics(q, p)[0]), compute_uv=False)[rank - 1])


def weakest(state: State, rank: int, usual: Usual) -> tuple[str, ...]:
    """Return the names of the loops and wheels whose constraints give way in a state.

    Parameters
    ----------
    state : State
    rank : int
        The usual rank.
    usual : Usual
        How large the rows usually are.
    """
    system = state.model.system
    left, values, _ = np.linalg.svd(usual.scale(state.model.kinetics(state.q, state.parameters)[0]))
    lost = [i for i in range(rank) if values[i] < max(1e-3, 2.0 * values[rank - 1])]
    weight = np.linalg.norm(left[:, lost], axis=1)
    rows = [system.rows[i] for i in np.flatnonzero(weight > 0.3 * np.max(weight, initial=1e-300))]
    return tuple(dict.fromkeys(row.rsplit(" (", 1)[0] for row in rows))


def find_rank_loss(
    state: State,
    at: Callable[[float], Moment | None],
    dense: Callable[[float], Array],
    step: tuple[float, float],
    usual: Usual,
) -> RankLoss | None:
    """Return the rank loss within a step, if there is one.

    Parameters
    ----------
    state
        The state at the beginning of the step.
    at
        The motion within and a little around the step, on the constraints.
    dense
        The same by the integrator's interpolant, y = [q, u_i] of shape (n + m,), off the constraints by its error.
    step
        When it begins and ends, s.
    usual
        What was usual so far; takes note of this step.
    """
    model, p, rank = state.model, state.parameters, len(state.partition.rows)
    if not rank:
        return None
    n, start, h = len(state.q), step[0], step[1] - step[0]
    times = [start + fraction * h for fraction in LOOK]
    q = np.array([dense(t)[:n] for t in times])
    jacobians = model.equations.kinetics(q.T, p)[0].full()
    stacked = np.array(np.split(jacobians, len(times), axis=1))
    usual.grow(stacked[1:-1])
    values = np.linalg.svd(usual.scale(stacked), compute_uv=False)[:, rank - 1]
    usual.firmness, usual.now = max(usual.firmness, float(np.max(values[1:-1]))), float(values[-1])
    return _bottom(state, at, times, values, usual)


def _bottom(
    state: State, at: Callable[[float], Moment | None], times: Sequence[float], values: Array, usual: Usual
) -> RankLoss | None:
    from scipy.optimize import minimize_scalar  # slow to import

    model, p, rank = state.model, state.parameters, len(state.partition.rows)

    def value(t: float) -> float:
        there = at(t)
        return 0.0 if there is None else firmness(model, there.state.q, p, rank, usual)

    for k in range(1, len(times) - 1):
        if not (values[k - 1] >= values[k] <= values[k + 1] and values[k] < SUSPECT * usual.firmness):
            continue
        low, high = times[k - 1], times[k + 1]
        bottom = minimize_scalar(value, bounds=(low, high), method="bounded", options={"xatol": 1e-9 * (high - low)})
        if bottom.fun < LOST * usual.firmness:
            t = float(bottom.x)
            rate = (values[k - 1] + values[k + 1]) / (high - low)
            there = at(t)
            place = state if there is None else there.state
            return RankLoss(t, float(rate), weakest(place, rank, usual), place)
    if values[-1] < min(values[0], LOST * usual.firmness):  # the steps only creep towards it
        rate = float(values[0] - values[-1]) / (times[-1] - times[0])
        return RankLoss(times[-1] + float(values[-1]) / rate, rate, weakest(state, rank, usual), state)
    return None
