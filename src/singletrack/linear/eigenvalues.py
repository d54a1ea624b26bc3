"""Eigenvalues and eigenmotions of the coefficient matrices at given speeds."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from singletrack.arrays import as_arrays, in_stretches, is_jax, namespace, stretches
from singletrack.errors import InputError
from singletrack.linear.characteristic import characteristic_polynomial
from singletrack.linear.pencil import pencil
from singletrack.linear.quartic.solve import CHUNK, quartic_roots, solve_at_speeds

if TYPE_CHECKING:
    from singletrack.arrays import Array, ArrayLike
    from singletrack.linear.characteristic import CharacteristicPolynomial
    from singletrack.model import LinearModel

_FASTEST = 299_792_458.0
#: Eigenvalue problems given to LAPACK at a time.
_PROBLEMS = 4096
#: Designs whose characteristic polynomials are made at a time, at least.
_DESIGNS = 256

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
    v, batch = checked_speeds(speeds), model.shape
    count, undamped = math.prod(batch), model.is_undamped
    valid = np.broadcast_to(model.valid, batch).ravel() if model.faults else None
    roots = np.empty((count, len(v), 2 * model.freedoms), dtype=complex)

    def work(piece: slice) -> None:
        some, own = model.part(piece) if batch else model, roots[piece]
        if model.freedoms > 2:
            own[:] = _by_lapack(some, v)
            return
        with np.errstate(all="ignore"):  # numbers out of range give NaN
            if undamped:
                _roots_at(characteristic_polynomial(some).flat()[0], v, own)
            else:
                own[:] = quartic_roots(*monic_quartic(some.M, *at_speeds(some, v)))
        lost = np.isnan(own[..., 0].real)
        if valid is not None:
            lost &= valid[piece, None]
        if lost.any():
            _told_otherwise(some, v, own, lost)

    least, problems = (1, _PROBLEMS) if model.freedoms > 2 else (_DESIGNS, CHUNK)
    in_stretches(work, count, max(least, problems // max(len(v), 1)))
    if valid is not None:
        roots[~valid] = np.nan
    return roots.reshape(*batch, *roots.shape[1:])


def _told_otherwise(model: LinearModel, v: np.ndarray, roots: np.ndarray, lost: np.ndarray) -> None:
    """Write the roots (m, k, 4) that are lost, whose quartic was out of range, as found in other units."""
    designs = lost.any(axis=-1)
    roots[designs] = np.where(
        lost[designs][..., None], _by_lapack(model.broadcast_to((len(roots),))[designs], v), roots[designs]
    )


def _jax_eigenvalues(model: LinearModel, v: Array) -> Array:
    if model.freedoms > 2:
        from singletrack.linear.jax_pencil import pencil_roots  # lazy: optional

        return pencil_roots(model.M[..., None, :, :], *at_speeds(model, v))
    from singletrack.linear.quartic.jax import quartic_roots as jax_quartic_roots  # lazy: optional

    if model.is_undamped:
        return jax_quartic_roots(*characteristic_polynomial(model).monic_at(v))
    return jax_quartic_roots(*monic_quartic(model.M, *at_speeds(model, v)))


def _by_lapack(model: LinearModel, v: np.ndarray) -> np.ndarray:
    """Return eigenvalues (..., k, 2 n) at speeds (k,) from the state matrices."""
    p, batch = pencil(model)
    roots = np.empty((len(p), len(v), 2 * p.freedoms), dtype=complex)

    def work(piece: slice) -> None:
        found = np.linalg.eigvals(p.state(v[piece] / p.speed[:, None]))
        roots[:, piece] = np.sort_complex(found) * p.rate[:, None, None]

    in_stretches(work, len(v), max(1, _PROBLEMS // max(len(p), 1)))
    roots[~p.told] = np.nan
    return roots.reshape(*batch, *roots.shape[1:])


def _one_axis(speeds: ArrayLike) -> Array:
    xp, (v,) = as_arrays(speeds)
    return xp.reshape(v, (-1,))


def _roots_at(polynomials: CharacteristicPolynomial, v: np.ndarray, roots: np.ndarray) -> None:
    """Write the roots (m, k, 4) of m polynomials at speeds (k,)."""
    ratios = polynomials.ratios()
    if len(roots) * len(v) <= CHUNK:
        solve_at_speeds(roots, ratios, v)
        return
    for rows in stretches(len(roots), max(1, CHUNK // max(len(v), 1))):
        some, own = ratios[:, rows], roots[rows]

        def work(piece: slice, some: np.ndarray = some, own: np.ndarray = own) -> None:
            solve_at_speeds(own[:, piece], some, v[piece])

        in_stretches(work, len(v), max(1, CHUNK // max(len(own), 1)))


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
    v, found = checked_speeds(speeds), np.asarray(roots)
    batch, k, n = np.broadcast_shapes(model.shape, found.shape[:-2]), len(v), model.freedoms
    flat = np.broadcast_to(found, (*batch, k, 2 * n)).reshape(math.prod(batch), k, 2 * n)
    whole = model if model.shape == batch else model.broadcast_to(batch)
    motions = np.empty((*flat.shape, n), dtype=complex)

    def work(piece: slice) -> None:
        some = whole.part(piece)

        def at(when: slice) -> None:
            motions[piece, when] = _null_vectors(some, v[when], flat[piece, when])

        in_stretches(at, k, max(1, CHUNK // max(len(flat[piece]), 1)))

    in_stretches(work, len(flat), max(1, CHUNK // max(k, 1)))
    return motions.reshape(*batch, k, 2 * n, n)


def _null_vectors(model: LinearModel, v: np.ndarray, roots: np.ndarray) -> np.ndarray:
    """Return the eigenmotions (m, k, 2 n, n) of roots (m, k, 2 n)."""
    if model.freedoms > 2:
        return _null_vectors_by_lapack(model, v, roots)
    damping, stiffness = (np.asarray(part) for part in at_speeds(model, v))
    M = np.asarray(model.M)[..., None, :, :]
    square = roots * roots

    def entry(i: int, j: int) -> np.ndarray:
        m, c, k = (part[..., i, j, None] for part in (M, damping, stiffness))
        result: np.ndarray = m * square + c * roots + k
        return result

    def size(z: np.ndarray) -> np.ndarray:
        result: np.ndarray = np.abs(z.real) + np.abs(z.imag)
        return result

    (a, b), (c, d) = [[entry(i, j) for j in range(2)] for i in range(2)]
    upper = size(a) + size(b) >= size(c) + size(d)
    lean, steer = np.where(upper, b, d), -np.where(upper, a, c)
    pure_steer = size(lean) <= np.finfo(float).tiny
    motions = np.ones((*roots.shape, 2), dtype=complex)
    with np.errstate(invalid="ignore"):  # faulty designs of a batch are NaN throughout
        motions[..., 1] = steer / np.where(pure_steer, 1.0, lean)
    motions[pure_steer] = (0.0, 1.0)
    return motions


def _null_vectors_by_lapack(model: LinearModel, v: np.ndarray, roots: np.ndarray) -> np.ndarray:
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
