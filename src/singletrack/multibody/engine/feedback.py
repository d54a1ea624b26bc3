"""Sampled state feedback in a simulation: measured, bounded, delayed, held."""

from __future__ import annotations

from bisect import bisect_right
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np

from singletrack.errors import ModelError, unknown_name
from singletrack.multibody.engine.inputs import Signal

if TYPE_CHECKING:
    from singletrack.arrays import Array
    from singletrack.multibody.engine.model import State
    from singletrack.multibody.engine.system import System
    from singletrack.parameters.feedback import Feedback

__all__ = ["Controller"]

#: A delay this near a whole number of periods is one.
_WHOLE = 1e-6


@dataclass(eq=False)
class _Held:
    """An input with what the controller adds to it: grows while the simulation goes on."""

    given: Signal
    times: list[float] = field(default_factory=list)
    values: list[float] = field(default_factory=list)

    @property
    def breaks(self) -> tuple[float, ...]:
        return self.given.breaks

    @property
    def max_step(self) -> float:
        return self.given.max_step

    def __call__(self, t: float) -> float:
        place = bisect_right(self.times, t)
        return self.given(t) + (self.values[place - 1] if place else 0.0)


class Controller:
    """A feedback at work on a machine; of one simulation, as it remembers what it commanded.

    Parameters
    ----------
    feedback : Feedback
        With gains that are numbers.
    system : System
    driven : list of Signal
        The inputs as given; those in ``signals`` add what the controller does.
    span : (float, float)
        From when to when, s.

    Raises
    ------
    ModelError
        For an input or a signal that the machine does not have.
    """

    def __init__(self, feedback: Feedback, system: System, driven: list[Signal], span: tuple[float, float]) -> None:
        names = [given.name for given in system.inputs]
        places = list(system.coordinates)
        known = [*places, *(f"{name} rate" for name in places)]
        self.matrix = np.zeros((len(names), len(known)))
        for (target, signal), gain in feedback.gains.items():
            if target not in names:
                raise ModelError(unknown_name("input", target, names))
            if signal not in known:
                raise ModelError(unknown_name("signal", signal, known))
            self.matrix[names.index(target), known.index(signal)] = _number(gain, target, signal)
        self.feedback = feedback
        self.held = [_Held(given) for given in driven]
        count = int(np.ceil((span[1] - span[0]) / feedback.period))
        whole, rest = self._delay()
        # The same sums for samples and torques: a delay of whole periods then changes nothing between two samples.
        self.samples = (span[0] + feedback.period * np.arange(count)).tolist()
        self.acts = (span[0] + feedback.period * (np.arange(count) + whole) + rest).tolist()

    def _delay(self) -> tuple[int, float]:
        periods = self.feedback.delay / self.feedback.period
        whole = round(periods) if abs(periods - round(periods)) < _WHOLE else int(periods)
        rest = self.feedback.delay - whole * self.feedback.period
        return whole, rest if rest > _WHOLE * self.feedback.period else 0.0

    @property
    def signals(self) -> list[Any]:
        """The inputs as they become."""
        return list(self.held)

    @property
    def breaks(self) -> set[float]:
        """When it measures, and when its torques change, s."""
        return {*self.samples, *self.acts}

    def measure(self, time: float, state: State) -> None:
        """Command what follows from a state, if it is time to measure; a repeated time replaces what was said."""
        place = bisect_right(self.samples, time) - 1
        if place < 0 or self.samples[place] != time:
            return
        torques: Array = self.matrix @ np.concatenate([state.q, state.u])
        for held, torque in zip(self.held, np.clip(torques, -self.feedback.limit, self.feedback.limit), strict=True):
            del held.times[place:], held.values[place:]
            held.times.append(self.acts[place])
            held.values.append(float(torque))


def _number(gain: Any, target: str, signal: str) -> float:
    try:
        return float(gain)
    except (TypeError, ValueError):
        raise ModelError(
            f"gain from {signal} to {target} = {gain!r}, must be a number: type feedback.at(speed)"
        ) from None
