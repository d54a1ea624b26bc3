"""States that satisfy the constraints are found, not demanded: closed loops, wheels on the ground, allowed speeds."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from singletrack.errors import ModelError
from singletrack.multibody.engine.model import Model, State, finite, index_of
from singletrack.multibody.engine.partition import RANK_TOLERANCE, Partition, independent_rows, partition

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from singletrack.arrays import Array

__all__ = ["assemble", "close", "move", "refuse_undefined", "span_of", "tangent_space"]

NEWTON_STEPS = 60
CLOSED = 1e-12
WALK = 21
FLAT = 1e-12
SINGULAR_HERE = "singular configuration: the independent speeds do not determine the others here"


def _blame(model: Model, q: Array, gradient: Array, phi: Array) -> ModelError:
    """Return the error for constraints that could not be satisfied, naming the worst."""
    names = model.system.holonomic_rows
    worst = int(np.argmax(abs(phi)))
    if not np.any(gradient[worst]):
        return ModelError(
            f"{names[worst]}: a constraint that cannot vary: no coordinate changes it from {phi[worst]:g}"
        )
    return ModelError(
        f"{names[worst]}: the loop cannot close; the nearest configuration found leaves {phi[worst]:.3g} "
        f"(coordinates {', '.join(f'{n} {v:.4g}' for n, v in zip(model.system.coordinates, q, strict=True))})"
    )


def close(model: Model, q: Array, p: Array, movable: Sequence[int]) -> Array:
    """Return coordinates that satisfy the holonomic constraints, by Gauss-Newton on the movable ones.

    Parameters
    ----------
    model : Model
        The machine.
    q : array, shape (n,)
        Where to begin, m or rad.
    p : array, shape (parameters,)
        Values of the parameters, gravity first.
    movable : sequence of int
        The coordinates that may change.

    Raises
    ------
    ModelError
        Where the loops cannot close; the worst is named.
    """
    q = np.array(q, dtype=float)
    move = list(movable)
    phi, gradient = model.holonomic(q, p)
    for _ in range(NEWTON_STEPS):
        size = float(np.linalg.norm(phi))
        if size <= CLOSED * 1e-2:
            break
        step = np.linalg.lstsq(gradient[:, move], -phi, rcond=1e-12)[0]
        step *= min(1.0, 0.5 / max(float(np.max(abs(step), initial=0.0)), 1e-300))
        trial, shrink = q.copy(), 1.0
        while shrink > 1e-4:
            trial[move] = q[move] + shrink * step
            phi_trial, gradient_trial = model.holonomic(trial, p)
            if np.linalg.norm(phi_trial) < size or size <= CLOSED:
                break
            shrink /= 2.0
        if np.linalg.norm(phi_trial) >= size:
            break
        q, phi, gradient = trial, phi_trial, gradient_trial
    if not float(np.max(abs(phi), initial=0.0)) <= CLOSED * 10 * max(1.0, float(np.max(abs(q), initial=0.0))):
        raise _blame(model, q, gradient, phi)
    return q


def assemble(
    model: Model,
    coordinates: Mapping[str, float] | None = None,
    parameters: Mapping[str, float] | None = None,
    *,
    guess: Mapping[str, float] | None = None,
    independent: Sequence[str] | None = None,
) -> State:
    """Find a configuration at rest that satisfies the constraints.

    Parameters
    ----------
    model
        The machine.
    coordinates
        Coordinates that are kept as given (m, rad).
    parameters
        Values of parameters, by name, SI.
    guess
        Where to start for the others (m, rad); zero, the drawing, where not given.
    independent
        Names of the independent speeds, if not those of the system.

    Raises
    ------
    ModelError
        Where loops cannot close, or the configuration is singular; the constraint is named.

    Examples
    --------
    >>> from singletrack.multibody import Body, System, build, close_distance, revolute
    >>> hinges = [revolute("a", "ground", "one", (0, 0, 0), (0, 1, 0)), revolute("b", "ground", "two", (1, 0, 0),
    ...           (0, 1, 0))]
    >>> rod = close_distance("rod", "one", "two", ((0, 0, -1), (1, 0, -1)), 1.0)
    >>> model = build(System([Body("one", 1.0), Body("two", 1.0)], hinges, [rod]))
    >>> round(assemble(model, {"a": 0.3})["b"], 12)
    0.3
    """
    p = model.parameters(parameters)
    given = model.vector(coordinates)
    q = model.vector(guess)
    fixed = [index_of(model.system, name) for name in coordinates or {}]
    refuse_undefined(model, q, p)
    q = _reach(model, q, given, fixed, p)
    refuse_undefined(model, q, p)
    jacobian, _ = model.kinetics(q, p)
    _refuse_singular(model, q, p, jacobian)
    return State(model, p, partition(model.system, jacobian, independent), q, np.zeros(len(q)))


def refuse_undefined(model: Model, q: Array, p: Array) -> None:
    """Refuse a configuration in which something has no direction, and name it.

    A wheel that lies flat touches the ground all around; a spring whose ends meet, or the rod of a
    :func:`close_distance`, pulls nowhere.

    Parameters
    ----------
    model : Model
        The machine.
    q : array, shape (n,)
        Coordinates, m or rad.
    p : array, shape (parameters,)
        Values of the parameters, gravity first.
    """
    levels = model.equations.contacts(q, p)[2].full().ravel()
    for wheel, level in zip(model.system.wheels, levels, strict=True):
        if not level > FLAT:
            raise ModelError(f"wheel {wheel.name}: its axle is vertical here: it lies flat and touches nowhere")
    lengths = model.equations.lengths(q, p).full().ravel()
    names = [f"spring {spring.name}" for spring in model.system.springs if not spring.is_linear]
    names += [f"loop {closure.name}" for closure in model.system.closures if closure.length is not None]
    for name, length in zip(names, lengths, strict=True):
        if not length > 0.0:
            raise ModelError(f"{name}: its ends meet here, which leaves its direction open")


def _reach(model: Model, q: Array, given: Array, fixed: list[int], p: Array) -> Array:
    """Return a closed configuration with the given coordinates: at once, or step by step from the start."""
    movable = [i for i in range(len(q)) if i not in fixed]
    target = q.copy()
    target[fixed] = given[fixed]
    try:
        return close(model, target, p, movable)
    except ModelError as error:
        start = q[fixed]
        try:
            for fraction in np.linspace(0.0, 1.0, WALK):
                q[fixed] = start + fraction * (given[fixed] - start)
                q = close(model, q, p, movable)
        except ModelError:
            raise error from None
        return q


def _refuse_singular(model: Model, q: Array, p: Array, jacobian: Array) -> None:
    """Refuse a configuration where the constraints have a lower rank than next to it."""
    count = len(model.system.holonomic_rows)
    gradient = jacobian[:count]
    kept = independent_rows(gradient)
    if len(kept) == count:
        return
    freedom = _null_space(gradient)
    if not freedom.shape[1]:
        return
    direction = freedom @ np.random.default_rng(0).standard_normal(freedom.shape[1])
    try:
        beside = close(model, q + 1e-3 * direction / np.linalg.norm(direction), p, range(len(q)))
    except ModelError:
        return
    more = set(independent_rows(model.holonomic(beside, p)[1], tolerance=1e-7)) - set(kept)
    if more:
        names = ", ".join(model.system.holonomic_rows[i] for i in sorted(more))
        raise ModelError(f"singular configuration: {names} gives way here (the loop can move in more than one way)")


def _null_space(matrix: Array) -> Array:
    _, values, right = np.linalg.svd(matrix)
    rank = int(np.sum(values > RANK_TOLERANCE * max(values[0], 1e-300)))
    return right[rank:].T


def move(state: State, rates: Mapping[str, float]) -> State:
    """Return the state with the given rates (m/s, rad/s) and the others as the constraints demand.

    Where fewer rates are given than there are degrees of freedom, the remaining independent speeds are zero.
    Rates of dependent coordinates may be given as well: the speeds nearest to zero that fulfil all are taken.

    Raises
    ------
    ModelError
        Where the constraints do not allow the given rates together.

    Examples
    --------
    >>> from singletrack.multibody import Body, System, build, revolute
    >>> bob = Body("bob", 1.0, (0, 0, 1))
    >>> model = build(System([bob], [revolute("swing", "ground", "bob", (0, 0, 0), (0, 1, 0))]))
    >>> move(assemble(model), {"swing": 2.0}).rate("swing")
    2.0
    """
    span = tangent_space(state)
    names = list(rates)
    chosen = [index_of(state.model.system, name) for name in names]
    values = np.array([finite("rate", name, rates[name]) for name in names])
    freedoms = list(state.partition.independent_speeds)
    if set(chosen) <= set(freedoms):
        speeds = np.zeros(len(freedoms))
        speeds[[freedoms.index(i) for i in chosen]] = values
    else:
        speeds = np.linalg.lstsq(span[chosen], values, rcond=None)[0]
    u = span @ speeds
    if names and np.max(abs(u[chosen] - values)) > 1e-9 * max(1.0, float(np.max(abs(values)))):
        raise ModelError(f"the constraints do not allow these rates together: {', '.join(names)}")
    return State(state.model, state.parameters, state.partition, state.q, u)


def tangent_space(state: State) -> Array:
    """Return T (n, freedoms): the speeds for each independent speed alone at one.

    Parameters
    ----------
    state : State
        On the constraints.
    """
    jacobian, _ = state.model.kinetics(state.q, state.parameters)
    return span_of(state.partition, jacobian)


def span_of(parts: Partition, jacobian: Array) -> Array:
    """Return T (n, freedoms) with C T = 0 for a constraint Jacobian C (rows, n).

    Parameters
    ----------
    parts : Partition
        Which speeds are independent, which dependent, which rows bind them.
    jacobian : array, shape (rows, n)
        C.
    """
    dependent, free = list(parts.dependent_speeds), list(parts.independent_speeds)
    span = np.zeros((jacobian.shape[1], len(free)))
    span[free, range(len(free))] = 1.0
    if dependent:
        kept = jacobian[list(parts.rows)]
        try:
            span[dependent] = -np.linalg.solve(kept[:, dependent], kept[:, free])
        except np.linalg.LinAlgError:
            raise ModelError(SINGULAR_HERE) from None
    return span
