"""The coefficient matrices of the linear bicycle model, from the nonlinear equations."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from singletrack.arrays import Array
from singletrack.multibody.assembly import assemble
from singletrack.multibody.bicycle import bicycle_model
from singletrack.multibody.linearise import speed_polynomials

if TYPE_CHECKING:
    from singletrack.parameters import Bicycle, Rider

__all__ = ["Coefficients", "coefficients"]


@dataclass(frozen=True, eq=False)
class Coefficients:
    """Coefficient matrices (2, 2) of ``M q'' + v C1 q' + (g K0 + v^2 K2) q = f``, q = (lean, steer), SI.

    ``gravity`` is g in N/kg. Lean and steer are in rad, positive to the right, f = (lean torque, steer torque) in N m.
    """

    M: Array
    C1: Array
    K0: Array
    K2: Array
    gravity: float


def coefficients(
    bicycle: Bicycle, rider: Rider | None = None, posture: str = "rigid", shoulder: str | None = None
) -> Coefficients:
    """Return the coefficient matrices that follow from the full nonlinear equations of motion.

    Independent of the closed form in ``singletrack.linear``: every joint of the rider moves, hands and wheels are
    constraints, and the linearisation is exact.

    Parameters
    ----------
    bicycle, rider
        One design; numbers, no arrays.
    posture
        ``rigid``, ``leaned`` or ``upright``.
    shoulder
        ``abduction`` or ``axial``.

    Raises
    ------
    InputError, PostureError
        See :func:`bicycle_model`.

    Examples
    --------
    >>> from singletrack import load_bicycle, load_rider
    >>> both = coefficients(load_bicycle("browser"), load_rider("rider-a"), posture="upright")
    >>> round(float(both.M[1, 1]), 4), round(float(both.gravity * both.K0[1, 1]), 4)
    (0.4614, 2.3268)
    """
    model = bicycle_model(bicycle, rider, posture, shoulder)
    rolling = {"rear wheel": -1.0 / model.system.parameters["rear radius"]}
    p = speed_polynomials(assemble(model), rolling, ("lean", "steer"))
    return Coefficients(p.M, p.C1, p.K0, p.K2, float(bicycle.gravity))
