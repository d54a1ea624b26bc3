"""Motions given over time: coordinates that a drive moves as prescribed, and the forces that it takes.

A prescribed coordinate is an independent one whose value, rate and acceleration are known. Accelerations and constraint
forces are linear in the forces on coordinates: one evaluation without the drives and one with each of them give the
drives under which the prescribed coordinates accelerate as they should, and all else that follows, exactly.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any, Protocol, Self, TypeAlias

import numpy as np

from singletrack.errors import ModelError
from singletrack.multibody.engine.connections import CoordinateForce
from singletrack.multibody.engine.model import State, build, index_of
from singletrack.multibody.engine.partition import partition

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from singletrack.arrays import Array

__all__ = ["Drives", "Prescribed", "driven_state"]

AT_START = 1e-8
CHECKS = 9
STEP = 1e-5
MISFIT = 1e-3

Law: TypeAlias = "Callable[[float], tuple[float, float, float]]"


@dataclass(frozen=True, eq=False)
class Prescribed:
    """A coordinate over time: value (m, rad), rate and acceleration at a time (s).

    Attributes
    ----------
    law
        Returns the three at a time.
    breaks
        Times where the acceleration jumps, s.
    max_step
        The longest step that cannot miss a feature, s.

    Examples
    --------
    >>> Prescribed(lambda t: (t**2, 2 * t, 2.0))(3.0)
    (9.0, 6.0, 2.0)
    """

    law: Law
    breaks: tuple[float, ...] = ()
    max_step: float = 0.02

    def __call__(self, t: float) -> tuple[float, float, float]:
        """Return value, rate and acceleration at a time."""
        try:
            value, rate, acceleration = self.law(t)
            return float(value), float(rate), float(acceleration)
        except (TypeError, ValueError):
            raise ModelError(
                "prescribed motion: must be a function of time that returns three numbers: value, rate, acceleration"
            ) from None

    @classmethod
    def through(cls, times: Array, values: Array) -> Self:
        """Return the motion through recorded values: a cubic spline, at rest at both ends and beyond.

        Parameters
        ----------
        times : array, shape (k,)
            In s, increasing.
        values : array, shape (k,)
            In m or rad.

        Raises
        ------
        ModelError
            For times that do not increase, or values that are not finite.

        Examples
        --------
        >>> lean = Prescribed.through([0.0, 1.0], [0.0, 0.2])
        >>> [round(value, 9) for value in lean(0.5)], lean(2.0)
        ([0.1, 0.3, 0.0], (0.2, 0.0, 0.0))
        """
        from scipy.interpolate import CubicSpline  # slow to import

        t, x = np.asarray(times, dtype=float), np.asarray(values, dtype=float)
        if t.ndim != 1 or t.shape != x.shape or len(t) < 2 or not np.all(np.isfinite(x)) or not np.all(np.diff(t) > 0):
            raise ModelError(f"prescribed: times {t.shape} must increase, values {x.shape} be finite and as many")
        spline = CubicSpline(t, x, bc_type="clamped")

        def law(moment: float) -> tuple[float, float, float]:
            if not t[0] <= moment <= t[-1]:
                return float(x[0] if moment < t[0] else x[-1]), 0.0, 0.0
            return float(spline(moment)), float(spline(moment, 1)), float(spline(moment, 2))

        return cls(law, (float(t[0]), float(t[-1])), float(np.min(np.diff(t))))


class Memory(Protocol):
    """Arrays that an evaluation reads and writes: inputs, accelerations, multipliers."""

    f: Array
    a: Array
    multipliers: Array


@dataclass(frozen=True, eq=False)
class Drives:
    """Prescribed coordinates of a machine: names, motions, places of the coordinates and of their drives' inputs."""

    names: tuple[str, ...] = ()
    motions: tuple[Prescribed, ...] = ()
    places: tuple[int, ...] = ()
    inputs: tuple[int, ...] = ()

    @property
    def breaks(self) -> set[float]:
        """Times where an acceleration jumps, s."""
        return {b for motion in self.motions for b in motion.breaks}

    @property
    def max_step(self) -> float:
        """The longest step that cannot miss a feature, s."""
        return min((motion.max_step for motion in self.motions), default=np.inf)

    def at(self, t: float) -> Array:
        """Return values, rates and accelerations (3, k) at a time, s."""
        return np.array([motion(t) for motion in self.motions]).reshape(-1, 3).T

    def solve(self, evaluate: Callable[[], Any], wanted: Array, places: list[int], memory: Memory) -> None:
        """Find the drives' forces by evaluations that share memory, and leave what follows in it.

        Parameters
        ----------
        evaluate : callable
            From ``memory.f`` to ``memory.a`` and ``memory.multipliers``.
        wanted : array, shape (k,)
            Accelerations of the prescribed coordinates.
        places : list of int
            Of these coordinates, k of them.
        memory : Memory
            Whose arrays are read and written.
        """
        drives = list(self.inputs)
        memory.f[drives] = 0.0
        evaluate()
        a, multipliers = memory.a.copy(), memory.multipliers.copy()
        pushed = []
        for drive in drives:
            memory.f[drives] = 0.0
            memory.f[drive] = 1.0
            evaluate()
            pushed.append((memory.a - a, memory.multipliers - multipliers))
        matrix = np.array([change[places] for change, _ in pushed]).T
        try:
            forces = np.linalg.solve(matrix, wanted - a[places])
        except np.linalg.LinAlgError:
            forces = np.full(len(drives), np.nan)
        memory.f[drives] = forces
        for force, (change, carried) in zip(forces, pushed, strict=True):
            a, multipliers = a + force * change, multipliers + force * carried
        memory.a[:], memory.multipliers[:] = a, multipliers
        memory.a[places] = wanted


