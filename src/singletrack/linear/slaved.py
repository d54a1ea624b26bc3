"""What bodies slaved to the steer angle add to the coefficient matrices (derived in docs/theory.md)."""

from __future__ import annotations

from typing import TYPE_CHECKING

from singletrack.arrays import Array, as_arrays, dot, matvec, namespace, vector
from singletrack.linear.whipple import Matrices, matrix2

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
    mass, r, inertia = bodies.mass, bodies.centre, bodies.inertia
    x, y, z = r[..., 0], r[..., 1], r[..., 2]
    ex, ez = vector(1.0, 0.0, 0.0), vector(0.0, 0.0, 1.0)
    lean = (vector(0.0 * x, -z, y), ex)
    yaw = (vector(-y, x, 0.0 * x), ez)
    steer = (mu[..., None] * yaw[0] + bodies.displacement, mu[..., None] * ez + bodies.rotation)

    def pair(a: tuple[Array, Array], b: tuple[Array, Array]) -> Array:
        return _sum(mass * dot(a[0], b[0]) + dot(a[1] + 0.0 * r, matvec(inertia, b[1] + 0.0 * r)))

    def lateral(a: tuple[Array, Array]) -> Array:
        return mass * a[0][..., 1]

    off_diagonal = pair(lean, steer)
    k0_off = -_sum(mass * (mu * x + bodies.displacement[..., 1]))
    scale = kappa[..., 0]
    return Matrices(
        matrix2(pair(lean, lean), off_diagonal, off_diagonal, pair(steer, steer)),
        matrix2(
            0.0,
            scale * pair(lean, yaw) + _sum(mu * lateral(lean)),
            0.0,
            scale * pair(steer, yaw) + _sum(mu * lateral(steer)),
        ),
        matrix2(_sum(mass * z), k0_off, k0_off, -_sum(mass * (mu * x * sin + bodies.curvature[..., 2]))),
        matrix2(0.0, _sum(kappa * lateral(lean)), 0.0, _sum(kappa * lateral(steer))),
    )


def _sum(values: Array) -> Array:
    return namespace(values).sum(values, axis=-1)
