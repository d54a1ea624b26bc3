"""Roots of many quartics at once: the driver of the kernel, on NumPy arrays or compiled.

The few quartics that the kernel's factors do not reproduce to rounding (a pair of roots near another pair, three roots
nearly equal, numbers out of range) are solved again (:mod:`singletrack.linear.quartic.hard`).
"""

from __future__ import annotations

from importlib.util import find_spec
from typing import TYPE_CHECKING

import numpy as np

from singletrack.linear.quartic.hard import solve_again
from singletrack.linear.quartic.kernel import factor, ordered_roots

if TYPE_CHECKING:
    from collections.abc import Callable

    from singletrack.arrays import Array

__all__ = ["CHUNK", "quartic_roots", "solve_into", "use_compiled"]

#: Quartics treated at a time, so that what is being worked on stays in the processor's cache.
CHUNK = 8192
#: Quartics after which the compiled kernel is loaded, where numba is installed: by then NumPy has taken as long.
_WORTH_COMPILING = 2_000_000


def quartic_roots(b: Array, c: Array, d: Array, e: Array) -> np.ndarray:
    """Return the roots (..., 4) of quartics s⁴ + b s³ + c s² + d s + e, sorted by real then imaginary part.

    Roots of a pair are exact conjugates, real roots have an imaginary part of exactly zero; NaN where a coefficient is
    not finite. Each set of roots is exact for a quartic whose coefficients differ from the given ones by a few
    roundings.

    Parameters
    ----------
    b, c, d, e : array, shape (...)
        Real, of any broadcastable shapes.

    Examples
    --------
    >>> quartic_roots(0.0, -5.0, 0.0, 4.0).tolist()  # (s² - 1) (s² - 4)
    [(-2+0j), (-1+0j), (1+0j), (2+0j)]
    """
    coefficients = np.broadcast_arrays(*(np.asarray(a, dtype=float) for a in (b, c, d, e)))
    shape = coefficients[0].shape
    flat = [np.ravel(a) for a in coefficients]
    roots = np.empty((flat[0].size, 4), dtype=complex)
    for start in range(0, len(roots), CHUNK):
        chunk = slice(start, start + CHUNK)
        solve_into(roots[chunk], *(a[chunk] for a in flat))
    return roots.reshape(*shape, 4)


class _Kernel:
    """Which kernel solves: NumPy at first, the compiled one once it has become worth its start."""

    solved = 0
    compiled: Callable[..., None] | None = None


def use_compiled() -> bool:
    """Load the compiled kernel now (for long work); return whether there is one. Both give the same bits."""
    if _Kernel.compiled is None and find_spec("numba") is not None:
        from singletrack.linear.quartic.compiled import roots_into  # lazy: heavy, optional

        _Kernel.compiled = roots_into
    return _Kernel.compiled is not None


def solve_into(roots: np.ndarray, b: np.ndarray, c: np.ndarray, d: np.ndarray, e: np.ndarray) -> None:
    """Write the roots of at most some thousand quartics, coefficients of shape (k,), to a complex array (k, 4).

    Parameters
    ----------
    roots : array, shape (k, 4)
        Complex; it is overwritten.
    b, c, d, e : array, shape (k,)
        Of x⁴ + b x³ + c x² + d x + e.
    """
    _Kernel.solved += len(roots)
    if _Kernel.solved > _WORTH_COMPILING:
        use_compiled()
    good = np.empty(len(roots), dtype=bool)
    if _Kernel.compiled is None:
        _roots_into(roots, good, b, c, d, e)
    else:
        _Kernel.compiled(roots, good, b, c, d, e)
    if not good.all():
        bad = ~good
        roots[bad] = solve_again(b[bad], c[bad], d[bad], e[bad])


def _roots_into(
    roots: np.ndarray, good: np.ndarray, b: np.ndarray, c: np.ndarray, d: np.ndarray, e: np.ndarray
) -> None:
    with np.errstate(all="ignore"):
        p1, q1, p2, q2, good[:] = factor(b, c, d, e, np.where, np.sqrt)
        parts = ordered_roots(p1, q1, p2, q2, np.where, np.sqrt)
    for k in range(4):
        roots.real[:, k], roots.imag[:, k] = parts[k], parts[k + 4]
