"""Critical speeds and stable ranges, as exact roots of polynomials in the speed; no grid is scanned."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from singletrack.linear.characteristic import CharacteristicPolynomial, characteristic_polynomial

if TYPE_CHECKING:
    from singletrack.model import LinearModel

__all__ = ["CriticalSpeeds", "critical_speeds"]


@dataclass(frozen=True, eq=False)
class CriticalSpeeds:
    """Speeds at which stability of a mode changes, and the ranges in which all modes are stable, in m/s.

    For a batch of designs of shape (...), :attr:`weave` and the others are nested lists: use the arrays.

    Attributes
    ----------
    weave_speeds : array, shape (..., 2)
        Speeds at which a pair of roots crosses the imaginary axis, ascending, NaN where there are fewer.
    capsize_speeds : array, shape (..., 2)
        Speeds at which a real root crosses zero, ascending, NaN where there are fewer.
    ranges : array, shape (..., 3, 2)
        Stable ranges (from, to), ascending; "to" may be infinite; NaN where there are fewer.
    """

    weave_speeds: np.ndarray
    capsize_speeds: np.ndarray
    ranges: np.ndarray

    @property
    def weave(self) -> list[Any]:
        """All weave speeds of a single design, empty for "never" (a batch: nested lists)."""
        return _lists(self.weave_speeds, 1)

    @property
    def capsize(self) -> list[Any]:
        """All capsize speeds of a single design, empty for "never" (a batch: nested lists)."""
        return _lists(self.capsize_speeds, 1)

    @property
    def stable_ranges(self) -> list[Any]:
        """All stable ranges (from, to) of a single design, empty for "never" (a batch: nested lists)."""
        return _lists(self.ranges, 2)

    def to_dict(self) -> dict[str, Any]:
        """Return the lists for JSON; a range without end ends with None, since JSON has no infinity."""
        return {
            "weave": self.weave,
            "capsize": self.capsize,
            "stable_ranges": _without_infinity(self.stable_ranges),
        }


def _lists(values: np.ndarray, axes: int) -> list[Any]:
    if values.ndim > axes:
        return [_lists(value, axes) for value in values]
    if axes == 1:
        return [float(value) for value in values[np.isfinite(values)]]
    return [(float(low), float(high)) for low, high in values if not np.isnan(low)]


def _without_infinity(value: Any) -> Any:
    if isinstance(value, list | tuple):
        return [_without_infinity(item) for item in value]
    return None if value == float("inf") else value


def critical_speeds(model: LinearModel) -> CriticalSpeeds:
    """Return the critical speeds and stable ranges of designs (...), for all speeds above zero.

    Notes
    -----
    With the coefficients of :mod:`singletrack.linear.characteristic`, a real root crosses zero where a0(u) = 0, and a
    pair crosses the imaginary axis where Hurwitz' determinant (a1 a2 a3 - a4 a1² - a0 a3²)(u) = 0 with a1/a3 > 0.
    Both are quadratics in u = v². Between neighbours of these speeds, Routh and Hurwitz decide at one speed.

    Examples
    --------
    >>> from singletrack import coefficients, load_bicycle
    >>> result = critical_speeds(coefficients(load_bicycle("benchmark")))
    >>> result.weave, result.capsize
    ([4.292382536...], [6.024262015...])
    """
    p = characteristic_polynomial(model)
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
    return CriticalSpeeds(np.sqrt(weave), np.sqrt(capsize), _stable_ranges(p, weave, capsize))


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
