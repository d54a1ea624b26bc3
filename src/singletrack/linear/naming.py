"""Names of the roots of any number of freedoms: given by physics at speeds that depend on the design alone.

Each coordinate beyond lean and steer has two roots in which it takes the greatest part (a pair, or two real roots where
it is overdamped or falls over): they carry its name. This is decided at the riding speed, of some, at which the parts
are told apart best. The four others are named at high speed, where every bicycle is alike: a pair is weave; of two real
ones the smaller is capsize and the other castering, which grows with the speed.

Names go from one interval to the next (:mod:`singletrack.linear.branches`), first up from the riding speed, then down
from the highest. Two real roots that meet become a pair and keep their order when it splits; but castering, which
grows with the speed past a further coordinate's root, is the slower of the two below such a pair and the faster above
(:mod:`singletrack.linear.castering`). Where weave has split and half of it meets a root of another mode, the
oscillation goes on as weave, and the half that is left takes the other's name.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from singletrack.linear.branches import EDGES, Branches, find_branches, in_order, places
from singletrack.linear.castering import CASTERING, FURTHER, castering_apart, castering_grows
from singletrack.linear.pencil import Pencil

__all__ = ["follow"]

_WEAVE, _CAPSIZE = (0, 1), 2
_HIGHEST = float(EDGES[-1])
#: Speeds at which further coordinates may be named, in units of the riding speed (some 5 to 12 m/s for bicycles).
_RIDING = np.array([3.0, 4.0, 6.0])


def follow(p: Pencil, v: np.ndarray, roots: np.ndarray) -> np.ndarray:
    """Put roots (m, k, 2 n) at speeds (m, k), all in units of the pencil, into the columns of their modes.

    Parameters
    ----------
    p : Pencil
        Of m designs.
    v : array, shape (m, k)
        Ascending speeds.
    roots : array, shape (m, k, 2 n)
        In any order.
    """
    path = _Path.of(p)
    columns, above, below = path.columns()
    named = np.empty_like(roots)
    # Above the last interval roots keep their order.
    np.put_along_axis(named, np.broadcast_to(columns[:, None], roots.shape), in_order(roots), axis=-1)
    design, at = np.nonzero(v < _HIGHEST)
    interval = path.interval(design, v[design, at])
    found = places(path.branches.rows(interval), roots[design, at], v[design, at])
    block = path.block[interval]
    real = np.take_along_axis(found, np.maximum(block, 0)[:, None], axis=-1)[:, 0].imag == 0
    low = (block >= 0) & (real == path.real_low[interval])
    row = np.empty_like(found)
    np.put_along_axis(row, np.where(low[:, None], below[interval], above[interval]), found, axis=-1)
    named[design, at] = row
    return _upper_first(named, p.freedoms)


@dataclass(frozen=True, eq=False)
class _Path:
    """The intervals of m designs, each design's from above, with the roots at their ends.

    Attributes
    ----------
    start, count : int array, shape (m,)
        First interval of each design, and how many it has.
    at_low, at_high : complex array, shape (r, N)
        Roots at both ends, in their places.
    block : int array, shape (r,)
        First place of the block that is real at one end and a pair at the other; -1 where there is none.
    real_low : bool array, shape (r,)
        Whether that block is real at the low end.
    highest : complex array, shape (m, N)
        Roots at the highest speed, in the order that lasts.
    """

    p: Pencil
    branches: Branches
    start: np.ndarray
    count: np.ndarray
    at_low: np.ndarray
    at_high: np.ndarray
    block: np.ndarray
    real_low: np.ndarray
    highest: np.ndarray

    @classmethod
    def of(cls, p: Pencil) -> _Path:
        """Return the path of designs (m,)."""
        b = find_branches(p)
        b = b.rows(np.lexsort((-b.low, b.design)))
        start = np.searchsorted(b.design, np.arange(len(p)))
        ends = np.stack([b.low, b.high], axis=-1)
        roots = np.linalg.eigvals(p.rows(b.design).state(ends)).astype(complex)
        at_low, at_high = places(b, roots[:, 0], b.low), places(b, roots[:, 1], b.high)
        changed = (at_low.imag == 0) != (at_high.imag == 0)
        block = np.where(changed.any(axis=-1), np.argmax(changed, axis=-1), -1)
        real_low = np.take_along_axis(at_low, np.maximum(block, 0)[:, None], axis=-1)[:, 0].imag == 0
        highest = in_order(np.linalg.eigvals(p.state(np.full((len(p), 1), _HIGHEST))).astype(complex))[:, 0]
        count = np.diff(np.append(start, len(b.design)))
        return cls(p, b, start, count, at_low, at_high, block, real_low, highest)

    def interval(self, design: np.ndarray, v: np.ndarray) -> np.ndarray:
        """Return the interval (q,) of each design that a speed is in: the first whose low end is not above."""
        lows = np.where(
            np.arange(self.count.max(initial=1)) < self.count[:, None],
            _padded(self.branches.low, self.start, self.count),
            -1.0,
        )
        result: np.ndarray = self.start[design] + (lows[design] > v[:, None]).sum(axis=-1)
        return result

    def columns(self) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Return the column of each root at the highest speed (m, N), and of each place at both ends (r, N)."""
        roots, columns = self.highest, _columns_of_four(self.highest, np.full(self.highest.shape, -1))
        if self.p.freedoms > 2:
            columns = self._further_from_below()
        above, below = (np.empty(self.at_low.shape, dtype=np.intp) for _ in range(2))
        node_roots, node_columns = roots.copy(), columns.copy()
        for step in range(int(self.count.max(initial=0))):  # all designs at once
            design = np.flatnonzero(step < self.count)
            k = self.start[design] + step
            above[k] = _carried(node_roots[design], node_columns[design], self.at_high[k])
            below[k] = _through_meeting(above[k], self.block[k], self.at_high[k], self.at_low[k], up=False)
            node_roots[design], node_columns[design] = self.at_low[k], below[k]
        return columns, above, below

    def _further_from_below(self) -> np.ndarray:
        """Return columns at the highest speed: further coordinates named at riding speed and followed up."""
        reference, node_roots, node_columns = _columns_at_riding_speed(self.p)
        first = self.interval(np.arange(len(self.p)), reference)
        for step in range(int((first - self.start).max(initial=-1)) + 1):
            design = np.flatnonzero(first - step >= self.start)
            k = first[design] - step
            lower = _carried(node_roots[design], node_columns[design], self.at_low[k])
            upper = _through_meeting(lower, self.block[k], self.at_low[k], self.at_high[k], up=True)
            node_roots[design], node_columns[design] = self.at_high[k], upper
        columns = _carried(node_roots, node_columns, self.highest)
        columns = _columns_of_four(self.highest, np.where(columns >= FURTHER, columns, -1))
        half = np.linalg.eigvals(self.p.state(np.full((len(self.p), 1), _HIGHEST / 2)))[:, 0]
        return castering_grows(self.highest, half, columns)


