"""What is unstable of a bicycle that no speed makes stable: the modes that grow at every speed."""

from __future__ import annotations

import itertools
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from singletrack.errors import InputError
from singletrack.linear.critical import critical_speeds
from singletrack.linear.modes import modes

if TYPE_CHECKING:
    from singletrack.linear.critical_record import CriticalSpeeds
    from singletrack.model import LinearModel

__all__ = ["AlwaysUnstable", "always_unstable"]

#: Speeds, m/s, at which growth is told: as far as people ride.
_TOLD = np.linspace(0.1, 10.0, 100)


class AlwaysUnstable(NamedTuple):
    """A mode that grows at every speed.

    Attributes
    ----------
    mode : str
    oscillates : bool
        Whether it is a pair at all speeds below 10 m/s; else it falls at some at least.
    growth : (float, float)
        Least and greatest real part of its eigenvalue from 0.1 to 10 m/s, 1/s.
    """

    mode: str
    oscillates: bool
    growth: tuple[float, float]

    def to_dict(self) -> dict[str, Any]:
        """Return the fields for JSON."""
        return {"mode": self.mode, "oscillates": self.oscillates, "growth": list(self.growth)}


def always_unstable(model: LinearModel, critical: CriticalSpeeds | None = None) -> tuple[AlwaysUnstable, ...]:
    """Return the modes of a single design that are unstable at every speed, the fastest first.

    Stability changes at crossings alone, so one speed between each two of them decides. There is none where some speed
    is stable, or where different modes are unstable at different speeds.

    Parameters
    ----------
    model : LinearModel
    critical : CriticalSpeeds, optional
        Of the model, where they are known.

    Raises
    ------
    InputError
        For a batch.

    Examples
    --------
    >>> from singletrack import coefficients, load_bicycle, load_rider
    >>> upright = coefficients(load_bicycle("browser"), load_rider("rider-a"), "upright")
    >>> [one.mode for one in always_unstable(upright)]
    ['capsize']
    """
    if model.shape != ():
        raise InputError(f"models of shape {model.shape}: this is asked of a single design")
    critical = critical_speeds(model) if critical is None else critical
    if critical.stable_ranges or critical.status == "could not tell":
        return ()
    bounds = [0.0, *(crossing.speed for crossing in critical.crossings)]
    between = [(a + b) / 2 for a, b in itertools.pairwise(bounds)] + [2 * bounds[-1] + 1.0]
    speeds = np.concatenate([between, _TOLD])
    found = modes(model, speeds)
    told, one_each = slice(len(between), None), []
    for name in dict.fromkeys(found.names):
        roots = found.eigenvalues[:, [own == name for own in found.names]]
        fastest = np.take_along_axis(roots, np.argmax(roots.real, axis=-1)[:, None], axis=-1)[:, 0]
        if (fastest.real > 0).all():
            growth = (float(fastest[told].real.min()), float(fastest[told].real.max()))
            one_each.append(AlwaysUnstable(name, bool(np.all(fastest[told].imag)), growth))
    return tuple(sorted(one_each, key=lambda one: -one.growth[1]))
