"""The array API standard under the kernels: the same code on NumPy (default) and on JAX.

``Array`` stands for a NumPy or JAX array, a NumPy scalar or a Python number; the two libraries share no type.
"""

from __future__ import annotations

import functools
import sys
from typing import TYPE_CHECKING, Any, TypeAlias

from singletrack.errors import InputError

if TYPE_CHECKING:
    from collections.abc import Sequence

__all__ = [
    "Array",
    "as_arrays",
    "cross",
    "dot",
    "is_concrete",
    "is_jax",
    "matvec",
    "namespace",
    "require_double",
    "skew",
    "stack",
    "unit_vector",
    "vector",
]

Array: TypeAlias = Any


@functools.cache
def _numpy() -> Any:
    import array_api_compat.numpy as xp  # lazy: `import singletrack` stays light

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


def require_double(value: Array) -> None:
    """Raise InputError if a result is a JAX array of single precision: too coarse for stability, and easily overlooked.

    Raises
    ------
    InputError
        With what to type to make JAX compute in double precision.
    """
    if is_jax(value) and value.dtype.itemsize < (16 if value.dtype.kind == "c" else 8):
        raise InputError(
            f"JAX computes in {value.dtype}, must be double precision: put "
            'jax.config.update("jax_enable_x64", True) at the start of the program'
        )


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
    return stack(components, -1)


def stack(arrays: Sequence[Array], axis: int) -> Array:
    """Stack arrays of any broadcastable shapes along a new axis, counted from the end (-1: last)."""
    xp, same_kind = as_arrays(*arrays)
    if is_jax(*same_kind):
        return xp.stack(xp.broadcast_arrays(*same_kind), axis=axis)
    # Written in place: a good deal faster than numpy.stack for the short axes used here.
    shapes, dtypes = {array.shape for array in same_kind}, {array.dtype for array in same_kind}
    shape = shapes.pop() if len(shapes) == 1 else xp.broadcast_shapes(*shapes)
    place = len(shape) + 1 + axis
    dtype = dtypes.pop() if len(dtypes) == 1 else xp.result_type(*dtypes)
    result = xp.empty((*shape[:place], len(same_kind), *shape[place:]), dtype=dtype)
    before = (slice(None),) * place
    for k, array in enumerate(same_kind):
        result[*before, k] = array
    return result


def cross(a: Array, b: Array) -> Array:
    """Return the cross product of vectors of shape (..., 3), with broadcasting."""
    ax, ay, az = a[..., 0], a[..., 1], a[..., 2]
    bx, by, bz = b[..., 0], b[..., 1], b[..., 2]
    return vector(ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx)


def dot(a: Array, b: Array) -> Array:
    """Return the inner product of vectors of shape (..., 3) (no complex conjugate), with broadcasting."""
    return a[..., 0] * b[..., 0] + a[..., 1] * b[..., 1] + a[..., 2] * b[..., 2]


def matvec(matrix: Array, vec: Array) -> Array:
    """Return matrices (..., m, 3) times vectors (..., 3), with broadcasting."""
    x, y, z = vec[..., 0:1], vec[..., 1:2], vec[..., 2:3]
    return matrix[..., :, 0] * x + matrix[..., :, 1] * y + matrix[..., :, 2] * z


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
