"""Critical speeds of two freedoms without springs and dampers: quadratics in u = v², solved without cancellation.

With the coefficients of :mod:`singletrack.linear.characteristic`, a real root crosses zero where a0(u) = 0, and a pair
crosses the imaginary axis where Hurwitz' determinant (a1 a2 a3 - a4 a1² - a0 a3²)(u) = 0 with a1/a3 > 0. Both are
quadratics in u. Between neighbours of these speeds, Routh and Hurwitz decide at one speed.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from singletrack.linear.characteristic import CharacteristicPolynomial

__all__ = ["Quadratics", "solve_quadratics"]


@dataclass(frozen=True, eq=False)
class Quadratics:
    """What the quadratics of designs (...) say; speeds in m/s, ascending, NaN where there are fewer.

    Attributes
    ----------
    weave, capsize : array, shape (..., 2)
    weave_growth, capsize_growth : array, shape (..., 2)
        Sign of the change of the root's real part with speed.
    ranges : array, shape (..., 3, 2)
        Stable ranges.
    told : bool array, shape (...)
        Whether all numbers are finite.
    """

    weave: np.ndarray
    capsize: np.ndarray
    weave_growth: np.ndarray
    capsize_growth: np.ndarray
    ranges: np.ndarray
    told: np.ndarray


def solve_quadratics(polynomial: CharacteristicPolynomial) -> Quadratics:
    """Return critical speeds and stable ranges, for all speeds above zero.

    Parameters
    ----------
    polynomial : CharacteristicPolynomial
        Of designs (m,).
    """
    p, speed = _in_own_units(polynomial)
    a4, a3, a2, a1, a0 = (np.asarray(a) for a in (p.a4, p.a3, p.a2, p.a1, p.a0))
    shape = np.broadcast_shapes(*(a.shape[:-1] for a in (a4, a2, a1, a0)))
    capsize = _positive_roots(*(np.broadcast_to(a0[..., i], shape) for i in range(3)))
    b, c = a3[..., 0], a4[..., 0]
    hurwitz = (
        b * a1[..., 0] * a2[..., 0] - c * a1[..., 0] ** 2 - b**2 * a0[..., 0],
        b * (a1[..., 0] * a2[..., 1] + a1[..., 1] * a2[..., 0]) - 2 * c * a1[..., 0] * a1[..., 1] - b**2 * a0[..., 1],
        b * a1[..., 1] * a2[..., 1] - c * a1[..., 1] ** 2 - b**2 * a0[..., 2],
    )
    crossing = _positive_roots(*hurwitz)
    square_frequency = (a1[..., :1] + a1[..., 1:] * crossing) / b[..., None]
    with np.errstate(invalid="ignore"):
        weave = np.sort(np.where(square_frequency > 0, crossing, np.nan), axis=-1)
    told = np.isfinite(sum(a.sum(axis=-1) for a in (a4, a3, a2, a1, a0)) + sum(hurwitz)) & (c != 0)
    # Of a pair near the axis, Hurwitz' determinant is -a3 times a positive number times the real part; of a real root
    # near zero, a0 is -v a1 times the root.
    weave_growth = -np.sign((hurwitz[1][..., None] + 2 * hurwitz[2][..., None] * weave) * b[..., None])
    slope = a1[..., :1] + a1[..., 1:] * capsize
    capsize_growth = -np.sign((a0[..., 1:2] + 2 * a0[..., 2:] * capsize) * slope)
    ranges = _stable_ranges(p, weave, capsize) * speed[..., None, None]
    v = speed[..., None]
    return Quadratics(v * np.sqrt(weave), v * np.sqrt(capsize), weave_growth, capsize_growth, ranges, told)


def _in_own_units(p: CharacteristicPolynomial) -> tuple[CharacteristicPolynomial, np.ndarray]:
    """Return the polynomials in units of speed and time, powers of two, in which they are of order one, and the speed.

    Products of five coefficients stay far from overflow then, and no bit changes.
    """
    a4, a3, a2, a1, a0 = (np.asarray(a) for a in (p.a4, p.a3, p.a2, p.a1, p.a0))
    k, r = _half_exponent(a2[..., 0] / a2[..., 1]), _half_exponent(a2[..., 0] / a4[..., 0])

    def scaled(a: np.ndarray, speeds: int, rates: int) -> np.ndarray:
        powers = speeds + 2 * np.arange(a.shape[-1])
        result: np.ndarray = np.ldexp(a, k[..., None] * powers - rates * r[..., None])
        return result

    units = scaled(a4, 0, 0), scaled(a3, 1, 1), scaled(a2, 0, 2), scaled(a1, 1, 3), scaled(a0, 0, 4)
    return CharacteristicPolynomial(*units), np.ldexp(1.0, k)


def _half_exponent(square: np.ndarray) -> np.ndarray:
    """Return the exponent of a power of two near the square root; zero where there is none."""
    usable = np.isfinite(square) & (square != 0)
    exponent: np.ndarray = np.frexp(np.where(usable, square, 1.0))[1] // 2
    return exponent


def _positive_roots(c0: np.ndarray, c1: np.ndarray, c2: np.ndarray) -> np.ndarray:
    """Return the positive real roots of c0 + c1 x + c2 x², ascending, NaN for the others, shape (..., 2).

    Without cancellation: the larger root by the usual formula with matching signs, the smaller from the product.
    A double root changes no sign and is left out.
    """
    c0, c1, c2 = np.broadcast_arrays(c0, c1, c2)
    with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
        discriminant = c1 * c1 - 4 * c2 * c0
        half = -0.5 * (c1 + np.copysign(np.sqrt(np.where(discriminant > 0, discriminant, np.nan)), c1))
        roots = np.stack([half / c2, c0 / half], axis=-1)
        roots = np.where((roots > 0) & np.isfinite(roots), roots, np.nan)
    return np.sort(roots, axis=-1)


def _stable_ranges(p: CharacteristicPolynomial, weave: np.ndarray, capsize: np.ndarray) -> np.ndarray:
    """Return the ranges of speed between critical ones in which all roots have negative real parts."""
    bounds = np.sort(np.concatenate([weave, capsize], axis=-1), axis=-1)
    known = np.isfinite(bounds)
    low = np.concatenate([np.zeros((*bounds.shape[:-1], 1)), np.where(known, bounds, np.inf)], axis=-1)
    high = np.concatenate([low[..., 1:], np.full((*bounds.shape[:-1], 1), np.inf)], axis=-1)
    inside = np.where(np.isinf(high), 2 * low + 1.0, (np.where(np.isinf(low), 0.0, low) + high) / 2)
    exists = np.isfinite(low) & (high > low)
    stable = exists & _is_stable(p, np.where(exists, inside, 1.0))
    # Neighbouring stable stretches are one range: a speed at which stability does not change divides nothing.
    starts = stable & ~np.concatenate([np.zeros_like(stable[..., :1]), stable[..., :-1]], axis=-1)
    ends = stable & ~np.concatenate([stable[..., 1:], np.zeros_like(stable[..., :1])], axis=-1)
    lows = np.sort(np.where(starts, low, np.nan), axis=-1)[..., :3]
    highs = np.sort(np.where(ends, high, np.nan), axis=-1)[..., :3]
    ranges: np.ndarray = np.sqrt(np.stack([lows, highs], axis=-1))
    return ranges


def _is_stable(p: CharacteristicPolynomial, u: np.ndarray) -> np.ndarray:
    """Routh and Hurwitz for the quartics at u = v² > 0, shape (..., k)."""
    sign = np.sign(p.a4)
    a4, a3 = sign * p.a4, sign * p.a3
    a2 = sign * (p.a2[..., :1] + p.a2[..., 1:] * u)
    a1 = sign * (p.a1[..., :1] + p.a1[..., 1:] * u)
    a0 = sign * (p.a0[..., :1] + (p.a0[..., 1:2] + p.a0[..., 2:] * u) * u)
    hurwitz = a1 * a2 * a3 - a4 * a1**2 - a0 * a3**2
    stable: np.ndarray = (a3 > 0) & (a2 > 0) & (a1 > 0) & (a0 > 0) & (hurwitz > 0)
    return stable
