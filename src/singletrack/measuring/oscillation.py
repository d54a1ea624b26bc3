"""From a recorded oscillation (time, rate) to its period and the period's uncertainty.

The model is a decaying oscillation, y = offset + exp(-decay t) (a cos(w t) + b sin(w t)). For given decay and w the
rest is linear, so that only these two are searched (variable projection), starting from the spectrum's peak.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from singletrack.arrays import Array
from singletrack.errors import InputError

__all__ = ["Oscillation", "fit_oscillation"]

_FEWEST = 20
_LONGEST = 200_000


@dataclass(frozen=True, eq=False)
class Oscillation:
    """A decaying oscillation fitted to a signal.

    Attributes
    ----------
    period, period_deviation : float
        Of the damped oscillation, and its standard deviation, in s.
    decay, decay_deviation : float
        Rate of decay in 1/s and its standard deviation.
    offset, cosine, sine : float
        Of the signal, in its unit, with time counted from the first sample.
    residual_deviation : float
        Standard deviation of what the fit leaves, in the signal's unit.
    correlation : float
        Of neighbouring residuals; where it is positive the standard deviations are enlarged for it.
    time, signal : array, shape (n,)
        What was fitted, in s and the signal's unit.
    """

    period: float
    period_deviation: float
    decay: float
    decay_deviation: float
    offset: float
    cosine: float
    sine: float
    residual_deviation: float
    correlation: float
    time: Array
    signal: Array

    def at(self, time: Array) -> np.ndarray:
        """Return the fitted signal at times (...) in s."""
        t = np.asarray(time, dtype=float) - self.time[0]
        phase = 2 * math.pi * t / self.period
        fitted: np.ndarray = self.offset + np.exp(-self.decay * t) * (
            self.cosine * np.cos(phase) + self.sine * np.sin(phase)
        )
        return fitted

    @property
    def natural_period(self) -> float:
        """Period in s without the damping, which is what the inertia follows from."""
        return 2 * math.pi / math.hypot(2 * math.pi / self.period, self.decay)


def fit_oscillation(time: Array, signal: Array, where: str = "signal") -> Oscillation:
    """Fit a decaying oscillation.

    Parameters
    ----------
    time : array, shape (n,)
        In s, increasing; n at least 20.
    signal : array, shape (n,)
        A rate, an angle, a voltage: any unit.
    where : str
        For messages.

    Raises
    ------
    InputError
        If there is too little, time does not increase, or no oscillation of at least one and a half periods is found.

    Notes
    -----
    Standard deviations follow from the residuals and the Jacobian of the fit, times sqrt((1 + r) / (1 - r)) for
    residuals whose neighbours correlate with r > 0.

    Examples
    --------
    >>> import numpy as np
    >>> t = np.linspace(0, 20, 2001)
    >>> noise = np.random.default_rng(0).normal(0, 0.01, t.shape)
    >>> fit = fit_oscillation(t, 0.2 + np.exp(-0.05 * t) * np.sin(2 * np.pi * t / 1.6) + noise)
    >>> round(fit.period, 3), fit.period_deviation < 1e-3
    (1.6, True)
    """
    t, y = _checked(time, signal, where)
    start, scale = t[0], float(np.std(y))
    t = t - start
    y_scaled = (y - y.mean()) / scale
    decay, omega = _search(t, y_scaled, where)
    (offset, cosine, sine), left = _amplitudes(t, y_scaled, decay, omega, where)
    covariance, spread, correlation = _covariance(t, decay, omega, cosine, sine, left)
    period = 2 * math.pi / omega
    return Oscillation(
        period=period,
        period_deviation=period / omega * math.sqrt(covariance[1, 1]),
        decay=decay,
        decay_deviation=math.sqrt(covariance[0, 0]),
        offset=float(y.mean()) + scale * offset,
        cosine=scale * cosine,
        sine=scale * sine,
        residual_deviation=scale * spread,
        correlation=correlation,
        time=t + start,
        signal=y,
    )


def _amplitudes(
    t: np.ndarray, y: np.ndarray, decay: float, omega: float, where: str
) -> tuple[tuple[float, float, float], np.ndarray]:
    """Return offset, cosine and sine of the best fit to a scaled signal, and what it leaves; refuse a poor one."""
    columns = _columns(t, decay, omega)
    offset, cosine, sine = np.linalg.lstsq(columns, y, rcond=None)[0].tolist()
    left = columns @ [offset, cosine, sine] - y
    explained = 1 - float(left @ left) / len(t)
    if explained < 0.5:  # less than half of the signal's variance
        raise InputError(
            f"{where}: no decaying oscillation: the best one explains {max(explained, 0):.0%} of the signal"
        )
    return (offset, cosine, sine), left


def _search(t: np.ndarray, y: np.ndarray, where: str) -> tuple[float, float]:
    """Return decay in 1/s and angular frequency in rad/s of the best fit to a scaled signal."""
    from scipy.optimize import least_squares  # lazy: heavy

    span, frequency = float(t[-1]), _spectral_peak(t, y)
    if frequency * span < 1.5:  # periods in the record
        raise InputError(f"{where}: holds {frequency * span:.2g} periods, must hold at least 1.5")

    def residuals(x: np.ndarray) -> np.ndarray:
        columns = _columns(t, *x)
        coefficients = np.linalg.lstsq(columns, y, rcond=None)[0]
        result: np.ndarray = columns @ coefficients - y
        return result

    omega = 2 * math.pi * frequency
    bounds = ([-20 / span, 0.2 * omega], [200 / span, 5 * omega])
    found = least_squares(residuals, [1 / span, omega], bounds=bounds, x_scale=[1 / span, 1 / span])
    return float(found.x[0]), float(found.x[1])


def _checked(time: Array, signal: Array, where: str) -> tuple[np.ndarray, np.ndarray]:
    t, y = np.asarray(time, dtype=float), np.asarray(signal, dtype=float)
    if t.ndim != 1 or t.shape != y.shape or not _FEWEST <= len(t) <= _LONGEST:
        raise InputError(
            f"{where}: has {t.shape} times and {y.shape} values, must have as many, {_FEWEST} to {_LONGEST}"
        )
    if not (np.isfinite(t).all() and np.isfinite(y).all() and np.abs([t, y]).max() < 1e12):
        raise InputError(f"{where}: has values that are not finite (or beyond 1e12), must have none")
    steps = np.diff(t)
    if not (steps > 0).all():
        raise InputError(
            f"{where}: time does not increase after {t[int(np.argmin(steps > 0))]:g} s, must do so throughout"
        )
    if not np.std(y) > 1e-9 * (1 + np.abs(y).max()):
        raise InputError(f"{where}: the signal does not change")
    return t, y


def _columns(t: np.ndarray, decay: float, omega: float) -> np.ndarray:
    """Return the linear model's columns: offset, cosine, sine."""
    envelope = np.exp(-decay * t)
    return np.stack([np.ones_like(t), envelope * np.cos(omega * t), envelope * np.sin(omega * t)], axis=-1)


