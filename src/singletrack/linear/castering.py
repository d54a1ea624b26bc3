"""Which root is castering beside the real roots of further coordinates: the one that grows with the speed."""

from __future__ import annotations

import numpy as np

__all__ = ["CASTERING", "FURTHER", "castering_apart", "castering_grows"]

#: The column of castering, and the first of further coordinates.
CASTERING, FURTHER = 3, 4


def castering_grows(roots: np.ndarray, slower: np.ndarray, columns: np.ndarray) -> np.ndarray:
    """Return the columns (m, N) of roots at the highest speed, where castering is no root that falls over.

    Castering decays, as fast as the speed is high; real roots of further coordinates stay as they are. Where the name
    was left for a root that falls, and a further coordinate has one that decays the faster the higher the speed, they
    change names.

    Parameters
    ----------
    roots : complex array, shape (m, N)
        At the highest speed.
    slower : complex array, shape (m, N)
        At half that speed, in any order.
    columns : int array, shape (m, N)
        Of the roots.
    """

    def nearest(wanted: np.ndarray) -> np.ndarray:
        result: np.ndarray = np.abs(wanted[:, :, None] - slower[:, None, :]).min(axis=-1)
        return result

    grows = (roots.imag == 0) & (nearest(roots / 2) < nearest(roots))
    wrong = (columns == CASTERING) & (roots.imag == 0) & (roots.real > 0)
    right = (columns >= FURTHER) & grows & (roots.real < 0)
    row = np.flatnonzero(wrong.any(axis=-1) & right.any(axis=-1))
    now, instead = np.argmax(wrong[row], axis=-1), np.argmax(right[row], axis=-1)
    result = columns.copy()
    result[row, now], result[row, instead] = columns[row, instead], CASTERING
    return result


def castering_apart(
    columns: np.ndarray, block: np.ndarray, before: np.ndarray, after: np.ndarray, *, up: bool
) -> np.ndarray:
    """Return columns (r, N) where pairs of castering and a further coordinate split: castering grows with the speed.

    Towards higher speeds it has the faster of the two real roots then, towards lower ones the slower.

    Parameters
    ----------
    columns : int array, shape (r, N)
        Of the places before the split.
    block : int array, shape (r,)
        First place of what may split, -1 for none.
    before, after : complex array, shape (r, N)
        Roots in their places.
    up : bool
        Whether the split is towards higher speeds.
    """
    row = np.flatnonzero(block >= 0)
    row = row[(before[row, block[row]].imag != 0) & (after[row, block[row]].imag == 0)]
    one, other = columns[row, block[row]], columns[row, block[row] + 1]
    mixed = (np.minimum(one, other) == CASTERING) & (np.maximum(one, other) >= FURTHER)
    row, further = row[mixed], np.maximum(one, other)[mixed]
    first = np.abs(after[row, block[row]]) > np.abs(after[row, block[row] + 1])
    first = first if up else ~first
    result = columns.copy()
    result[row, block[row]], result[row, block[row] + 1] = (
        np.where(first, CASTERING, further),
        np.where(first, further, CASTERING),
    )
    return result
