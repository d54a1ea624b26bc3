"""What is known of a frame's geometry while it is put together: from where, and whether it contradicts itself."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from singletrack.arrays import is_concrete
from singletrack.catalogue.sheet import Sheet
from singletrack.catalogue.tables import entries
from singletrack.errors import InputError

__all__ = ["Geometry", "known_if"]


@dataclass
class Geometry:
    """Geometry as it follows, one entry for each design of a sample, the first being the sheet itself.

    Attributes
    ----------
    sheet : Sheet
    normal : function
        Returns standard normal numbers, shape (n,).
    xp : namespace
        Of the arrays.
    values : dict of str to array, shape (n,)
        In m and rad: the parameters of a bicycle, and tyre widths and bead radii.
    notes : dict of str to str
        Where each comes from, in words.
    contradictions : list of InputError
    """

    sheet: Sheet
    normal: Callable[[], np.ndarray]
    xp: Any = np
    values: dict[str, np.ndarray] = field(default_factory=dict)
    notes: dict[str, str] = field(default_factory=dict)
    contradictions: list[InputError] = field(default_factory=list)

    def given(self, name: str) -> np.ndarray | None:
        """Return an entry of the sheet, shape (n,), None where it says nothing (``name``: of the entry)."""
        found = self.sheet.values.get(name)
        return None if found is None else self.drawn(found.value, found.deviation or 0.0)

    def drawn(self, mean: Any, deviation: Any) -> np.ndarray:
        """Return a sample, shape (n,), of a normal number with a mean and a standard deviation; the mean first."""
        result: np.ndarray = mean + deviation * self.normal()
        return result

    def typical(self, name: str, scale: Any = 1.0) -> np.ndarray:
        """Return an entry, shape (n,), given or else typical (``name`` of the entry, ``scale`` of what is typical)."""
        found = self.given(name)
        if found is not None:
            self.notes.setdefault(name, "given")
            return found
        mean, deviation = entries()[name].typical or (0.0, 0.0)
        self.notes.setdefault(name, f"not given, typical ({entries()[name].source})")
        return self.drawn(mean * scale, deviation * scale)

    def choose(self, name: str, ways: list[tuple[np.ndarray | None, str]], slack: float) -> np.ndarray | None:
        """Return the first of several ways to know something, and note those that contradict it.

        Parameters
        ----------
        name : str
        ways : list of (array of shape (n,) or None, str)
            Values and where they come from.
        slack : float
            What rounding on a sheet explains, in SI.
        """
        known = [(value, text) for value, text in ways if value is not None]
        if not known:
            return None
        value, text = known[0]
        for other, told in known[1:]:
            if is_concrete(other) and is_concrete(value) and not abs(other[0] - value[0]) <= slack:
                self.contradictions.append(_contradiction(name, value[0], text, other[0], told))
        self.notes[name] = text
        return value


def _contradiction(name: str, value: float, text: str, other: float, told: str) -> InputError:
    unit = entries()[name].unit if name in entries() else "m"
    first, second = (
        f"{math.degrees(number):.2f} deg" if unit == "rad" else f"{1000 * number:.1f} mm" for number in (value, other)
    )
    reason = f"{name} contradicts itself: {first} ({text}), but {second} ({told})"
    return InputError(reason, parameters=[name], found=(value, other), allowed="one of both, or both in agreement")


def known_if(function: Callable[..., np.ndarray], *arguments: np.ndarray | None) -> np.ndarray | None:
    """Return a function of arrays, None if one of them is not known.

    Parameters
    ----------
    function : callable
    *arguments : array of shape (n,) or None
    """
    with np.errstate(invalid="ignore"):
        return None if any(argument is None for argument in arguments) else function(*arguments)
