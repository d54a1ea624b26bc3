"""From a bicycle and a rider to the coefficient matrices."""

from __future__ import annotations

import dataclasses
from functools import partial
from typing import TYPE_CHECKING, Any

import numpy as np

from singletrack.arrays import Array, as_arrays, is_concrete, refuse_single, require_double
from singletrack.closed_form.batches import batch_shape, in_parts
from singletrack.closed_form.flexible import flexible_matrices, hinge_laws
from singletrack.closed_form.many import many_designs
from singletrack.closed_form.round_tyres import has_round_tyres, load_of_rider, on_round_tyres
from singletrack.closed_form.single import single_design
from singletrack.closed_form.slaved import slaved_matrices
from singletrack.closed_form.whipple import Matrices, whipple_matrices
from singletrack.model import COORDINATES, INPUTS, LinearModel
from singletrack.model.definite import indefinite
from singletrack.parameters.flexible import soft_hinges
from singletrack.posture import STEER, Options, input_name, seat, slaved_bodies, slaved_mass

if TYPE_CHECKING:
    from singletrack.parameters import Bicycle, Rider
    from singletrack.posture import Posture

__all__ = ["by_arrays", "coefficients", "seated_model"]


def coefficients(bicycle: Bicycle, rider: Rider | None = None, options: Options | str = "rigid") -> LinearModel:
    """Return the coefficient matrices of the linearised equations of motion.

    ``M q'' + (C0 + v C1) q' + (S0 + g K0 + v^2 K2) q = f`` with q = (lean, steer, free joints) in rad, f the torques
    (lean torque, steer torque, those of the joints) in N m.

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
        Each matrix of shape (..., n, n), where (...) is what the parameters broadcast to.

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
    The bicycle by Meijaard et al. (2007), appendix A; the rider's segments as bodies slaved to the steer angle
    and the free joints.

    Examples
    --------
    >>> from singletrack import load_bicycle, load_rider
    >>> model = coefficients(load_bicycle("browser"), load_rider("rider-a"), "upright")
    >>> round(float(model.M[1, 1]), 4), round(float(model.gravity * model.K0[1, 1]), 4)
    (0.4614, 2.3268)
    """
    options = Options.of(options)
    single = single_design(bicycle, rider, options)
    if single is not None:
        return single.model
    shape = batch_shape(bicycle, rider, options)
    if shape is None:
        return by_arrays(bicycle, rider, options)
    return in_parts(partial(many_designs, by_arrays), bicycle, rider, options, shape)


@np.errstate(all="ignore")  # sound designs overflow nowhere; faulty ones of a batch are flagged, and NaN
def by_arrays(bicycle: Bicycle, rider: Rider | None, options: Options) -> LinearModel:
    """Return the coefficient matrices by the equations for arrays: of any batch, on NumPy or JAX, with all faults.

    Parameters and errors as for :func:`coefficients`; each matrix of shape (..., n, n).
    """
    bare = whipple_matrices(bicycle)
    require_double(bare.M)
    if rider is None:
        options.require_rider()
        laws = _steer_laws(options, 1)
        model = LinearModel(*bare, bicycle.gravity, faults=bicycle.standing_faults, C0=laws[0], S0=laws[1])
        return _checked(on_round_tyres(_softened(model, bicycle, None), bicycle, None), bicycle.name)
    posture = seat(bicycle, rider, options)
    model = seated_model(bicycle, posture, bare, options)
    faults = bicycle.standing_faults + rider.standing_faults + model.faults
    return _checked(dataclasses.replace(model, faults=faults), bicycle.name)


