"""Results of a simulation as a labelled data set.

Over ``time``: ``q``, ``u``, ``a`` (coordinates, rates, accelerations; dimension ``coordinate``), ``input``,
``sensor``, ``contact`` (point of each ``wheel`` on the ground, m, dimension ``axis``), ``wheel_force`` (N, on the
wheel: longitudinal, lateral, normal; the normal force is positive when the wheel presses on the ground),
``loop_force`` and ``loop_torque`` (N and N m of the first body on the second, in the ground's frame, dimension
``loop``), ``kinetic_energy``, ``potential_energy``, ``energy`` (J) and ``residual``, the largest violation of a
constraint on coordinates. ``event_time`` holds the moments of events.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import groupby
from typing import TYPE_CHECKING, Any

import numpy as np

from singletrack.multibody.engine.dynamics import reduced, split_wheel_forces
from singletrack.multibody.engine.evaluation import Evaluator
from singletrack.multibody.engine.model import State

if TYPE_CHECKING:
    from collections.abc import Sequence

    import xarray as xr

    from singletrack.arrays import Array
    from singletrack.multibody.engine.inputs import Signal
    from singletrack.multibody.engine.prescribed import Drives

__all__ = ["Snapshot", "gather"]


@dataclass(frozen=True, eq=False)
class Snapshot:
    """A state at a time (s)."""

    time: float
    state: State


def _responses(snapshots: Sequence[Snapshot], inputs: Array) -> tuple[Array, Array]:
    """Return accelerations (k, n) and multipliers (k, rows) of all snapshots; NaN where they are not determined."""
    a, multipliers, start = [], [], 0
    for parts, group in groupby(snapshots, key=lambda snapshot: snapshot.state.partition):
        states = [snapshot.state for snapshot in group]
        q = np.array([state.q for state in states]).T
        u_i = np.array([state.u[list(parts.independent_speeds)] for state in states]).T
        f = inputs[start : start + len(states)].T
        a_part, m_part = _respond(states[0], q, u_i, f)
        a.append(a_part)
        multipliers.append(m_part)
        start += len(states)
    return np.vstack(a), np.vstack(multipliers)


def _respond(state: State, q: Array, u_i: Array, f: Array) -> tuple[Array, Array]:
    """Return accelerations and multipliers of a group of states, one by one where one of them is singular."""
    try:
        _, a, multipliers = reduced(state.model, state.partition)(q, u_i, f, state.parameters)
    except RuntimeError:
        if q.shape[1] > 1:
            each = [_respond(state, q[:, [i]], u_i[:, [i]], f[:, [i]]) for i in range(q.shape[1])]
            return np.vstack([a for a, _ in each]), np.vstack([m for _, m in each])
        return np.full((1, len(q)), np.nan), np.full((1, len(state.model.system.rows)), np.nan)
    return a.full().T, multipliers.full().T


def _blocks(matrix: Any, count: int, width: int) -> Array:
    """Return mapped (3, width) results of ``count`` snapshots as (count, width, 3)."""
    return matrix.full().T.reshape(count, width, 3)


def gather(
    snapshots: Sequence[Snapshot],
    driven: Sequence[Signal],
    happened: Sequence[tuple[str, float]],
    drives: Drives | None = None,
) -> xr.Dataset:
    """Collect the snapshots of a simulation, and what happened in it, into a data set (see the module's text).

    Parameters
    ----------
    snapshots : sequence of Snapshot
        In order of time.
    driven : sequence of Signal
        The inputs.
    happened : sequence of (str, float)
        Names and times (s) of events.
    drives : Drives, optional
        Prescribed motions, of which the inputs tell what they take.
    """
    import xarray as xr  # slow to import

    start = snapshots[0].state
    t = np.array([snapshot.time for snapshot in snapshots])
    inputs = np.array([[signal(moment) for signal in driven] for moment in t]).reshape(len(t), len(driven))
    if drives is not None and drives.names:
        for i, snapshot in enumerate(snapshots):
            evaluator = Evaluator(snapshot.state, driven, drives=drives)
            evaluator.respond(snapshot.time, snapshot.state.q, snapshot.state.u[evaluator.free])
            inputs[i] = evaluator.f
    variables = _variables(start, snapshots, inputs)
    variables["event_time"] = ("event", np.array([moment for _, moment in happened], dtype=float))
    system = start.model.system
    coords = {
        "time": t,
        "coordinate": list(system.coordinates),
        "input_name": [given.name for given in system.inputs],
        "sensor_name": [sensor.name for sensor in system.sensors],
        "wheel": [wheel.name for wheel in system.wheels],
        "loop": [closure.name for closure in system.closures],
        "axis": ["x", "y", "z"],
        "component": ["longitudinal", "lateral", "normal"],
        "event": np.array([name for name, _ in happened], dtype=str),
    }
    return xr.Dataset(variables, coords=coords)


def _variables(start: State, snapshots: Sequence[Snapshot], inputs: Array) -> dict[str, Any]:
    """Return dimensions and values of all that varies over time."""
    system, equations, p, count = start.model.system, start.model.equations, start.parameters, len(snapshots)
    q, u = (np.array([getattr(snapshot.state, name) for snapshot in snapshots]) for name in ("q", "u"))
    a, multipliers = _responses(snapshots, inputs)
    kinetic, potential = (value.full().ravel() for value in equations.energy(q.T, u.T, p))
    points = equations.contacts(q.T, p)[0]
    forces, torques = equations.loop_wrenches(q.T, multipliers.T, p)
    sensed = equations.sensors(q.T, u.T, p).full().T.reshape(count, len(system.sensors))
    phi = equations.holonomic(q.T, p)[0].full().T
    loops, axes = len(system.closures), ("time", "loop", "axis")
    return {
        "q": (("time", "coordinate"), q),
        "u": (("time", "coordinate"), u),
        "a": (("time", "coordinate"), a),
        "input": (("time", "input_name"), inputs),
        "sensor": (("time", "sensor_name"), sensed),
        "contact": (("time", "wheel", "axis"), _blocks(points, count, len(system.wheels))),
        "wheel_force": (("time", "wheel", "component"), split_wheel_forces(system, multipliers)),
        "loop_force": (axes, _blocks(forces, count, loops)),
        "loop_torque": (axes, _blocks(torques, count, loops)),
        "kinetic_energy": ("time", kinetic),
        "potential_energy": ("time", potential),
        "energy": ("time", kinetic + potential),
        "residual": ("time", np.max(abs(phi), axis=1, initial=0.0)),
    }
