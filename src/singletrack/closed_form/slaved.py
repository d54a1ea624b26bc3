"""What bodies slaved to the steer angle add to the coefficient matrices (derived in docs/theory.md)."""

from __future__ import annotations

from typing import TYPE_CHECKING

from singletrack.arrays import Array, as_arrays, dot, matvec, namespace
from singletrack.closed_form.whipple import Matrices, matrix2

if TYPE_CHECKING:
    from singletrack.parameters import Bicycle
    from singletrack.posture import SlavedBodies

__all__ = ["slaved_matrices"]


def slaved_matrices(bodies: SlavedBodies, bicycle: Bicycle) -> Matrices:
    """Return the sum of what bodies slaved to the steer add to M, C1, K0 and K2.

    Parameters
    ----------
    bodies : SlavedBodies
        n bodies with their motion relative to the rear frame, displacement J δ + H δ²/2 and rotation w δ.
    bicycle : Bicycle
        Wheel base, trail and steer axis tilt.

    Returns
    -------
    Matrices
        Each of shape (..., 2, 2), SI units.

    Notes
    -----
    With μ = c cos λ / w_b and κ = cos λ / w_b, each body has a translation p and a rotation a for unit rates of lean,
    steer and yaw about the rear contact, paired as ⟨(p, a), (q, b)⟩ = m p·q + a·I b; y(p) is the lateral part of p:

        M_ij += ⟨i, j⟩            C1_iδ += κ ⟨i, ψ⟩ + μ m y(p_i)         K2_iδ += κ m y(p_i)
        K0_φφ += m z              K0_φδ -= m (μ x + J_y)                 K0_δδ -= m (μ x sin λ + H_z)

    Examples
    --------
    A body that stays with the rear frame adds to the lean entry of M its moment of inertia about the x axis:

    >>> import numpy as np
    >>> from singletrack import load_bicycle
    >>> from singletrack.posture import SlavedBodies
    >>> at, still = np.array([[0.3, 0.0, -1.0]]), np.zeros((1, 3))
    >>> load = SlavedBodies(np.array([10.0]), at, np.zeros((1, 3, 3)), still, still, still)
    >>> float(slaved_matrices(load, load_bicycle("stratos")).M[0, 0])
    10.0
    """
    xp, (base, trail, tilt) = as_arrays(bicycle.wheel_base, bicycle.trail, bicycle.steer_axis_tilt)
    kappa, sin = xp.cos(tilt)[..., None] / base[..., None], xp.sin(tilt)[..., None]
    mu = trail[..., None] * kappa
    mass, J = bodies.mass, bodies.displacement
    x, y, z = (bodies.centre[..., k] for k in range(3))
    # Unit rates: lean moves a body by (0, -z, y) and turns it about x, yaw by (-y, x, 0) about z, steer by μ times
    # that and J, w besides. Angular momenta, and the lateral parts of momenta:
    spin_steer = matvec(bodies.inertia, bodies.rotation) + mu[..., None] * bodies.inertia[..., :, 2]
    lean_y, yaw_x, yaw_y = -mass * z, -mass * y, mass * x
    steer_x, steer_y, steer_z = mu * yaw_x + mass * J[..., 0], mu * yaw_y + mass * J[..., 1], mass * J[..., 2]
    spin_steer_w = dot(bodies.rotation, spin_steer) + mu * spin_steer[..., 2]

    lean_lean = _sum(mass * (y * y + z * z) + bodies.inertia[..., 0, 0])
    lean_steer = _sum(y * steer_z - z * steer_y + spin_steer[..., 0])
    lean_yaw = _sum(lean_y * x + bodies.inertia[..., 0, 2])
    steer_yaw = _sum(x * steer_y - y * steer_x + spin_steer[..., 2])
    moved = steer_x * (J[..., 0] - mu * y) + steer_y * (J[..., 1] + mu * x) + steer_z * J[..., 2]
    k0_off = -_sum(steer_y)
    kappa, mu, sin = kappa[..., 0], mu[..., 0], sin[..., 0]
    lean_lateral, steer_lateral = _sum(lean_y), -k0_off
    return Matrices(
        matrix2(lean_lean, lean_steer, lean_steer, _sum(moved + spin_steer_w)),
        matrix2(0.0, kappa * lean_yaw + mu * lean_lateral, 0.0, kappa * steer_yaw + mu * steer_lateral),
        matrix2(-lean_lateral, k0_off, k0_off, -mu * sin * _sum(yaw_y) - _sum(mass * bodies.curvature[..., 2])),
        matrix2(0.0, kappa * lean_lateral, 0.0, kappa * steer_lateral),
    )


def _sum(values: Array) -> Array:
    return namespace(values).sum(values, axis=-1)
