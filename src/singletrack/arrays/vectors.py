"""Vectors and matrices with any leading batch dimensions, on NumPy or JAX."""

from __future__ import annotations

from typing import TYPE_CHECKING

from singletrack.arrays.namespace import Array, as_arrays, is_jax, namespace

if TYPE_CHECKING:
    from collections.abc import Sequence

__all__ = ["cross", "dot", "matvec", "skew", "stack", "unit_vector", "vector"]


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
