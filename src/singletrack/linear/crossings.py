"""Where roots cross the imaginary axis, any number of freedoms: as roots of polynomials in the speed, not by scanning.

*Real roots* cross zero where det(K0 + v² K2) = 0. *Pairs* cross where two roots add up to zero. The bialternate product
2 A ⊙ 1 of the state matrix A has the sums of all pairs of A's roots as eigenvalues; A is a polynomial in v of degree
two, so that the speeds are the eigenvalues of a quadratic eigenproblem. What that finds (also two real roots of
opposite sign, which are no crossing) is refined until it is exact and kept if it is one.

Refining uses a scalar g(s, v) that vanishes with det P(s, v) and can be differentiated: the last component of the
solution of the bordered system [P b; c* 0] (x, g) = (0, 1). Its first and second derivatives give the root's path
s(v) ≈ s + s' d + s'' d²/2, whose two zeros of the real part start Newton's method, so that crossings which nearly
coincide are told apart, and a path that only touches the axis gives none.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from singletrack.linear.pencil import Pencil

__all__ = ["Crossings", "pair_crossings", "real_crossings"]

#: Where the eigenproblems are inverted: any number will do that is no crossing.
_SHIFT = -0.6180339887498949
#: Designs whose eigenproblems are solved at a time.
_CHUNK = 128
#: Least speed and frequency, in units of the pencil, that count as positive.
_POSITIVE = 1e-9
#: Error of a root's real part that rounding explains, relative to the root.
_ROUNDING = 64 * np.finfo(float).eps


@dataclass(frozen=True, eq=False)
class Crossings:
    """Crossings of m designs, one row each, NaN where there are fewer, ascending; in units of the pencil.

    Attributes
    ----------
    speeds : array, shape (m, k)
    growth : array, shape (m, k)
        Change of the root's real part with speed: positive where stability is lost.
    motions : array, shape (m, k, n)
        How much each coordinate takes part, in units that make masses alike.
    told : bool array, shape (m,)
        False where the eigenproblem says nothing: some roots add up to zero at every speed.
    """

    speeds: np.ndarray
    growth: np.ndarray
    motions: np.ndarray
    told: np.ndarray


@dataclass(frozen=True, eq=False)
class _Path:
    """A root's path at some speed: the root s nearest by, its derivatives with respect to v, its motion; shape (r,)."""

    s: np.ndarray
    first: np.ndarray
    second: np.ndarray
    motion: np.ndarray


def real_crossings(p: Pencil) -> Crossings:
    """Return where real roots cross zero: positive roots of det(K0 + v² K2)."""
    shifted = p.K0 + _SHIFT * p.K2
    regular = _regular(shifted)
    inverse = np.linalg.inv(np.where(regular[:, None, None], shifted, np.eye(p.freedoms)))
    with np.errstate(divide="ignore", invalid="ignore"):
        u = _SHIFT - 1 / np.linalg.eigvals(inverse @ p.K2).astype(complex)
        v = np.sqrt(np.where(u.real > 0, u.real, np.nan))
    near = regular[:, None] & np.isfinite(v) & (np.abs(u.imag) <= 1e-3 * np.abs(u)) & (v < 1e9)
    design, column = np.nonzero(near)
    found = _refined(p.rows(design), v[design, column], np.zeros(len(design), dtype=complex), real=True)
    return _collected(design, found, p, regular)


def pair_crossings(p: Pencil) -> Crossings:
    """Return where pairs of roots cross the imaginary axis."""
    parts = [_pair_candidates(p.rows(slice(k, k + _CHUNK))) for k in range(0, len(p), _CHUNK)]
    v = np.concatenate([part[0] for part in parts]) if parts else np.empty((0, 1))
    told = np.concatenate([part[1] for part in parts]) if parts else np.empty(0, dtype=bool)
    design, column = np.nonzero(np.isfinite(v))
    v = v[design, column]
    roots = np.linalg.eigvals(p.rows(design).state(v[:, None])[:, 0]).astype(complex)
    row, column = np.nonzero((roots.imag > _POSITIVE) & (np.abs(roots.real) <= 0.3 * np.abs(roots)))
    found = _refined(p.rows(design[row]), v[row], roots[row, column], real=False)
    return _collected(design[row], found, p, told)


