"""Roots of quartics as JAX arrays: :mod:`singletrack.linear.quartic.kernel` with exact first derivatives.

The roots are found as for NumPy, and differentiated implicitly: of p(s; b, c, d, e) = 0 follows p' ds = -∂p. Where
NumPy calls LAPACK, which JAX has not on every device, the roots are iterated together (Ehrlich and Aberth).
"""

from __future__ import annotations

from typing import Any

import jax
import jax.numpy as jnp

from singletrack.arrays import require_double
from singletrack.linear.quartic.hard import horner, refined
from singletrack.linear.quartic.kernel import factor, ordered_roots

__all__ = ["quartic_roots"]

_ITERATIONS = 60


def quartic_roots(b: Any, c: Any, d: Any, e: Any) -> Any:
    """Return the roots (..., 4) of quartics s⁴ + b s³ + c s² + d s + e, sorted by real then imaginary part.

    Raises
    ------
    InputError
        If JAX computes in single precision.
    """
    coefficients: Any = tuple(jnp.broadcast_arrays(*(jnp.asarray(a) for a in (b, c, d, e))))
    require_double(coefficients[0])
    fixed = tuple(jax.lax.stop_gradient(a) for a in coefficients)
    p1, q1, p2, q2, good = factor(fixed[0], fixed[1], fixed[2], fixed[3], jnp.where, jnp.sqrt)
    parts = ordered_roots(p1, q1, p2, q2, jnp.where, jnp.sqrt)
    roots = jnp.stack(parts[:4], axis=-1) + 1j * jnp.stack(parts[4:], axis=-1)
    roots = jax.lax.stop_gradient(_iterate(roots, good, fixed))
    value, _, _ = horner(roots, coefficients)
    _, slope, _ = horner(roots, fixed)
    # A step of Newton's method whose length is zero, but not its derivative.
    return roots - (value - jax.lax.stop_gradient(value)) / slope


def _iterate(roots: Any, good: Any, coefficients: tuple[Any, ...]) -> Any:
    """Iterate those sets of roots (..., 4) that are not good yet until all their residuals are rounding."""
    radius: Any = sum(jnp.abs(a) ** (1 / (k + 1)) for k, a in enumerate(coefficients)) / 2 + 1e-300
    circle = radius[..., None] * jnp.exp(1j * (0.4 + jnp.pi / 2 * jnp.arange(4)))
    usable = jnp.all(jnp.isfinite(roots), axis=-1, keepdims=True)
    start = jnp.where(good[..., None] | usable, roots, circle)
    pending = ~good & jnp.isfinite(sum(coefficients))

    def unfinished(state: tuple[Any, Any, Any]) -> Any:
        count, _, left = state
        return (count < _ITERATIONS) & jnp.any(left)

    def step(state: tuple[Any, Any, Any]) -> tuple[Any, Any, Any]:
        count, s, left = state
        moved, done = refined(s, coefficients, jnp.where)
        s = jnp.where(left[..., None] & ~done & jnp.isfinite(moved), moved, s)
        return count + 1, s, left & ~jnp.all(done, axis=-1)

    _, found, _ = jax.lax.while_loop(unfinished, step, (0, start, pending))
    return jnp.where(good[..., None], roots, jnp.sort(found, axis=-1))
