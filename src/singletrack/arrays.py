"""The array API standard under the kernels: the same code on NumPy (default) and on JAX.

``Array`` stands for a NumPy or JAX array, a NumPy scalar or a Python number; the two libraries share no type.
"""

from __future__ import annotations

import functools
import sys
from typing import Any, TypeAlias

__all__ = [
    "Array",
    "as_arrays",
    "cross",
    "dot",
    "is_concrete",
    "is_jax",
    "matvec",
    "namespace",
    "skew",
    "unit_vector",
    "vector",
]

Array: TypeAlias = Any


@functools.cache
def _numpy() -> Any:
    import array_api_compat.numpy as xp  # noqa: PLC0415  # lazy: `import singletrack` stays light

    return xp


def namespace(*values: Array) -> Any:
    """Return the array namespace of the values: JAX if any is a JAX array, else NumPy.

    >>> namespace(1.0, 2.0).__name__
    'array_api_compat.numpy'
    """
    return sys.modules["jax.numpy"] if is_jax(*values) else _numpy()


def is_jax(*values: Array) -> bool:
    """Tell whether any of the values is a JAX array (or stands for one while JAX traces a function)."""
    jax = sys.modules.get("jax")
    return jax is not None and any(isinstance(value, jax.Array) for value in values)


def is_concrete(value: Array) -> bool:
    """Tell whether a value can be looked at now (a JAX tracer cannot)."""
    return not any(cls.__name__ == "Tracer" for cls in type(value).__mro__)


def as_arrays(*values: Array) -> tuple[Any, tuple[Array, ...]]:
    """Return the namespace of the values and the values as arrays of floating-point (or complex) numbers."""
    xp = namespace(*values)
    arrays = (xp.asarray(value) for value in values)
    return xp, tuple(array if array.dtype.kind in "fc" else xp.astype(array, xp.float64) for array in arrays)


def vector(*components: Array) -> Array:
    """Stack components of any broadcastable shapes into vectors, shape (..., n).

    >>> vector(1.0, 0.0, 2.0).tolist()
    [1.0, 0.0, 2.0]
    """
    xp, arrays = as_arrays(*components)
    return xp.stack(xp.broadcast_arrays(*arrays), axis=-1)


def cross(a: Array, b: Array) -> Array:
    """Return the cross product of vectors of shape (..., 3), with broadcasting."""
    ax, ay, az = a[..., 0], a[..., 1], a[..., 2]
    bx, by, bz = b[..., 0], b[..., 1], b[..., 2]
    return vector(ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx)


def dot(a: Array, b: Array) -> Array:
    """Return the inner product of vectors of shape (..., n) (no complex conjugate), with broadcasting."""
    return namespace(a, b).sum(a * b, axis=-1)


def matvec(matrix: Array, vec: Array) -> Array:
    """Return matrices (..., m, n) times vectors (..., n), with broadcasting."""
    return namespace(matrix, vec).sum(matrix * vec[..., None, :], axis=-1)


def unit_vector(vec: Array) -> Array:
    """Return vectors of shape (..., n) scaled to length one."""
    xp = namespace(vec)
    return vec / xp.sqrt(dot(vec, vec))[..., None]


def skew(vec: Array) -> Array:
    """Return the matrices (..., 3, 3) with ``skew(a) b = a x b``."""
    x, y, z = vec[..., 0], vec[..., 1], vec[..., 2]
    zero = 0.0 * x
    xp = namespace(vec)
    return xp.stack([vector(zero, -z, y), vector(z, zero, -x), vector(-y, x, zero)], axis=-2)
