"""Critical speeds and stable ranges, as exact roots of polynomials in the speed; no grid is scanned."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from singletrack.arrays import in_stretches
from singletrack.linear.characteristic import characteristic_polynomial
from singletrack.linear.critical_record import CriticalSpeeds, Crossing
from singletrack.linear.crossings import Crossings, pair_crossings, real_crossings
from singletrack.linear.pencil import Pencil, pencil
from singletrack.linear.quadratics import solve_quadratics

if TYPE_CHECKING:
    from singletrack.model import LinearModel

__all__ = ["CriticalSpeeds", "Crossing", "critical_speeds"]

#: Width, relative to the speed, of a range in which the roots are too near the axis to be asked for their side.
_NARROW = 1e-4
#: Designs decided on at a time: of two freedoms without springs and dampers, of any other model.
_STRETCH, _CHUNK = 4096, 512


def critical_speeds(model: LinearModel) -> CriticalSpeeds:
    """Return the critical speeds and stable ranges of designs (...), for all speeds above zero.

    Notes
    -----
    Two freedoms without springs and dampers: quadratics in v² (:mod:`singletrack.linear.quadratics`). Any other model:
    real roots cross where det(S0 + g K0 + v² K2) = 0, pairs where the bialternate product of the state matrix is
    singular (:mod:`singletrack.linear.crossings`); between neighbouring crossings the eigenvalues at one speed decide,
    and their number on either side has to change as the crossings say, else the result "could not tell".

    Examples
    --------
    >>> from singletrack import coefficients, load_bicycle
    >>> result = critical_speeds(coefficients(load_bicycle("benchmark")))
    >>> result.weave, result.capsize, result.status
    ([4.292382536...], [6.024262015...], 'found')
    >>> [(c.mode, c.direction) for c in result.crossings]
    [('weave', 'gained'), ('capsize', 'lost')]
    """
    batch, by_quadratics = model.shape, model.freedoms == 2 and model.is_undamped
    if by_quadratics and not batch:
        return _of_two_freedoms(model, model.valid)
    valid = np.broadcast_to(model.valid, batch).ravel()
    parts: dict[int, CriticalSpeeds] = {}

    def work(piece: slice) -> None:
        some = model.part(piece)
        if by_quadratics:
            parts[piece.start] = _of_two_freedoms(some, valid[piece])
        else:
            p, _ = pencil(some)
            p = replace(p, told=p.told & valid[piece])
            parts[piece.start] = _of_any_freedoms(p, model)

    in_stretches(work, len(valid), _STRETCH if by_quadratics else _CHUNK)
    return CriticalSpeeds.joined([parts[start] for start in sorted(parts)], batch)


def _of_two_freedoms(model: LinearModel, valid: np.ndarray) -> CriticalSpeeds:
    with np.errstate(all="ignore"):  # numbers out of range are not told
        found = solve_quadratics(characteristic_polynomial(model))
    told = found.told & valid
    bad = ~told[..., None]

    def names(speeds: np.ndarray, name: str) -> np.ndarray:
        result: np.ndarray = np.where(np.isfinite(speeds), name, "")
        return result

    weave, capsize = (np.where(bad, np.nan, speeds) for speeds in (found.weave, found.capsize))
    return CriticalSpeeds(
        weave,
        capsize,
        np.where(bad[..., None], np.nan, found.ranges),
        weave_directions=_directions(weave, found.weave_growth),
        capsize_directions=_directions(capsize, found.capsize_growth),
        weave_modes=names(weave, "weave"),
        capsize_modes=names(capsize, "capsize"),
        told=told,
    )


def _directions(speeds: np.ndarray, growth: np.ndarray) -> np.ndarray:
    """Return 1 where stability is gained with growing speed, -1 where it is lost, 0 where there is no crossing."""
    result: np.ndarray = np.where(np.isfinite(speeds), -np.sign(growth), 0).astype(np.int8)
    return result


def _of_any_freedoms(p: Pencil, model: LinearModel) -> CriticalSpeeds:
    """Return the critical speeds of designs (m,) on one axis."""
    pairs, reals = pair_crossings(p), real_crossings(p)
    ranges, consistent = _stable_ranges(p, pairs, reals)
    told = p.told & pairs.told & reals.told & consistent
    least = 2 * (p.freedoms - 1)

    def finished(crossings: Crossings, own: str) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        short = max(0, least - crossings.speeds.shape[1])
        speeds = np.pad(crossings.speeds * p.speed[:, None], ((0, 0), (0, short)), constant_values=np.nan)
        speeds[~told] = np.nan
        growth = np.pad(crossings.growth, ((0, 0), (0, short)))
        names = np.array([own, own, *model.coordinates[2:]])
        strongest = np.argmax(np.nan_to_num(crossings.motions), axis=-1)
        modes = np.where(np.isfinite(speeds), np.pad(names[strongest], ((0, 0), (0, short))), "")
        return speeds, _directions(speeds, growth), modes

    weave, weave_directions, weave_modes = finished(pairs, "weave")
    capsize, capsize_directions, capsize_modes = finished(reals, "capsize")
    ranges = np.where(told[:, None, None], ranges * p.speed[:, None, None], np.nan)
    return CriticalSpeeds(
        weave,
        capsize,
        ranges,
        weave_directions=weave_directions,
        capsize_directions=capsize_directions,
        weave_modes=weave_modes,
        capsize_modes=capsize_modes,
        told=told,
    )


def _stable_ranges(p: Pencil, pairs: Crossings, reals: Crossings) -> tuple[np.ndarray, np.ndarray]:
    """Return stable ranges (m, k, 2), NaN where there are fewer, and whether crossings and eigenvalues agree (m,)."""
    bounds = np.concatenate([pairs.speeds, reals.speeds], axis=-1)
    changes = np.concatenate([2 * np.sign(pairs.growth), np.sign(reals.growth)], axis=-1)
    order = np.argsort(bounds, axis=-1)
    bounds, changes = np.take_along_axis(bounds, order, -1), np.take_along_axis(changes, order, -1)
    known = np.isfinite(bounds)
    low = np.concatenate([np.zeros((len(p), 1)), np.where(known, bounds, np.inf)], axis=-1)
    high = np.concatenate([low[:, 1:], np.full((len(p), 1), np.inf)], axis=-1)
    exists = np.isfinite(low)
    wide = exists & (high - np.where(exists, low, 0.0) > _NARROW * high)
    wide |= exists & np.isinf(high)
    inside = np.where(
        np.isinf(high), 2 * low + 1.0, (np.where(exists, low, 0.0) + np.where(np.isinf(high), 0.0, high)) / 2
    )
    roots = np.linalg.eigvals(p.state(np.where(exists, inside, 1.0)))
    unstable = np.where(wide, (roots.real > 0).sum(axis=-1), np.nan)
    # Counted from the crossings alone, beginning with what the eigenvalues of the last range say.
    steps = np.where(known, changes, 0.0)
    counted = np.concatenate([np.zeros((len(p), 1)), np.cumsum(steps, axis=-1)], axis=-1)
    last = np.take_along_axis(unstable - counted, exists.sum(axis=-1, keepdims=True) - 1, axis=-1)
    counted = counted + last
    consistent = np.where(wide, unstable == counted, counted >= 0).all(axis=-1, where=exists)
    stable = exists & (counted == 0) & (~wide | (roots.real < 0).all(axis=-1))
    starts = stable & ~np.concatenate([np.zeros_like(stable[:, :1]), stable[:, :-1]], axis=-1)
    ends = stable & ~np.concatenate([stable[:, 1:], np.zeros_like(stable[:, :1])], axis=-1)
    lows, highs = np.sort(np.where(starts, low, np.nan), axis=-1), np.sort(np.where(ends, high, np.nan), axis=-1)
    count = max(3, int(starts.sum(axis=-1).max(initial=0)))
    ranges = np.stack([lows, highs], axis=-1)[:, :count]
    return np.pad(ranges, ((0, 0), (0, count - ranges.shape[1]), (0, 0)), constant_values=np.nan), consistent
