"""Roots of quartics as JAX arrays: :mod:`singletrack.linear.quartic` with exact first derivatives.

The roots are found as for NumPy, and differentiated implicitly: of p(s; b, c, d, e) = 0 follows p' ds = -∂p. Where
NumPy calls LAPACK, which JAX has not on every device, the roots are iterated together (Ehrlich and Aberth).
"""

from __future__ import annotations

from typing import Any

import jax
import jax.numpy as jnp

from singletrack.errors import InputError
from singletrack.linear.quartic import factor, ordered_roots

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
    if coefficients[0].dtype != jnp.float64:
        raise InputError(
            f"eigenvalues of {coefficients[0].dtype} JAX arrays: must be float64; put "
            'jax.config.update("jax_enable_x64", True) at the start of the program'
        )
    fixed = tuple(jax.lax.stop_gradient(a) for a in coefficients)
    p1, q1, p2, q2, good = factor(fixed[0], fixed[1], fixed[2], fixed[3], jnp.where, jnp.sqrt)
    parts = ordered_roots(p1, q1, p2, q2, jnp.where, jnp.sqrt)
    roots = jnp.stack(parts[:4], axis=-1) + 1j * jnp.stack(parts[4:], axis=-1)
    roots = jax.lax.stop_gradient(_iterate(roots, good, fixed))
    value, _, _ = _horner(roots, coefficients)
    _, slope, _ = _horner(roots, fixed)
    # A step of Newton's method whose length is zero, but not its derivative.
    return roots - (value - jax.lax.stop_gradient(value)) / slope


def _horner(s: Any, coefficients: tuple[Any, ...]) -> tuple[Any, Any, Any]:
    """Return p(s), p'(s) and the sum of the sizes of p's terms, for s (..., 4) and coefficients (...)."""
    value, slope, size = jnp.ones_like(s), jnp.zeros_like(s), jnp.ones_like(s.real)
    for a in coefficients:
        slope = slope * s + value
        value = value * s + a[..., None]
        size = size * jnp.abs(s) + jnp.abs(a[..., None])
    return value, slope, size


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
        value, slope, size = _horner(s, coefficients)
        done = jnp.abs(value) <= 4e-16 * size
        newton = value / jnp.where(slope == 0, 1e-300, slope)
        gaps = s[..., :, None] - s[..., None, :]
        pull = jnp.sum(jnp.where(gaps == 0, 0.0, 1.0 / jnp.where(gaps == 0, 1.0, gaps)), axis=-1)
        moved = s - newton / (1.0 - newton * pull)
        s = jnp.where(left[..., None] & ~done & jnp.isfinite(moved), moved, s)
        return count + 1, s, left & ~jnp.all(done, axis=-1)

    _, found, _ = jax.lax.while_loop(unfinished, step, (0, start, pending))
    return jnp.where(good[..., None], roots, jnp.sort(found, axis=-1))
