"""The front of two aims: designs where neither gets better without the other getting worse."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from singletrack.analysis.derivatives import derivatives_of
from singletrack.analysis.search import search
from singletrack.errors import InputError

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from singletrack.analysis.aims import Aim
    from singletrack.analysis.problem import Found, Problem

__all__ = ["Front", "pareto_front", "worth"]


@dataclass(frozen=True, eq=False)
class Front:
    """Designs on a front of two aims, by growing first aim.

    Attributes
    ----------
    x : array, shape (m, k)
        From zero at the parameters' lower bounds to one at the upper.
    values : array, shape (m, 2)
        Of the aims.
    """

    x: np.ndarray
    values: np.ndarray


def worth(problem: Problem, aim: Aim, x: np.ndarray) -> float:
    """Return what an aim is at a design of a problem.

    Parameters
    ----------
    problem : Problem
    aim : Aim
    x : array, shape (k,)
        Share of the way from each lower bound to the upper, 0 to 1.
    """
    return float(aim(derivatives_of(problem.at(x), problem.names))[0].max())


def pareto_front(
    problem: Problem,
    other: Aim,
    points: int = 7,
    starts: int = 3,
    seed: int = 0,
    tell: Callable[[Found], object] | None = None,
    known: Sequence[Found] = (),
) -> Front:
    """Return the front of a problem's aim and another.

    Parameters
    ----------
    problem : Problem
        With the first aim.
    other : Aim
        The second.
    points : int
        On the front, three or more.
    starts : int
        Of the searches for the two ends.
    seed : int
    tell : callable, optional
        Called with each design found.
    known : sequence of Found
        What was told by an earlier call with the same arguments, in that order: not searched again.

    Raises
    ------
    InputError
        For fewer than three points.

    Notes
    -----
    Each aim alone gives an end; between them the first is made small while the second stays below a limit that goes
    from end to end (the epsilon constraint, Haimes et al. 1971), each search starting where its neighbour ended.
    Designs that another one beats in both are left out.
    """
    if points < 3:
        raise InputError(f"points = {points}, must be three or more")
    waiting = list(known)

    def searched(what: Problem, count: int, first: np.ndarray | None = None) -> list[Found]:
        own = waiting[:count]
        del waiting[:count]
        return search(what, count, seed, own, tell, first)

    best = searched(problem, starts)[0]
    last = searched(replace(problem, aim=other), starts)[0]
    low, high = worth(problem, other, last.x), worth(problem, other, best.x)
    found, x = [best.x], best.x
    for limit in np.linspace(high, low, points)[1:-1]:
        limited = replace(problem, limits=((other, float(limit)),))
        tried = [searched(limited, 1, start)[0] for start in (x, last.x)]
        good = sorted((one for one in tried if one.feasible), key=lambda one: one.value)
        if good:
            x = good[0].x
            found.append(x)
    places = np.array([*found, last.x])
    values = np.array([[worth(problem, problem.aim, x), worth(problem, other, x)] for x in places])
    beaten = [(np.all(values <= one, axis=1) & np.any(values < one - 1e-9, axis=1)).any() for one in values]
    kept = np.flatnonzero(~np.array(beaten))
    order = kept[np.argsort(values[kept, 0])]
    return Front(places[order], values[order])
