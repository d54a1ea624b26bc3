"""Through a singular position, where the branch of the motion continues on its other side.

At the position itself neither the speeds nor the forces are determined, and near it every error is magnified by the
distance from it; yet the motion is smooth. So the equations are left a little before it, the motion is continued as a
polynomial through states before (coordinates, speeds and accelerations of each), put onto the constraints on the
other side, and taken up there. Where it does not fit there, the branch does not continue and nothing is passed.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from singletrack.errors import ModelError
from singletrack.multibody.engine.assembly import close
from singletrack.multibody.engine.evaluation import Evaluator
from singletrack.multibody.engine.model import State
from singletrack.multibody.engine.partition import partition

if TYPE_CHECKING:
    from collections.abc import Sequence

    from singletrack.arrays import Array
    from singletrack.multibody.engine.inputs import Signal
    from singletrack.multibody.engine.prescribed import Drives
    from singletrack.multibody.engine.singular import RankLoss

__all__ = ["Passed", "continue_through"]

NEAR = 0.02
NODES = 4
SPACING = 8.0
MISFIT = 1e-3


@dataclass(frozen=True, eq=False)
class Passed:
    """A singular position passed: from when to when (s), the state after it, the motion in between."""

    start: float
    stop: float
    after: State
    at: Callable[[float], State]


def best_choice(state: State, held: Sequence[str] = ()) -> State:
    """Return the state with the best independent speeds there are in it, some of them held (by name)."""
    jacobian, _ = state.model.kinetics(state.q, state.parameters)
    parts = partition(state.model.system.replace(independent=None), jacobian, held=held)
    return State(state.model, state.parameters, parts, state.q, state.u)


def _nodes(evaluator: Evaluator, state: State, t: float, spacing: float) -> tuple[Array, Array]:
    """Return times and (q, u, a) of the motion at some moments up to a time, by integrating backwards."""
    from scipy.integrate import solve_ivp  # slow to import

    n, m = len(state.q), len(evaluator.free)
    times = t - spacing * np.arange(NODES)
    # turn to turn, the orbit backwards: exact to the last digits as it leads away from the singular position
    back = solve_ivp(
        lambda s, y: -evaluator.slope(t - s, y),
        (0.0, spacing * (NODES - 1)),
        np.concatenate([state.q, state.u[evaluator.free]]),
        method="DOP853",
        t_eval=spacing * np.arange(NODES),
        rtol=1e-13,
        atol=1e-14,
        max_step=spacing,
    )
    if back.status != 0 or back.y.shape != (n + m, NODES):
        raise ModelError("the motion before the singular position cannot be computed")
    found = []
    for moment, y in zip(times, back.y.T, strict=True):
        q = evaluator.close(y[:n])
        evaluator.respond(moment, y[:n] if q is None else q, y[n:])
        found.append([evaluator.q.copy(), evaluator.u.copy(), evaluator.a.copy()])
    return times, np.array(found)


def continue_through(
    state: State,
    t: float,
    loss: RankLoss,
    driven: Sequence[Signal],
    bounds: tuple[float, float],
    drives: Drives | None = None,
) -> Passed:
    """Continue a motion from a state at a time close before a singular position to the other side of it.

    Parameters
    ----------
    state : State
        Close before the position.
    t : float
        Its time, s.
    loss : RankLoss
        Where and when the constraints lose rank.
    driven : sequence of Signal
        The inputs.
    bounds : pair of float
        The times between which the motion may be continued, s.
    drives : Drives, optional
        Prescribed motions.

    Raises
    ------
    ModelError
        Where the branch does not continue.
    """
    from scipy.interpolate import KroghInterpolator  # slow to import

    held = drives.names if drives else ()
    chosen = best_choice(state, held)
    evaluator = Evaluator(chosen, driven, *bounds, drives=drives)
    distance = max(loss.time - t, 1e-12)
    times, nodes = _nodes(evaluator, chosen, t, SPACING * distance)
    polynomial = KroghInterpolator(np.repeat(times, 3), nodes.reshape(3 * NODES, -1))
    stop = loss.time + distance

    def on(moment: float) -> tuple[Array, Array]:
        q, u = polynomial.derivatives(moment, 2)
        return q, u

    q, u = on(stop)
    try:
        closed = close(state.model, q, state.parameters, range(len(q)))
        after = best_choice(State(state.model, state.parameters, chosen.partition, closed, u), held)
    except ModelError:
        raise ModelError("the branch does not continue") from None
    jacobian, _ = state.model.kinetics(closed, state.parameters)
    change = np.linalg.lstsq(jacobian, jacobian @ u, rcond=1e-10)[0]
    moved = float(np.linalg.norm(q - nodes[0, 0]))
    if len(after.partition.rows) != len(state.partition.rows) or not (
        np.linalg.norm(closed - q) <= MISFIT * moved and np.linalg.norm(change) <= MISFIT * np.linalg.norm(u)
    ):
        raise ModelError("the branch does not continue")

    def at(moment: float) -> State:
        between, rate = on(moment)
        return State(state.model, state.parameters, chosen.partition, between, rate)

    return Passed(t, stop, State(state.model, state.parameters, after.partition, closed, u - change), at)
