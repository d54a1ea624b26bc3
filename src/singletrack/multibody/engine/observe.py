"""What is seen of a small motion: coordinates, rates, accelerations, multipliers and sensors, row by row."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from singletrack.errors import ModelError, unknown_name

if TYPE_CHECKING:
    from collections.abc import Sequence

    from singletrack.arrays import Array
    from singletrack.multibody.engine.model import State
    from singletrack.multibody.engine.variations import Variations

__all__ = ["observe", "observe_responses"]


def observe(state: State, names: Sequence[str], dq: Array, du: Array) -> Array:
    """Return the derivatives (outputs, directions) of named outputs along directions of coordinates and speeds.

    Parameters
    ----------
    state : State
        About which the motion is small.
    names : sequence of str
        Coordinates, rates (``'``), accelerations (``''``), multipliers or sensors.
    dq, du : array, shape (n, directions)
        Changes of coordinates and speeds.
    """
    system = state.model.system
    sensors = [sensor.name for sensor in system.sensors]
    sensed = np.zeros((len(sensors), dq.shape[1]))
    if any(name in sensors for name in names):
        by_q, by_u = _sensor_gradients(state)
        sensed = by_q @ dq + by_u @ du
    rows = []
    for name in names:
        if name in sensors:
            rows.append(sensed[sensors.index(name)])
        elif name in system.rows or name.removesuffix("''") != name:
            rows.append(np.zeros(dq.shape[1]))  # filled in by what the machine responds
        elif name.removesuffix("'") in system.coordinates:
            place = system.coordinates.index(name.removesuffix("'"))
            rows.append(du[place] if name.endswith("'") else dq[place])
        else:
            raise ModelError(unknown_name("output", name, (*system.coordinates, *sensors)))
    return np.array(rows).reshape(len(names), dq.shape[1])


def observe_responses(
    state: State, names: Sequence[str], v: Variations, columns: list[int], solved: Array, seen: Array, through: Array
) -> None:
    """Fill in the rows of accelerations and of multipliers, in the states (C) and in the inputs (D).

    Parameters
    ----------
    state : State
        About which the motion is small.
    names : sequence of str
        Of the outputs.
    v : Variations
        Of the equations about the state.
    columns : list of int
        The directions that are states, k of them.
    solved : array, shape (m, k + inputs)
        Independent accelerations for unit states and inputs.
    seen, through : array, shape (outputs, k) and (outputs, inputs)
        C and D; they are written to.
    """
    system, parts = state.model.system, state.partition
    jacobian, mass = state.model.kinetics(state.q, state.parameters)
    drive = state.model.equations.input_matrix(state.q, state.parameters).full()
    states = len(columns)
    changed = v.acceleration_changes[:, columns] + v.span @ solved[:, :states]
    pushed = v.span @ solved[:, states:]
    multipliers = [np.zeros((len(system.rows), width)) for width in (states, drive.shape[1])]
    rows, dependent = list(parts.rows), list(parts.dependent_speeds)
    if rows:
        own = jacobian[np.ix_(rows, dependent)].T
        left = (mass @ changed + v.residual_changes[:, columns], mass @ pushed - drive)
        for found, side in zip(multipliers, left, strict=True):
            found[rows] = np.linalg.solve(own, side[dependent])
    for i, name in enumerate(names):
        if name in system.rows:
            place = system.rows.index(name)
            seen[i], through[i] = multipliers[0][place], multipliers[1][place]
        elif name.endswith("''"):
            if name[:-2] not in system.coordinates:
                raise ModelError(unknown_name("output", name, system.coordinates))
            place = system.coordinates.index(name[:-2])
            seen[i], through[i] = changed[place], pushed[place]


def _sensor_gradients(state: State) -> tuple[Array, Array]:
    cache: dict[Any, Any] = state.model.cache
    if "sensor gradients" not in cache:
        cache["sensor gradients"] = state.model.equations.sensors.jacobian()
    zero = np.zeros(len(state.model.system.sensors))
    out = cache["sensor gradients"](state.q, state.u, state.parameters, zero)
    return out[0].full(), out[1].full()
