"""Eigenvalues of any number of freedoms as JAX arrays, with exact first derivatives.

The roots come from LAPACK (on the processor: JAX has no general eigenvalues elsewhere) and are differentiated by
perturbation theory: with the null vectors y* P = 0, P x = 0 of P(s) = M s² + C s + K, ds = -(y* dP x) / (y* P' x).
"""

from __future__ import annotations

from typing import Any

import jax
import jax.numpy as jnp

from singletrack.arrays import require_double

__all__ = ["pencil_roots"]


def pencil_roots(M: Any, C: Any, K: Any) -> Any:
    """Return the roots (..., 2 n) of det(M s² + C s + K), sorted by real then imaginary part.

    Parameters
    ----------
    M, C, K : array, shape (..., n, n)

    Raises
    ------
    InputError
        If JAX computes in single precision.
    """
    M, C, K = jnp.broadcast_arrays(*(jnp.asarray(a) for a in (M, C, K)))
    require_double(M)
    fixed = tuple(jax.lax.stop_gradient(a) for a in (M, C, K))
    roots = jax.lax.stop_gradient(jnp.sort(jnp.linalg.eigvals(_state(*fixed)), axis=-1))
    s = roots[..., None, None]
    left, _, right = jnp.linalg.svd(_pencil(s, *fixed))
    y, x = jax.lax.stop_gradient((left[..., :, -1].conj(), right[..., -1, :].conj()))
    slope = _form(y, 2 * s * fixed[0][..., None, :, :] + fixed[1][..., None, :, :], x)
    value = _form(y, _pencil(s, M, C, K), x)
    # A step of Newton's method whose length is zero, but not its derivative.
    return roots - (value - jax.lax.stop_gradient(value)) / slope


def _state(M: Any, C: Any, K: Any) -> Any:
    n = M.shape[-1]
    top = jnp.broadcast_to(jnp.eye(n, 2 * n, n), (*M.shape[:-1], 2 * n))
    return jnp.concatenate([top, -jnp.linalg.solve(M, jnp.concatenate([K, C], axis=-1))], axis=-2)


def _pencil(s: Any, M: Any, C: Any, K: Any) -> Any:
    return s * s * M[..., None, :, :] + s * C[..., None, :, :] + K[..., None, :, :]


def _form(y: Any, matrix: Any, x: Any) -> Any:
    return jnp.einsum("...i,...ij,...j->...", y, matrix, x)
