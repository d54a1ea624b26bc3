"""Feedback: the torques with which a rider, or a machine, answers what the bicycle does."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace

from singletrack.errors import InputError

__all__ = ["Feedback", "Gains"]

#: Gains by (input, signal): a number, or the coefficients of 1, v, v² of a gain that depends on the speed.
Gains = Mapping[tuple[str, str], "float | Sequence[float]"]

#: Shorter periods are no controller's, and make a simulation take for ever.
_SHORTEST = 1e-4
#: N m/rad or N m s/rad: no hand or motor is near it, and equations with more lose the bicycle in rounding.
_GREATEST = 1e7


@dataclass(frozen=True)
class Feedback:
    """State feedback, sampled: input = sum of gain times signal, bounded, some time later.

    Attributes
    ----------
    gains : mapping of (str, str) to float or sequence of float
        By (input, signal), such as ``("steer torque", "lean rate")``: signals are coordinates and their rates, gains in
        N m/rad and N m s/rad. A sequence holds the coefficients of 1, v and v² of a gain that depends on the speed.
    limit : float
        Largest torque of each input, N m.
    delay : float
        From a measurement to the torque it causes, s.
    period : float
        From one measurement to the next, s; the torque is held in between.

    Raises
    ------
    InputError
        For gains that are none, not finite or beyond 1e7, a limit that is not positive, a negative delay, a period
        below 0.1 ms.

    Notes
    -----
    Linear models take the gains alone: no limit, no delay, no period.

    Examples
    --------
    >>> Feedback({("steer torque", "lean rate"): [50.0, -10.0]}, limit=20.0).at(4.0).gains
    {('steer torque', 'lean rate'): 10.0}
    """

    gains: Gains = field(default_factory=dict)
    limit: float = math.inf
    delay: float = 0.0
    period: float = 0.005

    def __post_init__(self) -> None:
        for (target, signal), gain in self.gains.items():
            parts = coefficients_of(gain)
            if not parts or not all(abs(part) <= _GREATEST for part in parts):  # NaN is not either
                what = f"gain from {signal} to {target} = {gain!r}"
                raise InputError(f"{what}, must be finite numbers from {-_GREATEST:g} to {_GREATEST:g}, one or more")
        for name, found, good, allowed in (
            ("limit", self.limit, self.limit > 0.0, "greater than zero"),
            ("delay", self.delay, 0.0 <= self.delay < math.inf, "finite, zero or greater"),
            ("period", self.period, _SHORTEST <= self.period < math.inf, f"at least {_SHORTEST:g} s"),
        ):
            if not good:
                raise InputError(f"{name} = {found!r}, must be {allowed}", parameters=(name,), found=found)

    def at(self, speed: float) -> Feedback:
        """Return the feedback with the gains that it has at a speed in m/s."""
        fixed = {
            key: sum(part * speed**power for power, part in enumerate(coefficients_of(gain)))
            for key, gain in self.gains.items()
        }
        return replace(self, gains=fixed)


def coefficients_of(gain: float | Sequence[float]) -> list[float]:
    """Return the coefficients of 1, v, v² and so on of a gain."""
    return [float(part) for part in gain] if isinstance(gain, Sequence) else [float(gain)]
