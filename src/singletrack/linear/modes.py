"""Eigenvalues as named modes, followed through the speeds.

Names come from physics at high speed, where every bicycle is alike: one real root stays bounded (capsize), the other
three grow with the speed, a real one (castering) and a pair (weave). From there each root is followed down to any
speed along the exact meetings of roots (:mod:`singletrack.linear.meetings`), so that the name of a root depends on the
bicycle and the speed alone, and all four roots are there at every speed.

Where weave splits into two real roots and one of these meets another real root, that is one event: the oscillation goes
on as weave, and the root left over takes the other's name. Only there a column jumps, from one real root to another.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from singletrack.arrays import in_stretches
from singletrack.errors import InputError
from singletrack.linear.characteristic import characteristic_polynomial
from singletrack.linear.display import line_of_modes, table_of_modes
from singletrack.linear.eigenvalues import checked_speeds, eigenmotions, eigenvalues
from singletrack.linear.meetings import Meetings, find_meetings
from singletrack.linear.naming import follow
from singletrack.linear.pencil import pencil
from singletrack.linear.quartic.solve import quartic_roots
from singletrack.linear.root_columns import in_columns
from singletrack.linear.root_order import label_at_infinity, label_below, real_count
from singletrack.model import COORDINATES

if TYPE_CHECKING:
    from collections.abc import Callable

    import xarray

    from singletrack.arrays import ArrayLike
    from singletrack.linear.characteristic import CharacteristicPolynomial
    from singletrack.model import LinearModel

__all__ = ["Modes", "modes"]

_NAMES = ("weave", "weave", "capsize", "castering")
_LABELS = ("weave +", "weave -", "capsize", "castering")
#: Designs of any number of freedoms followed at a time.
_CHUNK = 256
#: Problems in a stretch.
_PROBLEMS = 32768


@dataclass(frozen=True, eq=False)
class Modes:
    """The eigenvalues at k speeds, one column for each mode of n freedoms.

    Attributes
    ----------
    speeds : array, shape (k,)
        Forward speeds in m/s.
    eigenvalues : complex array, shape (..., k, 2 n)
        In 1/s; columns as in :attr:`names`. Of a weave pair, the first column has the
        positive imaginary part; of two real weave roots it has the smaller. Likewise for further coordinates.
    eigenmotions : complex array, shape (..., k, 2 n, n)
        All coordinates in each mode, lean normalised to one.
    coordinates : tuple of str
        Names of the n coordinates.
    dominant : int array, shape (..., k, 2 n)
        Which coordinate takes most part in each motion, in units that make masses alike: ``|q_i|² M_ii`` is largest.
    """

    speeds: np.ndarray
    eigenvalues: np.ndarray
    eigenmotions: np.ndarray
    coordinates: tuple[str, ...] = COORDINATES
    dominant: np.ndarray | None = None

    @property
    def names(self) -> tuple[str, ...]:
        """Names of the columns: weave, weave, capsize, castering, then each further coordinate twice."""
        return (*_NAMES, *(name for name in self.coordinates[2:] for _ in range(2)))

    @property
    def applies(self) -> np.ndarray:
        """Whether each name describes the motion at each speed, bool array of shape (..., k, 2 n).

        Weave: a pair of roots, an oscillation. Capsize: a real root. Castering: a real negative root whose motion is
        mostly steer. A further coordinate: it takes most part in the motion, a pair or two real roots; then none of
        the other names applies.
        """
        roots = self.eigenvalues
        size = np.abs(self.eigenmotions[..., 3, :])
        with np.errstate(invalid="ignore"):
            pair = (roots[..., :2].imag != 0) & (roots[..., :1] == np.conj(roots[..., 1:2]))
            steer_dominates = (size[..., 1:2] > np.delete(size, 1, axis=-1)).all(axis=-1)
            castering = (roots[..., 3].imag == 0) & (roots[..., 3].real < 0) & steer_dominates
        applies = np.concatenate([pair, roots[..., 2:3].imag == 0, castering[..., None]], axis=-1)
        if self.dominant is not None:
            further = self.dominant[..., 4:] == np.arange(4, roots.shape[-1]) // 2
            applies = np.concatenate([applies & (self.dominant[..., :4] < 2), further], axis=-1)
        known: np.ndarray = applies & np.isfinite(roots)
        return known

    @property
    def steer_phase(self) -> np.ndarray:
        """Phase of steer relative to lean, shape (..., k, 2 n), in rad: negative where steer lags."""
        phase: np.ndarray = np.angle(self.eigenmotions[..., 1])
        return phase

    def __repr__(self) -> str:
        return line_of_modes(self)

    def _repr_html_(self) -> str:
        """Return a table, for notebooks."""
        return table_of_modes(self)

    def to_dict(self) -> dict[str, Any]:
        """Return speeds, eigenvalues as [k][2 n][re, im] and the names of the columns, for JSON."""
        parts = np.stack([self.eigenvalues.real, self.eigenvalues.imag], axis=-1)
        return {"speeds": self.speeds.tolist(), "eigenvalues": parts.tolist(), "modes": list(self.names)}

    def to_xarray(self) -> xarray.Dataset:
        """Return eigenvalues and eigenmotions labelled by speed, mode and coordinate."""
        import xarray as xr  # lazy: heavy

        batch = [f"design_{i}" for i in range(self.eigenvalues.ndim - 2)]
        return xr.Dataset(
            {
                "eigenvalues": ([*batch, "speed", "mode"], self.eigenvalues, {"units": "1/s"}),
                "eigenmotions": ([*batch, "speed", "mode", "coordinate"], self.eigenmotions),
                "applies": ([*batch, "speed", "mode"], self.applies),
            },
            coords={
                "speed": ("speed", self.speeds, {"units": "m/s"}),
                "mode": [*_LABELS, *(f"{name} {sign}" for name in self.coordinates[2:] for sign in "+-")],
                "coordinate": list(self.coordinates),
            },
        )


def modes(model: LinearModel, speeds: ArrayLike) -> Modes:
    """Return the named modes of designs (...) at speeds (k,).

    Parameters
    ----------
    model : LinearModel
    speeds : array, shape () or (k,)
        Forward speeds in m/s, in any order, not negative.

    Raises
    ------
    InputError
        If a speed is negative or not finite.

    Examples
    --------
    >>> from singletrack import coefficients, load_bicycle
    >>> modes(coefficients(load_bicycle("benchmark")), 5.0).eigenvalues.round(2)[0].tolist()
    [(-0.78+4.46j), (-0.78-4.46j), (-0.32+0j), (-14.08+0j)]
    """
    v = checked_speeds(speeds)
    if (v < 0).any():
        raise InputError(f"speeds: found {v.min():g} m/s, must be zero or more (modes are named for riding forward)")
    if model.freedoms > 2 or not model.is_undamped:
        return _of_any_freedoms(model, v)
    return _followed(model, v, _by_meetings)


def _of_any_freedoms(model: LinearModel, v: np.ndarray) -> Modes:
    return _followed(model, v, _by_branches)


def _followed(
    model: LinearModel, v: np.ndarray, name: Callable[[LinearModel, np.ndarray, np.ndarray], np.ndarray]
) -> Modes:
    """Return the modes of designs (...), stretch by stretch, by a function that puts roots into columns."""
    batch, k, n = model.shape, len(v), model.freedoms
    valid = np.broadcast_to(model.valid, batch).ravel()
    named = np.empty((math.prod(batch), k, 2 * n), dtype=complex)

    def work(piece: slice) -> None:
        some = model.part(piece)
        roots = eigenvalues(some, v)
        roots[~valid[piece]] = np.nan
        named[piece] = name(some, v, roots)

    in_stretches(work, len(named), max(1, _PROBLEMS // max(k, 1)))
    named = named.reshape(*batch, k, 2 * n)
    motions = eigenmotions(model, v, named)
    if n == 2:
        return Modes(v, named, motions)
    return Modes(v, named, motions, model.coordinates, _dominant(model, motions))


def _dominant(model: LinearModel, motions: np.ndarray) -> np.ndarray:
    """Return which coordinate takes most part in each motion (..., k, 2 n, n)."""
    masses = np.sqrt(np.abs(np.diagonal(np.asarray(model.M), axis1=-2, axis2=-1)))
    share = np.abs(motions)
    share *= masses[..., None, None, :]
    result: np.ndarray = np.argmax(np.nan_to_num(share, copy=False), axis=-1)
    return result


def _by_meetings(model: LinearModel, v: np.ndarray, roots: np.ndarray) -> np.ndarray:
    """Put roots (m, k, 4) of two freedoms without springs and dampers into the columns of their modes."""
    with np.errstate(all="ignore"):  # faulty designs are NaN throughout
        polynomials, _ = characteristic_polynomial(model).flat()
    usable = np.isfinite(roots).all(axis=(1, 2))
    named = np.full_like(roots, np.nan)
    if usable.any() and len(v):
        named[usable] = _follow(polynomials.rows(usable), v, roots[usable])
    return named


def _by_branches(model: LinearModel, v: np.ndarray, roots: np.ndarray) -> np.ndarray:
    """Put roots (m, k, 2 n) of any freedoms into the columns of their modes."""
    p, _ = pencil(model)
    named = roots.copy()
    told = np.flatnonzero(p.told & np.isfinite(roots).all(axis=(1, 2)) & bool(len(v)))
    for start in range(0, len(told), _CHUNK):
        rows = told[start : start + _CHUNK]
        some = p.rows(rows)
        rate = some.rate[:, None, None]
        named[rows] = follow(some, v / some.speed[:, None], named[rows] / rate) * rate
    return named


def _follow(p: CharacteristicPolynomial, v: np.ndarray, roots: np.ndarray) -> np.ndarray:
    """Put roots (m, n, 4) into the columns of their modes."""
    meetings = find_meetings(p)
    counts, labels = _labels(p, meetings)
    interval = np.zeros(roots.shape[:-1], dtype=np.intp)
    for speeds in meetings.speeds.T:
        if np.isfinite(speeds).any():
            interval += v > speeds[:, None]
    return in_columns(roots, interval, counts, labels, v < meetings.passing[:, None])


def _labels(p: CharacteristicPolynomial, meetings: Meetings) -> tuple[np.ndarray, np.ndarray]:
    """Return, for m designs and 7 intervals, the number of real roots (m, 7) and the column of each place (m, 7, 4).

    What has no meeting at its upper end is as the interval above.
    """
    inside, finite = meetings.between(), np.isfinite(meetings.speeds)
    counts = np.empty(inside.shape, dtype=np.intp)
    counts[:, -1] = real_count(_roots_at(p, inside[:, -1]))
    labels = np.empty((*counts.shape, 4), dtype=np.intp)
    labels[:, -1] = label_at_infinity(p, counts[:, -1])
    for k in range(meetings.speeds.shape[1] - 1, -1, -1):
        counts[:, k], labels[:, k] = counts[:, k + 1], labels[:, k + 1]
        row = np.flatnonzero(finite[:, k])
        if not len(row):
            continue
        some, speed = p.rows(row), meetings.speeds[row, k]
        counts[row, k] = real_count(_roots_at(some, inside[row, k]))
        at, descending = _roots_at(some, speed), speed < meetings.passing[row]
        labels[row, k] = label_below(labels[row, k + 1], counts[row, k + 1], counts[row, k], at, descending)
    return counts, labels


def _roots_at(p: CharacteristicPolynomial, speeds: np.ndarray) -> np.ndarray:
    """Return the roots (m, 4) of designs at a speed (m,) each."""
    return quartic_roots(*p.monic_at(speeds[:, None]))[:, 0]
