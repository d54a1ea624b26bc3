"""Critical speeds followed while a parameter changes, to where they cease to exist."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from scipy.optimize import linear_sum_assignment

from singletrack.linear import CriticalSpeeds, critical_speeds

if TYPE_CHECKING:
    from singletrack.analysis.designs import Design

__all__ = ["Ends", "critical_ends"]

# Steps in which a change is made, and halvings of the one in which a critical speed ceases to exist.
_STEPS, _HALVINGS = 8, 30
_KINDS = (("pair", "weave_speeds"), ("real", "capsize_speeds"))


@dataclass(frozen=True, eq=False)
class Ends:
    """What becomes of q critical speeds when each of k parameters is changed one way and the other.

    Attributes
    ----------
    speeds : array, shape (q, k, 2)
        After the whole change down and up, in m/s; NaN where the speed has ceased to exist, or no such design can.
    folds : array, shape (q, k, 2)
        The change, SI, at which the speed ceases to exist; NaN where it does not.
    impossible : bool array, shape (k, 2)
        Where the changed design cannot exist.
    """

    speeds: np.ndarray
    folds: np.ndarray
    impossible: np.ndarray


def critical_ends(design: Design, names: tuple[str, ...], changes: np.ndarray) -> Ends:
    """Return the critical speeds after changes, each followed from where it is.

    Parameters
    ----------
    design : Design
        A single one.
    names : tuple of str
        The k parameters.
    changes : array, shape (k,)
        SI, each made down and up.

    Notes
    -----
    Each change is made in eight steps. A speed keeps its rank among those of its kind as long as their number stays;
    where it changes, those that are nearest to one another are the same, and the rest have ceased to exist.
    """
    k = len(names)
    each = np.repeat(np.eye(k), 2, axis=0) * (np.repeat(changes, 2) * np.tile([-1.0, 1.0], k))[:, None]  # (2 k, k)
    fractions = np.arange(1, _STEPS + 1) / _STEPS
    model = design.shifted(names, (fractions[:, None, None] * each).reshape(-1, k)).model()
    model = model.broadcast_to((_STEPS * 2 * k,))
    found, good = critical_speeds(model), model.valid.reshape(_STEPS, 2 * k)
    own = critical_speeds(design.model())
    parts = [_followed(getattr(own, a), getattr(found, a).reshape(_STEPS, 2 * k, -1), good) for _, a in _KINDS]
    last = np.concatenate([ends for ends, _ in parts])
    lasted = np.concatenate([steps for _, steps in parts])
    kinds = np.repeat([0, 1], [len(ends) for ends, _ in parts])
    folds = _folds(design, names, each, lasted, kinds, good)
    shape = (len(last), k, 2)
    return Ends(last.reshape(shape), folds.reshape(shape), ~good[-1].reshape(k, 2))


def _followed(own: np.ndarray, found: np.ndarray, good: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Follow speeds (w,) through the steps (s, 2 k, w'); return ends (q, 2 k) and steps that each lasts."""
    own = own[np.isfinite(own)]
    steps, many, _ = found.shape
    counts = np.isfinite(found).sum(axis=-1)
    ends = np.full((len(own), many), np.nan)
    lasted = np.full((len(own), many), steps)
    same = ((counts == len(own)) & good).all(axis=0)
    ends[:, same] = found[-1][same, : len(own)].T
    for j in np.flatnonzero(~same):  # few: where speeds appear or cease
        now = own.copy()
        for i in range(steps):
            there = found[i, j][np.isfinite(found[i, j])]
            alive = np.flatnonzero(np.isfinite(now))
            after = np.full(len(own), np.nan)
            if len(there) and len(alive):
                rows, columns = linear_sum_assignment(np.abs(now[alive, None] - there[None, :]))
                after[alive[rows]] = there[columns]
            ceased = np.isfinite(now) & ~np.isfinite(after)
            lasted[ceased, j] = i
            now = after
        ends[:, j] = now
    return ends, lasted


def _folds(
    design: Design, names: tuple[str, ...], each: np.ndarray, lasted: np.ndarray, kinds: np.ndarray, good: np.ndarray
) -> np.ndarray:
    """Return the changes (q, 2 k) at which speeds that do not last through all steps cease to exist."""
    folds = np.full(lasted.shape, np.nan)
    steps = len(good)
    q, j = np.nonzero(lasted < steps)
    possible = good[lasted[q, j], j]
    q, j = q[possible], j[possible]
    if not len(q):
        return folds
    low, high = lasted[q, j] / steps, (lasted[q, j] + 1) / steps

    def counts(fractions: np.ndarray) -> np.ndarray:
        found = critical_speeds(design.shifted(names, fractions[:, None] * each[j]).model().broadcast_to(q.shape))
        return _count(found, kinds[q])

    before = counts(low)
    for _ in range(_HALVINGS):
        middle = (low + high) / 2
        still = counts(middle) == before
        low, high = np.where(still, middle, low), np.where(still, high, middle)
    folds[q, j] = (low + high) / 2 * each[j].sum(axis=-1)
    return folds


def _count(found: CriticalSpeeds, kinds: np.ndarray) -> np.ndarray:
    """Return how many speeds of its kind each design has (m,)."""
    numbers = [np.isfinite(getattr(found, attribute)).sum(axis=-1) for _, attribute in _KINDS]
    result: np.ndarray = np.where(kinds == 0, *numbers)
    return result
