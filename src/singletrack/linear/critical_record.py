"""The record of critical speeds: arrays for batches, words for a reader."""

from __future__ import annotations

from dataclasses import dataclass, field, fields
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from singletrack.linear.display import line_of_critical_speeds, table_of_critical_speeds

if TYPE_CHECKING:
    from collections.abc import Sequence

__all__ = ["CriticalSpeeds", "Crossing"]

_DIRECTIONS = {1: "gained", -1: "lost", 0: "unknown"}


class Crossing(NamedTuple):
    """A speed in m/s at which a root crosses the imaginary axis.

    ``kind`` is "pair" (an oscillation begins or ends) or "real"; ``mode`` is weave or capsize, or the coordinate beyond
    lean and steer that dominates the motion there; ``direction`` says whether this mode's stability is "gained" or
    "lost" with growing speed.
    """

    speed: float
    kind: str
    mode: str
    direction: str


@dataclass(frozen=True, eq=False)
class CriticalSpeeds:
    """Speeds at which stability of a mode changes, and the ranges in which all modes are stable, in m/s.

    For a batch of designs of shape (...), :attr:`weave` and the others are nested lists: use the arrays. Two freedoms
    have two columns of each kind and three ranges at most; more freedoms may have more.

    Attributes
    ----------
    weave_speeds : array, shape (..., 2)
        Speeds at which a pair of roots crosses the imaginary axis, ascending, NaN where there are fewer.
    capsize_speeds : array, shape (..., 2)
        Speeds at which a real root crosses zero, ascending, NaN where there are fewer.
    ranges : array, shape (..., 3, 2)
        Stable ranges (from, to), ascending; "to" may be infinite; NaN where there are fewer.
    weave_directions, capsize_directions : int array, shape (..., 2)
        1 where stability is gained with growing speed, -1 where it is lost, 0 where there is no crossing.
    weave_modes, capsize_modes : str array, shape (..., 2)
        Name of the mode that crosses; empty where there is no crossing.
    told : bool array, shape (...)
        False where nothing can be said: faulty designs, numbers that are not finite, roots that stay on the imaginary
        axis at every speed. All speeds are NaN there.
    """

    weave_speeds: np.ndarray
    capsize_speeds: np.ndarray
    ranges: np.ndarray
    weave_directions: np.ndarray = field(kw_only=True)
    capsize_directions: np.ndarray = field(kw_only=True)
    weave_modes: np.ndarray = field(kw_only=True)
    capsize_modes: np.ndarray = field(kw_only=True)
    told: np.ndarray = field(kw_only=True)

    @classmethod
    def joined(cls, parts: Sequence[CriticalSpeeds], batch: tuple[int, ...]) -> CriticalSpeeds:
        """Return designs (m,), cut into several records, as one of a batch (...).

        Parameters
        ----------
        parts : sequence of CriticalSpeeds
            In the order of the designs.
        batch : tuple of int
            Shape of the batch; the product of its entries is m.
        """
        if not parts:
            parts = [cls.empty()]
        arrays = {}
        for name in (one.name for one in fields(cls)):
            values = [np.asarray(getattr(part, name)) for part in parts]
            width = max((value.shape[1] for value in values if value.ndim > 1), default=0)
            fill: Any = {"f": np.nan, "U": ""}.get(values[0].dtype.kind, 0)
            wide = [_widened(value, width, fill) if value.ndim > 1 else value for value in values]
            arrays[name] = np.concatenate(wide).reshape((*batch, *wide[0].shape[1:]))
        return cls(**arrays)

    @classmethod
    def empty(cls) -> CriticalSpeeds:
        """Return the critical speeds of no designs."""
        speeds, directions, modes = np.empty((0, 2)), np.empty((0, 2), dtype=np.int8), np.empty((0, 2), dtype="U7")
        return cls(
            speeds,
            speeds,
            np.empty((0, 3, 2)),
            weave_directions=directions,
            capsize_directions=directions,
            weave_modes=modes,
            capsize_modes=modes,
            told=np.empty(0, dtype=bool),
        )

    @property
    def weave(self) -> list[Any]:
        """All weave speeds of a single design, empty for "never" (a batch: nested lists)."""
        return _lists(self.weave_speeds, 1)

    @property
    def capsize(self) -> list[Any]:
        """All capsize speeds of a single design, empty for "never" (a batch: nested lists)."""
        return _lists(self.capsize_speeds, 1)

    @property
    def stable_ranges(self) -> list[Any]:
        """All stable ranges (from, to) of a single design, empty for "never" (a batch: nested lists)."""
        return _lists(self.ranges, 2)

    @property
    def crossings(self) -> list[Any]:
        """All crossings of a single design (:class:`Crossing`), ascending (a batch: nested lists)."""
        parts = (self.weave_speeds, self.weave_modes, self.weave_directions)
        others = (self.capsize_speeds, self.capsize_modes, self.capsize_directions)
        return _crossings(parts, others)

    @property
    def status(self) -> Any:
        """What became of a single design: "found", "none" (no crossing) or "could not tell" (a batch: nested lists)."""
        some = np.isfinite(self.weave_speeds).any(axis=-1) | np.isfinite(self.capsize_speeds).any(axis=-1)
        return np.where(self.told, np.where(some, "found", "none"), "could not tell").tolist()

    def __repr__(self) -> str:
        return line_of_critical_speeds(self)

    def _repr_html_(self) -> str:
        """Return a table, for notebooks."""
        return table_of_critical_speeds(self)

    def to_dict(self) -> dict[str, Any]:
        """Return the lists for JSON; a range without end ends with None, since JSON has no infinity.

        Where there are crossings, or nothing could be told, ``status`` and ``crossings`` follow; without them the empty
        lists mean "none".
        """
        lists = {
            "weave": self.weave,
            "capsize": self.capsize,
            "stable_ranges": _without_infinity(self.stable_ranges),
        }
        if self.status == "none":
            return lists
        return lists | {"status": self.status, "crossings": _as_dicts(self.crossings)}


def _widened(value: np.ndarray, width: int, fill: Any) -> np.ndarray:
    more = ((0, 0), (0, width - value.shape[1]), *((0, 0),) * (value.ndim - 2))
    return np.pad(value, more, constant_values=fill)


def _lists(values: np.ndarray, axes: int) -> list[Any]:
    if values.ndim > axes:
        return [_lists(value, axes) for value in values]
    if axes == 1:
        return [float(value) for value in values[np.isfinite(values)]]
    return [(float(low), float(high)) for low, high in values if not np.isnan(low)]


def _crossings(pairs: tuple[np.ndarray, ...], reals: tuple[np.ndarray, ...]) -> list[Any]:
    if pairs[0].ndim > 1:
        of_each = zip(zip(*pairs, strict=True), zip(*reals, strict=True), strict=True)
        return [_crossings(pair, real) for pair, real in of_each]
    found = [
        Crossing(float(speed), kind, str(mode), _DIRECTIONS[int(direction)])
        for kind, arrays in (("pair", pairs), ("real", reals))
        for speed, mode, direction in zip(*arrays, strict=True)
        if np.isfinite(speed)
    ]
    return sorted(found)


def _as_dicts(value: Any) -> Any:
    if isinstance(value, Crossing):
        return value._asdict()
    return [_as_dicts(item) for item in value]


def _without_infinity(value: Any) -> Any:
    if isinstance(value, list | tuple):
        return [_without_infinity(item) for item in value]
    return None if value == float("inf") else value
