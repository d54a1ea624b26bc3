"""Roots of any number of freedoms followed through the speeds, with proof: which root is which between two speeds.

The speeds are cut into intervals until in each of them a disc (or two, about a pair that is near the real axis) can be
drawn about every root from which the root does not get out and into which no other gets. The proof is Gershgorin's
theorem for the state matrix in the basis of its eigenvectors at the middle of the interval, in which it is nearly
diagonal; two roots that nearly meet are taken together as a block of two, so that they may meet, split and pass inside.
The intervals depend on the design alone, never on the speeds that are asked for.

Within an interval roots are put in *places*: discs in a fixed order, and within a block of two the upper root of a pair
or the lower of two real roots first. What the places are called is the business of :mod:`singletrack.linear.naming`.
"""

from __future__ import annotations

from dataclasses import dataclass, fields
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from singletrack.linear.pencil import Pencil

__all__ = ["EDGES", "Branches", "find_branches", "in_order", "places"]

#: Ends of the first intervals, in units of the pencil; above the last one roots keep their order.
EDGES = np.concatenate([[0.0], *(np.array([1.0, 1.5]) * 2.0**k for k in range(-6, 10))])
#: Width of an interval, relative to its speed, that is not cut again: roots that meet by threes, or without splitting.
_NARROWEST = 1e-9
#: Intervals of a design that are cut at a time, at most.
_MOST_OPEN = 200
#: Two roots are taken together if they are nearer to each other than this part of their distance from any other.
_TOGETHER = 0.25


@dataclass(frozen=True, eq=False)
class Branches:
    """Intervals of speed of designs, r of them, and the discs of their N roots; in units of the pencil.

    Attributes
    ----------
    design : int array, shape (r,)
    low, high : array, shape (r,)
    centre : complex array, shape (r, 3, N)
        Centre of each disc as a polynomial of the distance from the interval's middle, constant term first.
    radius : array, shape (r, N)
    block : int array, shape (r, N)
        The place of the first root in the same disc.
    """

    design: np.ndarray
    low: np.ndarray
    high: np.ndarray
    centre: np.ndarray
    radius: np.ndarray
    block: np.ndarray

    def rows(self, which: np.ndarray) -> Branches:
        """Return some intervals.

        Parameters
        ----------
        which : array, shape (r,)
            Indices, or a mask of all intervals.
        """
        return Branches(*(getattr(self, one.name)[which] for one in fields(self)))


def find_branches(p: Pencil) -> Branches:
    """Return the intervals of all designs, in any order.

    Parameters
    ----------
    p : Pencil
        Of m designs.
    """
    edges = len(EDGES) - 1
    design = np.repeat(np.arange(len(p)), edges)
    low, high = np.tile(EDGES[:-1], len(p)), np.tile(EDGES[1:], len(p))
    done = []
    while len(design):
        some = _discs(p.rows(design), design, low, high)
        keep = _apart(some)
        row = np.flatnonzero(keep)
        keep[row] = _changes(p.rows(design[row]), some.rows(row)) <= 1
        keep |= high - low <= _NARROWEST * (1 + high)
        # Roots that coincide over a whole range are never told apart: a design with so many open intervals is done.
        keep |= np.bincount(design[~keep], minlength=len(p))[design] > _MOST_OPEN
        done.append(some.rows(keep))
        design, low, high = (a[~keep] for a in (design, low, high))
        middle = (low + high) / 2
        design, low, high = np.tile(design, 2), np.concatenate([low, middle]), np.concatenate([middle, high])
    return Branches(*(np.concatenate([getattr(part, one.name) for part in done]) for one in fields(Branches)))


