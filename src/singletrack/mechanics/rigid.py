"""Rigid-body arithmetic."""

from __future__ import annotations

from collections.abc import Sequence  # noqa: TC003  # part of the public signature
from dataclasses import dataclass

from singletrack.arrays import Array, dot, namespace

__all__ = ["Body", "combine"]


@dataclass(frozen=True, eq=False)
class Body:
    """A rigid body in the bicycle's frame (x forward, y right, z down, origin at the rear contact).

    Attributes
    ----------
    mass : array, shape (...)
        In kg.
    centre : array, shape (..., 3)
        Centre of mass in m.
    inertia : array, shape (..., 3, 3)
        Inertia tensor about the centre of mass, along the axes of the frame, in kg m^2.
    """

    mass: Array
    centre: Array
    inertia: Array

    def inertia_about(self, point: Array) -> Array:
        """Return the inertia tensor (..., 3, 3) about a point (..., 3), in kg m^2 (parallel axes theorem).

        >>> import numpy as np
        >>> ball = Body(2.0, np.array([0.0, 0.0, -1.0]), 0.1 * np.eye(3))
        >>> np.diag(ball.inertia_about(np.zeros(3))).tolist()
        [2.1, 2.1, 0.1]
        """
        return self.inertia + point_inertia(self.mass, self.centre - point)


def point_inertia(mass: Array, arm: Array) -> Array:
    """Return the inertia tensor (..., 3, 3) of a point mass (...) at an arm (..., 3), in kg m^2."""
    xp = namespace(mass, arm)
    mass = xp.asarray(mass)[..., None, None]
    square = dot(arm, arm)[..., None, None] * xp.eye(3, dtype=arm.dtype)
    return mass * (square - arm[..., :, None] * arm[..., None, :])


def combine(bodies: Sequence[Body]) -> Body:
    """Return several bodies as one rigid body.

    >>> import numpy as np
    >>> left, right = (Body(1.0, np.array([0.0, y, 0.0]), np.zeros((3, 3))) for y in (-1.0, 1.0))
    >>> both = combine([left, right])
    >>> float(both.mass), both.centre.tolist(), np.diag(both.inertia).tolist()
    (2.0, [0.0, 0.0, 0.0], [2.0, 0.0, 2.0])
    """
    xp = namespace(*(body.centre for body in bodies))
    mass = sum(xp.asarray(body.mass) for body in bodies)
    centre = sum(xp.asarray(body.mass)[..., None] * body.centre for body in bodies) / mass[..., None]
    return Body(mass, centre, sum(body.inertia_about(centre) for body in bodies))
