"""The coefficient matrices of the linear bicycle model, from the nonlinear equations."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from singletrack.model import LinearModel
from singletrack.multibody.bicycle.balance import holding_inputs
from singletrack.multibody.bicycle.model import bicycle_model
from singletrack.multibody.engine.assembly import assemble, move
from singletrack.multibody.engine.checks import is_number
from singletrack.multibody.engine.linearise import linearise

if TYPE_CHECKING:
    from collections.abc import Sequence

    from singletrack.arrays import Array
    from singletrack.multibody.engine.elements import Scalar
    from singletrack.multibody.engine.model import State
    from singletrack.parameters import Bicycle, Rider
    from singletrack.posture import Options

__all__ = ["coefficients"]


def coefficients(bicycle: Bicycle, rider: Rider | None = None, options: Options | str = "rigid") -> LinearModel:
    """Return the coefficient matrices that follow from the full nonlinear equations of motion.

    Independent of the closed form in ``singletrack.closed_form``: every joint of the rider moves, hands and wheels are
    constraints, and the linearisation is exact. The forward speed is held; so is, by constant torques, a rider who is
    not in balance upright.

    Parameters
    ----------
    bicycle, rider
        One design; numbers, no arrays.
    options
        How the rider sits, or a posture's name.

    Raises
    ------
    InputError, PostureError
        See :func:`bicycle_model`.

    Examples
    --------
    >>> from singletrack import load_bicycle, load_rider
    >>> both = coefficients(load_bicycle("browser"), load_rider("rider-a"), "upright")
    >>> round(float(both.M[1, 1]), 4), round(float(both.gravity * both.K0[1, 1]), 4)
    (0.4614, 2.3268)
    """
    model = bicycle_model(bicycle, rider, options)
    rolling = {"rear wheel": -1.0 / model.system.parameters["rear radius"]}
    names = tuple(name for name in model.system.independent or () if name != "rear wheel")
    upright = assemble(model)
    gravity = float(bicycle.gravity)
    weightless, heavy = (_with_gravity(upright, strength) for strength in (0.0, 1.0))
    still, pulled, moving = (_held(state, names) for state in (weightless, heavy, move(weightless, rolling)))
    motions = [motion for joint in model.system.joints for motion in joint.motions]
    damped = any(not _is_zero(motion.damping) for motion in motions)
    # The preload of a free joint, which the angle itself does not change, is no spring.
    sprung = any(
        not _is_zero(motion.stiffness) or not (motion.name in names or _is_zero(motion.preload)) for motion in motions
    )
    return LinearModel(
        M=still[0],
        C0=still[1] if damped else np.zeros_like(still[1]),
        C1=moving[1] - still[1],
        S0=still[2] if sprung else np.zeros_like(still[2]),
        K0=pulled[2] - still[2],
        K2=moving[2] - still[2],
        gravity=gravity,
        coordinates=names,
        inputs=tuple(given.name for given in model.system.inputs[: len(names)]),
    )


def _is_zero(number: Scalar) -> bool:
    return is_number(number) and float(number) == 0.0


def _with_gravity(state: State, strength: float) -> State:
    parameters = state.parameters.copy()
    parameters[0] = strength
    return replace(state, parameters=parameters)


def _held(state: State, names: Sequence[str]) -> tuple[Array, Array, Array]:
    """Return M, C and K of some freedoms, held in balance and at constant speed (rate of the rear wheel)."""
    small = linearise(state, holding_inputs(state), keep=names)
    rows = [small.speeds.index(name) for name in names]
    columns = [small.coordinates.index(name) for name in names]
    pick = np.ix_(rows, rows)
    return small.M[pick], small.C[pick], small.K[np.ix_(rows, columns)]
