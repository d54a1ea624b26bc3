"""Where a machine stops being the machine that was described: what ends a simulation unless it is told not to."""

from __future__ import annotations

import math
from dataclasses import dataclass

from singletrack.errors import ModelError
from singletrack.multibody.engine.checks import check_number

__all__ = ["Limit", "Reach"]


@dataclass(frozen=True, eq=False)
class Limit:
    """A coordinate's range; beyond it the machine has fallen, or hit a stop, and a simulation ends.

    Parameters
    ----------
    coordinate
        Its name.
    low, high
        The range, m or rad.
    below, above
        What to say when it is left; by default that the coordinate is at its lower or upper limit.

    Raises
    ------
    ModelError
        For a range without an inside.

    Examples
    --------
    >>> Limit("lean", -1.4, 1.4, "fell to the left", "fell to the right").above
    'fell to the right'
    >>> Limit("elbow", 0.0, 2.6).below
    'elbow at its lower limit'
    """

    coordinate: str
    low: float = -math.inf
    high: float = math.inf
    below: str = ""
    above: str = ""

    def __post_init__(self) -> None:
        for side in ("low", "high"):
            value = getattr(self, side)
            if not (isinstance(value, (int, float)) and math.isinf(value)):
                object.__setattr__(self, side, check_number(f"limit of {self.coordinate}", side, value))
        if not self.low < self.high:
            raise ModelError(f"limit of {self.coordinate}: low {self.low:g} must lie below high {self.high:g}")
        object.__setattr__(self, "below", self.below or f"{self.coordinate} at its lower limit")
        object.__setattr__(self, "above", self.above or f"{self.coordinate} at its upper limit")


@dataclass(frozen=True, eq=False)
class Reach:
    """Coordinates that loops are to determine: where they cease to, a limb is stretched or folded, a simulation ends.

    Parameters
    ----------
    loops
        Names of the closures, all of them together.
    coordinates
        Names of the coordinates that they determine, as many as the closures have equations.
    saying
        What to say of the loop that gives way; ``{loop}`` stands for its name.

    Examples
    --------
    >>> Reach(("left hand",), ("shoulder", "turn", "elbow")).saying.format(loop="left hand")
    'left hand at the end of its reach'
    """

    loops: tuple[str, ...]
    coordinates: tuple[str, ...]
    saying: str = "{loop} at the end of its reach"

    def __post_init__(self) -> None:
        object.__setattr__(self, "loops", tuple(self.loops))
        object.__setattr__(self, "coordinates", tuple(self.coordinates))