def driven_state(
    state: State, prescribed: Mapping[str, Prescribed | Law] | None, start: float, stop: float, given: Mapping[str, Any]
) -> tuple[State, Drives]:
    """Return a state whose independent speeds include the prescribed ones, of a machine with a drive for each of them.

    Parameters
    ----------
    state : State
        Where the simulation starts.
    prescribed : mapping, optional
        Motions by coordinate.
    start, stop : float
        Times of the simulation, s.
    given : mapping
        The inputs as given, by name.

    Raises
    ------
    ModelError
        For an unknown coordinate, one that cannot be chosen, a motion that starts elsewhere than the state or whose
        rate is not that of its value, an input that would be the drive.
    """
    if not prescribed:
        return state, Drives()
    names = tuple(prescribed)
    motions = tuple(m if isinstance(m, Prescribed) else Prescribed(m) for m in prescribed.values())
    places = tuple(index_of(state.model.system, name) for name in names)
    for name, motion in zip(names, motions, strict=True):
        _check(state, name, motion, (start, stop))
    state = _with_inputs(state, names)
    system = state.model.system
    drives = {i.coordinate: k for k, i in enumerate(system.inputs) if isinstance(i, CoordinateForce)}
    for name in names:
        drive = system.inputs[drives[name]].name
        if drive in given:
            raise ModelError(f"input {drive}: it follows where {name} is prescribed; leave it out")
    if not set(places) <= set(state.partition.independent_speeds):
        jacobian, _ = state.model.kinetics(state.q, state.parameters)
        try:
            parts = partition(system.replace(independent=None), jacobian, held=names)
        except ModelError:
            raise ModelError(f"prescribed {', '.join(names)}: the constraints leave no such freedom here") from None
        state = replace(state, partition=parts)
    return state, Drives(names, motions, places, tuple(drives[name] for name in names))


def _check(state: State, name: str, motion: Prescribed, span: tuple[float, float]) -> None:
    value, rate, _ = motion(span[0])
    if not abs(value - state[name]) + abs(rate - state.rate(name)) < AT_START * (1.0 + abs(value) + abs(rate)):
        raise ModelError(
            f"prescribed {name}: starts at {value:.6g} with the rate {rate:.6g}, but the state is at {state[name]:.6g} "
            f"with the rate {state.rate(name):.6g}; assemble and move it there"
        )
    inside = np.linspace(*span, CHECKS + 2)[1:-1]
    some = [t for t in inside if all(abs(t - b) > 2 * STEP for b in motion.breaks)]
    seen = np.array([(motion(t - STEP), motion(t), motion(t + STEP)) for t in some]).reshape(-1, 3, 3)
    if not np.all(np.isfinite(seen)):
        raise ModelError(f"prescribed {name}: value, rate and acceleration must be finite at all times")
    for k, (one, other) in enumerate((("rate", "value"), ("acceleration", "rate"))):
        slope = (seen[:, 2, k] - seen[:, 0, k]) / (2 * STEP)
        off = abs(slope - seen[:, 1, k + 1])
        scale = np.max(abs(seen[:, 1, k + 1]), initial=0.0) + np.max(abs(slope), initial=0.0)
        if np.any(off > MISFIT * scale + 1e-6):
            t = some[int(np.argmax(off))]
            raise ModelError(f"prescribed {name}: its {one} at {t:.6g} s is not the derivative of its {other}")


def _with_inputs(state: State, names: tuple[str, ...]) -> State:
    """Return the state of a machine that has an input on each of some coordinates."""
    system = state.model.system
    known = {given.coordinate for given in system.inputs if isinstance(given, CoordinateForce)}
    missing = [name for name in names if name not in known]
    if not missing:
        return state
    key = ("driven", tuple(missing))
    if key not in state.model.cache:
        more = [CoordinateForce(f"{name} drive", name) for name in missing]
        state.model.cache[key] = build(system.replace(inputs=(*system.inputs, *more)))
    return replace(state, model=state.model.cache[key])
