"""A fixed order of four roots, in which following a mode is bookkeeping.

Real roots come first, ascending, then pairs (positive imaginary part first), ascending by real part. Within an
interval between meetings a place in this order belongs to one mode. Two pairs pass each other at most once; below that
speed they are taken in descending order (``descending``), so that places stay with their modes. A pair keeps in mind
which of its modes was the lower one while both were real: when it splits again, order is as before.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from singletrack.linear.characteristic import CharacteristicPolynomial

__all__ = ["arrange", "label_at_infinity", "label_below", "real_count"]


_WEAVES = 2  # columns 0 and 1 are weave


def real_count(roots: np.ndarray) -> np.ndarray:
    """Return how many of the roots (..., 4) are real: 0, 2 or 4.

    >>> real_count(np.array([-3.0, -1.0, 0.5 - 2j, 0.5 + 2j]))
    np.int64(2)
    """
    count: np.ndarray = np.sum(np.asarray(roots).imag == 0, axis=-1)
    return count


def arrange(roots: np.ndarray, count: np.ndarray, descending: np.ndarray) -> np.ndarray:
    """Return roots (..., 4) in their order, as if ``count`` (...) of them were real.

    Right at a meeting rounding may show two nearly equal real roots as a pair or the reverse; then the pair nearest to
    the real axis counts as real, or the two nearest real roots as a pair. Nothing is lost: the result is a permutation.

    Parameters
    ----------
    roots : array, shape (..., 4)
        Pairs as exact conjugates.
    count : array, shape (...)
        0, 2 or 4.
    descending : array of bool, shape (...)
        Whether the larger of the first two goes first, else the smaller.

    Examples
    --------
    >>> arrange(np.array([0.5 - 2j, 0.5 + 2j, -1.0, 3.0]), np.array(2), np.array(False)).tolist()
    [(-1+0j), (3+0j), (0.5+2j), (0.5-2j)]
    """
    found = np.sort_complex(roots)
    actual = real_count(found)
    count, descending = np.broadcast_to(count, actual.shape), np.broadcast_to(descending, actual.shape)
    # First the two roots that are the most "pair", then the others: 0 and 1 real or the other pair.
    pair = _pair_positions(found, actual)
    others = _remaining(pair)
    first, second = (np.take_along_axis(found, positions, axis=-1) for positions in (others, pair))
    second = second[..., ::-1]  # positive imaginary part first
    mixed = np.concatenate([first, second], axis=-1)
    flipped = np.concatenate([first[..., ::-1], second], axis=-1)
    swap = (first[..., 0].real > second[..., 0].real) ^ descending
    two_pairs = np.where(swap[..., None], np.concatenate([second, flipped[..., :2]], axis=-1), flipped)
    by_count = np.where((count == 0)[..., None], two_pairs, mixed)
    return np.where((count == 4)[..., None], found, by_count)


def _pair_positions(found: np.ndarray, actual: np.ndarray) -> np.ndarray:
    """Return the positions (..., 2) in sorted roots of the two that count as a pair if only two do."""
    real_gap = np.where(found.imag == 0, found.real, np.nan)
    gaps = np.diff(real_gap, axis=-1)
    closest = np.argmin(np.where(np.isnan(gaps), np.inf, gaps), axis=-1)
    # The pair with the largest imaginary part; of equal ones the second, which sorts last.
    largest = np.argmax(np.abs(found.imag)[..., ::-1], axis=-1)
    upper = 3 - largest
    partner = np.argmin(np.abs(found - np.conj(np.take_along_axis(found, upper[..., None], axis=-1))), axis=-1)
    low = np.where(actual == 4, closest, np.minimum(upper, partner))
    high = np.where(actual == 4, closest + 1, np.maximum(upper, partner))
    return np.stack([low, high], axis=-1)


def _remaining(taken: np.ndarray) -> np.ndarray:
    """Return the two of the positions 0 to 3, ascending, that are not among the two taken."""
    free = (np.arange(4) != taken[..., :1]) & (np.arange(4) != taken[..., 1:])
    order = np.argsort(~free, axis=-1, kind="stable")
    return order[..., :2]


def label_at_infinity(p: CharacteristicPolynomial, count: np.ndarray) -> np.ndarray:
    """Return the column of each place (m, 4) above the last meeting, where ``count`` (m,) roots are real.

    As v grows, s = σ v for three roots, with the cubic a4 σ³ + a3 σ² + a2' σ + a1' (primes: the parts that grow), and
    the fourth, capsize, stays bounded: among the real roots it comes after the negative roots of the cubic.
    """
    cubic = np.stack([p.a4[:, 0], p.a3[:, 0], p.a2[:, 1], p.a1[:, 1]], axis=-1)
    mirrored = cubic * np.array([-1.0, 1.0, -1.0, 1.0])  # its positive roots are the negative ones of the cubic
    changes = np.sum(np.sign(mirrored[:, 1:]) != np.sign(mirrored[:, :-1]), axis=-1)  # Descartes; all three real
    one_real = (cubic[:, 3] * cubic[:, 0] > 0).astype(np.intp)
    capsize = np.where(count == 4, changes, one_real)
    castering = np.where(capsize == 0, 1, 0)
    labels = np.empty((len(count), 4), dtype=np.intp)
    rows = np.arange(len(count))
    free = _remaining(np.stack([capsize, castering], axis=-1))
    labels[rows, capsize], labels[rows, castering] = 2, 3
    labels[rows, free[:, 0]], labels[rows, free[:, 1]] = 0, 1
    return labels


def label_below(
    labels: np.ndarray, above: np.ndarray, below: np.ndarray, at: np.ndarray, descending: np.ndarray
) -> np.ndarray:
    """Return the column of each place (m, 4) below a meeting.

    Parameters
    ----------
    labels : array, shape (m, 4)
        Columns of the places above the meeting.
    above, below : array, shape (m,)
        Number of real roots above and below.
    at : complex array, shape (m, 4)
        The roots at the meeting, two of which are equal but for rounding.
    descending : array, shape (m,)
        Whether pairs are taken in descending order of their real parts.
    """
    place, others = _meeting_roots(at)
    others_real = np.abs(others[:, 0].imag) <= np.abs(others[:, 0] - others[:, 1]) * 1e-12
    before = np.sum(others.real < place[:, None], axis=-1)
    pair_first = (place < others[:, 0].real) ^ descending

    splits = np.where(others_real[:, None], _insert(labels, before), _pair_to_front(labels, pair_first))
    joins = np.where(others_real[:, None], _extract(labels, before), _front_to_pair(labels, pair_first))
    return np.where((below > above)[:, None], splits, np.where((below < above)[:, None], joins, labels))


def _meeting_roots(at: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return the double root (m,), real, and the other two roots (m, 2)."""
    low, high = np.triu_indices(4, 1)
    closest = np.argmin(np.abs(at[:, low] - at[:, high]), axis=-1)
    meeting = np.stack([low[closest], high[closest]], axis=-1)
    place = np.take_along_axis(at, meeting, axis=-1).real.mean(axis=-1)
    return place, np.take_along_axis(at, _remaining(meeting), axis=-1)