def _padded(values: np.ndarray, start: np.ndarray, count: np.ndarray) -> np.ndarray:
    at = np.minimum(start[:, None] + np.arange(count.max(initial=1)), max(len(values) - 1, 0))
    result: np.ndarray = values[at]
    return result


def _upper_first(named: np.ndarray, freedoms: int) -> np.ndarray:
    """Put the upper root of a pair, or the lower of two real roots, into the first of a mode's two columns."""
    for first in (0, *range(FURTHER, 2 * freedoms, 2)):
        one, two = named[..., first], named[..., first + 1]
        both_real = (one.imag == 0) & (two.imag == 0)
        swap = ((one.imag < 0) & (two.imag > 0)) | (both_real & (one.real > two.real))
        named[..., first], named[..., first + 1] = np.where(swap, two, one), np.where(swap, one, two)
    return named


def _carried(known: np.ndarray, columns: np.ndarray, roots: np.ndarray) -> np.ndarray:
    """Return the columns of roots (r, N), which are known ones in another order."""
    one, other = np.lexsort((known.imag, known.real)), np.lexsort((roots.imag, roots.real))
    result = np.empty_like(columns)
    np.put_along_axis(result, other, np.take_along_axis(columns, one, axis=-1), axis=-1)
    return result


def _through_meeting(
    columns: np.ndarray, block: np.ndarray, before: np.ndarray, after: np.ndarray, *, up: bool
) -> np.ndarray:
    """Return the columns of places (r, N) at the other end of intervals in which a block may join to a pair."""
    columns = castering_apart(columns, block, before, after, up=up)
    row = np.flatnonzero(block >= 0)
    row = row[before[row, block[row]].imag == 0]  # joins; other pairs that split keep their order
    one, other = columns[row, block[row]], columns[row, block[row] + 1]
    half = (one < _CAPSIZE) != (other < _CAPSIZE)  # half of weave and a root of another mode
    row, one, other = row[half], one[half], other[half]
    first = one < _CAPSIZE
    lost_place = block[row] + first  # of the root that is not weave's: it joins weave
    rest = 1 - np.where(first, one, other)  # weave's other column, and where it is
    rest_place = np.argmax(columns[row] == rest[:, None], axis=-1)
    goes_on = after[row, rest_place].imag == 0
    row, lost_place, rest_place, rest = (a[goes_on] for a in (row, lost_place, rest_place, rest))
    result = columns.copy()
    result[row, rest_place], result[row, lost_place] = columns[row, lost_place], rest
    return result


