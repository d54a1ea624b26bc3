"""Designs by aim: several starts, exact gradients, constraints, and what binds at the end."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np
from scipy.optimize import minimize, nnls
from scipy.stats import qmc

from singletrack.analysis.derivatives import derivatives_of
from singletrack.analysis.kinks import descended
from singletrack.analysis.problem import Found, Problem
from singletrack.analysis.quantities import quantities_with_gradients
from singletrack.errors import InputError, SingletrackError

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence


__all__ = ["search"]

_IMPOSSIBLE = 1e6  # worth of a design that cannot exist
_SCREENED = 12  # designs looked at for each start
_AT_BOUND = 1e-5  # of the range
_ROUNDS, _BESIDE, _SMOOTH = 3, 0.1, 1e-4  # searches beside where one ended, how far beside, and where not
_MOST = 100  # numbers of an aim that are looked at, the largest


@dataclass(eq=False)
class _Evaluation:
    """Values and gradients at the last x, scaled: aim's numbers (r, 1 + k), constraints (c, 1 + k), good when >= 0."""

    problem: Problem
    _x: np.ndarray | None = None
    _rows: tuple[np.ndarray, np.ndarray] = field(default=(np.empty(0), np.empty(0)))

    def at(self, x: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        if self._x is None or not np.array_equal(x, self._x):
            self._x, self._rows = x.copy(), self._computed(np.clip(x, 0.0, 1.0))
        return self._rows

    def _computed(self, x: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        p = self.problem
        low, high = np.array(list(p.bounds.values())).T
        k = len(low)
        try:
            design = p.at(x)
            slopes = derivatives_of(design, p.names)
            names = tuple(keep.name for keep in p.keeps)
            values, rows = quantities_with_gradients(design, names, p.names)
            aim = _joined(*p.aim(slopes))
            limits = [
                _joined(limit - numbers, -grads)
                for numbers, grads, limit in ((*other(slopes), limit) for other, limit in p.limits)
            ]
        except SingletrackError:
            return np.array([[_IMPOSSIBLE, *np.zeros(k)]]), np.zeros((0, 1 + k))
        kept = [
            _joined((v - keep.low)[None], r[None])
            for keep, v, r in zip(p.keeps, values, rows, strict=True)
            if np.isfinite(keep.low)
        ]
        kept += [
            _joined((keep.high - v)[None], -r[None])
            for keep, v, r in zip(p.keeps, values, rows, strict=True)
            if np.isfinite(keep.high)
        ]
        scale = np.concatenate([[1.0], high - low])
        constraints = np.concatenate([*kept, *limits, np.zeros((0, 1 + k))]) * scale
        return aim * scale, constraints


def _joined(values: np.ndarray, gradients: np.ndarray) -> np.ndarray:
    return np.concatenate([values[:, None], gradients], axis=1)


def search(
    problem: Problem,
    starts: int = 6,
    seed: int = 0,
    known: Sequence[Found] = (),
    tell: Callable[[Found], object] | None = None,
    first: np.ndarray | None = None,
) -> list[Found]:
    """Return where searches from several starts ended, the best first.

    Parameters
    ----------
    problem : Problem
    starts : int
        The design as it is, and others well spread within the bounds.
    seed : int
        The same seed starts from the same designs.
    known : sequence of Found
        Results of the first starts of an earlier call with the same problem and seed: not searched again.
    tell : callable, optional
        Called with each result as it comes.
    first : array, shape (k,), optional
        Where the first search starts instead of from the design as it is: share of the way from each lower bound to
        the upper.

    Notes
    -----
    The aim is the largest of r numbers, so a bound on them is made small with each of them below it (sequential least
    squares programming, Kraft 1988, in scipy). Designs that start are the best of twelve times as many drawn from
    Sobol's sequence. At the end the gradients of what binds are fitted to that of the aim (Karush, Kuhn and Tucker).
    """
    evaluation = _Evaluation(problem)
    places = _starts(problem, evaluation, starts, seed, first)
    found = list(known[: len(places)])
    for place in places[len(found) :]:
        found.append(_from(problem, evaluation, place))
        if tell is not None:
            tell(found[-1])
    return sorted(found, key=lambda one: (not one.feasible, one.value))


def _starts(
    problem: Problem, evaluation: _Evaluation, starts: int, seed: int, first: np.ndarray | None
) -> list[np.ndarray]:
    if starts < 1:
        raise InputError(f"starts = {starts}, must be one or more")
    own = problem.start if first is None else first
    if starts == 1:
        return [own]
    many = 2 ** int(np.ceil(np.log2(_SCREENED * starts)))
    drawn = qmc.Sobol(len(problem.names), seed=seed).random(many)
    worth = np.array([_worth(*evaluation.at(x)) for x in drawn])
    best = drawn[np.argsort(worth, kind="stable")]
    return [own, *best[: starts - 1]]


def _worth(aim: np.ndarray, constraints: np.ndarray) -> float:
    return float(aim[:, 0].max()) + 100.0 * float(np.maximum(-constraints[:, 0], 0.0).sum())


def _from(problem: Problem, evaluation: _Evaluation, start: np.ndarray) -> Found:
    """Search from one start, and on by gradients from around where it ended if that is no smooth optimum.

    Where roots meet, growth has a kink that no single gradient tells of (:mod:`singletrack.analysis.kinks`); a search
    that starts beside it may go along it.
    """
    x = _minimised(evaluation, start)
    if not np.isfinite(x).all() or _worth(*evaluation.at(x)) > _worth(*evaluation.at(start)):
        x = start
    found = _ended(problem, evaluation, x)
    rng = np.random.default_rng(0)
    for around in range(_ROUNDS):
        if not _is_kink(found):
            break
        for place in (found.x, _minimised(evaluation, _beside(rng, found.x, around))):
            better = descended(lambda point: _slope(evaluation, point), place) if np.isfinite(place).all() else found.x
            if _worth(*evaluation.at(better)) < _worth(*evaluation.at(found.x)):
                found = _ended(problem, evaluation, better)
    return found


def _beside(rng: np.random.Generator, x: np.ndarray, around: int) -> np.ndarray:
    """Return a place beside one, nearer in each round (``around``)."""
    place: np.ndarray = np.clip(x + _BESIDE * 0.5**around * rng.standard_normal(len(x)), 0.0, 1.0)
    return place


def _is_kink(found: Found) -> bool:
    """Tell whether a search ended where the gradients of what binds do not make up that of the aim."""
    return not found.stationary < _SMOOTH * max(1.0, abs(found.value))


def _slope(evaluation: _Evaluation, x: np.ndarray) -> tuple[float, np.ndarray]:
    """Return the worth of a design and its gradient (k,): of the aim's largest number and of constraints broken."""
    aim, constraints = evaluation.at(x)
    row = aim[int(np.argmax(aim[:, 0])), 1:]
    if aim[:, 0].max() >= _IMPOSSIBLE:
        return np.inf, np.zeros(len(x))
    broken = constraints[constraints[:, 0] < 0]
    return _worth(aim, constraints), row - 100.0 * broken[:, 1:].sum(axis=0)


def _minimised(evaluation: _Evaluation, start: np.ndarray) -> np.ndarray:
    """Minimise from one start: x (k,) and, if the aim is the largest of several numbers, the bound t on them."""
    k = len(start)
    many = len(evaluation.at(start)[0]) > 1
    tail = [float(evaluation.at(start)[0][:, 0].max())] if many else []
    rows = len(evaluation.at(start)[1])

    def objective(z: np.ndarray) -> tuple[float, np.ndarray]:
        if many:
            return float(z[k]), np.append(np.zeros(k), 1.0)
        aim = evaluation.at(z[:k])[0][0]
        return float(aim[0]), aim[1:]

    def constraints(z: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        aim, kept = evaluation.at(z[:k])
        if len(kept) != rows:  # no such design: nothing holds
            kept = np.hstack([np.full((rows, 1), -_IMPOSSIBLE), np.zeros((rows, k))])
        if not many:
            return kept[:, 0], kept[:, 1:]
        aim = _resized(aim, _MOST)
        values = np.concatenate([kept[:, 0], z[k] - aim[:, 0]])
        gradients = np.vstack(
            [np.hstack([kept[:, 1:], np.zeros((rows, 1))]), np.hstack([-aim[:, 1:], np.ones((_MOST, 1))])]
        )
        return values, gradients

    rules: Any = [{"type": "ineq", "fun": lambda z: constraints(z)[0], "jac": lambda z: constraints(z)[1]}]
    bounds = [(0.0, 1.0)] * k + [(None, None)] * len(tail)
    end = minimize(
        objective,
        np.append(start, tail),
        jac=True,
        method="SLSQP",
        bounds=bounds,
        constraints=rules if many or rows else [],
        options={"maxiter": 60, "ftol": 1e-13},
    )
    x: np.ndarray = np.clip(end.x[:k], 0.0, 1.0)
    return x


def _resized(rows: np.ndarray, count: int) -> np.ndarray:
    """Return the largest numbers first, always as many: the number of roots in pairs changes, that of rows must not."""
    order = np.argsort(-rows[:, 0], kind="stable")[:count]
    return rows[np.resize(order, count)] if len(order) < count else rows[order]


def _ended(problem: Problem, evaluation: _Evaluation, x: np.ndarray) -> Found:
    aim, kept = evaluation.at(x)
    value = float(aim[:, 0].max())
    words, columns = [], []
    for i, name in enumerate(problem.names):
        for end, sign, word in ((0.0, 1.0, "least"), (1.0, -1.0, "greatest")):
            if abs(x[i] - end) < _AT_BOUND:
                words.append(f"{name} at its {word}")
                columns.append(sign * np.eye(len(x))[i])
    labels = [f"{keep.name} at its least" for keep in problem.keeps if np.isfinite(keep.low)]
    labels += [f"{keep.name} at its greatest" for keep in problem.keeps if np.isfinite(keep.high)]
    labels += [other.name for other, _ in problem.limits for _ in range(len(kept) - len(labels))][: len(kept)]
    for label, row in zip(labels, kept, strict=False):
        if abs(row[0]) < 1e-6 * max(1.0, np.abs(row[1:]).max()):
            words.append(label)
            columns.append(row[1:])
    active = aim[aim[:, 0] > value - 1e-6 * max(1.0, abs(value))]
    feasible = value < _IMPOSSIBLE and bool((kept[:, 0] > -1e-6).all())
    weights, stationary = _multipliers(active[:, 1:], np.array(columns).reshape(len(columns), len(x)))
    held = tuple(dict.fromkeys(word for word, weight in zip(words, weights, strict=True) if weight > 1e-6))
    return Found(x, value, feasible, held, stationary)


def _multipliers(active: np.ndarray, columns: np.ndarray) -> tuple[np.ndarray, float]:
    """Return the weights of what binds, and what is left of the aim's gradient."""
    size = float(np.abs(active).max()) or 1.0
    both = np.vstack([active / size, -columns / max(1e-300, float(np.abs(columns).max(initial=0.0)) or 1.0)])
    sums = np.concatenate([np.ones(len(active)), np.zeros(len(columns))])
    weights, _ = nnls(np.vstack([both.T, 1e3 * sums]), np.append(np.zeros(active.shape[1]), 1e3))
    return weights[len(active) :], size * float(np.abs(both.T @ weights).max())
