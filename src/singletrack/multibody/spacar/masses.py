"""Kinds of mass: their kinetic energy and the work of their weight.

A beam is interpolated between its ends by cubics whose end tangents are its drawn length times the turned axes; its
consistent mass follows from the velocity of that curve, with the convective terms of turning ends.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import casadi as ca

from singletrack.multibody.spacar.kinds import body_rates, rotation

__all__ = ["MASSES", "Mass"]

# Integrals over a unit length of products of the cubics: value and slope at the start, value and slope at the end.
_CUBIC = ca.DM([[156, 22, 54, -13], [22, 4, 13, -3], [54, 13, 156, -22], [-13, -3, -22, 4]]) / 420
_CUBIC_MEAN = ca.DM([1 / 2, 1 / 12, 1 / 2, -1 / 12])
_LINEAR = ca.DM([[2, 1], [1, 2]]) / 6


@dataclass(frozen=True)
class Mass:
    """One kind of mass.

    Attributes
    ----------
    width
        Number of coordinates.
    parameters
        Number of parameters.
    energy
        From x, v and p to the kinetic energy and the work that its weight has done.
    """

    width: int
    parameters: int
    energy: Callable[[Any, Any, Any], tuple[Any, Any]]


def _of_points(points: Any, x: Any, v: Any, weights: Any, mean: Any, mass: Any, gravity: Any) -> tuple[Any, Any]:
    """Return energy and work of a line whose shape is linear in ``points`` (dimension, k)."""
    rates = ca.horzcat(*[ca.jtimes(points[:, i], x, v) for i in range(points.shape[1])])
    return mass * ca.trace(rates @ weights @ rates.T) / 2, mass * ca.dot(gravity, points @ mean)


def _truss(dimension: int) -> Callable[[Any, Any, Any], tuple[Any, Any]]:
    def energy(x: Any, v: Any, p: Any) -> tuple[Any, Any]:
        points = ca.horzcat(x[:dimension], x[dimension:])
        return _of_points(points, x, v, _LINEAR, ca.DM([0.5, 0.5]), p[0], p[1:])

    return energy


def _planar_beam(x: Any, v: Any, p: Any) -> tuple[Any, Any]:
    """Parameters: mass, gravity (2), length, the drawn direction as seen from both ends (2 + 2)."""
    tangents = []
    for angle, d in ((x[2], p[4:6]), (x[5], p[6:8])):
        c, s = ca.cos(angle), ca.sin(angle)
        tangents.append(p[3] * ca.vertcat(c * d[0] - s * d[1], s * d[0] + c * d[1]))
    points = ca.horzcat(x[0:2], tangents[0], x[3:5], tangents[1])
    return _of_points(points, x, v, _CUBIC, _CUBIC_MEAN, p[0], p[1:3])


def _beam(x: Any, v: Any, p: Any) -> tuple[Any, Any]:
    """Parameters: mass, gravity (3), length, drawn axis as seen from both ends (3 + 3), inertia about the axis."""
    turns = (x[3:7], x[10:14])
    tangents = [p[4] * rotation(turn) @ axis for turn, axis in zip(turns, (p[5:8], p[8:11]), strict=True)]
    points = ca.horzcat(x[0:3], tangents[0], x[7:10], tangents[1])
    energy, work = _of_points(points, x, v, _CUBIC, _CUBIC_MEAN, p[0], p[1:4])
    spins = ca.vertcat(ca.dot(p[5:8], body_rates(turns[0]) @ v[3:7]), ca.dot(p[8:11], body_rates(turns[1]) @ v[10:14]))
    return energy + p[11] * (spins.T @ _LINEAR @ spins) / 2, work


def _rotor(x: Any, v: Any, p: Any) -> tuple[Any, Any]:
    """Parameters: inertia xx, xy, xz, yy, yz, zz in the body's axes."""
    spin = body_rates(x) @ v
    xx, xy, xz, yy, yz, zz = (p[i] for i in range(6))
    inertia = ca.vertcat(ca.horzcat(xx, xy, xz), ca.horzcat(xy, yy, yz), ca.horzcat(xz, yz, zz))
    return spin.T @ inertia @ spin / 2, ca.SX(0)


#: Kinds of mass by name.
MASSES = {
    "truss2": Mass(4, 3, _truss(2)),
    "truss3": Mass(6, 4, _truss(3)),
    "beam2": Mass(6, 8, _planar_beam),
    "beam3": Mass(14, 12, _beam),
    "rotor": Mass(4, 6, _rotor),
}
