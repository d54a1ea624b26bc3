"""From recorded rates to an eigenvalue: a growing or decaying oscillation, with honest standard deviations.

The model of a record is y = offset + exp(σ t) (a cos ω t + b sin ω t), fitted by least squares, as is usual for weave
(Kooijman, Schwab and Meijaard 2008). What remains is rarely white: neighbouring residuals are alike. They are taken for
an autoregressive process of the order that they call for, and the standard deviations follow from its covariance Σ,
(JᵀJ)⁻¹ Jᵀ Σ J (JᵀJ)⁻¹, with the variance that the fit itself has taken out of the residuals put back.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
import scipy.linalg
import scipy.optimize
import scipy.stats

from singletrack.control.residuals import autocorrelations, corrected_autoregression
from singletrack.errors import InputError

if TYPE_CHECKING:
    from collections.abc import Sequence

    from singletrack.arrays import Array

__all__ = ["IdentifiedMode", "combine_modes", "identify_mode"]

_FEWEST = 30
_WELL = 0.9
_HALF = 0.5


@dataclass(frozen=True, eq=False)
class IdentifiedMode:
    """An oscillation's eigenvalue σ ± i ω.

    Attributes
    ----------
    eigenvalue : complex
        In 1/s, with a positive imaginary part.
    covariance : array, shape (2, 2)
        Of its real and imaginary part, in 1/s².
    freedom : float
        Degrees of freedom of the standard deviations, for intervals (Student's t).
    start : float
        Time in s from which on the record was used.
    samples : int
    correlation : float
        Of neighbouring residuals.
    explained : float
        Share of the record's variance that the oscillation explains, from the start on.
    runs : int
        How many records it is from.
    """

    eigenvalue: complex
    covariance: np.ndarray
    freedom: float
    start: float
    samples: int
    correlation: float
    explained: float
    runs: int = 1

    @property
    def deviations(self) -> tuple[float, float]:
        """Standard deviations of real and imaginary part in 1/s."""
        real, imaginary = np.sqrt(np.diag(self.covariance))
        return float(real), float(imaginary)

    def interval(self, share: float = 0.95) -> tuple[tuple[float, float], tuple[float, float]]:
        """Return the intervals of real and imaginary part that hold the true one with a probability (share)."""
        factor = float(scipy.stats.t.ppf((1 + share) / 2, self.freedom))
        parts = zip((self.eigenvalue.real, self.eigenvalue.imag), self.deviations, strict=True)
        (real, imaginary) = ((value - factor * sd, value + factor * sd) for value, sd in parts)
        return real, imaginary


def identify_mode(time: Array, signal: Array, start: float | None = None, where: str = "signal") -> IdentifiedMode:
    """Return the eigenvalue of the oscillation in a record.

    Parameters
    ----------
    time : array, shape (n,)
        In s, evenly spaced.
    signal : array, shape (n,)
        A rate or an angle, any unit.
    start : float, optional
        Time in s from which on the record is used; by default the earliest from which one oscillation explains 90 % of
        its variance (what a push leaves besides it has died out by then); at most half of the record is left out.
    where : str
        For messages.

    Raises
    ------
    InputError
        If the record is too short, not evenly spaced, or holds no oscillation.

    Examples
    --------
    >>> import numpy as np
    >>> t = np.arange(0, 6, 0.01)
    >>> noise = np.random.default_rng(0).normal(0, 0.01, t.shape)
    >>> found = identify_mode(t, np.exp(-0.5 * t) * np.sin(4 * t) + noise)
    >>> abs(found.eigenvalue - (-0.5 + 4j)) < 0.02
    True
    """
    t, y = _checked(time, signal, where)
    if start is not None:
        first = int(np.searchsorted(t, start - 1e-9))
        if len(t) - first < _FEWEST:
            raise InputError(f"{where}: has {len(t) - first} samples from {start:g} s on, must have {_FEWEST} or more")
        return _fit(t, y, first, where)
    fits = [_fit(t, y, first, where) for first in _candidates(t, y, where)]
    return next(fit for fit in fits if fit.explained >= min(_WELL, max(one.explained for one in fits)))


def _candidates(t: np.ndarray, y: np.ndarray, where: str) -> list[int]:
    """Return the places at which the record may start: the first alone if it does, else all that leave half of it."""
    whole = _fit(t, y, 0, where, refuse=False)
    if whole.explained >= _WELL:
        return [0]
    last = max(len(t) // 2, 1) if len(t) // 2 >= _FEWEST else max(len(t) - _FEWEST, 1)
    return [0, *range(max(1, len(t) // 40), last, max(1, len(t) // 40))]


def _checked(time: Array, signal: Array, where: str) -> tuple[np.ndarray, np.ndarray]:
    t, y = np.asarray(time, dtype=float), np.asarray(signal, dtype=float)
    if t.ndim != 1 or t.shape != y.shape or len(t) < _FEWEST:
        raise InputError(f"{where}: has {t.shape} times and {y.shape} values, must have as many, {_FEWEST} or more")
    if not (np.isfinite(t).all() and np.isfinite(y).all()):
        raise InputError(f"{where}: has values that are not finite, must have none")
    steps = np.diff(t)
    if not (steps.min() > 0 and steps.max() <= 1.5 * np.median(steps)):
        raise InputError(
            f"{where}: times must ascend evenly; a step of {steps.max():g} s stands beside {np.median(steps):g} s"
        )
    if not np.std(y) > 1e-9 * (1 + np.abs(y).max()):
        raise InputError(f"{where}: the signal does not change")
    return t, y


def _columns(t: np.ndarray, sigma: float, omega: float) -> np.ndarray:
    """Return the model's columns (n, 3): offset, cosine, sine; the envelope at most one."""
    envelope = np.exp(sigma * (t - (t[-1] if sigma > 0 else t[0])))
    return np.stack([np.ones_like(t), envelope * np.cos(omega * t), envelope * np.sin(omega * t)], axis=-1)


def _fit(t: np.ndarray, y: np.ndarray, first: int, where: str, *, refuse: bool = True) -> IdentifiedMode:
    t, y = t[first:], y[first:]
    own = t - t[0]
    scaled = (y - y.mean()) / (np.std(y) or 1.0)
    found, left = _least_squares(own, scaled, _guess(own, scaled), where)
    explained = 1.0 - float(left @ left) / len(left)
    if refuse and explained < _HALF:
        raise InputError(f"{where}: no oscillation: the best one explains {explained:.0%} of the signal")
    correlation = float(left[1:] @ left[:-1] / (left @ left)) if left @ left > 0 else 0.0
    covariance, freedom = _covariance(own, scaled, *found, left)
    return IdentifiedMode(complex(*found), covariance, freedom, float(t[0]), len(t), correlation, explained)


def _best(t: np.ndarray, y: np.ndarray, sigma: float, omega: float) -> np.ndarray:
    columns = _columns(t, sigma, omega)
    fitted: np.ndarray = columns @ np.linalg.lstsq(columns, y, rcond=None)[0]
    return fitted


def _guess(t: np.ndarray, y: np.ndarray) -> tuple[float, float]:
    """Return σ and ω of the best fit on a grid around the spectrum: a start for least squares."""
    span = float(t[-1])
    rates = np.linspace(-8.0, 4.0, 13) / span
    frequencies = 2 * math.pi * np.geomspace(0.5 / span, 0.2 * (len(t) - 1) / span, 40)
    best = min(
        ((float(np.sum((y - _best(t, y, s, w)) ** 2)), s, w) for s in rates for w in frequencies),
        key=lambda item: item[0],
    )
    return best[1], best[2]


def _least_squares(
    t: np.ndarray, y: np.ndarray, guess: tuple[float, float], where: str
) -> tuple[tuple[float, float], np.ndarray]:
    def residuals(x: np.ndarray) -> np.ndarray:
        left: np.ndarray = y - _best(t, y, *x)
        return left

    span = float(t[-1] - t[0])
    bounds = ([-60 / span, 0.3 / span], [30 / span, math.pi * (len(t) - 1) / span])
    inside = np.clip(guess, np.array(bounds[0]) * 0.999, np.array(bounds[1]) * 0.999)
    found = scipy.optimize.least_squares(residuals, inside, bounds=bounds, x_scale=[1 / span, 1 / span])
    if not found.success:
        raise InputError(f"{where}: no oscillation was found")
    return (float(found.x[0]), float(found.x[1])), found.fun


def _covariance(t: np.ndarray, y: np.ndarray, sigma: float, omega: float, left: np.ndarray) -> tuple[np.ndarray, float]:
    """Return the covariance of σ and ω, and the degrees of freedom that the residuals are worth."""
    columns = _columns(t, sigma, omega)
    amplitudes = np.linalg.lstsq(columns, y, rcond=None)[0]
    oscillation = columns[:, 1:] @ amplitudes[1:]
    quadrature = amplitudes[2] * columns[:, 1] - amplitudes[1] * columns[:, 2]
    jacobian = np.column_stack([t * oscillation, t * quadrature, columns])
    basis, triangle = np.linalg.qr(jacobian)
    coefficients = corrected_autoregression(left, basis)
    covariance, both = _spread(coefficients, left, basis, triangle)
    unsure = 2.0 / max(both - 5.0, 2.0) + _unsure_of_correlation(coefficients, left, basis, triangle)
    return covariance, max(2.0 / unsure, 2.0)


def _spread(
    coefficients: np.ndarray, left: np.ndarray, basis: np.ndarray, triangle: np.ndarray
) -> tuple[np.ndarray, float]:
    """Return the covariance of σ and ω under an autoregression, and how many independent squares there are."""
    correlated = scipy.linalg.toeplitz(autocorrelations(coefficients, len(left)))
    # Of residuals (1 - P) e with e ~ s² R: E|residuals|² = s² (n - trace(P R)); the fit takes out what it can.
    taken = basis.T @ correlated @ basis
    worth = len(left) - float(np.trace(taken))
    variance = float(left @ left) / max(worth, 1.0)
    inverse = np.linalg.inv(triangle)
    covariance = inverse @ taken @ inverse.T * variance
    both = len(left) ** 2 / float(np.sum(correlated**2))  # Bartlett
    return covariance[:2, :2], both


def _unsure_of_correlation(
    coefficients: np.ndarray, left: np.ndarray, basis: np.ndarray, triangle: np.ndarray
) -> float:
    """Return the relative variance of the variances that comes from not knowing the autoregression better.

    Its coefficients have the covariance [1 - b²] / n, or [[1 - b², -a (1 + b)], [-a (1 + b), 1 - b²]] / n of two (Box
    and Jenkins, *Time Series Analysis*, 7.2).
    """
    if not coefficients.size:
        return 0.0
    last = coefficients[-1]
    own = (1.0 - last**2) * np.eye(len(coefficients))
    if len(coefficients) == 2:
        own[0, 1] = own[1, 0] = -coefficients[0] * (1.0 + last)
    step = 1e-4

    def logs(change: np.ndarray) -> np.ndarray:
        found: np.ndarray = np.log(np.diag(_spread(coefficients + change, left, basis, triangle)[0]))
        return found

    slopes = np.array([(logs(-step * row) - logs(step * row)) / (2 * step) for row in np.eye(len(coefficients))])
    return float(np.mean(np.einsum("ik,ij,jk->k", slopes, own, slopes))) / len(left)


def combine_modes(found: Sequence[IdentifiedMode]) -> IdentifiedMode:
    """Return the mean of repetitions, weighted by their precision; its deviation at least what their scatter says.

    Parameters
    ----------
    found : sequence of IdentifiedMode
        One for each repetition.

    Raises
    ------
    InputError
        If there are none.

    Examples
    --------
    >>> import numpy as np
    >>> one = IdentifiedMode(-1 + 5j, 0.01 * np.eye(2), 50, 0.0, 100, 0.0, 0.9)
    >>> combine_modes([one, one]).deviations[0] < 0.08
    True
    """
    if not found:
        raise InputError("combining repetitions needs at least one")
    if len(found) == 1:
        return found[0]
    values = np.array([[one.eigenvalue.real, one.eigenvalue.imag] for one in found])
    variances = np.array([np.diag(one.covariance) for one in found])
    # Scatter between runs beyond what each run claims (DerSimonian and Laird), then weights with both.
    weights = 1 / variances
    mean = (weights * values).sum(0) / weights.sum(0)
    excess = (weights * (values - mean) ** 2).sum(0) - (len(found) - 1)
    between = np.maximum(excess / (weights.sum(0) - (weights**2).sum(0) / weights.sum(0)), 0.0)
    weights = 1 / (variances + between)
    mean = (weights * values).sum(0) / weights.sum(0)
    freedom = len(found) - 1.0 if between.any() else float(sum(one.freedom for one in found))
    return IdentifiedMode(
        complex(*mean),
        np.diag(1 / weights.sum(0)),
        freedom,
        float(np.mean([one.start for one in found])),
        sum(one.samples for one in found),
        float(np.mean([one.correlation for one in found])),
        float(np.mean([one.explained for one in found])),
        len(found),
    )
