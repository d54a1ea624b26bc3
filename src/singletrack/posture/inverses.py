"""Solving the loops' equations: block by block where each loop has three joints of its own, else by one inverse.

Which of them solves for a design depends on that design alone, so that no bit depends on the others in its batch.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from singletrack.arrays import Array, as_arrays, is_concrete, is_jax, stack
from singletrack.arrays.faults import Fault, refuse_single
from singletrack.errors import PostureError
from singletrack.posture.twists import cross3, dot3

if TYPE_CHECKING:
    from collections.abc import Callable

    from singletrack.posture.loops import Loops
    from singletrack.posture.seated import Posture

__all__ = ["solver_of", "squared_condition"]

#: Loops whose matrix (of sines of angles, arms scaled to their mean) is closer to singular than this cannot move.
_SINGULAR = 1e-6


def solver_of(
    xp: Any, posture: Posture, loops: Loops, spin: Array, shape: tuple[int, ...]
) -> tuple[Callable[[Array], Array], tuple[Fault, ...]]:
    """Return a function from right sides (rows, p, N) to rates (joints that are not free, p, N), and faults.

    Rates are NaN in designs whose loops cannot move.

    Parameters
    ----------
    xp : namespace
    posture : Posture
    loops : Loops
    spin : array, shape (3, n, N)
        Axes of the joints, as in :class:`singletrack.posture.twists.Motion`.
    shape : tuple of int
        Of the batch of N designs.
    """
    own = posture.tree.points.own
    if own is None or posture.tree.angles.index:
        return _by_inverse(xp, posture, loops.matrix(xp, spin, posture.tree.dependent), shape)
    blocks, doubtful = _blocks(loops, own)
    if doubtful is None or not doubtful.any():
        return blocks, ()
    matrix = np.asarray(loops.matrix(xp, spin, posture.tree.dependent))
    inverse, faults = _by_inverse(np, posture, matrix[..., doubtful], shape, doubtful)

    def of_each(right: Array) -> Array:
        rates = np.array(blocks(right))
        rates[..., doubtful] = inverse(np.asarray(right)[..., doubtful])
        return xp.asarray(rates)

    return of_each, faults


def _blocks(loops: Loops, own: np.ndarray) -> tuple[Callable[[Array], Array], np.ndarray | None]:
    """Return the solver of loops with three joints each of their own, and for which designs (N,) it is doubtful.

    None where JAX does not let that be looked at.
    """
    count = len(own)
    columns, rows, volume = _adjugates(loops, own)
    doubtful = None
    if is_concrete(volume):
        with np.errstate(invalid="ignore"):
            # |A| |A⁻¹| (Frobenius) is at least σmax / σmin.
            clear = abs(np.asarray(_sizes(columns, rows))) * _SINGULAR**2 < abs(np.asarray(volume)) ** 2
        doubtful = np.asarray(~clear.all(axis=0))

    def by_blocks(right: Array) -> Array:
        sides = right.reshape(3, count, *right.shape[1:])
        rates = stack([dot3(row[:, :, None], sides) for row in rows], -3) / volume[:, None, None]
        return rates.reshape(3 * count, *right.shape[1:])

    return by_blocks, doubtful


def _adjugates(loops: Loops, own: np.ndarray) -> tuple[list[Array], list[Array], Array]:
    """Return columns, adjugates' rows (3, L, N) and determinants (L, N) of loops with three joints of their own."""
    mine = loops.columns[:, np.arange(len(own))[:, None], own]
    one, two, three = (mine[:, :, k] for k in range(3))
    rows = [cross3(two, three), cross3(three, one), cross3(one, two)]
    return [one, two, three], rows, dot3(one, rows[0])


def _sizes(columns: list[Array], rows: list[Array]) -> Array:
    """Return |A|² |adj A|² (L, N), Frobenius."""
    one, two, three = (dot3(column, column) for column in columns)
    first, second, third = (dot3(row, row) for row in rows)
    return (one + two + three) * (first + second + third)


