"""What is plainly sound: well within what the equations for arrays let pass, for one design and for many alike."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    from singletrack.arrays import Array
    from singletrack.parameters import Rider
    from singletrack.posture import Margins

__all__ = ["is_definite", "sits"]

#: Limbs' reach, residual and condition of loops, inertia of a free joint, mass matrix.
_REACH = 1e-9
_RESIDUAL, _CONDITION, _INERTIA = 1e-12, 1e8, 1e-9
_DEFINITE = 1e-6


def sits(margins: Margins, rider: Rider) -> Any:
    """Tell of which designs limbs reach and fold and the arms follow the steer, with room to spare.

    Parameters
    ----------
    margins : Margins
    rider : Rider
    """
    sound = (margins.residual < _RESIDUAL) & (margins.condition < _CONDITION) & (margins.inertia > _INERTIA)
    for share, upper, lower in (
        (margins.arm, rider.upper_arm_length, rider.lower_arm_length),
        (margins.leg, rider.upper_leg_length, rider.lower_leg_length),
    ):
        sound = sound & (share < 1 - _REACH) & (share * (upper + lower) > abs(upper - lower) + _REACH)
    return sound


def is_definite(entries: Array, n: int) -> Any:
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
        return positive & (abs(a) < 1 - _DEFINITE)
    b = entries[2] / np.sqrt(diagonal[0] * diagonal[2])
    c = entries[5] / np.sqrt(diagonal[1] * diagonal[2])
    # Leading minors of M scaled to a unit diagonal; its least eigenvalue is at least 4/9 of the last one.
    return positive & (abs(a) < 1 - _DEFINITE) & (1 + 2 * a * b * c - a * a - b * b - c * c > _DEFINITE)
