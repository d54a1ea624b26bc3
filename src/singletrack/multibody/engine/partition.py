"""Which coordinates and speeds are independent, and which constraints say nothing new (rank-revealing)."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from scipy.linalg import lu, qr

from singletrack.errors import ModelError, unknown_name

if TYPE_CHECKING:
    from collections.abc import Sequence

    from singletrack.multibody.engine.system import System

__all__ = ["Partition", "independent_rows", "partition"]

RANK_TOLERANCE = 1e-9


@dataclass(frozen=True)
class Partition:
    """A choice of independent coordinates and speeds, as indices into the joint coordinates.

    Attributes
    ----------
    rows
        Constraint rows that are independent of those before them.
    redundant
        Names of the rows that are not.
    holonomic_count
        How many of ``rows`` are holonomic.
    dependent_coordinates, independent_coordinates
        By the holonomic constraints.
    dependent_speeds, independent_speeds
        By all constraints; the independent speeds are the degrees of freedom.
    pivots
        The ``rows`` in the order in which to eliminate the dependent speeds, one for each.
    """

    rows: tuple[int, ...]
    redundant: tuple[str, ...]
    holonomic_count: int
    dependent_coordinates: tuple[int, ...]
    independent_coordinates: tuple[int, ...]
    dependent_speeds: tuple[int, ...]
    independent_speeds: tuple[int, ...]
    pivots: tuple[int, ...]


def independent_rows(matrix: np.ndarray[Any, Any], tolerance: float = RANK_TOLERANCE) -> list[int]:
    """Return the rows of a matrix (m, n) that are not combinations of earlier ones, to a relative tolerance.

    >>> independent_rows(np.array([[1.0, 0.0], [2.0, 0.0], [1.0, 1.0]]))
    [0, 2]
    """
    basis: list[np.ndarray[Any, Any]] = []
    kept = []
    scale = np.max(np.linalg.norm(matrix, axis=1), initial=0.0)
    for i, row in enumerate(matrix):
        rest = row.copy()
        for _ in range(2):  # the second pass repairs the rounding of the first
            for vector in basis:
                rest -= (vector @ rest) * vector
        size = np.linalg.norm(rest)
        if size > tolerance * max(np.linalg.norm(row), 1e-3 * scale):
            basis.append(rest / size)
            kept.append(i)
    return kept


def _pivots(matrix: np.ndarray[Any, Any], candidates: Sequence[int]) -> list[int]:
    """Return as many candidate columns as the matrix has rows, the best conditioned that QR with pivoting finds."""
    if not len(matrix):
        return []
    _, triangle, order = qr(matrix[:, list(candidates)], mode="economic", pivoting=True)
    diagonal = np.abs(np.diag(triangle))
    if len(diagonal) < len(matrix) or diagonal[-1] <= RANK_TOLERANCE * diagonal[0]:
        return []
    return sorted(candidates[i] for i in order[: len(matrix)])


def _normalised(matrix: np.ndarray[Any, Any]) -> np.ndarray[Any, Any]:
    size = np.linalg.norm(matrix, axis=1, keepdims=True)
    return matrix / np.where(size > 0.0, size, 1.0)


def _dependent(
    scaled: np.ndarray[Any, Any], count: int, kept: Sequence[int], *, choose: bool
) -> tuple[list[int], list[int]]:
    """Return the dependent coordinates (by the first ``count`` rows) and the dependent speeds (by all rows)."""
    candidates = [i for i in range(scaled.shape[1]) if i not in kept]
    coordinates = _pivots(scaled[:count], candidates)
    if not choose or len(coordinates) != count:
        return coordinates, _pivots(scaled, candidates)
    # dependent coordinates stay dependent as speeds; the rolling rows then choose among the others
    first, rest = scaled[:count], scaled[count:]
    reduced = rest - rest[:, coordinates] @ np.linalg.lstsq(first[:, coordinates], first, rcond=None)[0]
    others = [i for i in candidates if i not in coordinates]
    return coordinates, sorted(coordinates + _pivots(reduced, others))


def partition(
    system: System,
    jacobian: np.ndarray[Any, Any],
    independent: Sequence[str] | None = None,
    held: Sequence[str] = (),
) -> Partition:
    """Choose independent coordinates and speeds for a constraint Jacobian (rows, n).

    Parameters
    ----------
    system
        The machine; its rows name the constraints.
    jacobian
        Holonomic rows, then rolling rows, at an assembled configuration.
    independent
        Coordinates whose rates shall be the independent speeds, by name (default: those of the system, else the
        best conditioned choice).
    held
        Coordinates that must be among them, by name, where the others are chosen.

    Raises
    ------
    ModelError
        Where the chosen speeds are not as many as the degrees of freedom, or do not determine the others.
    """
    names = system.coordinates
    wanted = system.independent if independent is None else tuple(independent)
    for name in wanted or ():
        if name not in names:
            raise ModelError(unknown_name("independent coordinate", name, names))
    holonomic = len(system.holonomic_rows)
    rows = independent_rows(jacobian)
    redundant = tuple(system.rows[i] for i in range(len(jacobian)) if i not in rows)
    freedoms = len(names) - len(rows)
    if wanted is not None and len(wanted) != freedoms:
        note = f" (redundant constraints: {', '.join(redundant)})" if redundant else ""
        raise ModelError(
            f"independent speeds {', '.join(wanted) or 'none'}: the machine has {freedoms} degrees of freedom left, "
            f"not {len(wanted)}{note}"
        )
    kept = [names.index(name) for name in (held if wanted is None else wanted)]
    count = sum(i < holonomic for i in rows)
    coordinates, speeds = _dependent(_normalised(jacobian[rows]), count, kept, choose=wanted is None)
    if len(coordinates) != count or len(speeds) != len(rows):
        raise ModelError(
            f"independent speeds {', '.join(wanted or ())}: they do not determine the other speeds here; "
            "choose others, or leave the choice to the engine"
        )
    return Partition(
        tuple(rows),
        redundant,
        count,
        tuple(coordinates),
        tuple(i for i in range(len(names)) if i not in coordinates),
        tuple(speeds),
        tuple(kept) if wanted is not None else tuple(i for i in range(len(names)) if i not in speeds),
        _pivot_rows(jacobian, rows, speeds),
    )


def _pivot_rows(jacobian: np.ndarray[Any, Any], rows: Sequence[int], speeds: Sequence[int]) -> tuple[int, ...]:
    """Return the rows in the order of partial pivoting, each scaled to length one."""
    if not rows:
        return ()
    order = lu(_normalised(jacobian[list(rows)])[:, list(speeds)], p_indices=True)[0]
    # scipy returns where each row goes; the row that comes to a place is wanted
    return tuple(rows[int(i)] for i in np.argsort(order))