def _discs(p: Pencil, design: np.ndarray, low: np.ndarray, high: np.ndarray) -> Branches:
    middle, half = (low + high) / 2, (high - low) / 2
    roots, vectors = np.linalg.eig(p.state(middle[:, None])[:, 0])
    roots, vectors = roots.astype(complex), vectors.astype(complex)
    partner = _partners(roots)
    order, block = _places_of_blocks(partner)
    roots = np.take_along_axis(roots, order, axis=-1)
    basis = _basis(np.take_along_axis(vectors, order[:, None, :], axis=-1), block)
    same = block[:, :, None] == block[:, None, :]
    gap = np.where(same, np.inf, np.abs(roots[:, :, None] - roots[:, None, :])).min(axis=-1)
    constant, linear, square = _in_basis(p, middle, basis, gap)
    h = half[:, None, None]
    size = np.abs(constant) + h * np.abs(linear) + h * h * np.abs(square)
    # A block's off-diagonal part: all of its rows together.
    outside = np.where(same, 0.0, size).sum(axis=-1)
    outside = (same * outside[:, None, :]).sum(axis=-1)
    parts = np.stack([constant, linear, square], axis=1)
    count = same.sum(axis=-1)
    diagonal = np.diagonal(parts, axis1=-2, axis2=-1)
    centre = (same[:, None] * diagonal[:, :, None, :]).sum(axis=-1) / count[:, None]
    # What a block of two does inside: its own roots' distance, what changes, and how far it is from normal.
    inner = np.where(same[:, None], parts - centre[..., None] * np.eye(parts.shape[-1]), 0.0)
    square_norms = (np.abs(inner) ** 2).sum(axis=-1)
    norms = np.sqrt((same[:, None] * square_norms[:, :, None, :]).sum(axis=-1))
    spread = np.abs(roots - centre[:, 0])
    spread = np.max(np.where(same, spread[:, None, :], 0.0), axis=-1)
    two = count > 1
    change = outside + np.where(two, half[:, None] * norms[:, 1] + half[:, None] ** 2 * norms[:, 2], 0.0)
    departure = np.where(two, norms[:, 0], 0.0)
    radius = np.where(two, spread, 0.0) + (change + np.sqrt(change * change + 4 * change * departure)) / 2
    return Branches(design, low, high, centre, radius, block)


def _partners(roots: np.ndarray) -> np.ndarray:
    """Return for each root (r, N) the place of the one it may meet soon, its own where there is none.

    That is the conjugate of a complex root, the nearest real root of a real one, if both are nearer to each other than
    to any other root.
    """
    count = roots.shape[-1]
    own = np.eye(count, dtype=bool)
    gap = np.where(own, np.inf, np.abs(roots[:, :, None] - roots[:, None, :]))
    real = roots.imag == 0
    allowed = (real[:, :, None] & real[:, None, :]) | (
        ~real[:, :, None] & (roots[:, :, None] == roots[:, None, :].conj())
    )
    partner = np.argmin(np.where(allowed & ~own, gap, np.inf), axis=-1)
    inside = np.take_along_axis(np.where(allowed & ~own, gap, np.inf), partner[..., None], axis=-1)[..., 0]
    mutual = np.take_along_axis(partner, partner, axis=-1) == np.arange(count)
    of_two = own | (np.arange(count) == partner[..., None])
    others = np.where(of_two, np.inf, gap).min(axis=-1)
    others = np.minimum(others, np.take_along_axis(others, partner, axis=-1))
    together = mutual & np.isfinite(inside) & (inside < _TOGETHER * others)
    return np.where(together, partner, np.arange(count))