def _columns_at_riding_speed(p: Pencil) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return a speed (m,), the roots there (m, N) and their columns: the speed at which parts are told apart best."""
    designs, speeds = len(p), len(_RIDING)
    wanted = p.riding[:, None] * _RIDING
    at = EDGES[np.clip(np.searchsorted(EDGES, wanted), 1, len(EDGES) - 2)].ravel()
    q = p.rows(np.repeat(np.arange(designs), speeds))
    roots = in_order(np.linalg.eigvals(q.state(at[:, None])).astype(complex))[:, 0]
    columns, clear = _columns_by_parts(roots, _parts(q, roots, at))
    best = np.argmax(clear.reshape(designs, speeds), axis=-1) + speeds * np.arange(designs)
    return at[best], roots[best], _columns_of_four(roots[best], columns[best])


def _columns_by_parts(roots: np.ndarray, part: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return the columns (m, N) of roots in which further coordinates take most part, -1 for four, and how clear (m,).

    Roots are in the order of :func:`in_order`. One coordinate after the other takes its roots, the clearest first.
    """
    designs, count = roots.shape
    further = part[..., 2:] - part[..., 1:2]  # a root that is mostly steer is castering
    columns = np.full((designs, count), -1)
    row, upper = np.arange(designs), roots.imag > 0
    waiting = np.ones((designs, further.shape[-1]), dtype=bool)
    clear = np.full(designs, np.inf)
    for _ in range(further.shape[-1]):
        free = columns < 0
        own = np.where(free[:, :, None] & waiting[:, None], further, -9.0)
        whole = upper & free & np.roll(free, -1, axis=-1)
        pairs = np.where(whole[:, :, None], own, -9.0)
        reals = np.sort(np.where(roots.imag[:, :, None] == 0, own, -9.0), axis=1)
        best_pair, best_reals = pairs.max(axis=1), reals[:, -2:].mean(axis=1)
        # One of its roots has met capsize: half of the slowest pair, beside which there is one that is weave.
        slow, two_pairs = np.argmax(whole, axis=-1), whole.sum(axis=-1) > 1
        mixed_allowed = two_pairs[:, None] & (reals[:, -1] > best_pair)
        best_mixed = np.where(mixed_allowed, (reals[:, -1] + own[row, slow]) / 2, -9.0)
        which = np.argmax(np.maximum(np.maximum(best_pair, best_reals), best_mixed), axis=-1)
        first = np.argmax(pairs[row, :, which], axis=-1)
        real = np.where(roots.imag == 0, own[row, :, which], -99.0)
        two_reals = np.sort(np.argsort(real, axis=-1)[:, -2:], axis=-1)
        as_pair = best_pair[row, which] >= best_reals[row, which]
        pair = np.stack([first, np.minimum(first + 1, count - 1)], axis=-1)
        chosen = np.where(as_pair[:, None], pair, two_reals)
        better = np.maximum(best_pair, best_reals)[row, which]
        mixed = np.stack([np.argmax(real, axis=-1), np.minimum(slow + 1, count - 1)], axis=-1)
        chosen = np.where((best_mixed[row, which] > better)[:, None], mixed, chosen)
        columns[row[:, None], chosen] = FURTHER + 2 * which[:, None] + [0, 1]
        waiting[row, which] = False
        others = np.where(columns < 0, further[row, :, which], 0.0).max(axis=-1)
        clear = np.minimum(clear, further[row[:, None], chosen, which[:, None]].mean(axis=-1) - others)
    return columns, clear