def _pair_candidates(p: Pencil) -> tuple[np.ndarray, np.ndarray]:
    """Return positive, nearly real eigenvalues v (m, k) of the bialternate product, NaN for others; what is told."""
    n = p.freedoms
    lift = _bialternate(2 * n)
    zero, one, two = (np.zeros((len(p), 2 * n, 2 * n)) for _ in range(3))
    zero[:, :n, n:] = np.eye(n)
    zero[:, n:, :n], zero[:, n:, n:] = -p.K0, -p.C0
    one[:, n:, n:], two[:, n:, :n] = -p.C1, -p.K2
    B0, B1, B2 = (np.einsum("PQij,mij->mPQ", lift, part) for part in (zero, one, two))
    # With v = shift + 1/w: w² B(shift) + w B'(shift) + B2, of which w are the eigenvalues of the companion matrix.
    shifted = B0 + _SHIFT * B1 + _SHIFT**2 * B2
    told = _regular(shifted)
    inverse = np.linalg.inv(np.where(told[:, None, None], shifted, np.eye(shifted.shape[-1])))
    size = shifted.shape[-1]
    companion = np.zeros((len(p), 2 * size, 2 * size))
    companion[:, :size, :size] = -inverse @ (B1 + 2 * _SHIFT * B2)
    companion[:, :size, size:] = -inverse @ B2
    companion[:, size:, :size] = np.eye(size)
    with np.errstate(divide="ignore", invalid="ignore"):
        v = _SHIFT + 1 / np.linalg.eigvals(companion).astype(complex)
        near = told[:, None] & (v.real > _POSITIVE) & (v.real < 1e9) & (np.abs(v.imag) <= 1e-2 * v.real)
    return np.where(near, v.real, np.nan), told


def _regular(matrices: np.ndarray) -> np.ndarray:
    size = np.linalg.svd(matrices, compute_uv=False)
    regular: np.ndarray = size[:, -1] > 1e-14 * size[:, 0]
    return regular


@cache
def _bialternate(size: int) -> np.ndarray:
    """Return the tensor (P, P, size, size) that makes the bialternate product 2 A ⊙ 1 of a matrix A.

    On the antisymmetric products e_p ∧ e_q, A acts as A e_p ∧ e_q + e_p ∧ A e_q.
    """
    pairs = [(p, q) for p in range(size) for q in range(p)]
    place = {pair: k for k, pair in enumerate(pairs)}
    tensor = np.zeros((len(pairs), len(pairs), size, size))
    for (p, q), column in place.items():
        for i in range(size):
            for one, other, entry in ((i, q, (i, p)), (p, i, (i, q))):
                if one != other:
                    tensor[place[max(one, other), min(one, other)], column][entry] += 1.0 if one > other else -1.0
    return tensor


def _refined(p: Pencil, v: np.ndarray, s: np.ndarray, *, real: bool) -> tuple[np.ndarray, ...]:
    """Return crossings near v (r,) with roots near s (r,): speeds (NaN: none), frequencies, doubts, growth, motions."""
    at = _bordered(p, s, v)
    start = _path(p, s, v, at)
    steps = _zeros_of_real_part(start, real=real)
    far = np.abs(steps) > 0.2 * v[:, None]
    with np.errstate(all="ignore"):
        speeds = np.where(far, np.nan, v[:, None] + steps).ravel()
        twice = np.repeat(np.arange(len(v)), 2)
        q, border = p.rows(twice), (at[0][twice], at[1][twice])
        omega = (start.s[twice] + start.first[twice] * steps.ravel()).imag * (not real)
        step = np.full(len(twice), np.nan)
        for _ in range(8):
            path = _path(q, 1j * omega, np.where(np.isfinite(speeds), speeds, 1.0), border)
            step = -path.s.real / path.first.real
            speeds = speeds + step
            omega = (path.s + path.first * step).imag * (not real)
        path = _path(q, 1j * omega, np.where(np.isfinite(speeds), speeds, 1.0), border)
        good = (np.abs(step) <= 1e-7 * speeds) & (speeds > _POSITIVE) & (real | (omega > 1e-7))
        good &= np.abs(path.s - 1j * omega) <= 1e-7 * (1 + np.abs(omega))
        good &= np.abs(speeds - v[twice]) <= 0.4 * v[twice]
        growth = path.first.real
        doubt = _ROUNDING * (1 + np.abs(omega)) / np.abs(growth)
    return np.where(good, speeds, np.nan), omega, doubt, growth, path.motion


def _zeros_of_real_part(path: _Path, *, real: bool) -> np.ndarray:
    """Return both steps d (r, 2) at which s + s' d + s'' d²/2 has no real part; NaN where there are none."""
    a, b, c = path.second.real / 2, path.first.real, path.s.real
    with np.errstate(all="ignore"):
        discriminant = b * b - 4 * a * c
        # Where rounding decides whether the path crosses twice or only touches, it counts as touching.
        discriminant[np.abs(discriminant) <= 4 * np.abs(a) * _ROUNDING * (1 + np.abs(path.s))] = np.nan
        half = -0.5 * (b + np.copysign(np.sqrt(discriminant), b))
        steps = np.stack([c / half, half / a], axis=-1)
        steps = np.where(np.isfinite(steps), steps, np.nan)
        if real:  # s = 0 is no root of the pencil at this speed yet: its path says less than a step of Newton's
            steps = np.where(np.isfinite(steps), steps, np.stack([-c / b, -c / b], axis=-1))
    return steps


