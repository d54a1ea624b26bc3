"""Steady motions: rest, straight running, steady turning, any relative equilibrium, found by Newton's method."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING

import numpy as np

from singletrack.errors import ModelError, unknown_name
from singletrack.multibody.engine.assembly import assemble, close, span_of
from singletrack.multibody.engine.dynamics import accelerations, input_vector
from singletrack.multibody.engine.model import State
from singletrack.multibody.engine.variations import vary

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from singletrack.arrays import Array
    from singletrack.multibody.engine.dynamics import Response
    from singletrack.multibody.engine.model import Model
    from singletrack.multibody.engine.variations import Variations

__all__ = ["STEADY", "Search", "SteadyMotion", "derivative", "moved", "plan", "residual", "steady_motion"]

STEPS = 60
STEADY = 1e-10


@dataclass(frozen=True, eq=False)
class SteadyMotion:
    """A state whose independent speeds do not change, and the inputs that keep it so."""

    state: State
    inputs: dict[str, float] = field(default_factory=dict)


@dataclass(frozen=True, eq=False)
class Search:
    """What is sought, as indices: coordinates, independent speeds, inputs; and which coordinates must rest."""

    coordinates: list[int]
    speeds: list[int]
    inputs: list[int]
    resting: list[int]


def steady_motion(
    model: Model,
    coordinates: Mapping[str, float] | None = None,
    rates: Mapping[str, float] | None = None,
    *,
    resting: Sequence[str],
    guess: Mapping[str, float] | None = None,
    guess_rates: Mapping[str, float] | None = None,
    inputs: Mapping[str, float] | None = None,
    adjust: Sequence[str] = (),
    parameters: Mapping[str, float] | None = None,
) -> SteadyMotion:
    """Find a motion in which the coordinates that matter rest and no independent speed changes.

    Parameters
    ----------
    model
        The machine.
    coordinates, rates
        What is given: coordinates (m, rad), and rates of independent speeds (m/s, rad/s).
    resting
        Names of the independent coordinates that matter and stay constant, such as lean and steer; those not
        given are sought, and their rates are zero.
    guess, guess_rates
        Where to start with the others, in the same units. The motion found is the nearest of a family in the sense of
        Gauss-Newton.
    inputs, adjust
        Constant inputs (N, N m), and names of inputs to be sought, such as the torque that holds a turn.
    parameters
        Values of parameters, SI.

    Raises
    ------
    ModelError
        Where none is found, with what is left of the accelerations.

    Examples
    --------
    >>> from singletrack.multibody import Body, System, build, revolute
    >>> bob = Body("bob", 1.0, (0, 0, 1))
    >>> swing = revolute("swing", "ground", "bob", (0, 0, 0), (0, 1, 0), stiffness=9.81, preload=9.81)
    >>> found = steady_motion(build(System([bob], [swing])), resting=["swing"], guess={"swing": 0.4})
    >>> round(float(found.state["swing"] + np.sin(found.state["swing"])), 12)
    1.0
    """
    given = dict(coordinates or {})
    start = assemble(model, given, parameters, guess=guess)
    search = plan(start, given, rates or {}, resting, adjust)
    u_i = np.array([(rates or {}).get(n, (guess_rates or {}).get(n, 0.0)) for n in start.freedoms])
    f = input_vector(model.system, inputs)
    state = _with_speeds(start, start.q, u_i)
    last = np.inf
    for _ in range(STEPS):
        response, left_over, variations = residual(state, f, search)
        left = float(np.max(abs(left_over), initial=0.0)) / max(1.0, float(np.max(abs(response.a))))
        last, better = left, left < 0.5 * last
        if left <= STEADY and not better:
            names = [given_input.name for given_input in model.system.inputs]
            return SteadyMotion(state, dict(zip(names, f.tolist(), strict=True)))
        state, f = _step(state, f, search, left_over, variations)
    free = ", ".join(f"{n}'" for n in state.freedoms)
    raise ModelError(f"no steady motion found near the guess: {free} still change by {left_over[: len(u_i)]}")


def plan(
    start: State, given: Mapping[str, float], rates: Mapping[str, float], resting: Sequence[str], adjust: Sequence[str]
) -> Search:
    """Return what is sought, for what is given by name.

    Parameters
    ----------
    start : State
        Where the search begins.
    given, rates : mapping
        Coordinates and rates that are given, by name.
    resting : sequence of str
        Coordinates whose rates must vanish.
    adjust : sequence of str
        Inputs that may be chosen.
    """
    system, parts = start.model.system, start.partition
    free = [system.coordinates[i] for i in parts.independent_coordinates]
    for name in resting:
        if name not in free:
            raise ModelError(unknown_name("independent coordinate", name, free))
    for name in rates:
        if name not in start.freedoms:
            raise ModelError(unknown_name("independent speed", name, start.freedoms))
    known_inputs = [given_input.name for given_input in system.inputs]
    for name in adjust:
        if name not in known_inputs:
            raise ModelError(unknown_name("input", name, known_inputs))
    return Search(
        [free.index(name) for name in resting if name not in given],
        [i for i, name in enumerate(start.freedoms) if name not in rates],
        [known_inputs.index(name) for name in adjust],
        [system.coordinates.index(name) for name in resting],
    )


def _with_speeds(state: State, q: Array, u_i: Array) -> State:
    jacobian, _ = state.model.kinetics(q, state.parameters)
    return State(state.model, state.parameters, state.partition, q, span_of(state.partition, jacobian) @ u_i)


def residual(state: State, f: Array, search: Search) -> tuple[Response, Array, Variations]:
    """Return the response, what must vanish (independent accelerations, rates at rest) and the derivatives.

    Parameters
    ----------
    state : State
        On the constraints.
    f : array, shape (inputs,)
        Values of the inputs, N or N m.
    search : Search
        What is sought.
    """
    names = [given.name for given in state.model.system.inputs]
    response = accelerations(state, dict(zip(names, f.tolist(), strict=True)))
    independent = list(state.partition.independent_speeds)
    left_over = np.concatenate([response.a[independent], state.u[search.resting]])
    return response, left_over, vary(state, response, f)


def derivative(state: State, search: Search, v: Variations) -> Array:
    """Return the derivative of the residual with respect to what is sought: coordinates, speeds, inputs.

    Shape (equations, unknowns).

    Parameters
    ----------
    state : State
        On the constraints.
    search : Search
        What is sought.
    v : Variations
        Of the equations about the state.
    """
    drive = v.span.T @ state.model.equations.input_matrix(state.q, state.parameters).full()
    k, s = search.coordinates, search.speeds
    changes = np.linalg.solve(v.M, np.hstack([-v.K[:, k], -v.C[:, s], drive[:, search.inputs]]))
    rates = np.hstack([v.speed_changes[:, k], v.span[:, s], np.zeros((len(state.q), len(search.inputs)))])
    return np.vstack([changes, rates[search.resting]])


def _step(state: State, f: Array, search: Search, left_over: Array, v: Variations) -> tuple[State, Array]:
    step = np.linalg.lstsq(derivative(state, search, v), -left_over, rcond=1e-11)[0]
    k = len(search.coordinates)
    step *= min(1.0, 0.3 / max(float(np.max(abs(step[:k]), initial=0.0)), 1e-300))
    return moved(state, f, search, step, v)


def moved(state: State, f: Array, search: Search, step: Array, v: Variations) -> tuple[State, Array]:
    """Return the state and inputs after a step in what is sought, with loops closed.

    Parameters
    ----------
    state : State
        Before.
    f : array, shape (inputs,)
        Values of the inputs before, N or N m.
    search : Search
        What is sought.
    step : array, shape (unknowns,)
    v : Variations
        Of the equations about the state.
    """
    k, s = search.coordinates, search.speeds
    parts = state.partition
    q = state.q.copy()
    q += v.coordinate_directions[:, k] @ step[: len(k)]
    q = close(state.model, q, state.parameters, parts.dependent_coordinates)
    u_i = state.u[list(parts.independent_speeds)]
    u_i[s] += step[len(k) : len(k) + len(s)]
    f = f.copy()
    f[search.inputs] += step[len(k) + len(s) :]
    return _with_speeds(state, q, u_i), f
