"""Families of steady motions, followed by the length of their arc: through folds, never to another family.

In one unknown more than there are equations the steady motions form curves. From a motion on one, the curve is
followed along its tangent and put right across it (Keller's pseudo-arclength continuation), with exact derivatives;
steps are shortened where the tangent turns, so that nothing is jumped over.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from singletrack.arrays import Array
from singletrack.errors import ModelError
from singletrack.multibody.engine.dynamics import input_vector
from singletrack.multibody.engine.equilibrium import STEADY, SteadyMotion, derivative, moved, plan, residual
from singletrack.multibody.engine.events import Moment, default_ends
from singletrack.multibody.engine.model import State
from singletrack.multibody.engine.variations import Variations

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping, Sequence

    from singletrack.multibody.engine.dynamics import Response
    from singletrack.multibody.engine.equilibrium import Search
    from singletrack.multibody.engine.events import Watched

__all__ = ["Family", "follow"]

SHORTEST = 1e-6
TURN = 0.97  # cosine of the largest turn of the tangent in a step
ROUNDS = 10
REACHED = 0.02  # what a limb has left of its hold in the first motion, when no force could hold it any more
FORCE = 10.0  # N or N m of an input that count as much as one rad


@dataclass(frozen=True, eq=False)
class Family:
    """Steady motions one after the other along a curve, and why it ends."""

    motions: tuple[SteadyMotion, ...]
    end: str


@dataclass(frozen=True, eq=False)
class _Point:
    """A motion on the curve with the tangent there (in scaled unknowns), its derivatives and multipliers."""

    state: State
    f: Array
    tangent: Array
    variations: Variations
    multipliers: Array


def follow(
    start: SteadyMotion,
    resting: Sequence[str],
    *,
    rates: Sequence[str] = (),
    adjust: Sequence[str] = (),
    towards: Mapping[str, float],
    step: float = 0.02,
    most: int = 2000,
    until: Callable[[SteadyMotion], str] | None = None,
) -> Family:
    """Follow the family of a steady motion.

    Parameters
    ----------
    start
        A motion of the family.
    resting
        Names of the independent coordinates that rest in it and differ from motion to motion.
    rates
        Names of independent speeds that are the same in all of them.
    adjust
        Names of inputs that differ from motion to motion.
    towards
        Which way to go first: the sign of the change of a coordinate, by its name, such as ``{"lean": 1.0}``.
    step
        Longest step along the curve, rad.
    most
        How many motions at most.
    until
        Returns why the family ends with a motion, or nothing.

    Raises
    ------
    ModelError
        Where the start is not on a single curve.
    """
    system = start.state.model.system
    search = plan(start.state, {}, dict.fromkeys(rates, 0.0), resting, adjust)
    free = [system.coordinates[i] for i in start.state.partition.independent_coordinates]
    first = np.zeros(_count(search))
    for name, sign in towards.items():
        first[search.coordinates.index(free.index(name))] = sign
    scale = _scale(start, search)
    f = input_vector(system, start.inputs)
    response, _, v = residual(start.state, f, search)
    point = _at(start.state, f, search, scale, first, response, v)
    ends = [(end, _value(end, point)) for end in default_ends(start.state)]
    motions, length, why = [start], min(step, 1e-2), ""
    while not why and len(motions) < most:
        onwards = _advance(point, search, scale, length)
        if onwards is None:
            length /= 2.0
            why = "the family cannot be followed any further" if length < SHORTEST else ""
            continue
        crossed = [end for end, value in ends if _value(end, onwards) / value < (0.0 if end.direction else REACHED)]
        if crossed and length > 1e3 * SHORTEST:
            length /= 2.0
            continue
        if crossed:
            why = crossed[0].saying(onwards.state)
            break
        point, length = onwards, min(1.3 * length, step)
        motions.append(_motion(point))
        why = (until(motions[-1]) if until is not None else "") or ""
    return Family(tuple(motions), why or "as many motions as were asked for")


def _count(search: Search) -> int:
    return len(search.coordinates) + len(search.speeds) + len(search.inputs)


def _scale(start: SteadyMotion, search: Search) -> Array:
    """Return what one unit of each unknown is worth: one rad, the fastest speed, some N m."""
    fastest = max(1.0, float(np.max(abs(start.state.u), initial=0.0)))
    parts = [np.ones(len(search.coordinates)), np.full(len(search.speeds), fastest), np.full(len(search.inputs), FORCE)]
    return np.concatenate(parts)


def _motion(point: _Point) -> SteadyMotion:
    names = [given.name for given in point.state.model.system.inputs]
    return SteadyMotion(point.state, dict(zip(names, point.f.tolist(), strict=True)))


def _value(end: Watched, point: _Point) -> float:
    return end.value(Moment(0.0, point.state, point.multipliers))


def _at(
    state: State, f: Array, search: Search, scale: Array, along: Array, response: Response, v: Variations
) -> _Point:
    """Return the point with its tangent, in the sense of ``along``."""
    _, values, directions = np.linalg.svd(derivative(state, search, v) * scale)
    if len(values) >= len(scale) and values[-2] < 1e-7 * values[0]:
        raise ModelError("the steady motions here are not a single curve; give one more rate, or adjust one input less")
    tangent = directions[-1]
    return _Point(state, f, tangent if tangent @ along >= 0.0 else -tangent, v, response.multipliers)


def _advance(point: _Point, search: Search, scale: Array, length: float) -> _Point | None:
    """Return the next point at a distance along the curve, None where it is not found or the curve turns too much."""
    try:
        state, f = moved(point.state, point.f, search, length * point.tangent * scale, point.variations)
        for _ in range(ROUNDS):
            response, left_over, v = residual(state, f, search)
            if float(np.max(abs(left_over))) <= STEADY * max(1.0, float(np.max(abs(response.a)))):
                onwards = _at(state, f, search, scale, point.tangent, response, v)
                return onwards if onwards.tangent @ point.tangent > TURN else None
            system = np.vstack([derivative(state, search, v) * scale, point.tangent])
            step = np.linalg.lstsq(system, np.append(-left_over, 0.0), rcond=1e-11)[0]
            if np.linalg.norm(step) > length:
                return None
            state, f = moved(state, f, search, step * scale, v)
    except (ModelError, np.linalg.LinAlgError):
        return None
    return None
