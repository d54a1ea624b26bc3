"""What looks odd is said as a Python warning, once for each record, wherever something is computed from it."""

from __future__ import annotations

import inspect
import warnings
from math import cos, sin
from pathlib import Path
from typing import TYPE_CHECKING
from weakref import WeakKeyDictionary, WeakSet

from singletrack.body.reach import reach_oddities, seat_oddities
from singletrack.body.skeleton import frame_faults, frame_points
from singletrack.errors import OddityWarning, SingletrackError
from singletrack.parameters import Bicycle
from singletrack.parameters.plausibility import Oddity, oddities

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping

    from singletrack.arrays import Number
    from singletrack.parameters import Rider

__all__ = ["frame_oddities", "warn_of_oddities"]

_PACKAGE = str(Path(__file__).parents[1])
#: The bicycles and riders whose oddities have been said; by bicycle, the riders on it.
_SAID: WeakSet[Bicycle | Rider] = WeakSet()
_SAID_TOGETHER: WeakKeyDictionary[Bicycle, WeakSet[Rider]] = WeakKeyDictionary()


def warn_of_oddities(
    record: Bicycle | Rider, rider: Rider | None = None, shares: Mapping[str, Number] | None = None
) -> None:
    """Warn of what looks odd about a bicycle or rider, and about a rider's reach on a bicycle (:class:`OddityWarning`).

    Each record is warned about once, and each rider on a bicycle once. A batch of designs is left alone, and so is what
    JAX looks at.

    Parameters
    ----------
    record : Bicycle or Rider
    rider : Rider, optional
        Seated on the bicycle.
    shares : mapping of str to number, optional
        How far the limbs of a single rider are stretched, where that is known already
        (:func:`~singletrack.body.reach.reach`).

    Examples
    --------
    >>> from singletrack import load_bicycle
    >>> with warnings.catch_warnings(record=True, action="always") as said:
    ...     warn_of_oddities(load_bicycle("stratos").replace(trail=60.0))
    >>> said[0].message.parameter, said[0].message.found, said[0].message.expected
    ('trail', 60.0, '0 to 0.3 m')
    """
    if record.is_single and record not in _SAID:
        _SAID.add(record)
        _say(record.name, (*oddities(record), *(frame_oddities(record) if isinstance(record, Bicycle) else ())))
    if isinstance(record, Bicycle) and rider is not None and record.is_single and rider.is_single:
        _warn_of_rider(record, rider, shares)


def frame_oddities(bicycle: Bicycle) -> tuple[Oddity, ...]:
    """Return what keeps the tubes from being where the geometry has them: no fault as long as nobody sits there.

    Parameters
    ----------
    bicycle : Bicycle
        A single design.

    Examples
    --------
    >>> from singletrack import load_bicycle
    >>> [odd.parameter for odd in frame_oddities(load_bicycle("stratos").replace(trail=1.2))]
    ['fork_length']
    """
    if bicycle.missing_geometry():
        return ()
    tilt = float(bicycle.steer_axis_tilt)
    drop = bicycle.rear_wheel_radius - bicycle.bottom_bracket_height
    offset = bicycle.front_wheel_radius * sin(tilt) - bicycle.trail * cos(tilt)
    if bicycle.chain_stay_length >= abs(float(drop)) and bicycle.fork_length >= abs(float(offset)):
        return ()
    faults = [fault for fault in frame_faults(frame_points(bicycle), bicycle) if fault.bad]
    return tuple(
        Oddity(
            fault.parameters[0],
            f"{fault.reason()}; no rider can be seated",
            float(getattr(bicycle, fault.parameters[0])),
            fault.allowed,
        )
        for fault in faults
    )


def _warn_of_rider(bicycle: Bicycle, rider: Rider, shares: Mapping[str, Number] | None) -> None:
    on_it = _SAID_TOGETHER.setdefault(bicycle, WeakSet())
    if rider in on_it:
        return
    on_it.add(rider)
    try:
        seated = rider.on(bicycle)
        found = seat_oddities(bicycle, seated) if shares is None else reach_oddities(shares)
    except SingletrackError:  # who cannot sit or does not reach is told so when the model is made
        return
    if rider not in _SAID:
        _SAID.add(rider)
        _say(rider.name, oddities(seated))
    _say(" on ".join(name for name in (rider.name, bicycle.name) if name), found)


def _say(name: str, found: Iterable[Oddity]) -> None:
    for odd in found:
        warning = OddityWarning(odd.text, name=name, parameter=odd.parameter, found=odd.found, expected=odd.expected)
        warnings.warn(warning, stacklevel=_level_of_caller())


def _level_of_caller() -> int:
    """Return the ``stacklevel`` with which a warning points at the line of the program that called this package."""
    frame, level = inspect.currentframe(), 0
    while frame is not None and frame.f_code.co_filename.startswith(_PACKAGE):
        frame, level = frame.f_back, level + 1
    return level
