"""One sound design by its structure's program: a thousand scalar statements instead of a thousand small arrays.

What is not plainly sound is left to the equations for arrays, which know every fault by name.
"""

from __future__ import annotations

import functools
from dataclasses import dataclass
from math import isfinite, pi, sqrt
from typing import TYPE_CHECKING

import numpy as np

from singletrack.closed_form.programs import MATRICES, program_of, values_of
from singletrack.closed_form.round_tyres import on_round_tyres
from singletrack.closed_form.soundness import CONDITION, DEFINITE, INERTIA, REACH, RESIDUAL
from singletrack.model import COORDINATES, INPUTS, LinearModel
from singletrack.posture import STEER, TORSO_LEAN, Margins, Options, input_name

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from singletrack.arrays import Array
    from singletrack.closed_form.programs import Program
    from singletrack.parameters import Bicycle, Rider

__all__ = ["NAMES", "Single", "single_design"]

#: Coordinates and inputs by their number.
NAMES = {2: (COORDINATES, INPUTS), 3: ((*COORDINATES, TORSO_LEAN), (*INPUTS, input_name(TORSO_LEAN)))}
_WRONG = (ValueError, ZeroDivisionError, OverflowError)


@dataclass(frozen=True, eq=False)
class Single:
    """A single sound design.

    Attributes
    ----------
    model : LinearModel
    margins : Margins, or None without rider
    """

    model: LinearModel
    margins: Margins | None


def single_design(bicycle: Bicycle, rider: Rider | None, options: Options) -> Single | None:
    """Return the model of a single design by its program; None for all that is a batch, faulty, odd or rare.

    Parameters
    ----------
    bicycle : Bicycle
    rider : Rider, optional
    options : Options

    Examples
    --------
    >>> from singletrack import load_bicycle, load_rider
    >>> from singletrack.posture import Options
    >>> found = single_design(load_bicycle("browser"), load_rider("rider-a"), Options("upright"))
    >>> round(float(found.model.M[1, 1]), 4), round(found.margins.arm, 3)
    (0.4614, 0.945)
    """
    if not bicycle.is_single or (rider is not None and not rider.is_single):
        return None
    program = program_of(bicycle, rider, options) if rider is not None or _needs_no_rider(options) else None
    values = None if program is None else _values(program, bicycle, rider)
    laws = None if program is None else _laws(options, program.freedoms)
    if program is None or values is None or laws is None:
        return None
    try:
        found = _function(program)(*values)
    except _WRONG:
        return None
    n = program.freedoms
    if not isfinite(sum(found)) or not _definite(found, n):
        return None
    seated, load = None, None
    if rider is not None:
        size = len(MATRICES) * n * n
        load, seated = (found[size], found[size + 1]), Margins(*found[size + 2 :])
        if not _sits(found[size + 2 :], rider):
            return None
    M, C1, K0, K2 = np.array(found[: len(MATRICES) * n * n]).reshape(-1, n, n)
    names, (C0, S0) = NAMES[n], laws
    model = LinearModel(M, C1, K0, K2, bicycle.gravity, C0=C0, S0=S0, coordinates=names[0], inputs=names[1])
    return Single(on_round_tyres(model, bicycle, load), seated)


def _needs_no_rider(options: Options) -> bool:
    return options.posture == "rigid" and not options.torso_lean and options.fit is None


@functools.cache
def _function(program: Program) -> Callable[..., tuple[float, ...]]:
    return program.function()


def _values(program: Program, bicycle: Bicycle, rider: Rider | None) -> tuple[float, ...] | None:
    """Return the values that a program takes, or None if one is missing, or the lean angle none."""
    found = values_of(program, bicycle, rider)
    if rider is not None and rider.forward_lean_angle is None:  # an angle of the rider's list is not checked yet
        lean = rider.forward_lean_angles.get(bicycle.name)
        if not (isinstance(lean, float) and 0 < lean < pi / 2):
            return None
    return None if None in found else found


def _laws(options: Options, freedoms: int) -> tuple[Array, Array] | None:
    """Return C0 and S0 of springs and dampers on the steer and the torso's lean; None where there are others."""
    found = np.zeros((2, freedoms, freedoms))
    for matrix, amounts in zip(found, (options.dampers, options.springs), strict=True):
        for name, amount in amounts.items():
            place = 1 if name == STEER else 2
            if name not in (STEER, TORSO_LEAN) or place >= freedoms or not isinstance(amount, int | float):
                return None
            matrix[place, place] = amount
    return found[0], found[1]


def _sits(margins: Sequence[float], rider: Rider) -> bool:
    """Tell whether limbs reach and fold and the arms follow the steer, with room to spare; margins as they stand."""
    arm, leg, residual, condition, inertia = margins
    own = rider.__dict__
    if not (residual < RESIDUAL and condition < CONDITION and inertia > INERTIA):
        return False
    for share, upper, lower in (
        (arm, own["upper_arm_length"], own["lower_arm_length"]),
        (leg, own["upper_leg_length"], own["lower_leg_length"]),
    ):
        if not (share < 1 - REACH and share * (upper + lower) > abs(upper - lower) + REACH):
            return False
    return True


def _definite(entries: tuple[float, ...], n: int) -> bool:
    """Tell whether the mass matrix, the first n x n of the entries, is positive definite without any doubt."""
    diagonal = entries[0 : n * n : n + 1]
    if min(diagonal) <= 0:
        return False
    a = entries[1] / sqrt(diagonal[0] * diagonal[1])
    if n == 2:
        return abs(a) < 1 - DEFINITE
    b = entries[2] / sqrt(diagonal[0] * diagonal[2])
    c = entries[5] / sqrt(diagonal[1] * diagonal[2])
    # Leading minors of M scaled to a unit diagonal; its least eigenvalue is at least 4/9 of the last one.
    return abs(a) < 1 - DEFINITE and 1 + 2 * a * b * c - a * a - b * b - c * c > DEFINITE
