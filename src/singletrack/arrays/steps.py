"""The door for complex numbers: derivatives by a complex step, which nothing else may use unasked.

A complex step h i in a parameter p gives df/dp = Im f(p + h i) / h, exact to rounding. A complex number that gets into
a parameter in any other way is a mistake, and records refuse it.
"""

from __future__ import annotations

import contextlib
from contextvars import ContextVar
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterator

__all__ = ["complex_allowed", "complex_steps"]

_ALLOWED: ContextVar[bool] = ContextVar("complex_steps", default=False)


@contextlib.contextmanager
def complex_steps() -> Iterator[None]:
    """Let records made within the block hold complex parameters (of this thread or task only).

    Examples
    --------
    >>> from singletrack import coefficients, load_bicycle
    >>> with complex_steps():
    ...     moved = coefficients(load_bicycle("benchmark").replace(rear_frame_z=complex(-0.9, 1e-30)))
    >>> print(round(moved.K0[0, 0].imag / 1e-30, 9))
    85.0
    """
    before = _ALLOWED.set(True)
    try:
        yield
    finally:
        _ALLOWED.reset(before)


def complex_allowed() -> bool:
    """Tell whether complex parameters are expected here: whether a :func:`complex_steps` block is open."""
    return _ALLOWED.get()
