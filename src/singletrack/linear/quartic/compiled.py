"""The kernel of :mod:`singletrack.linear.quartic` compiled by numba: the same functions, the same bits, sooner."""

from __future__ import annotations

from types import FunctionType
from typing import TYPE_CHECKING, Any

import numba

from singletrack.linear.quartic import solve as quartic

if TYPE_CHECKING:
    from collections.abc import Callable

__all__ = ["roots_into"]

_PARTS = (
    "_where",
    "_sqrt",
    "_cubic_start",
    "_resolvent_root",
    "_newton_step",
    "_reproduces",
    "factor",
    "_quadratic_roots",
    "_sort_two",
    "ordered_roots",
)


def _compile() -> Callable[..., None]:
    """Return ``quartic._blocks_into`` compiled, with all that it calls; kept on disk for the next process."""
    names = dict(vars(quartic))
    for name in _PARTS:
        original = getattr(quartic, name)
        copy = FunctionType(original.__code__, names, name, original.__defaults__)
        names[name] = _jit(copy, inline="always")
    kernel = FunctionType(quartic._blocks_into.__code__, names, "_blocks_into")  # noqa: SLF001
    compiled: Callable[..., None] = _jit(kernel, cache=True)
    return compiled


def _jit(function: FunctionType, **options: Any) -> Any:
    # Division as NumPy does it: no exceptions, hence no branches. No fast-math: the bits stay NumPy's.
    return numba.njit(error_model="numpy", nogil=True, **options)(function)


roots_into = _compile()
