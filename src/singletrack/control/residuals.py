"""Residuals of a fit as an autoregressive process: how alike neighbouring ones are."""

from __future__ import annotations

import math

import numpy as np
import scipy.linalg
import scipy.optimize
import scipy.signal

__all__ = ["autocorrelations", "corrected_autoregression"]

_HIGHEST_ORDER = 2
#: Largest size of a root of the autoregression: disturbances that last longer than the record cannot be told from it.
_NEARLY_ENDLESS = 0.98


def _autoregression(left: np.ndarray) -> np.ndarray:
    """Return coefficients (p,) of the residuals' autoregression, the order p by Akaike's criterion for few samples."""
    n = len(left)
    best, chosen = math.inf, np.zeros(0)
    for p in range(_HIGHEST_ORDER + 1):
        rows = (
            np.stack([left[_HIGHEST_ORDER - k - 1 : n - k - 1] for k in range(p)], axis=-1) if p else np.zeros((n, 0))
        )
        wanted = left[_HIGHEST_ORDER:]
        rows = rows[: len(wanted)]
        coefficients = np.linalg.lstsq(rows, wanted, rcond=None)[0] if p else np.zeros(0)
        rest = wanted - rows @ coefficients
        count = len(wanted)
        score = count * math.log(max(float(rest @ rest) / count, 1e-300)) + 2 * (p + 1) * count / max(count - p - 2, 1)
        if score < best:
            best, chosen = score, coefficients
    roots = np.roots([1.0, *-chosen])
    if roots.size and np.abs(roots).max() > _NEARLY_ENDLESS:  # an estimate that would never settle
        roots = roots * np.minimum(1.0, _NEARLY_ENDLESS / np.abs(roots))
        chosen = -np.real(np.poly(roots))[1:]
    return chosen


def autocorrelations(coefficients: np.ndarray, count: int) -> np.ndarray:
    """Return the autocorrelations (count,) of an autoregressive process, from its impulse response.

    Parameters
    ----------
    coefficients : array, shape (p,)
        Of the process e[i] = sum of coefficients[k] e[i - 1 - k], and noise.
    count : int
        How many, from lag zero on.
    """
    impulse = np.zeros(4 * count + 200)
    impulse[0] = 1.0
    weights = scipy.signal.lfilter([1.0], [1.0, *-coefficients], impulse)
    sums = scipy.signal.fftconvolve(weights, weights[::-1])[len(weights) - 1 :][:count]
    found: np.ndarray = sums / sums[0]
    return found


def corrected_autoregression(left: np.ndarray, basis: np.ndarray) -> np.ndarray:
    """Return the autoregression of the disturbance: estimated from residuals, mended for what the fit takes out.

    The residuals of a fit look less correlated than the disturbance was. For each candidate the first correlation that
    residuals would show is compared with the one they do show, and the candidate moved until both agree.

    Shape (p,), p the order of the process.

    Parameters
    ----------
    left : array, shape (n,)
        The residuals.
    basis : array, shape (n, m)
        Orthonormal columns that span what the fit can take out.
    """
    coefficients = _autoregression(left)
    if not coefficients.size:
        return coefficients
    shown = float(left[1:] @ left[:-1] / (left @ left))
    roots = np.roots([1.0, *-coefficients])
    low, high = 0.5, _NEARLY_ENDLESS / max(np.abs(roots).max(), 1e-9)

    def stretched(factor: float) -> np.ndarray:
        return -np.real(np.poly(roots * factor))[1:]

    def gap(factor: float) -> float:
        correlated = scipy.linalg.toeplitz(autocorrelations(stretched(factor), len(left)))
        projected = correlated - basis @ (basis.T @ correlated)
        projected = projected - (projected @ basis) @ basis.T
        return float(np.trace(projected, offset=1) / np.trace(projected)) - shown

    if high <= low or gap(low) * gap(high) > 0:
        return stretched(min(high, 1.0)) if high < 1.0 or gap(high) > 0 else stretched(high)
    return stretched(float(scipy.optimize.brentq(gap, low, high, xtol=1e-3)))
