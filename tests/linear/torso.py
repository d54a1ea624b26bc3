"""A bicycle with a torso on a hinge: the least model with a third freedom, straight from rigid-body mechanics."""

from __future__ import annotations

import numpy as np

from singletrack import coefficients
from singletrack.model import LinearModel

MASS, HIP, CENTRE, INERTIA = 45.0, (0.35, 0.0, -0.95), (0.40, 0.0, -1.25), (2.5, 2.5, 0.6)


def with_torso(bicycle, spring=0.0, damper=0.0):
    """Return the model of a bicycle with a torso that leans about the x axis through the hip, spring in N m."""
    base, tilt = coefficients(bicycle), bicycle.steer_axis_tilt
    mu, kappa = bicycle.trail * np.cos(tilt) / bicycle.wheel_base, np.cos(tilt) / bicycle.wheel_base
    ex, _, ez = np.eye(3)
    r, hip = np.array(CENTRE), np.array(HIP)
    # Translation of the centre and rotation for unit rates of lean, steer and torso lean, and for yaw.
    rates = [(np.cross(ex, r), ex), (mu * np.cross(ez, r), mu * ez), (np.cross(ex, r - hip), ex)]
    yaw = (np.cross(ez, r), ez)

    def product(one, other):
        return MASS * one[0] @ other[0] + one[1] @ np.diag(INERTIA) @ other[1]

    M, C1, K0, K2 = (np.pad(np.asarray(matrix), ((0, 1), (0, 1))) for matrix in base.matrices)
    for i, rate in enumerate(rates):
        M[i] += [product(rate, other) for other in rates]
        C1[i, 1] += kappa * product(rate, yaw) + mu * MASS * rate[0][1]
        K2[i, 1] += kappa * MASS * rate[0][1]
    x, _, z = CENTRE
    above = z - hip[2]
    K0 += MASS * np.array([[z, -mu * x, above], [-mu * x, -mu * x * np.sin(tilt), 0.0], [above, 0.0, above]])
    last = np.diag([0.0, 0.0, 1.0])
    return LinearModel(
        M,
        C1,
        K0,
        K2,
        base.gravity,
        C0=damper * last,
        S0=spring * last,
        coordinates=("lean", "steer", "torso lean"),
        inputs=("lean torque", "steer torque", "torso torque"),
    )
