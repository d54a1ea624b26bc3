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
    if is_jax(*arrays):
        xp, same_kind = as_arrays(*arrays)
        return xp.stack(xp.broadcast_arrays(*same_kind), axis=axis)
    # Written in place, a good deal faster than numpy.stack for the short axes used here; and with the new axis first in
    # memory, so that components of many designs lie side by side.
    xp = namespace()
    shapes = {array.shape for array in arrays if hasattr(array, "shape")}
    shape = shapes.pop() if len(shapes) == 1 else xp.broadcast_shapes(*shapes)
    kinds = {array.dtype for array in arrays if hasattr(array, "dtype")}
    result = xp.empty((len(arrays), *shape), dtype=kinds.pop() if len(kinds) == 1 else xp.result_type(0.0, *arrays))
    if result.dtype.kind not in "fc":
        result = result.astype(float)
    for k, array in enumerate(arrays):
        result[k] = array
    place = len(shape) + 1 + axis
    return xp.moveaxis(result, 0, place) if place else result


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
