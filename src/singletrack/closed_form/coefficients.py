"""From a bicycle and a rider to the coefficient matrices."""

from __future__ import annotations

import dataclasses
from typing import TYPE_CHECKING

from singletrack.arrays import is_concrete, refuse_single, require_double
from singletrack.closed_form.slaved import slaved_matrices
from singletrack.closed_form.whipple import whipple_matrices
from singletrack.model import LinearModel
from singletrack.model.definite import indefinite
from singletrack.posture import Options, seat, slaved_bodies

if TYPE_CHECKING:
    from singletrack.parameters import Bicycle, Rider

__all__ = ["coefficients"]


def coefficients(bicycle: Bicycle, rider: Rider | None = None, options: Options | str = "rigid") -> LinearModel:
    """Return the coefficient matrices of the linearised equations of motion.

    ``M q'' + v C1 q' + (g K0 + v^2 K2) q = f`` with q = (lean, steer) in rad, f = (lean torque, steer torque) in N m.

    Parameters
    ----------
    bicycle : Bicycle
    rider : Rider, optional
        Without one, the bicycle as measured.
    options : Options or str
        How the rider sits, or a posture's name.

    Returns
    -------
    LinearModel
        Each matrix of shape (..., 2, 2), where (...) is what the parameters broadcast to.

    Raises
    ------
    InputError
        For an unknown name, a bicycle without frame geometry, a rider without forward lean angle; for a mass matrix
        that is not positive definite, such as of a massless front assembly;
        for JAX arrays in single precision.
    PostureError
        If arms or legs do not reach, or the arms cannot follow the steer.

    Notes
    -----
    The bicycle by Meijaard et al. (2007), appendix A; the rider's segments as bodies slaved to the steer angle.

    Examples
    --------
    >>> from singletrack import load_bicycle, load_rider
    >>> model = coefficients(load_bicycle("browser"), load_rider("rider-a"), "upright")
    >>> round(float(model.M[1, 1]), 4), round(float(model.gravity * model.K0[1, 1]), 4)
    (0.4614, 2.3268)
    """
    options = Options.of(options)
    bare = whipple_matrices(bicycle)
    require_double(bare.M)
    if rider is None:
        options.require_rider()
        return _checked(LinearModel(*bare, bicycle.gravity, faults=bicycle.standing_faults), bicycle.name)
    bodies = slaved_bodies(seat(bicycle, rider, options), bicycle)
    added = slaved_matrices(bodies, bicycle)
    faults = bicycle.standing_faults + rider.standing_faults + bodies.faults
    M, C1, K0, K2 = (one + other for one, other in zip(bare, added, strict=True))
    return _checked(LinearModel(M, C1, K0, K2, bicycle.gravity, faults=faults), bicycle.name)


def _checked(model: LinearModel, name: str) -> LinearModel:
    """Return a model with the fault of a mass matrix that is not positive definite; raise it for a single design."""
    if not is_concrete(model.M):
        return model
    return dataclasses.replace(model, faults=model.faults + refuse_single([indefinite(model.M)], where=name))
