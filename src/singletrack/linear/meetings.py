"""Where roots meet: the exact skeleton along which modes are followed through the speeds.

Two roots of the characteristic quartic can only trade places, or turn from two real ones into a pair, at a speed at
which they are equal: a zero of the discriminant. With the quartic's invariants

    I = 12 a4 a0 - 3 a3 a1 + a2²,    J = 72 a4 a2 a0 + 9 a3 a2 a1 - 27 a4 a1² - 27 a0 a3² - 2 a2³

the discriminant is (4 I³ - J²) / 27, a polynomial of degree six in u = v². Between its zeros real roots keep their
order, so that the order says which is which. Two pairs can pass each other without meeting, when their real parts are
equal: then the linear coefficient of the quartic without its cubic term vanishes, which is linear in u.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from singletrack.linear.characteristic import CharacteristicPolynomial

__all__ = ["Meetings", "find_meetings", "meeting_speeds"]

_MOST_MEETINGS = 6


@dataclass(frozen=True, eq=False)
class Meetings:
    """Speeds at which roots meet or pass, for a flat batch of m designs.

    Attributes
    ----------
    speeds : array, shape (m, 6)
        Zeros of the discriminant in m/s, ascending, infinite where there are fewer.
    passing : array, shape (m,)
        Speed at which the real parts of two pairs are equal, NaN if never.
    """

    speeds: np.ndarray
    passing: np.ndarray

    def between(self) -> np.ndarray:
        """Return a speed inside each of the intervals that the meetings bound, shape (m, 7).

        Where there are fewer meetings, the last intervals repeat the one that has no upper end.
        """
        low = np.concatenate([np.zeros((len(self.speeds), 1)), self.speeds], axis=-1)
        high = np.concatenate([self.speeds, np.full((len(self.speeds), 1), np.inf)], axis=-1)
        last = np.max(np.where(np.isfinite(low), low, 0.0), axis=-1, keepdims=True)
        return np.where(np.isfinite(high), (low + np.where(np.isfinite(high), high, 0.0)) / 2, 2 * last + 1.0)


def find_meetings(p: CharacteristicPolynomial) -> Meetings:
    """Return where roots of the characteristic polynomials of m designs (each coefficient of shape (m, k)) meet."""
    scale = _speed_scale(p)
    powers = scale[:, None] ** (2 * np.arange(3))
    # Monic, and with u and s scaled so that coefficients are of order one: s⁴ + v b s³ + c s² + v d s + e.
    b = p.a3 / p.a4
    c, d, e = (a / p.a4 * powers[:, : a.shape[1]] for a in (p.a2, p.a1, p.a0))
    square = scale[:, None] ** 2
    i = _sum(12 * e, _shift(-3 * square * b * d), _product(c, c))
    j = _sum(
        72 * _product(c, e),
        _shift(9 * square * b * _product(c, d)),
        _shift(-27 * square * _product(d, d)),
        _shift(-27 * square * b * b * e),
        -2 * _product(c, _product(c, c)),
    )
    discriminant = _sum(4 * _product(i, _product(i, i)), -_product(j, j))
    discriminant = np.pad(discriminant, ((0, 0), (0, 7)))[:, :7]
    speeds = scale[:, None] * np.sqrt(_positive_real_roots(discriminant))
    return Meetings(speeds, scale * _passing(scale * b[:, 0], c, d * scale[:, None], e))


def _passing(b: np.ndarray, c: np.ndarray, d: np.ndarray, e: np.ndarray) -> np.ndarray:
    """Return the speed (m,) at which s⁴ + v b s³ + c(u) s² + v d(u) s + e(u) has two pairs with equal real parts.

    Shifted by its mean root the quartic is x⁴ + P x² + Q x + R. Q / v = d - b c / 2 + b³ u / 8 is linear in u; where it
    vanishes, x² has two negative values for pairs with equal real parts (and none for pairs of equal moduli).
    """
    constant = d[:, 0] - b * c[:, 0] / 2
    slope = d[:, 1] - b * c[:, 1] / 2 + b**3 / 8
    with np.errstate(divide="ignore", invalid="ignore"):
        u = -constant / slope
        bb, c_u = b * b * u, c[:, 0] + c[:, 1] * u
        P = c_u - 3 * bb / 8
        R = e[:, 0] + (e[:, 1] + e[:, 2] * u) * u - b * (d[:, 0] + d[:, 1] * u) * u / 4 + bb * c_u / 16
        R -= 3 * bb * bb / 256
        return np.sqrt(np.where((u > 0) & (P > 0) & (R > 0) & (P * P > 4 * R), u, np.nan))


def meeting_speeds(p: CharacteristicPolynomial) -> np.ndarray:
    """Return the speeds in m/s at which roots of a single design meet, ascending.

    >>> from singletrack import coefficients, load_bicycle
    >>> from singletrack.linear.characteristic import characteristic_polynomial
    >>> meeting_speeds(characteristic_polynomial(coefficients(load_bicycle("benchmark")))).round(6).tolist()
    [0.684283]
    """
    single = (p.a4, p.a3, p.a2, p.a1, p.a0)
    speeds = find_meetings(type(p)(*(np.reshape(a, (1, -1)) for a in single))).speeds[0]
    found: np.ndarray = speeds[np.isfinite(speeds)]
    return found


def _speed_scale(p: CharacteristicPolynomial) -> np.ndarray:
    """Return a speed (m,) at which the constant and the quadratic term of a2 are equally large."""
    with np.errstate(divide="ignore", invalid="ignore"):
        scale = np.sqrt(np.abs(p.a2[:, 0] / p.a2[:, 1]))
    return np.where(np.isfinite(scale) & (scale > 0), scale, 1.0)


def _product(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    """Multiply polynomials, coefficients ascending on the last axis."""
    result = np.zeros((len(a), a.shape[1] + b.shape[1] - 1))
    for k in range(a.shape[1]):
        result[:, k : k + b.shape[1]] += a[:, k : k + 1] * b
    return result


def _shift(a: np.ndarray) -> np.ndarray:
    """Multiply a polynomial by its variable."""
    return np.pad(a, ((0, 0), (1, 0)))


def _sum(*terms: np.ndarray) -> np.ndarray:
    longest = max(term.shape[1] for term in terms)
    return sum((np.pad(term, ((0, 0), (0, longest - term.shape[1]))) for term in terms), np.zeros((1, longest)))


def _positive_real_roots(coefficients: np.ndarray) -> np.ndarray:
    """Return the positive real roots of polynomials of degree six, ascending, infinite for the others, (m, 6).

    A root counts as real within the accuracy that a double root can have: a meeting too many does no harm, because
    the roots on both sides are looked at.
    """
    lead = coefficients[:, 6:]
    size = np.abs(coefficients).max(axis=1, keepdims=True)
    usable = (np.abs(lead) > 1e-300 * size) & np.isfinite(coefficients).all(axis=1, keepdims=True)
    companion = np.zeros((len(coefficients), 6, 6))
    companion[:, range(1, 6), range(5)] = 1.0
    companion[:, :, 5] = np.where(usable, -coefficients[:, :6] / np.where(usable, lead, 1.0), 0.0)
    roots = np.linalg.eigvals(companion)
    real = usable & (roots.real > 0) & (np.abs(roots.imag) <= 1e-7 * np.abs(roots))
    return np.sort(np.where(real, roots.real, np.inf), axis=-1)