def seated_model(
    bicycle: Bicycle,
    posture: Posture,
    bare: Matrices | None = None,
    options: Options | None = None,
    *,
    massless: bool = False,
) -> LinearModel:
    """Return the equations with a seated rider, whatever the mass matrix; faults are those of the posture.

    Parameters
    ----------
    bicycle : Bicycle
    posture : Posture
    bare : Matrices, optional
        Of the bicycle alone, where they are known already.
    options : Options, optional
        Whose spring and damper at the steer there are.
    massless : bool
        Let free joints move no mass.
    """
    bare = whipple_matrices(bicycle) if bare is None else bare
    bodies = slaved_mass(posture, bicycle, massless=massless)
    added = slaved_matrices(bodies, bicycle)
    more = len(bodies.freedoms)
    M, C1, K0, K2 = (_padded(one, more) + other for one, other in zip(bare, added, strict=True))
    of_joints = (bodies.damping, bodies.stiffness)
    C0, S0 = (
        _both(None if own is None else _bordered(own), steer)
        for own, steer in zip(of_joints, _steer_laws(options or Options(), 1 + more), strict=True)
    )
    model = LinearModel(
        M,
        C1,
        K0,
        K2,
        bicycle.gravity,
        faults=bodies.faults,
        C0=C0,
        S0=S0,
        coordinates=(*COORDINATES, *bodies.freedoms),
        inputs=(*INPUTS, *map(input_name, bodies.freedoms)),
    )
    load = load_of_rider(posture) if has_round_tyres(bicycle) else None
    return on_round_tyres(_softened(model, bicycle, posture), bicycle, load)


def _softened(model: LinearModel, bicycle: Bicycle, posture: Posture | None) -> LinearModel:
    """Return a model with the freedoms of a soft frame and fork, where the bicycle has them."""
    hinges = soft_hinges(bicycle)
    if not hinges:
        return model
    # The twist of the frame is already there where it carries a handlebar that is held.
    soft = tuple(hinge.name for hinge in hinges if hinge.name not in model.coordinates)
    bodies = None if posture is None else slaved_bodies(posture, bicycle)
    matrices = flexible_matrices(bicycle, bodies, model.coordinates[2:])
    coordinates = (*model.coordinates, *soft)
    laws = hinge_laws(bicycle, coordinates)
    C0, S0 = (_padded(own, len(soft)) + law for own, law in zip((model.C0, model.S0), laws, strict=True))
    return LinearModel(
        *matrices,
        model.gravity,
        faults=model.faults,
        C0=C0,
        S0=S0,
        coordinates=coordinates,
        inputs=(*model.inputs, *map(input_name, soft)),
    )


def _padded(matrix: Array, more: int) -> Array:
    """Return matrices (..., n, n) with so many rows and columns of zeros more."""
    if not more:
        return matrix
    xp, (matrix,) = as_arrays(matrix)
    batch, n = matrix.shape[:-2], matrix.shape[-1]
    wide = xp.concat([matrix, xp.zeros((*batch, n, more), dtype=matrix.dtype)], axis=-1)
    return xp.concat([wide, xp.zeros((*batch, more, n + more), dtype=matrix.dtype)], axis=-2)


def _bordered(matrix: Array) -> Array:
    """Return matrices (..., f, f) of steer and free joints with a row and column of zeros before them, for the lean."""
    xp, (matrix,) = as_arrays(matrix)
    batch, f = matrix.shape[:-2], matrix.shape[-1]
    wide = xp.concat([xp.zeros((*batch, f, 1), dtype=matrix.dtype), matrix], axis=-1)
    return xp.concat([xp.zeros((*batch, 1, f + 1), dtype=matrix.dtype), wide], axis=-2)


def _steer_laws(options: Options, freedoms: int) -> tuple[Any, Any]:
    """Return C0 and S0 of damper and spring on the steer, None without."""
    found: list[Array | None] = []
    for values in (options.dampers, options.springs):
        value = values.get(STEER)
        if value is None:
            found.append(None)
            continue
        place = np.zeros((1 + freedoms, 1 + freedoms))
        place[1, 1] = 1.0
        found.append(as_arrays(value)[1][0][..., None, None] * place)
    return found[0], found[1]


def _both(one: Array | None, other: Array | None) -> Any:
    if one is None or other is None:
        return other if one is None else one
    return one + other


def _checked(model: LinearModel, name: str) -> LinearModel:
    """Return a model with the fault of a mass matrix that is not positive definite; raise it for a single design."""
    if not is_concrete(model.M):
        return model
    return dataclasses.replace(model, faults=model.faults + refuse_single([indefinite(model.M)], where=name))
