"""Rigid-body arithmetic."""

from __future__ import annotations

from collections.abc import Sequence  # noqa: TC003  # part of the public signature
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np

from singletrack.arrays import Array, Number, dot, namespace, stack, vector

__all__ = ["PlanarBody", "RigidBody", "combine", "point_inertia", "principal_in_plane"]


@dataclass(frozen=True, eq=False)
class RigidBody:
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

    mass: Number
    centre: Array
    inertia: Array

    def inertia_about(self, point: Array) -> Array:
        """Return the inertia tensor (..., 3, 3) about a point (..., 3), in kg m^2 (parallel axes theorem).

        >>> import numpy as np
        >>> ball = RigidBody(2.0, np.array([0.0, 0.0, -1.0]), 0.1 * np.eye(3))
        >>> np.diag(ball.inertia_about(np.zeros(3))).tolist()
        [2.1, 2.1, 0.1]
        """
        return self.inertia + point_inertia(self.mass, self.centre - point)


def point_inertia(mass: Number, arm: Array) -> Array:
    """Return the inertia tensor (..., 3, 3) of a point mass (...) at an arm (..., 3), in kg m^2."""
    xp = namespace(mass, arm)
    mass = xp.asarray(mass)[..., None, None]
    square = dot(arm, arm)[..., None, None] * xp.eye(3, dtype=arm.dtype)
    return mass * (square - arm[..., :, None] * arm[..., None, :])


def combine(bodies: Sequence[RigidBody]) -> RigidBody:
    """Return several bodies as one rigid body.

    >>> import numpy as np
    >>> left, right = (RigidBody(1.0, np.array([0.0, y, 0.0]), np.zeros((3, 3))) for y in (-1.0, 1.0))
    >>> both = combine([left, right])
    >>> float(both.mass), both.centre.tolist(), np.diag(both.inertia).tolist()
    (2.0, [0.0, 0.0, 0.0], [2.0, 0.0, 2.0])
    """
    xp = namespace(*(body.centre for body in bodies))
    mass: Any = sum(xp.asarray(body.mass) for body in bodies)
    centre = sum(xp.asarray(body.mass)[..., None] * body.centre for body in bodies) / mass[..., None]
    inertia: Any = sum(body.inertia_about(centre) for body in bodies)
    return RigidBody(mass, centre, inertia)


class PlanarBody(NamedTuple):
    """A rigid body symmetric about the x-z plane, by its entries, each of shape (...), SI, in the bicycle's frame.

    Attributes
    ----------
    mass : array, shape (...)
        In kg.
    x, z : array, shape (...)
        Centre of mass, forward and down, in m.
    xx, yy, zz, xz : array, shape (...)
        Entries of the inertia tensor about the centre of mass in kg m^2.
    """

    mass: Number
    x: Number
    z: Number
    xx: Number
    yy: Number
    zz: Number
    xz: Number

    def body(self) -> RigidBody:
        """Return the same body with its centre (..., 3) and its tensor (..., 3, 3).

        >>> PlanarBody(2.0, 0.5, -1.0, 0.1, 0.2, 0.3, 0.05).body().inertia.tolist()
        [[0.1, 0.0, 0.05], [0.0, 0.2, 0.0], [0.05, 0.0, 0.3]]
        """
        rows = [vector(self.xx, 0.0, self.xz), vector(0.0, self.yy, 0.0), vector(self.xz, 0.0, self.zz)]
        return RigidBody(self.mass, vector(self.x, 0.0, self.z), stack(rows, -2))

    @classmethod
    def of(cls, body: RigidBody) -> PlanarBody:
        """Return a body by its entries; products of inertia that symmetry makes zero are left out."""
        centre, tensor = body.centre, body.inertia
        moments = (tensor[..., 0, 0], tensor[..., 1, 1], tensor[..., 2, 2], tensor[..., 0, 2])
        return cls(body.mass, centre[..., 0], centre[..., 2], *moments)


def principal_in_plane(xx: Number, zz: Number, xz: Number) -> tuple[Array, Array, Array]:
    """Return the principal moments in the x-z plane and the direction of the larger one's axis.

    Parameters
    ----------
    xx, zz, xz : array, shape (...)
        Entries of the inertia tensor in kg m^2.

    Returns
    -------
    larger, smaller : array, shape (...)
        In kg m^2.
    angle : array, shape (...)
        Of the larger one's axis from x, about y (right-handed: from x towards -z), in rad.

    Examples
    --------
    >>> [float(value) for value in principal_in_plane(1.0, 1.0, -0.25)]
    [1.25, 0.75, 0.7853981633974483]
    """
    mean, half = (xx + zz) / 2, np.hypot((xx - zz) / 2, xz)
    return mean + half, mean - half, np.arctan2(-2 * xz, xx - zz) / 2