def _take(labels: np.ndarray, orders: list[list[int]], which: np.ndarray) -> np.ndarray:
    return np.take_along_axis(labels, np.array(orders)[which], axis=-1)


def _insert(labels: np.ndarray, before: np.ndarray) -> np.ndarray:
    """Make the pair in places 2 and 3 real, after ``before`` of the two real roots."""
    return _take(labels, [[2, 3, 0, 1], [0, 2, 3, 1], [0, 1, 2, 3]], before)


def _extract(labels: np.ndarray, before: np.ndarray) -> np.ndarray:
    """Make two of four real roots, after ``before`` others, a pair; a pair of weave and another mode is all weave.

    Where weave splits and one half meets another real root, the oscillation goes on: it keeps its name, and the half
    that stays real takes the other's.
    """
    taken = _take(labels, [[2, 3, 0, 1], [0, 3, 1, 2], [0, 1, 2, 3]], before)
    real_weave = taken[:, :2] < _WEAVES
    other_in_pair = taken[:, 2:] >= _WEAVES
    mixed = (real_weave.sum(axis=1) == 1) & (other_in_pair.sum(axis=1) == 1)
    single, partner = np.argmax(real_weave, axis=1), 2 + np.argmax(other_in_pair, axis=1)
    order = np.tile(np.arange(4), (len(taken), 1))
    rows = np.flatnonzero(mixed)
    order[rows, single[rows]], order[rows, partner[rows]] = partner[rows], single[rows]
    return np.take_along_axis(taken, order, axis=1)


def _pair_to_front(labels: np.ndarray, first: np.ndarray) -> np.ndarray:
    """Make the first or the second of two pairs real."""
    return _take(labels, [[2, 3, 0, 1], [0, 1, 2, 3]], first.astype(np.intp))


def _front_to_pair(labels: np.ndarray, first: np.ndarray) -> np.ndarray:
    """Make the two real roots a pair, the first or the second of two."""
    return _take(labels, [[2, 3, 0, 1], [0, 1, 2, 3]], first.astype(np.intp))
