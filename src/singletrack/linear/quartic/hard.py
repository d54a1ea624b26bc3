"""The few quartics that two real factors do not hold: roots that nearly meet, or of very different size."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from singletrack.linear.quartic.kernel import factor, ordered_roots

if TYPE_CHECKING:
    from collections.abc import Callable

    from singletrack.arrays import Array

#: Relative difference between the product of LAPACK's refined roots and the quartic that rounding explains.
_ROUNDING = 1e-13

__all__ = ["horner", "refined", "solve_again"]


def solve_again(b: np.ndarray, c: np.ndarray, d: np.ndarray, e: np.ndarray) -> np.ndarray:
    """Return the roots of the few quartics that :func:`factor` has not factored to rounding.

    Roots of very different size only need more of Newton's steps; for those that (nearly) meet, LAPACK finds the
    eigenvalues of the companion matrix, and these are refined until each is exact for coefficients changed by rounding.
    Here, too, the product of the roots' factors is compared with the quartic: what it does not reproduce becomes NaN.

    Shape (k, 4), complex.

    Parameters
    ----------
    b, c, d, e : array, shape (k,)
        Of x⁴ + b x³ + c x² + d x + e.
    """
    with np.errstate(all="ignore"):
        p1, q1, p2, q2, good = factor(b, c, d, e, np.where, np.sqrt, newton_steps=12)
        parts = ordered_roots(p1, q1, p2, q2, np.where, np.sqrt)
    roots: np.ndarray = np.stack(parts[:4], axis=-1) + 1j * np.stack(parts[4:], axis=-1)
    if not good.all():
        bad = ~good
        roots[bad] = _solve_by_lapack(*(a[bad] for a in (b, c, d, e)))
    return roots


def _solve_by_lapack(b: np.ndarray, c: np.ndarray, d: np.ndarray, e: np.ndarray) -> np.ndarray:
    finite = np.isfinite(b) & np.isfinite(c) & np.isfinite(d) & np.isfinite(e)
    monic = np.where(finite[:, None], np.stack([b, c, d, e], axis=-1), 0.0)
    companion = np.zeros((len(b), 4, 4))
    companion[:, range(1, 4), range(3)] = 1.0
    # In units in which no coefficient exceeds one, a power of two: numbers far out of range come back in, bits stay.
    with np.errstate(divide="ignore"):
        exponents = np.where(monic == 0, -np.inf, np.frexp(monic)[1] / np.arange(1, 5))
    unit = np.ceil(np.max(np.where(np.isfinite(exponents), exponents, -1074.0), axis=1, keepdims=True)).astype(int)
    monic = np.ldexp(monic, -unit * np.arange(1, 5))
    companion[:, 0, :] = -monic
    found = roots = np.sort_complex(np.linalg.eigvals(companion).astype(complex))
    # Each root's conjugate among the four: refined together, they stay conjugates.
    partner = np.argmin(np.abs(roots[:, :, None] - roots[:, None, :].conj()), axis=-1)
    upper, real = roots.imag > 0, roots.imag == 0
    with np.errstate(all="ignore"):
        for _ in range(20):
            moved, done = refined(roots, tuple(monic.T), np.where)
            moved = np.where(real, moved.real, np.where(upper, moved, np.take_along_axis(moved, partner, 1).conj()))
            roots = np.where(np.isfinite(moved) & ~done, moved, roots)
        # Three roots nearly equal, each refined by itself, may no longer be right together, as LAPACK's are.
        roots = np.where(_reproduced(roots, monic)[:, None], roots, found)
        sound = finite & _reproduced(roots, monic)
        factor = np.ldexp(1.0, unit)
        return np.where(sound[:, None], np.sort_complex(roots) * factor, np.nan)


def _reproduced(roots: np.ndarray, monic: np.ndarray) -> np.ndarray:
    """Tell of which quartics (m,) the product of the roots' factors is the quartic, to a few roundings of its terms."""
    product, size = np.ones((len(roots), 1), dtype=complex), np.ones((len(roots), 1))
    for k in range(4):
        longer = np.pad(product, ((0, 0), (0, 1)))
        longer[:, 1:] -= roots[:, k, None] * product
        product = longer
        terms = np.pad(size, ((0, 0), (0, 1)))
        terms[:, 1:] += np.abs(roots[:, k, None]) * size
        size = terms
    sound: np.ndarray = (np.abs(product[:, 1:] - monic) <= _ROUNDING * size[:, 1:]).all(axis=1)
    return sound


def refined(s: Array, coefficients: tuple[Array, ...], where: Callable[..., Any]) -> tuple[Array, Array]:
    """Return roots (..., 4) after one iteration of Ehrlich and Aberth, and which of them were exact to rounding.

    Parameters
    ----------
    s : array, shape (..., 4)
        The roots so far, complex.
    coefficients : tuple of array, shape (...)
        b, c, d, e.
    where : callable
        ``where`` of the arrays' namespace.
    """
    value, slope, size = horner(s, coefficients)
    newton = value / where(slope == 0, 1e-300, slope)
    gaps = s[..., :, None] - s[..., None, :]
    pull = where(gaps == 0, 0.0, 1.0 / where(gaps == 0, 1.0, gaps)).sum(axis=-1)
    return s - newton / (1.0 - newton * pull), abs(value) <= 4e-16 * size


def horner(s: Array, coefficients: tuple[Array, ...]) -> tuple[Array, Array, Array]:
    """Return p(s), p'(s) and the sum of the sizes of p's terms, for s (..., 4) and coefficients b to e (...)."""
    value, slope, size = 1.0 + 0.0 * s, 0.0 * s, 1.0 + 0.0 * abs(s)
    for a in coefficients:
        slope = slope * s + value
        value = value * s + a[..., None]
        size = size * abs(s) + abs(a[..., None])
    return value, slope, size