def _spectral_peak(t: np.ndarray, y: np.ndarray) -> float:
    """Return the frequency in Hz of the largest peak of the spectrum, finely resolved."""
    count = len(t)
    even = np.interp(np.linspace(t[0], t[-1], count), t, y)
    padded = 8 * count
    power = np.abs(np.fft.rfft((even - even.mean()) * np.hanning(count), padded))
    rate = (count - 1) / (t[-1] - t[0])
    lowest = max(1, math.ceil(padded / (rate * (t[-1] - t[0]))))
    peak = lowest + int(np.argmax(power[lowest:]))
    return float(peak * rate / padded)


def _covariance(
    t: np.ndarray, decay: float, omega: float, cosine: float, sine: float, left: np.ndarray
) -> tuple[np.ndarray, float, float]:
    """Return the covariance of decay and omega, the residuals' standard deviation, their correlation."""
    envelope, cos, sin = np.exp(-decay * t), np.cos(omega * t), np.sin(omega * t)
    oscillation = envelope * (cosine * cos + sine * sin)
    quadrature = envelope * (sine * cos - cosine * sin)
    jacobian = np.stack([-t * oscillation, t * quadrature, np.ones_like(t), envelope * cos, envelope * sin], axis=-1)
    spread = math.sqrt(float(left @ left) / (len(t) - 5))
    energy = float(left @ left)
    correlation = float(left[1:] @ left[:-1]) / energy if energy > 0 else 0.0
    r = min(max(correlation, 0.0), 0.99)
    covariance: np.ndarray = np.linalg.pinv(jacobian.T @ jacobian)[:2, :2] * spread**2 * (1 + r) / (1 - r)
    return covariance, spread, correlation