def _columns_of_four(roots: np.ndarray, columns: np.ndarray) -> np.ndarray:
    """Return columns (m, N) with the four that are -1 filled in; roots in the order of :func:`in_order`."""
    last = np.argsort(columns >= 0, axis=-1, kind="stable")[:, :4]
    result = columns.copy()
    np.put_along_axis(result, last, _last_four(np.take_along_axis(roots, last, axis=-1)), axis=-1)
    return result


def _last_four(roots: np.ndarray) -> np.ndarray:
    """Return the columns of the four roots (m, 4) that lean and steer have: real ones first, ascending, then pairs."""
    real = (roots.imag == 0).sum(axis=-1)
    # Half of a pair, of which a further coordinate has the other half, counts as real.
    half = (roots.imag != 0) & ~(roots[:, :, None] == roots[:, None, :].conj()).any(axis=-1)
    size = np.where(half, 0.0, np.where(roots.imag == 0, np.abs(roots), np.inf))
    capsize = np.argmin(size, axis=-1)
    castering = np.where(capsize == 0, 1, 0)
    place = np.arange(4)
    columns = np.full(roots.shape, -1)
    columns[place == capsize[:, None]], columns[place == castering[:, None]] = _CAPSIZE, CASTERING
    rest = np.argsort(columns >= 0, axis=-1, kind="stable")[:, :2]
    np.put_along_axis(columns, rest, np.broadcast_to(_WEAVE, rest.shape), axis=-1)
    # Two pairs: the slower one has the names of the real roots, which it has yet to become.
    falls = roots[:, :1].real < 0  # castering, the faster one, is the lower then
    two_pairs = np.where(falls, [CASTERING, _CAPSIZE, *_WEAVE], [_CAPSIZE, CASTERING, *_WEAVE])
    result: np.ndarray = np.where((real == 0)[:, None], two_pairs, columns)
    return result


def _parts(p: Pencil, roots: np.ndarray, v: np.ndarray) -> np.ndarray:
    """Return how much each coordinate takes part in the motion of each root, (m, 2 n, n), adding up to one."""
    s, v = roots[:, :, None, None], v[:, None, None]
    value = s * s * np.eye(p.freedoms) + s * (p.C0 + v * p.C1)[:, None] + (p.K0 + v * v * p.K2)[:, None]
    motion = np.abs(np.linalg.svd(value)[2][..., -1, :]) * p.weights[:, None]
    share: np.ndarray = motion**2 / (motion**2).sum(axis=-1, keepdims=True)
    return share
