"""Inputs over time. Each knows where it is not smooth, so that the integration stops there and steps over nothing."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Protocol, TypeAlias

import numpy as np

from singletrack.arrays import Array
from singletrack.errors import ModelError, unknown_name
from singletrack.multibody.engine.model import finite

if TYPE_CHECKING:
    from collections.abc import Mapping

    from singletrack.multibody.engine.system import System

__all__ = ["Constant", "Function", "Pulse", "Sampled", "Signal", "signals"]


class Signal(Protocol):
    """An input over time (s)."""

    @property
    def breaks(self) -> tuple[float, ...]:
        """Times where it is not smooth, s."""

    @property
    def max_step(self) -> float:
        """The longest step that cannot miss a feature, s."""

    def __call__(self, t: float) -> float:
        """Return its value at time t."""


@dataclass(frozen=True)
class Constant:
    """An input that never changes.

    >>> Constant(2.0)(5.0)
    2.0
    """

    value: float
    breaks: tuple[float, ...] = ()
    max_step: float = np.inf

    def __call__(self, t: float) -> float:  # noqa: ARG002  # the same at all times
        """Return its value."""
        return self.value


@dataclass(frozen=True)
class Pulse:
    """A rectangular pulse: ``height`` from ``start`` for ``duration`` (s), zero elsewhere.

    >>> pulse = Pulse(8.0, 0.05, 10.0)
    >>> pulse(8.01), pulse(8.06), pulse.breaks
    (10.0, 0.0, (8.0, 8.05))
    """

    start: float
    duration: float
    height: float
    max_step: float = np.inf

    def __post_init__(self) -> None:
        if not np.all(np.isfinite([self.start, self.duration, self.height])) or self.duration <= 0.0:
            raise ModelError(
                f"pulse: start {self.start!r}, duration {self.duration!r}, height {self.height!r}; "
                "allowed: finite numbers, a duration above zero"
            )

    @property
    def breaks(self) -> tuple[float, ...]:
        """Its two edges."""
        return (self.start, self.start + self.duration)

    def __call__(self, t: float) -> float:
        """Return its value at time t."""
        return self.height if self.start <= t < self.start + self.duration else 0.0


@dataclass(frozen=True, eq=False)
class Sampled:
    """Sampled data: linear between samples, or held (``hold``); constant before the first and after the last.

    Parameters
    ----------
    times
        Times of the samples, s, increasing, (k,).
    values
        Values, (k,).
    hold
        Hold each value until the next.

    Examples
    --------
    >>> Sampled([0.0, 1.0], [0.0, 4.0])(0.25)
    1.0
    >>> Sampled([0.0, 1.0], [0.0, 4.0], hold=True)(0.25)
    0.0
    """

    times: Array
    values: Array
    hold: bool = False
    max_step: float = np.inf

    def __post_init__(self) -> None:
        times, values = np.asarray(self.times, dtype=float), np.asarray(self.values, dtype=float)
        if times.ndim != 1 or times.shape != values.shape or not len(times):
            raise ModelError(f"sampled input: times {times.shape} and values {values.shape} must be two equal lists")
        if not np.all(np.diff(times) > 0.0) or not np.all(np.isfinite(values)):
            raise ModelError("sampled input: times must increase and values be finite")
        object.__setattr__(self, "times", times)
        object.__setattr__(self, "values", values)

    @property
    def breaks(self) -> tuple[float, ...]:
        """Samples at which the value (held) or the slope (linear) changes."""
        if self.hold:
            changes = np.flatnonzero(np.diff(self.values)) + 1
        else:
            slopes = np.concatenate([[0.0], np.diff(self.values) / np.diff(self.times), [0.0]])
            changes = np.flatnonzero(np.diff(slopes))
        return tuple(self.times[changes].tolist())

    def __call__(self, t: float) -> float:
        """Return its value at time t."""
        if self.hold:
            return float(self.values[max(0, int(np.searchsorted(self.times, t, side="right")) - 1)])
        return float(np.interp(t, self.times, self.values))


@dataclass(frozen=True, eq=False)
class Function:
    """Any function of time. Steps stay below ``max_step``, as nobody knows where it has corners; name them if you can.

    >>> Function(np.cos, max_step=0.1)(0.0)
    1.0
    """

    function: Callable[[float], float]
    breaks: tuple[float, ...] = ()
    max_step: float = 0.02

    def __call__(self, t: float) -> float:
        """Return its value at time t."""
        return float(self.function(t))


Given: TypeAlias = "Signal | float | Callable[[float], float]"


def _signal(name: str, value: Any) -> Signal:
    if isinstance(value, Constant):
        return Constant(finite("input", name, value.value))
    if isinstance(value, (Pulse, Sampled, Function)):
        return value
    return Function(value) if callable(value) else Constant(finite("input", name, value))


def signals(system: System, inputs: Mapping[str, Given] | None) -> list[Signal]:
    """Return one signal for each input of the machine; those not given are zero.

    Parameters
    ----------
    system : System
        The machine.
    inputs : mapping, optional
        Numbers, functions of time or signals by name, N or N m.

    Raises
    ------
    ModelError
        For an input the machine does not have, or a number that is not finite.
    """
    names = [given.name for given in system.inputs]
    for name in inputs or {}:
        if name not in names:
            raise ModelError(unknown_name("input", name, names))
    return [_signal(name, (inputs or {}).get(name, 0.0)) for name in names]
