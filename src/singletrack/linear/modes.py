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

from singletrack.errors import InputError
from singletrack.linear.characteristic import characteristic_polynomial
from singletrack.linear.display import line_of_modes, table_of_modes
from singletrack.linear.eigenvalues import checked_speeds, eigenmotions, eigenvalues
from singletrack.linear.meetings import Meetings, find_meetings
from singletrack.linear.naming import follow
from singletrack.linear.pencil import pencil
from singletrack.linear.quartic.solve import quartic_roots
from singletrack.linear.root_order import arrange, label_at_infinity, label_below, real_count
from singletrack.model import COORDINATES

if TYPE_CHECKING:
    import xarray

    from singletrack.arrays import ArrayLike
    from singletrack.linear.characteristic import CharacteristicPolynomial
    from singletrack.model import LinearModel

__all__ = ["Modes", "modes"]

_NAMES = ("weave", "weave", "capsize", "castering")
_LABELS = ("weave +", "weave -", "capsize", "castering")
#: Designs of any number of freedoms followed at a time.
_CHUNK = 256


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
    with np.errstate(all="ignore"):  # faulty designs are NaN throughout
        polynomials, batch = characteristic_polynomial(model).flat()
    roots = eigenvalues(model, v).reshape(math.prod(batch), len(v), 4)
    usable = np.isfinite(roots).all(axis=(1, 2))
    named = np.full_like(roots, np.nan)
    if usable.any() and len(v):
        named[usable] = _follow(polynomials.rows(usable), v, roots[usable])
    named = named.reshape(*batch, len(v), 4)
    return Modes(v, named, eigenmotions(model, v, named))


def _of_any_freedoms(model: LinearModel, v: np.ndarray) -> Modes:
    p, _ = pencil(model)
    roots = eigenvalues(model, v)
    named = roots.reshape(len(p), len(v), 2 * model.freedoms).copy()
    told = np.flatnonzero(p.told & np.isfinite(named).all(axis=(1, 2)) & bool(len(v)))
    for start in range(0, len(told), _CHUNK):
        rows = told[start : start + _CHUNK]
        some = p.rows(rows)
        rate = some.rate[:, None, None]
        named[rows] = follow(some, v / some.speed[:, None], named[rows] / rate) * rate
    named = named.reshape(roots.shape)
    motions = eigenmotions(model, v, named)
    if model.freedoms == 2:
        return Modes(v, named, motions)
    masses = np.sqrt(np.abs(np.diagonal(np.asarray(model.M), axis1=-2, axis2=-1)))
    dominant = np.argmax(np.nan_to_num(np.abs(motions) * masses[..., None, None, :]), axis=-1)
    return Modes(v, named, motions, model.coordinates, dominant)


def _follow(p: CharacteristicPolynomial, v: np.ndarray, roots: np.ndarray) -> np.ndarray:
    """Put roots (m, n, 4) into the columns of their modes."""
    meetings = find_meetings(p)
    counts, labels = _labels(p, meetings)
    interval = (v[None, :, None] > meetings.speeds[:, None, :]).sum(axis=-1)
    count = np.take_along_axis(counts, interval, axis=1)
    ordered = arrange(roots, count, descending=v[None, :] < meetings.passing[:, None])
    columns = np.take_along_axis(labels, interval[..., None], axis=1)
    named = np.empty_like(roots)
    np.put_along_axis(named, columns, ordered, axis=-1)
    first, second = named[..., 0], named[..., 1]
    both_real = (first.imag == 0) & (second.imag == 0)
    swapped = ((first.imag < 0) & (second.imag > 0)) | (both_real & (first.real > second.real))
    named[..., :2] = np.where(swapped[..., None], named[..., 1::-1], named[..., :2])
    return named


def _labels(p: CharacteristicPolynomial, meetings: Meetings) -> tuple[np.ndarray, np.ndarray]:
    """Return, for m designs and 7 intervals, the number of real roots (m, 7) and the column of each place (m, 7, 4)."""
    inside = meetings.between()
    counts = real_count(quartic_roots(*p.monic_at(inside)))
    finite = np.isfinite(meetings.speeds)
    at = quartic_roots(*p.monic_at(np.where(finite, meetings.speeds, 1.0)))
    descending = np.where(finite, meetings.speeds, 1.0) < meetings.passing[:, None]
    labels = np.empty((*counts.shape, 4), dtype=np.intp)
    labels[:, -1] = label_at_infinity(p, counts[:, -1])
    for k in range(meetings.speeds.shape[1] - 1, -1, -1):
        below = label_below(labels[:, k + 1], counts[:, k + 1], counts[:, k], at[:, k], descending[:, k])
        labels[:, k] = np.where(finite[:, k, None], below, labels[:, k + 1])
    return counts, labels
