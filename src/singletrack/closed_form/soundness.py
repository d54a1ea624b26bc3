"""What is plainly sound: well within what the equations for arrays let pass, for one design and for many alike."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from singletrack.arrays import Array
    from singletrack.parameters import Rider
    from singletrack.posture import Margins

__all__ = ["CONDITION", "DEFINITE", "INERTIA", "REACH", "RESIDUAL", "is_definite", "sits"]

#: Limbs' reach, residual and condition of loops, inertia of a free joint, mass matrix.
REACH = 1e-9
RESIDUAL, CONDITION, INERTIA = 1e-12, 1e8, 1e-9
DEFINITE = 1e-6


def sits(margins: Margins, rider: Rider) -> Array:
    """Tell of which designs (...) limbs reach and fold and the arms follow the steer, with room to spare.

    Parameters
    ----------
    margins : Margins
    rider : Rider
    """
    sound = np.asarray(margins.residual) < RESIDUAL
    sound = sound & (np.asarray(margins.condition) < CONDITION) & (np.asarray(margins.inertia) > INERTIA)
    for share, upper, lower in (
        (margins.arm, rider.upper_arm_length, rider.lower_arm_length),
        (margins.leg, rider.upper_leg_length, rider.lower_leg_length),
    ):
        most, least = np.add(upper, lower), np.abs(np.subtract(upper, lower))
        sound = sound & (share < 1 - REACH) & (share * most > least + REACH)
    result: Array = sound
    return result


def is_definite(entries: Array, n: int) -> Array:
    """Tell where a mass matrix is positive definite without any doubt.

    Parameters
    ----------
    entries : array, shape (k, ...)
        The first n x n are those of the matrix.
    n : int
        2 or 3.
    """
    diagonal = entries[0 : n * n : n + 1]
    positive = np.min(diagonal, axis=0) > 0
    a = entries[1] / np.sqrt(diagonal[0] * diagonal[1])
    if n == 2:
        return positive & (abs(a) < 1 - DEFINITE)
    b = entries[2] / np.sqrt(diagonal[0] * diagonal[2])
    c = entries[5] / np.sqrt(diagonal[1] * diagonal[2])
    # Leading minors of M scaled to a unit diagonal; its least eigenvalue is at least 4/9 of the last one.
    return positive & (abs(a) < 1 - DEFINITE) & (1 + 2 * a * b * c - a * a - b * b - c * c > DEFINITE)
