"""Vectors and matrices with any leading batch dimensions, on NumPy or JAX."""

from __future__ import annotations

import functools
from typing import TYPE_CHECKING, Any

from singletrack.arrays.namespace import Array, Number, as_arrays, is_jax, namespace

if TYPE_CHECKING:
    from collections.abc import Sequence

__all__ = ["cross", "dot", "matvec", "skew", "stack", "unit_vector", "vector"]


def vector(*components: Number) -> Array:
    """Stack components of any broadcastable shapes into vectors, shape (..., n), of any unit.

    >>> vector(1.0, 0.0, 2.0).tolist()
    [1.0, 0.0, 2.0]
    """
    return stack(components, -1)


def stack(arrays: Sequence[Number], axis: int) -> Array:
    """Stack arrays of any broadcastable shapes along a new axis, counted from the end (-1: last).

    Parameters
    ----------
    arrays : sequence of array, shape (...)
        Of any unit.
    axis : int
        Where the new axis stands in the result: -1 for the last.
    """
    if is_jax(*arrays):
        xp, same_kind = as_arrays(*arrays)
        return xp.stack(xp.broadcast_arrays(*same_kind), axis=axis)
    # Written in place, a good deal faster than numpy.stack for the short axes used here; and with the new axis first in
    # memory, so that components of many designs lie side by side.
    xp = namespace()
    shape, kinds = _common(xp, arrays)
    result = xp.empty((len(arrays), *shape), dtype=kinds)
    for k, array in enumerate(arrays):
        result[k] = array
    return result.transpose(_first_to(len(shape) + 1, len(shape) + 1 + axis)) if shape else result


def _common(xp: Any, arrays: Sequence[Number]) -> tuple[tuple[int, ...], Any]:
    """Return the shape to which arrays and numbers broadcast, and the type that holds them, at least double."""
    shape: tuple[int, ...] = ()
    alike, kind = True, xp.float64
    for array in arrays:
        own = getattr(array, "shape", ())
        if own != shape and own:
            alike, shape = alike and not shape, own
        of_array = getattr(array, "dtype", xp.complex128 if isinstance(array, complex) else kind)
        if of_array != kind:
            kind = xp.result_type(kind, of_array)
    return shape if alike else xp.broadcast_shapes(*(getattr(array, "shape", ()) for array in arrays)), kind


@functools.cache
def _first_to(dimensions: int, place: int) -> tuple[int, ...]:
    """Return the order of axes in which the first one stands at a place."""
    return (*range(1, place + 1), 0, *range(place + 1, dimensions))


def cross(a: Array, b: Array) -> Array:
    """Return the cross product of vectors a, b of shape (..., 3) and any units, with broadcasting."""
    ax, ay, az = a[..., 0], a[..., 1], a[..., 2]
    bx, by, bz = b[..., 0], b[..., 1], b[..., 2]
    return vector(ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx)


def dot(a: Array, b: Array) -> Array:
    """Return the inner product (no complex conjugate) of vectors a, b of shape (..., 3) and any units."""
    return a[..., 0] * b[..., 0] + a[..., 1] * b[..., 1] + a[..., 2] * b[..., 2]


def matvec(matrix: Array, vec: Array) -> Array:
    """Return matrices (..., m, 3) times vectors (..., 3), with broadcasting.

    Parameters
    ----------
    matrix : array, shape (..., m, 3)
    vec : array, shape (..., 3)
    """
    x, y, z = vec[..., 0:1], vec[..., 1:2], vec[..., 2:3]
    return matrix[..., :, 0] * x + matrix[..., :, 1] * y + matrix[..., :, 2] * z


def unit_vector(vec: Array) -> Array:
    """Return vectors of shape (..., n), of any unit, scaled to length one."""
    xp = namespace(vec)
    return vec / xp.sqrt(dot(vec, vec))[..., None]


def skew(vec: Array) -> Array:
    """Return the matrices (..., 3, 3) with ``skew(a) b = a x b``.

    Parameters
    ----------
    vec : array, shape (..., 3)
        The vector a, of any unit.
    """
    x, y, z = vec[..., 0], vec[..., 1], vec[..., 2]
    zero = 0.0 * x
    xp = namespace(vec)
    return xp.stack([vector(zero, -z, y), vector(z, zero, -x), vector(-y, x, zero)], axis=-2)