def _bordered(p: Pencil, s: np.ndarray, v: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return borders b, c (r, n) that make the bordered system regular: the singular vectors of the least value."""
    left, _, right = np.linalg.svd(_value(p, s, v))
    return left[:, :, -1], right[:, -1, :]


def _value(p: Pencil, s: np.ndarray, v: np.ndarray) -> np.ndarray:
    s, v = s[:, None, None], v[:, None, None]
    value: np.ndarray = s * s * np.eye(p.freedoms) + s * (p.C0 + v * p.C1) + p.K0 + v * v * p.K2
    return value


def _path(p: Pencil, s: np.ndarray, v: np.ndarray, border: tuple[np.ndarray, np.ndarray]) -> _Path:
    """Return the path of the root near s (r,) at speeds v (r,)."""
    n, b, c = p.freedoms, *border
    system = np.zeros((len(s), n + 1, n + 1), dtype=complex)
    system[:, :n, :n], system[:, :n, n], system[:, n, :n] = _value(p, s, v), b, c
    singular = ~np.isfinite(system).all(axis=(1, 2)) | (np.linalg.slogdet(np.nan_to_num(system))[0] == 0)
    system[singular] = np.eye(n + 1)
    inverse = np.linalg.inv(system)
    x, g = inverse[:, :n, n], inverse[:, n, n]
    by_s = 2 * s[:, None, None] * np.eye(n) + p.C0 + v[:, None, None] * p.C1
    by_v = s[:, None, None] * p.C1 + 2 * v[:, None, None] * p.K2

    def solved(*terms: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        both = -(inverse[:, :, :n] @ sum(terms)[..., None])[..., 0]  # type: ignore[index]
        return both[:, :n], both[:, n]

    def times(matrix: np.ndarray, vector: np.ndarray) -> np.ndarray:
        product: np.ndarray = (matrix @ vector[..., None])[..., 0]
        return product

    x_s, g_s = solved(times(by_s, x))
    x_v, g_v = solved(times(by_v, x))
    g_ss = solved(2 * x, 2 * times(by_s, x_s))[1]
    g_sv = solved(times(p.C1, x), times(by_s, x_v), times(by_v, x_s))[1]
    g_vv = solved(2 * times(p.K2, x), 2 * times(by_v, x_v))[1]
    with np.errstate(all="ignore"):
        first = -g_v / g_s
        # The root at this speed by a step of Halley's method, and its path to second order.
        root = s - 2 * g * g_s / (2 * g_s * g_s - g * g_ss)
        second = -(g_vv + 2 * g_sv * first + g_ss * first * first) / g_s
    first = np.where(singular, np.nan, first)
    return _Path(root, first, second, np.abs(x) * p.weights)


def _collected(design: np.ndarray, found: tuple[np.ndarray, ...], p: Pencil, told: np.ndarray) -> Crossings:
    """Put crossings, two candidates (2 r,) for each of the designs (r,), into rows (m, k), each once."""
    design = np.repeat(design, 2)
    design, *values = (a[np.isfinite(found[0])] for a in (design, *found[:-1], *found[-1].T))
    order = np.lexsort((values[0], design))
    rows = _padded(design[order], len(p), *(value[order] for value in values))
    v, w, doubt, growth = rows[:4]
    with np.errstate(invalid="ignore"):
        near = np.abs(v[:, :, None] - v[:, None, :]) <= 1e-9 * v[:, :, None] + doubt[:, :, None]
        near &= np.abs(w[:, :, None] - w[:, None, :]) <= 1e-5 * (1e-3 + np.abs(w[:, :, None]))
        same = np.sign(growth[:, :, None]) == np.sign(growth[:, None, :])
    again = (near & same & np.tri(v.shape[1], k=-1, dtype=bool)).any(axis=-1)
    design, column = np.nonzero(np.isfinite(v) & ~again)
    kept = _padded(design, len(p), *(a[design, column] for a in rows))
    return Crossings(kept[0], kept[3], np.stack(kept[4:], axis=-1), told & p.told)


def _padded(design: np.ndarray, count: int, *values: np.ndarray) -> list[np.ndarray]:
    """Return values (r,), ordered by their design, as rows (count, k), NaN where there are fewer."""
    sizes = np.bincount(design, minlength=count)
    column = np.arange(len(design)) - np.repeat(np.cumsum(sizes) - sizes, sizes)
    rows = []
    for value in values:
        row = np.full((count, int(sizes.max(initial=0))), np.nan)
        row[design, column] = value
        rows.append(row)
    return rows
