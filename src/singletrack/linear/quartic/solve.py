"""Roots of many quartics at once: the driver of the kernel, on NumPy arrays or compiled.

The few quartics that the kernel's factors do not reproduce to rounding (a pair of roots near another pair, three roots
nearly equal, numbers out of range) are solved again (:mod:`singletrack.linear.quartic.hard`).
"""

from __future__ import annotations

from functools import cache
from importlib.util import find_spec
from typing import TYPE_CHECKING, Any

import numpy as np

from singletrack.arrays.tape import WORDS, record
from singletrack.linear.quartic.hard import solve_again
from singletrack.linear.quartic.kernel import factor, monic, ordered_roots

if TYPE_CHECKING:
    from collections.abc import Callable

    from singletrack.arrays import Array
    from singletrack.arrays.tape import Tape

__all__ = ["CHUNK", "quartic_roots", "solve_at_speeds", "solve_into", "use_compiled"]

#: Quartics treated at a time, so that what is being worked on stays in the processor's cache.
CHUNK = 8192
#: Quartics after which the compiled kernel is loaded, where numba is installed: by then NumPy has taken as long.
_WORTH_COMPILING = 2_000_000
#: Quartics after which NumPy replays what it has recorded of the kernel.
_WORTH_RECORDING = 20_000
#: Speeds from which the compiled loop over them is long enough for vector instructions.
_ENOUGH_SPEEDS = 16


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
    at_speeds: Callable[..., None] | None = None


def use_compiled() -> bool:
    """Load the compiled kernel now (for long work); return whether there is one. Both give the same bits."""
    if _Kernel.compiled is None and find_spec("numba") is not None:
        from singletrack.linear.quartic.compiled import roots_at_speeds, roots_into  # lazy: heavy, optional

        _Kernel.compiled, _Kernel.at_speeds = roots_into, roots_at_speeds
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
    _count(len(roots))
    good = np.empty(len(roots), dtype=bool)
    if _Kernel.compiled is None:
        _roots_into(roots, good, _all_at_once, b, c, d, e)
    else:
        _Kernel.compiled(roots, good, b, c, d, e)
    if not good.all():
        bad = ~good
        roots[bad] = solve_again(b[bad], c[bad], d[bad], e[bad])


def solve_at_speeds(roots: np.ndarray, ratios: np.ndarray, speeds: np.ndarray) -> None:
    """Write the roots of m designs' quartics at k speeds, some thousand in all, to a complex array (m, k, 4).

    Parameters
    ----------
    roots : array, shape (m, k, 4)
        Complex; it is overwritten.
    ratios : array, shape (8, m)
        What :func:`~singletrack.linear.quartic.kernel.monic` takes.
    speeds : array, shape (k,)
        In m/s.
    """
    shape = roots.shape[:-1]
    _count(roots.size // 4)
    good = np.empty(shape, dtype=bool)
    compiled, at_speeds = _Kernel.compiled, _Kernel.at_speeds
    if compiled is not None and at_speeds is not None and shape[1] >= _ENOUGH_SPEEDS and roots.flags.c_contiguous:
        at_speeds(roots, good, np.ascontiguousarray(ratios), speeds)
    elif compiled is not None:
        with np.errstate(all="ignore"):
            quartics = [np.broadcast_to(a, shape).ravel() for a in _monic_at(ratios[..., None], speeds)]
        flat = np.empty((roots.size // 4, 4), dtype=complex)
        compiled(flat, good.reshape(-1), *quartics)
        roots[:] = flat.reshape(roots.shape)
    else:
        _roots_into(roots, good, _from_ratios, *ratios[..., None], speeds)
    if not good.all():
        i, k = np.nonzero(~good)
        with np.errstate(all="ignore"):
            roots[i, k] = solve_again(*_monic_at(ratios[:, i], speeds[k]))


def _monic_at(ratios: np.ndarray, speeds: np.ndarray) -> tuple[np.ndarray, ...]:
    b, c0, c1, d0, d1, e0, e1, e2 = ratios
    return monic(b, c0, c1, d0, d1, e0, e1, e2, speeds)


def _count(quartics: int) -> None:
    _Kernel.solved += quartics
    if _Kernel.solved > _WORTH_COMPILING:
        use_compiled()


def _roots_into(roots: np.ndarray, good: np.ndarray, function: Callable[..., Any], *values: np.ndarray) -> None:
    """Write roots (..., 4), and where they are good, by a function of values (...)."""
    with np.errstate(all="ignore"):
        if _Kernel.solved > _WORTH_RECORDING:
            *parts, sound = _tape(function, len(values)).run(*values)
        else:
            *parts, sound = function(*values, np.where, np.sqrt)
    good[...] = sound.reshape(good.shape)
    real, imag = roots.real, roots.imag
    for k in range(4):
        real[..., k], imag[..., k] = parts[k].reshape(good.shape), parts[k + 4].reshape(good.shape)


def _all_at_once(b: Any, c: Any, d: Any, e: Any, where: Any, sqrt: Any) -> tuple[Any, ...]:
    """Return real, then imaginary parts of the four roots, and whether they are good."""
    p1, q1, p2, q2, good = factor(b, c, d, e, where, sqrt)
    return (*ordered_roots(p1, q1, p2, q2, where, sqrt), good)


def _from_ratios(*ratios_speed_where_sqrt: Any) -> tuple[Any, ...]:
    *values, where, sqrt = ratios_speed_where_sqrt
    return _all_at_once(*monic(*values), where, sqrt)


@cache
def _tape(function: Callable[..., Any], count: int) -> Tape:
    return record(lambda *values: function(*values, WORDS["where"], WORDS["sqrt"]), count)
