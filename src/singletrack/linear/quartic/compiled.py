"""The kernel of :mod:`singletrack.linear.quartic` compiled by numba: the same functions, the same bits, sooner.

The kernel's plain functions are registered with numba as they are; what is compiled is a loop over numbers in blocks.
The machine code is kept on disk for the next process where there is a place to write to, and made anew where not (an
installation that cannot be written to, no home folder).
"""

from __future__ import annotations

import hashlib
import math
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numba
import numpy as np
from numba.extending import overload

from singletrack.linear.quartic import kernel

if TYPE_CHECKING:
    from collections.abc import Callable

__all__ = ["roots_at_speeds", "roots_into"]

# Division as NumPy does it: no exceptions, hence no branches. No fast-math: the bits stay NumPy's.
_OPTIONS: Any = {"error_model": "numpy", "nogil": True}
_INLINE: Any = {**_OPTIONS, "forceinline": True}


def _where(condition: bool, yes: float, no: float) -> float:
    return yes if condition else no


def _sqrt(x: float) -> float:
    return math.sqrt(x)


def _register(function: Callable[..., Any]) -> None:
    """Tell numba to compile a plain function where compiled code calls it."""
    overload(function, jit_options=_INLINE, strict=False)(lambda *_: function)


def _block_loop(stamp: str) -> Callable[..., None]:
    """Return the loop over numbers. The stamp of the kernel's source is part of the key of what is kept on disk."""
    factor, ordered_roots = kernel.factor, kernel.ordered_roots

    def loop(roots: np.ndarray, good: np.ndarray, b: np.ndarray, c: np.ndarray, d: np.ndarray, e: np.ndarray) -> None:
        # The inner loop has no branches, so that the compiler uses the processor's vector instructions; real and
        # imaginary parts are interleaved afterwards.
        parts = np.empty((9, 256))
        _ = stamp
        for start in range(0, len(b), 256):
            n = min(256, len(b) - start)
            for k in range(n):
                i = start + k
                p1, q1, p2, q2, is_good = factor(b[i], c[i], d[i], e[i], _where, _sqrt)
                r = ordered_roots(p1, q1, p2, q2, _where, _sqrt)
                parts[0, k], parts[1, k], parts[2, k], parts[3, k] = r[0], r[1], r[2], r[3]
                parts[4, k], parts[5, k], parts[6, k], parts[7, k] = r[4], r[5], r[6], r[7]
                parts[8, k] = 1.0 if is_good else 0.0
            for k in range(n):
                i = start + k
                for j in range(4):
                    roots[i, j] = complex(parts[j, k], parts[j + 4, k])
                good[i] = parts[8, k] > 0.0

    return loop


def _speed_loop(stamp: str) -> Callable[..., None]:
    """Return the loop over designs and speeds, likewise."""
    factor, monic, ordered_roots = kernel.factor, kernel.monic, kernel.ordered_roots

    def loop(roots: np.ndarray, good: np.ndarray, ratios: np.ndarray, v: np.ndarray) -> None:
        parts = np.empty((9, 256))
        _ = stamp
        for i in range(ratios.shape[1]):
            b0, c0, c1, d0, d1 = ratios[0, i], ratios[1, i], ratios[2, i], ratios[3, i], ratios[4, i]
            e0, e1, e2 = ratios[5, i], ratios[6, i], ratios[7, i]
            for start in range(0, len(v), 256):
                n = min(256, len(v) - start)
                for k in range(n):
                    b, c, d, e = monic(b0, c0, c1, d0, d1, e0, e1, e2, v[start + k])
                    p1, q1, p2, q2, is_good = factor(b, c, d, e, _where, _sqrt)
                    r = ordered_roots(p1, q1, p2, q2, _where, _sqrt)
                    parts[0, k], parts[1, k], parts[2, k], parts[3, k] = r[0], r[1], r[2], r[3]
                    parts[4, k], parts[5, k], parts[6, k], parts[7, k] = r[4], r[5], r[6], r[7]
                    parts[8, k] = 1.0 if is_good else 0.0
                for k in range(n):
                    for j in range(4):
                        roots[i, start + k, j] = complex(parts[j, k], parts[j + 4, k])
                    good[i, start + k] = parts[8, k] > 0.0

    return loop


def _compile(make: Callable[[str], Callable[..., None]]) -> Callable[..., None]:
    loop = make(hashlib.sha256(Path(kernel.__file__).read_bytes()).hexdigest())
    try:
        compiled: Callable[..., None] = numba.njit(loop, cache=True, **_OPTIONS)
    except RuntimeError:  # no place to keep it
        compiled = numba.njit(loop, **_OPTIONS)
    return compiled


for _function in (*(getattr(kernel, name) for name in kernel.__all__), _where, _sqrt):
    _register(_function)
roots_into, roots_at_speeds = _compile(_block_loop), _compile(_speed_loop)
