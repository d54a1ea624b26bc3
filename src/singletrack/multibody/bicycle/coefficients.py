"""The coefficient matrices of the linear bicycle model, from the nonlinear equations."""

from __future__ import annotations

from typing import TYPE_CHECKING

from singletrack.model import LinearModel
from singletrack.multibody.bicycle.model import bicycle_model
from singletrack.multibody.engine.assembly import assemble
from singletrack.multibody.engine.linearise import speed_polynomials

if TYPE_CHECKING:
    from singletrack.parameters import Bicycle, Rider
    from singletrack.posture import Options

__all__ = ["coefficients"]


def coefficients(bicycle: Bicycle, rider: Rider | None = None, options: Options | str = "rigid") -> LinearModel:
    """Return the coefficient matrices that follow from the full nonlinear equations of motion.

    Independent of the closed form in ``singletrack.closed_form``: every joint of the rider moves, hands and wheels are
    constraints, and the linearisation is exact.

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
    p = speed_polynomials(assemble(model), rolling, ("lean", "steer"))
    return LinearModel(p.M, p.C1, p.K0, p.K2, float(bicycle.gravity))
