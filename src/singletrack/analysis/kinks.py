"""Descent where a function has kinks: gradient sampling (Burke, Lewis and Overton 2005), within the unit box.

Where roots meet, the growth of a mode has a kink that is not even Lipschitz: gradients on one side are large, and tell
nothing of the other. The shortest vector among the mixtures of gradients at points around is a direction in which the
function falls on all sides; where there is none, nothing near is better.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from scipy.optimize import nnls

if TYPE_CHECKING:
    from collections.abc import Callable

__all__ = ["descended"]

#: Radii of the balls in which gradients are sampled, and steps in each at most.
_RADII, _STEPS = (0.03, 3e-3, 3e-4, 3e-5), 20
_HALVINGS = 12
_TURNS = (0.03, 0.1, 0.3)
#: Steps that find nothing, in one ball at an edge, until the next: the edge's direction is only a sample's.
_FAILURES = 4
#: Length of a mixture of gradients, of the largest one's, that is none.
_FLAT = 1e-4


def descended(
    function: Callable[[np.ndarray], tuple[float, np.ndarray]], start: np.ndarray, seed: int = 0
) -> np.ndarray:
    """Return a point of the unit box (k,) that is no worse than the start, a minimum among its neighbours as a rule.

    Parameters
    ----------
    function : callable
        From a point, shape (k,), to its value, infinite where it has none, and its gradient (k,).
    start : array, shape (k,)
        From zero to one.
    seed : int
        Of the points around.

    Examples
    --------
    >>> def kink(x):
    ...     return abs(x[0] - 0.3) + 2 * abs(x[1] - 0.6), np.sign(x - [0.3, 0.6]) * [1, 2]
    >>> descended(kink, np.array([0.9, 0.1])).round(3).tolist()
    [0.3, 0.6]
    """
    random = np.random.default_rng(seed)
    x = np.clip(start, 0.0, 1.0)
    value, _ = function(x)
    for radius in _RADII:
        failures = 0
        for _ in range(_STEPS):
            around = np.clip(x + radius * random.uniform(-1, 1, (3 * len(x), len(x))), 0.0, 1.0)
            there = [function(point) for point in (x, *around)]
            gone = np.array([not np.isfinite(value) for value, _ in there[1:]])
            edge = [_outward(around, gone)] if gone.any() else []
            gradients = np.array([row for value, row in there if np.isfinite(value)])
            direction = _downhill(gradients, x, edge)
            moved = _lower(function, x, value, _turned(direction, edge), radius)
            failures += moved is None
            if moved is not None:
                x, value = moved
            elif failures == _FAILURES or not edge:
                break
    return x


def _outward(around: np.ndarray, gone: np.ndarray) -> np.ndarray:
    """Return the direction (k,) in which those of some points (m, k) lie that are gone (m,), seen from the others."""
    mean: np.ndarray = around[gone].mean(axis=0) - (around if gone.all() else around[~gone]).mean(axis=0)
    return mean / max(float(np.linalg.norm(mean)), 1e-300)


def _turned(direction: np.ndarray, edge: list[np.ndarray]) -> list[np.ndarray]:
    """Return directions to try: as it is, and turned away from an edge, which is known but roughly; none for zero."""
    if not direction.any():
        return []
    return [direction, *(direction - turn * outward for outward in edge for turn in _TURNS)]


def _downhill(gradients: np.ndarray, x: np.ndarray, edge: list[np.ndarray]) -> np.ndarray:
    """Return minus the shortest mixture of gradients (m, k), zero for none; what leads out is free.

    Out is beyond the walls of the box, and beyond an edge, of which the outward normal (k,) is given.
    """
    if not len(gradients):
        return np.zeros(len(x))
    size = float(np.abs(gradients).max())
    if size == 0.0 or not np.isfinite(size):
        return np.zeros(len(x))
    walls = np.concatenate([-np.eye(len(x))[x <= 0.0], np.eye(len(x))[x >= 1.0], *(n[None] for n in edge)])
    columns = np.concatenate([gradients / size, walls])
    sums = np.concatenate([np.ones(len(gradients)), np.zeros(len(walls))])
    weights, _ = nnls(np.vstack([columns.T, 1e3 * sums]), np.append(np.zeros(len(x)), 1e3))
    mixture: np.ndarray = columns.T @ weights
    length = float(np.linalg.norm(mixture))
    return -mixture / length if length > _FLAT else np.zeros(len(x))


def _lower(
    function: Callable[[np.ndarray], tuple[float, np.ndarray]],
    x: np.ndarray,
    value: float,
    directions: list[np.ndarray],
    radius: float,
) -> tuple[np.ndarray, float] | None:
    """Return a point along some direction where the function is lower, and its value; None where there is none."""
    for step in 10.0 * radius * 0.5 ** np.arange(_HALVINGS if directions else 0):
        for direction in directions:
            tried = np.clip(x + step * direction, 0.0, 1.0)
            there, _ = function(tried)
            if there < value - 1e-14 * max(1.0, abs(value)):
                return tried, there
    return None
