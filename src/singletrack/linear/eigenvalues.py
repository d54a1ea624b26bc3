"""Eigenvalues and eigenmotions of the coefficient matrices at given speeds."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from singletrack.arrays import as_arrays, is_jax, namespace
from singletrack.errors import InputError
from singletrack.linear.characteristic import characteristic_polynomial
from singletrack.linear.pencil import pencil
from singletrack.linear.quartic.solve import CHUNK, quartic_roots, solve_into

if TYPE_CHECKING:
    from singletrack.arrays import Array, ArrayLike
    from singletrack.linear.characteristic import CharacteristicPolynomial
    from singletrack.model import LinearModel

_FASTEST = 299_792_458.0
#: Eigenvalue problems given to LAPACK at a time.
_PROBLEMS = 4096

__all__ = ["checked_speeds", "eigenmotions", "eigenvalues"]


def checked_speeds(speeds: ArrayLike) -> np.ndarray:
    """Return speeds as an array (n,) in m/s.

    Raises
    ------
    InputError
        If they are not finite real numbers on at most one axis, or faster than light.
    """
    array = np.asarray(speeds)
    allowed = "a finite number or a list of them, in m/s"
    if array.dtype.kind not in "iuf" or array.ndim > 1 or not np.isfinite(array).all():
        raise InputError(
            f"speeds = {speeds!r}, must be {allowed}", parameters=("speeds",), found=speeds, allowed=allowed
        )
    array = np.atleast_1d(array).astype(float)
    if (np.abs(array) > _FASTEST).any():
        fastest = array[np.argmax(np.abs(array))]
        allowed = f"at most {_FASTEST:.0f} m/s, the speed of light"
        text = f"speeds: found {fastest:g} m/s, must be {allowed}"
        raise InputError(text, parameters=("speeds",), found=fastest, allowed=allowed)
    return array


def eigenvalues(model: LinearModel, speeds: ArrayLike) -> Array:
    """Return the eigenvalues (..., k, 2 n) in 1/s at speeds (k,) in m/s, sorted by real then imaginary part.

    Roots of a pair are exact conjugates, real roots have an imaginary part of exactly zero. Designs of a batch that
    are faulty get NaN.

    Parameters
    ----------
    model : LinearModel
        Any number n of freedoms, any batch (...).
    speeds : array_like, shape (k,) or ()
        In m/s.

    Notes
    -----
    Two freedoms: roots of the characteristic quartic (:mod:`singletrack.linear.quartic`), whose coefficients are
    polynomials in the speed. More freedoms: eigenvalues of the state matrix by LAPACK. Matrices that are JAX arrays
    give JAX arrays, which can be differentiated (once) and compiled.

    Examples
    --------
    >>> from singletrack import coefficients, load_bicycle
    >>> eigenvalues(coefficients(load_bicycle("benchmark")), 5.0).round(4)[0].tolist()
    [(-14.0784+0j), (-0.7753-4.4649j), (-0.7753+4.4649j), (-0.3229+0j)]
    """
    if is_jax(*model.matrices, model.C0, model.S0, model.gravity, speeds):
        return _jax_eigenvalues(model, _one_axis(speeds))
    v = checked_speeds(speeds)
    if model.freedoms > 2:
        return _by_lapack(model, v)
    with np.errstate(all="ignore"):  # numbers out of range give NaN
        if model.is_undamped:
            polynomials, batch = characteristic_polynomial(model).flat()
            roots = _roots_at(polynomials, v).reshape(*batch, len(v), 4)
        else:
            roots = quartic_roots(*monic_quartic(model.M, *at_speeds(model, v)))
    lost = np.isnan(roots[..., 0].real)
    if lost.any() and (lost := lost & model.valid[..., None]).any():
        roots = _told_otherwise(model, v, roots, lost)
    if model.faults:
        roots = np.where(model.valid[..., None, None], roots, np.nan)
    return roots


def _told_otherwise(model: LinearModel, v: np.ndarray, roots: np.ndarray, lost: np.ndarray) -> np.ndarray:
    """Return roots (..., k, 4) with the lost ones, whose quartic was out of range, found in other units."""
    designs = lost.any(axis=-1)
    some = model.broadcast_to(model.shape)[designs]
    roots[designs] = np.where(lost[designs][..., None], _by_lapack(some, v), roots[designs])
    return roots


def _jax_eigenvalues(model: LinearModel, v: Array) -> Array:
    if model.freedoms > 2:
        from singletrack.linear.jax_pencil import pencil_roots  # lazy: optional

        return pencil_roots(model.M[..., None, :, :], *at_speeds(model, v))
    from singletrack.linear.quartic.jax import quartic_roots as jax_quartic_roots  # lazy: optional

    if model.is_undamped:
        return jax_quartic_roots(*characteristic_polynomial(model).monic_at(v))
    return jax_quartic_roots(*monic_quartic(model.M, *at_speeds(model, v)))


def _by_lapack(model: LinearModel, v: np.ndarray) -> np.ndarray:
    """Return eigenvalues (..., k, 2 n) at speeds (k,) from the state matrices, chunk by chunk."""
    p, batch = pencil(model)
    roots = np.empty((len(p), len(v), 2 * p.freedoms), dtype=complex)
    step = max(1, _PROBLEMS // max(len(v), 1))
    for start in range(0, len(p), step):
        rows = slice(start, start + step)
        some = p.rows(rows)
        for first in range(0, len(v), _PROBLEMS):
            columns = slice(first, first + _PROBLEMS)
            found = np.linalg.eigvals(some.state(v[columns] / some.speed[:, None]))
            roots[rows, columns] = np.sort_complex(found) * some.rate[:, None, None]
    roots[~p.told] = np.nan
    return roots.reshape(*batch, *roots.shape[1:])


def _one_axis(speeds: ArrayLike) -> Array:
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


def at_speeds(model: LinearModel, v: Array) -> tuple[Array, Array]:
    """Return C0 + v C1 and S0 + g K0 + v² K2, each of shape (..., k, n, n), at speeds (k,) in m/s."""
    C1, K0, K2 = (_with_axis(matrix) for matrix in (model.C1, model.K0, model.K2))
    column = v[:, None, None]
    gravity = namespace(model.gravity, v).asarray(model.gravity)[..., None, None, None]
    damping, stiffness = column * C1, gravity * K0 + column**2 * K2
    if model.is_undamped:
        return damping, stiffness
    return _with_axis(model.C0) + damping, _with_axis(model.S0) + stiffness


def _with_axis(matrix: Array) -> Array:
    return namespace(matrix).asarray(matrix)[..., None, :, :]


def monic_quartic(M: Array, damping: Array, stiffness: Array) -> tuple[Array, Array, Array, Array]:
    """Return b, c, d, e (..., k) of the characteristic quartic of two freedoms: M (..., 2, 2), the others per speed."""
    M = _with_axis(M)

    def mixed(A: Array, B: Array) -> Array:
        return (
            A[..., 0, 0] * B[..., 1, 1]
            + B[..., 0, 0] * A[..., 1, 1]
            - A[..., 0, 1] * B[..., 1, 0]
            - B[..., 0, 1] * A[..., 1, 0]
        )

    lead = mixed(M, M) / 2
    b, c = mixed(M, damping) / lead, (mixed(damping, damping) / 2 + mixed(M, stiffness)) / lead
    return b, c, mixed(damping, stiffness) / lead, mixed(stiffness, stiffness) / 2 / lead


def eigenmotions(model: LinearModel, speeds: ArrayLike, roots: np.ndarray) -> np.ndarray:
    """Return the eigenmotion of each root: every coordinate, with lean normalised to one.

    Parameters
    ----------
    model : LinearModel
    speeds : array, shape (k,)
        In m/s.
    roots : complex array, shape (..., k, 2 n)
        Eigenvalues at these speeds, in 1/s, in any order.

    Returns
    -------
    complex array, shape (..., k, 2 n, n)
        (1, steer / lean, ...); where lean takes no part, the largest is one: (0, 1) for a motion of pure steer.

    Notes
    -----
    The null vector of P(s) = M s² + (C0 + v C1) s + S0 + g K0 + v² K2: of two freedoms from its larger row, of more
    the singular vector of the least singular value.

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
    if model.freedoms > 2:
        return _null_vectors(model, v, np.asarray(roots))
    damping, stiffness = (np.asarray(part) for part in at_speeds(model, v))
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


