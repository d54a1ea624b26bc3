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
from singletrack.multibody.engine.model import State

if TYPE_CHECKING:
    from collections.abc import Sequence

    import xarray as xr

    from singletrack.arrays import Array
    from singletrack.multibody.engine.inputs import Signal

__all__ = ["Snapshot", "gather"]


@dataclass(frozen=True, eq=False)
class Snapshot:
    """A state at a time (s)."""

    time: float
    state: State


def _responses(samples: Sequence[Snapshot], inputs: Array) -> tuple[Array, Array]:
    """Return accelerations (k, n) and multipliers (k, rows) of all samples."""
    a, multipliers, start = [], [], 0
    for parts, group in groupby(samples, key=lambda sample: sample.state.partition):
        states = [sample.state for sample in group]
        q = np.array([state.q for state in states]).T
        u_i = np.array([state.u[list(parts.independent_speeds)] for state in states]).T
        f = inputs[start : start + len(states)].T
        _, a_part, m_part = reduced(states[0].model, parts)(q, u_i, f, states[0].parameters)
        a.append(a_part.full().T)
        multipliers.append(m_part.full().T)
        start += len(states)
    return np.vstack(a), np.vstack(multipliers)


def _blocks(matrix: Any, count: int, width: int) -> Array:
    """Return mapped (3, width) results of ``count`` samples as (count, width, 3)."""
    return matrix.full().T.reshape(count, width, 3)


def gather(
    start: State,
    driven: Sequence[Signal],
    times: Array,
    samples: Sequence[Snapshot],
    passages: Sequence[tuple[str, float]],
) -> xr.Dataset:
    """Collect the samples of a simulation into a data set (see the module's text)."""
    import xarray as xr  # slow to import

    if not samples or samples[0].time > times[0]:
        samples = [Snapshot(float(times[0]), start), *samples]
    t = np.array([sample.time for sample in samples])
    inputs = np.array([[signal(moment) for signal in driven] for moment in t]).reshape(len(t), len(driven))
    variables = _variables(start, samples, inputs)
    variables["event_time"] = ("event", np.array([moment for _, moment in passages], dtype=float))
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
        "event": np.array([name for name, _ in passages], dtype=str),
    }
    return xr.Dataset(variables, coords=coords)


def _variables(start: State, samples: Sequence[Snapshot], inputs: Array) -> dict[str, Any]:
    """Return dimensions and values of all that varies over time."""
    system, equations, p, count = start.model.system, start.model.equations, start.parameters, len(samples)
    q, u = (np.array([getattr(sample.state, name) for sample in samples]) for name in ("q", "u"))
    a, multipliers = _responses(samples, inputs)
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
