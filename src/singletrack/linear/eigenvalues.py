"""Eigenvalues and eigenmotions of the coefficient matrices at given speeds."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from singletrack.arrays import as_arrays, is_jax
from singletrack.errors import InputError
from singletrack.linear.characteristic import characteristic_polynomial
from singletrack.linear.quartic.solve import CHUNK, solve_into

if TYPE_CHECKING:
    from singletrack.arrays import Array
    from singletrack.linear.characteristic import CharacteristicPolynomial
    from singletrack.model import LinearModel

__all__ = ["checked_speeds", "eigenmotions", "eigenvalues"]


def checked_speeds(speeds: Array) -> np.ndarray:
    """Return speeds as an array (n,) in m/s.

    Raises
    ------
    InputError
        If they are not finite real numbers on at most one axis.
    """
    array = np.asarray(speeds)
    if array.dtype.kind not in "iuf" or array.ndim > 1 or not np.isfinite(array).all():
        raise InputError(f"speeds = {speeds!r}, must be a finite number or a list of them, in m/s")
    return np.atleast_1d(array).astype(float)


def eigenvalues(model: LinearModel, speeds: Array) -> Array:
    """Return the eigenvalues (..., n, 4) in 1/s at speeds (n,) in m/s, sorted by real then imaginary part.

    Roots of a pair are exact conjugates, real roots have an imaginary part of exactly zero. Designs of a batch that
    are faulty get NaN.

    Notes
    -----
    Roots of the characteristic quartic (:mod:`singletrack.linear.quartic`), whose coefficients are polynomials in the
    speed. Matrices that are JAX arrays give JAX arrays, which can be differentiated (once) and compiled.

    Examples
    --------
    >>> from singletrack import coefficients, load_bicycle
    >>> eigenvalues(coefficients(load_bicycle("benchmark")), 5.0).round(4)[0].tolist()
    [(-14.0784+0j), (-0.7753-4.4649j), (-0.7753+4.4649j), (-0.3229+0j)]
    """
    if is_jax(model.M, model.C1, model.K0, model.K2, model.gravity, speeds):
        from singletrack.linear.quartic.jax import quartic_roots  # lazy: optional

        return quartic_roots(*characteristic_polynomial(model).monic_at(_one_axis(speeds)))
    v = checked_speeds(speeds)
    with np.errstate(all="ignore"):  # numbers out of range give NaN
        polynomials, batch = characteristic_polynomial(model).flat()
        roots = _roots_at(polynomials, v).reshape(*batch, len(v), 4)
    if model.faults:
        roots[~np.broadcast_to(model.valid, batch)] = np.nan
    return roots


def _one_axis(speeds: Array) -> Array:
    xp, (v,) = as_arrays(speeds)
    return xp.reshape(v, (-1,))


def _roots_at(polynomials: CharacteristicPolynomial, v: np.ndarray) -> np.ndarray:
    """Return the roots (m, n, 4) of m polynomials at n speeds, in chunks that stay in the cache."""
    designs, n = len(polynomials.a4), max(len(v), 1)
    roots = np.empty((designs, len(v), 4), dtype=complex)
    step = max(1, CHUNK // n)
    for start in range(0, designs, step):
        rows = slice(start, start + step)
        some = polynomials.rows(rows)
        for first in range(0, len(v), CHUNK):
            columns = slice(first, first + CHUNK)
            solve_into(roots[rows, columns].reshape(-1, 4), *(a.ravel() for a in some.monic_at(v[columns])))
    return roots


def _per_speed(model: LinearModel, v: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return v C1 and g K0 + v^2 K2, each of shape (..., n, 2, 2)."""
    C1, K0, K2 = (np.asarray(matrix)[..., None, :, :] for matrix in (model.C1, model.K0, model.K2))
    column = v[:, None, None]
    gravity = np.asarray(model.gravity, dtype=float)[..., None, None, None]
    return column * C1, gravity * K0 + column**2 * K2


def eigenmotions(model: LinearModel, speeds: Array, roots: np.ndarray) -> np.ndarray:
    """Return the eigenmotion of each root: lean and steer, with lean normalised to one.

    Parameters
    ----------
    model : LinearModel
    speeds : array, shape (n,)
        In m/s.
    roots : complex array, shape (..., n, 4)
        Eigenvalues at these speeds, in any order.

    Returns
    -------
    complex array, shape (..., n, 4, 2)
        (1, steer / lean); (0, 1) for a motion of pure steer.

    Notes
    -----
    The null vector of the 2 x 2 matrix P(s) = M s² + v C1 s + g K0 + v² K2, from its larger row.

    Examples
    --------
    >>> import numpy as np
    >>> from singletrack import coefficients, load_bicycle
    >>> model = coefficients(load_bicycle("benchmark"))
    >>> motion = eigenmotions(model, 5.0, model.eigenvalues(5.0))[0, 2]
    >>> round(float(np.abs(motion[1])), 2), round(float(np.degrees(np.angle(motion[1]))))
    (1.3, -10)
    """
    v = checked_speeds(speeds)
    damping, stiffness = _per_speed(model, v)
    s = np.asarray(roots)[..., None, None]
    M = np.asarray(model.M)[..., None, None, :, :]
    pencil = M * s**2 + damping[..., None, :, :] * s + stiffness[..., None, :, :]
    size = np.abs(pencil).sum(axis=-1)
    row = np.where((size[..., 0] >= size[..., 1])[..., None], pencil[..., 0, :], pencil[..., 1, :])
    lean, steer = row[..., 1], -row[..., 0]
    pure_steer = np.abs(lean) <= np.finfo(float).tiny
    with np.errstate(invalid="ignore"):  # faulty designs of a batch are NaN throughout
        ratio = np.where(pure_steer, 1.0, steer / np.where(pure_steer, 1.0, lean))
    return np.stack([np.where(pure_steer, 0.0, 1.0 + 0j), ratio], axis=-1)