def _null_vectors(model: LinearModel, v: np.ndarray, roots: np.ndarray) -> np.ndarray:
    p, batch = pencil(model)
    n = p.freedoms
    flat = np.broadcast_to(roots, (*batch, *roots.shape[-2:])).reshape(len(p), *roots.shape[-2:])
    motions = np.full((*flat.shape, n), np.nan, dtype=complex)
    finite = np.isfinite(flat)
    step = max(1, _PROBLEMS // max(flat[0].size, 1)) if len(flat) else 1
    for start in range(0, len(p), step):
        rows = slice(start, start + step)
        design, at, column = np.nonzero(finite[rows])
        some = p.rows(rows).rows(design)
        s = (flat[rows][design, at, column] / some.rate)[:, None, None]
        u = (v[at] / some.speed)[:, None, None]
        value = s * s * np.eye(n) + s * (some.C0 + u * some.C1) + some.K0 + u * u * some.K2
        motion = np.linalg.svd(value)[2][:, -1].conj() * some.masses
        largest = np.take_along_axis(motion, np.argmax(np.abs(motion), axis=-1)[:, None], axis=-1)
        lean = motion[:, :1]
        no_lean = np.abs(lean) <= 1e-14 * np.abs(largest)
        motion = motion / np.where(no_lean, largest, lean)
        motion[:, :1] = np.where(no_lean, 0.0, 1.0)
        motions[rows][design, at, column] = motion
    return motions.reshape(*batch, *motions.shape[1:])
