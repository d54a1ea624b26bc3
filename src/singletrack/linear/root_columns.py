"""Roots at many speeds put into the columns of their modes, by looking up how they nearly always come.

What :mod:`singletrack.linear.root_order` does for any four roots, done by a table for those whose order says all: as
many are real as between the meetings, and no two real parts are equal. The few others are arranged one by one.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from singletrack.linear.root_order import arrange

if TYPE_CHECKING:
    from singletrack.arrays import Array

__all__ = ["in_columns"]

#: Positions of sorted roots in their order (:func:`~singletrack.linear.root_order.arrange`): all real; two real before,
#: around or after a pair; two pairs, taken ascending or descending.
_USUAL = np.array([[0, 1, 2, 3], [0, 1, 3, 2], [0, 3, 2, 1], [2, 3, 1, 0], [1, 0, 3, 2], [3, 2, 1, 0]])
_REAL = np.array([4, 2, 2, 2, 0, 0])
_ALL_REAL, _ASCENDING, _UNUSUAL = 0, 4, len(_USUAL)
#: Which of them it is, by which of the sorted roots are real, as bits, the first root's the lowest.
_BY_BITS = np.full(16, _UNUSUAL, dtype=np.int16)
_BY_BITS[[0b1111, 0b0011, 0b1001, 0b1100, 0b0000]] = [_ALL_REAL, 1, 2, 3, _ASCENDING]
#: Positions of the roots for the four columns, by the columns' places as digits of base four, then by the above.
_PLACES = np.arange(256)[:, None] >> np.array([6, 4, 2, 0]) & 3
_POSITIONS = np.ascontiguousarray(_USUAL.T[_PLACES].transpose(0, 2, 1).reshape(-1, 4))


def in_columns(roots: Array, interval: Array, counts: Array, labels: Array, descending: Array) -> Array:
    """Return the roots of m designs at n speeds in the columns of their modes, (m, n, 4).

    Parameters
    ----------
    roots : array, shape (m, n, 4)
        Sorted by real then imaginary part, pairs as exact conjugates.
    interval : array of int, shape (m, n)
        Between which meetings each speed lies.
    counts : array of int, shape (m, i)
        How many roots are real in each interval.
    labels : array of int, shape (m, i, 4)
        The column of each place in each interval.
    descending : array of bool, shape (m, n)
        Whether pairs are taken in descending order of their real parts.

    Examples
    --------
    >>> roots = np.array([[[-1.0, 0.5 - 2j, 0.5 + 2j, 3.0]]])
    >>> order = {"counts": np.array([[2]]), "labels": np.array([[[2, 3, 0, 1]]]), "descending": np.array([[False]])}
    >>> in_columns(roots, np.array([[0]]), **order)[0, 0].tolist()
    [(0.5+2j), (0.5-2j), (-1+0j), (3+0j)]
    """
    rows = np.arange(len(roots))[:, None]
    wanted = counts[rows, interval]
    real = [roots[..., k].imag == 0 for k in range(4)]
    usual = _BY_BITS[real[0] | real[1] * np.int8(2) | real[2] * np.int8(4) | real[3] * np.int8(8)]
    # Two pairs: sorted, they are neighbours unless their real parts are equal.
    apart = roots[..., 1].real < roots[..., 2].real
    usual = np.where(usual == _ASCENDING, np.where(apart, _ASCENDING + descending, _UNUSUAL), usual)
    unusual = np.append(_REAL, -1)[usual] != wanted
    digits = (np.argsort(labels, axis=-1) * np.array([64, 16, 4, 1])).sum(axis=-1)
    row = digits[rows, interval] * _UNUSUAL + np.where(unusual, 0, usual)
    flat = _POSITIONS[row]
    flat += np.arange(row.size).reshape(*row.shape, 1) * 4
    named = np.ascontiguousarray(roots).reshape(-1)[flat]
    if unusual.any():
        ordered = arrange(roots[unusual], wanted[unusual], descending[unusual])
        columns = np.broadcast_to(rows, interval.shape)[unusual], interval[unusual]
        some = np.empty_like(ordered)
        np.put_along_axis(some, labels[columns], ordered, axis=-1)
        named[unusual] = some
    return _upper_weave_first(named)


def _upper_weave_first(named: Array) -> Array:
    """Put the upper root of weave's pair, or the lower of its two real roots, into its first column."""
    first, second = named[..., 0], named[..., 1]
    both_real = (first.imag == 0) & (second.imag == 0)
    swapped = ((first.imag < 0) & (second.imag > 0)) | (both_real & (first.real > second.real))
    if swapped.any():
        named[swapped, :2] = named[swapped, 1::-1]
    return named