def _places_of_blocks(partner: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return an order (r, N) in which roots of a block are neighbours, and each place's first place of its block."""
    count = partner.shape[-1]
    first = np.minimum(partner, np.arange(count))
    order = np.argsort(first, axis=-1, kind="stable")
    first = np.take_along_axis(first, order, axis=-1)
    block = np.argmax(first[:, :, None] == first[:, None, :], axis=-1)
    return order, block


def _basis(vectors: np.ndarray, block: np.ndarray) -> np.ndarray:
    """Return eigenvectors (r, N, N) as columns, of each block of two an orthonormal basis of what they span."""
    before = np.roll(vectors, 1, axis=-1)
    second = block != np.arange(block.shape[-1])
    along = (before.conj() * vectors).sum(axis=-2, keepdims=True)
    apart = vectors - along * before
    norm = np.linalg.norm(apart, axis=-2, keepdims=True)
    return np.where(second[:, None, :], apart / np.where(norm > 0, norm, 1.0), vectors)


def _in_basis(p: Pencil, middle: np.ndarray, basis: np.ndarray, gap: np.ndarray) -> list[np.ndarray]:
    """Return the state matrix about the middle, its terms of order 0, 1 and 2, in a basis.

    Its columns are scaled so that entries and their mirror images are alike, relative to the gaps (r, N) about the
    roots: a root far from all others may have a large disc.
    """
    n = p.freedoms
    singular = np.linalg.slogdet(basis)[0] == 0
    basis = np.where(singular[:, None, None], np.eye(2 * n), basis)
    inverse = np.linalg.inv(basis)
    singular |= ~(np.linalg.norm(inverse, axis=(-2, -1)) * np.linalg.norm(basis, axis=(-2, -1)) < 1e12)
    scale = np.sqrt(np.linalg.norm(inverse, axis=-1) / np.linalg.norm(basis, axis=-2) / np.where(gap > 0, gap, 1.0))
    basis, inverse = basis * scale[:, None, :], inverse / scale[:, :, None]
    linear, square = np.zeros_like(basis), np.zeros_like(basis)
    linear[:, n:, :n], linear[:, n:, n:] = -2 * middle[:, None, None] * p.K2, -p.C1
    square[:, n:, :n] = -p.K2
    parts = [inverse @ part @ basis for part in (p.state(middle[:, None])[:, 0].astype(complex), linear, square)]
    parts[0][singular] = np.nan  # nothing is proved
    return parts


def _apart(b: Branches) -> np.ndarray:
    """Return whether discs of different blocks stay apart throughout each interval (r,)."""
    half = ((b.high - b.low) / 2)[:, None, None]
    gap = np.abs(b.centre[:, :, :, None] - b.centre[:, :, None, :])
    least = gap[:, 0] - half * gap[:, 1] - half * half * gap[:, 2]
    clear = least > b.radius[:, :, None] + b.radius[:, None, :]
    same = b.block[:, :, None] == b.block[:, None, :]
    apart: np.ndarray = (clear | same).all(axis=(-2, -1))
    return apart


def _changes(p: Pencil, b: Branches) -> np.ndarray:
    """Return how often a block of two in each interval (r,) turns from real roots to a pair or back.

    Beside both ends and the middle it is looked at where the square of the difference of its roots, which changes
    nearly as a parabola, is extreme: there two real roots may be a pair for a short while.
    """
    half = (b.high - b.low) / 2
    speeds = np.stack([b.low, b.low + half, b.high], axis=-1)
    found = [_placed(p, b, speeds[:, k]) for k in range(3)]
    first = np.roll(b.block, -1, axis=-1) == b.block  # the first of two
    low, middle, high = (np.where(first, (roots - np.roll(roots, -1, axis=-1)) ** 2, 0.0).real for roots in found)
    bend, slope = (low - 2 * middle + high) / 2, (high - low) / 2
    with np.errstate(divide="ignore", invalid="ignore"):
        extreme = -slope / (2 * bend)
        value = middle + slope * extreme / 2
    inside = first & (np.abs(extreme) < 1) & (np.sign(low) == np.sign(high))
    # Of several blocks the one whose extreme is nearest to, or farthest beyond, a meeting.
    nearest = np.argmin(np.where(inside, value * np.sign(low), np.inf), axis=-1)
    row = np.flatnonzero(inside.any(axis=-1))
    t = np.take_along_axis(extreme, nearest[:, None], axis=-1)[row, 0]
    between = found[1].copy()
    between[row] = _placed(p.rows(row), b.rows(row), b.low[row] + half[row] * (1 + t))
    real = np.stack([found[0].imag == 0, between.imag == 0, found[1].imag == 0, found[2].imag == 0])
    steps = (real[0] != real[2]).astype(int) + (real[2] != real[3]) + 2 * ((real[0] == real[3]) & (real[1] != real[0]))
    changes: np.ndarray = np.where(first, steps, 0).sum(axis=-1)
    return changes


def _placed(p: Pencil, b: Branches, v: np.ndarray) -> np.ndarray:
    """Return the roots (r, N) at speeds (r,) in their places."""
    return places(b, np.sort_complex(np.linalg.eigvals(p.state(v[:, None])))[:, 0], v)


def places(b: Branches, roots: np.ndarray, v: np.ndarray) -> np.ndarray:
    """Return roots (r, N) at speeds (r,) in their places; a permutation, whatever the roots.

    Parameters
    ----------
    b : Branches
        The r intervals in which the speeds lie.
    roots : array, shape (r, N)
        In the pencil's units.
    v : array, shape (r,)
        In the pencil's units.
    """
    t = (v - (b.low + b.high) / 2)[:, None]
    centre = b.centre[:, 0] + t * b.centre[:, 1] + t * t * b.centre[:, 2]
    outside = np.abs(roots[:, :, None] - centre[:, None, :]) - b.radius[:, None, :]
    disc = np.argmin(np.where(np.isnan(outside), np.inf, outside), axis=-1)
    block = np.take_along_axis(b.block, disc, axis=-1)
    order = np.lexsort((roots.real, -roots.imag, block))
    return np.take_along_axis(roots, order, axis=-1)


def in_order(roots: np.ndarray) -> np.ndarray:
    """Return roots (..., N) in an order that lasts above all meetings: real ones ascending, then pairs by modulus."""
    pair = roots.imag != 0
    size = np.where(pair, np.abs(roots), roots.real)
    return np.take_along_axis(roots, np.lexsort((-roots.imag, size, pair)), axis=-1)