def squared_condition(xp: Any, posture: Posture, loops: Loops, spin: Array) -> Array:
    """Return |A|² |A⁻¹|² (N,), Frobenius, of the loops' matrices, summed over loops that are solved one by one.

    Parameters
    ----------
    xp : namespace
    posture : Posture
    loops : Loops
    spin : array, shape (3, n, N)
    """
    own = posture.tree.points.own
    if own is not None and not posture.tree.angles.index:
        columns, rows, volume = _adjugates(loops, own)
        return xp.sum(_sizes(columns, rows) / (volume * volume), axis=0)
    matrix = xp.moveaxis(loops.matrix(xp, spin, posture.tree.dependent), -1, 0)
    return xp.sum(matrix**2, axis=(-2, -1)) * xp.sum(xp.linalg.inv(matrix) ** 2, axis=(-2, -1))


def _by_inverse(
    xp: Any, posture: Posture, matrix: Array, shape: tuple[int, ...], which: np.ndarray | None = None
) -> tuple[Callable[[Array], Array], tuple[Fault, ...]]:
    """Return the solver by inverses of the loops' matrices (rows, joints, k), of those of a mask (N,)."""
    inverse, bad = _inverse(xp.moveaxis(matrix, -1, 0))

    def solve(right: Array) -> Array:
        return xp.moveaxis(xp.matmul(inverse, xp.moveaxis(right, -1, 0)), 0, -1)

    if bad is None or not bad.any():
        return solve, ()
    numbers = np.moveaxis(np.asarray(matrix), -1, 0)
    of_all = np.ones(len(numbers), dtype=bool) if which is None else which
    return solve, refuse_single([_singular(posture, numbers, bad, np.flatnonzero(of_all), len(of_all), shape)])


def _inverse(matrix: Array) -> tuple[Array, np.ndarray | None]:
    """Return the inverses of the loops' matrices (N, rows, joints), NaN where they cannot move, and where that is."""
    xp, (matrix,) = as_arrays(matrix)
    if not is_concrete(matrix):
        return xp.linalg.inv(matrix), None
    numbers = np.asarray(matrix)
    try:
        inverse = np.linalg.inv(numbers)
        # |A| |A⁻¹| (Frobenius) is at least σmax / σmin: enough to clear nearly all, at a tenth of the cost.
        condition = np.linalg.norm(numbers, axis=(-2, -1)) * np.linalg.norm(inverse, axis=(-2, -1))
    except np.linalg.LinAlgError:  # one of them is singular to the last bit
        condition = np.full(numbers.shape[:-2], np.inf)
    finite = np.isfinite(numbers).all(axis=(-2, -1))
    suspect = finite & ~(condition * _SINGULAR < 1)
    bad = np.zeros(finite.shape, dtype=bool)
    if suspect.any():
        singular_values = np.linalg.svd(numbers[suspect], compute_uv=False)
        bad[suspect] = singular_values[..., -1] <= _SINGULAR * singular_values[..., 0]
    if is_jax(matrix) or suspect.any():
        inverse = xp.linalg.inv(xp.where(xp.asarray(bad)[..., None, None], xp.nan, matrix))
    return inverse, bad


def _singular(
    posture: Posture, matrices: Array, bad: np.ndarray, designs: np.ndarray, count: int, shape: tuple[int, ...]
) -> Fault:
    """Return the fault of loops that cannot follow, with the joint and the loop in which it shows for each design."""
    tree = posture.tree
    left, _, right = np.linalg.svd(matrices[bad])
    joints = np.array([posture.joints[k].name for k in tree.dependent])
    rows = [*tree.points.index, *tree.points.index, *tree.points.index, *tree.angles.index]
    loops = np.array([posture.loops[k].name for k in rows])
    mask = np.zeros(count, dtype=bool)
    mask[designs[bad]] = True
    found = {"joint": np.zeros(count, joints.dtype), "loop": np.zeros(count, loops.dtype)}
    found["joint"][mask] = joints[np.argmax(abs(right[:, -1]), axis=-1)]
    found["loop"][mask] = loops[np.argmax(abs(left[:, :, -1]), axis=-1)]
    text = (
        f"posture {posture.name}: the hands cannot follow the grips when steering, because the loops through the arms "
        "are singular (an arm is stretched straight, or its axes line up): joint {joint} is not determined by the "
        "loops, loop {loop} cannot move all ways"
    )
    values = {name: value.reshape(shape) for name, value in found.items()}
    return Fault(mask.reshape(shape), text, values, PostureError)
