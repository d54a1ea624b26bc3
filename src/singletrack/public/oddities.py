"""What looks odd is said as a Python warning, once for each record, wherever something is computed from it."""

from __future__ import annotations

import warnings
from pathlib import Path
from typing import TYPE_CHECKING
from weakref import WeakKeyDictionary, WeakSet

import singletrack
from singletrack.body.reach import seat_oddities
from singletrack.errors import OddityWarning, PostureError
from singletrack.parameters.plausibility import oddities

if TYPE_CHECKING:
    from singletrack.parameters import Bicycle, Rider
    from singletrack.parameters.plausibility import Oddity

__all__ = ["warn_of_oddities"]

_PACKAGE = (str(Path(singletrack.__file__).parent),)
#: The bicycles and riders whose oddities have been said; by bicycle, the riders on it.
_SAID: WeakSet[Bicycle | Rider] = WeakSet()
_SAID_TOGETHER: WeakKeyDictionary[Bicycle, WeakSet[Rider]] = WeakKeyDictionary()


def warn_of_oddities(bicycle: Bicycle, rider: Rider | None = None) -> None:
    """Warn of what looks odd about a bicycle, its rider, and the rider's reach (:class:`OddityWarning`).

    Each record is warned about once, and each rider on a bicycle once. A batch of designs is left alone, and so is what
    JAX looks at.

    Parameters
    ----------
    bicycle : Bicycle
    rider : Rider, optional
        Seated on it.

    Examples
    --------
    >>> from singletrack import load_bicycle
    >>> with warnings.catch_warnings(record=True) as said:
    ...     warn_of_oddities(load_bicycle("stratos").replace(trail=60.0))
    >>> said[0].message.parameter, said[0].message.found, said[0].message.expected
    ('trail', 60.0, '0 to 0.3 m')
    """
    for record in (bicycle, rider):
        if record is not None and record.is_single and record not in _SAID:
            _SAID.add(record)
            _say(record.name, oddities(record))
    if rider is None or not (bicycle.is_single and rider.is_single):
        return
    riders = _SAID_TOGETHER.setdefault(bicycle, WeakSet())
    if rider not in riders and not bicycle.missing_geometry():
        riders.add(rider)
        try:
            found = seat_oddities(bicycle, rider)
        except PostureError:  # who does not reach is told by an error
            return
        _say(" on ".join(name for name in (rider.name, bicycle.name) if name), found)


def _say(name: str, found: tuple[Oddity, ...]) -> None:
    for odd in found:
        warning = OddityWarning(
            odd.text, name=name, parameter=odd.parameter, found=odd.found, expected=odd.expected
        )
        # As said where the program calls us, not somewhere within.
        warnings.warn(warning, stacklevel=2, skip_file_prefixes=_PACKAGE)
