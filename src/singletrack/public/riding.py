"""The nonlinear ride as a program asks for it: a speed, a push, a torque, and what came of it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
import xarray as xr

from singletrack.errors import InputError
from singletrack.multibody.bicycle.drawn import Line, drawn_lines, placed
from singletrack.multibody.bicycle.model import bicycle_model, ride
from singletrack.multibody.engine.inputs import Sampled
from singletrack.multibody.engine.model import Model
from singletrack.multibody.engine.simulate import simulate
from singletrack.posture import require_records
from singletrack.public.bounds import within

if TYPE_CHECKING:
    from collections.abc import Callable

    from singletrack.arrays import Array
    from singletrack.parameters import Bicycle, Rider
    from singletrack.parameters.feedback import Feedback
    from singletrack.posture import Options

__all__ = ["Ride", "ride_for"]

MOST_STEPS = 20_000
RATE = 100.0
DOWN = np.radians(45.0)


@dataclass(frozen=True, eq=False)
class Ride:
    """A ride that was simulated.

    Attributes
    ----------
    data
        All that varies over time (see :mod:`singletrack.multibody.engine.results`).
    end
        How it ended, in words, such as ``fell to the right``.
    end_time
        When, s.
    model, lines
        The machine, and what can be seen of it.
    """

    data: xr.Dataset
    end: str
    end_time: float
    model: Model
    lines: tuple[Line, ...]

    @property
    def whole(self) -> bool:
        """Whether it went on for the time that was asked for."""
        return str(self.data.attrs["end"]) == "all times reached"

    def coordinate(self, name: str) -> Array:
        """Return a coordinate over time, (t,), m or rad.

        Parameters
        ----------
        name : str
            Of a coordinate of the machine, such as ``lean`` or ``steer``.
        """
        values: Array = self.data.q.sel(coordinate=name).to_numpy()
        return values

    def places(self, every: int = 1) -> list[Array]:
        """Return where the points of each line are at every so manieth time, (t, k, 3), m."""
        return placed(self.model, self.lines, self.data.q.to_numpy()[::every])


def ride_for(
    bicycle: Bicycle,
    rider: Rider | None = None,
    options: Options | str = "rigid",
    *,
    speed: float,
    duration: float = 10.0,
    push: float = 0.0,
    lean: float = 0.0,
    torque: tuple[Array, Array] | None = None,
    feedback: Feedback | None = None,
    progress: Callable[[float], object] | None = None,
) -> Ride:
    """Ride a bicycle, nonlinear, until the time is over or it has fallen.

    Parameters
    ----------
    bicycle, rider
        One design; numbers, no arrays.
    options
        How the rider sits, or a posture's name.
    speed
        Radius of the rear wheel times its turning rate, m/s.
    duration
        How long, s.
    push
        Lean rate at the start, as after a knock from the side, rad/s; to the right.
    lean
        Lean at the start, rad; to the right.
    torque
        Times (k,), s, and steer torques (k,), N m, linear in between.
    feedback
        What the rider or a machine does about it, with the gains of the speed at the start.
    progress
        Called with the time reached, s.

    Raises
    ------
    InputError
        For a number that is not allowed.

    Examples
    --------
    >>> from singletrack import load_bicycle, load_rider
    >>> fall = ride_for(load_bicycle("browser"), load_rider("rider-a"), "upright", speed=4.0, push=0.3)
    >>> fall.end, round(fall.end_time, 1)
    ('fell to the right (rear wheel off the ground)', 1.5)

    Steering into the fall, with at most 20 N m, keeps them up.

    >>> from singletrack.parameters import Feedback
    >>> steady = Feedback({("steer torque", "lean rate"): 20.0}, limit=20.0)
    >>> both = load_bicycle("browser"), load_rider("rider-a")
    >>> ride_for(*both, "upright", speed=4.0, push=0.3, duration=2.0, feedback=steady).end
    'rode on'
    """
    require_records(bicycle, rider)
    speed, push, lean = within("speed", speed), within("push", push), within("lean", lean)
    duration = within("duration", duration)
    if not duration > 0.0:
        raise InputError(f"duration: {duration!r} s; allowed: above zero")
    model = bicycle_model(bicycle, rider, options)
    start = ride(model, speed, {"lean": lean}, {"lean": push})
    given: dict[str, Any] = {} if torque is None else {"steer torque": Sampled(*torque)}
    times = np.linspace(0.0, duration, max(2, round(duration * RATE) + 1))
    settings: dict[str, Any] = {"trouble": "end", "rtol": 1e-8, "atol": 1e-9, "most_steps": MOST_STEPS}
    if feedback is not None:
        settings["feedback"] = feedback.at(speed)
        settings["most_steps"] += 4 * round(duration / feedback.period)
    data = simulate(start, times, given, progress=progress, **settings)
    end_time = float(data.attrs["end_time"])
    return Ride(data, _words(data), end_time, model, drawn_lines(bicycle, rider, options))


def _words(data: xr.Dataset) -> str:
    """Return how a ride ended: a wheel that lifts off beyond 45 degrees of lean belongs to a fall."""
    end, lean = str(data.attrs["end"]), float(data.q.sel(coordinate="lean")[-1])
    if end == "all times reached":
        return "rode on"
    if "wheel" in end and abs(lean) > DOWN:
        return f"fell to the {'right' if lean > 0.0 else 'left'} ({end})"
    return end
