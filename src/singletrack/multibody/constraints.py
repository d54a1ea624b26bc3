"""Closed loops and rolling wheels as expressions: what must vanish, and the forces that keep it so."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import casadi as ca

from singletrack.multibody.kinematics import DOWN, SX, column, unit

if TYPE_CHECKING:
    from collections.abc import Mapping

    from singletrack.multibody.connections import Closure, Wheel
    from singletrack.multibody.kinematics import Frame
    from singletrack.multibody.system import System

__all__ = ["Contact", "closure_residual", "closure_wrench", "wheel_contact"]


def closure_residual(closure: Closure, frames: Mapping[str, Frame]) -> SX:
    """Return what must vanish for the loop to be closed: one entry for each of the closure's rows."""
    first, second = frames[closure.first], frames[closure.second]
    apart = second.point(column(closure.second_point)) - first.point(column(closure.first_point))
    if closure.length is not None:
        return ca.norm_2(apart) - closure.length
    rows = [ca.dot(first.rotation @ column(direction), apart) for direction in closure.directions]
    rows += [ca.dot(first.rotation @ column(one), second.rotation @ column(other)) for one, other in closure.orthogonal]
    return ca.vertcat(*rows)


def closure_wrench(closure: Closure, frames: Mapping[str, Frame], multipliers: SX) -> tuple[SX, SX]:
    """Return the force (N) and torque (N m) of the first body on the second, at its point, in the ground's frame."""
    first, second = frames[closure.first], frames[closure.second]
    force, torque = ca.SX(3, 1), ca.SX(3, 1)
    if closure.length is not None:
        apart = second.point(column(closure.second_point)) - first.point(column(closure.first_point))
        return apart / ca.norm_2(apart) * multipliers[0], torque
    count = len(closure.directions)
    for i, direction in enumerate(closure.directions):
        force += multipliers[i] * (first.rotation @ column(direction))
    for i, (one, other) in enumerate(closure.orthogonal):
        axis = ca.cross(second.rotation @ column(other), first.rotation @ column(one))
        torque += multipliers[count + i] * axis
    return force, torque


@dataclass(frozen=True, eq=False)
class Contact:
    """Where and how a wheel touches the ground: point, its height, heading, side and the slip velocities."""

    point: SX
    height: SX
    heading: SX
    side: SX
    slip: SX


def wheel_contact(wheel: Wheel, frames: Mapping[str, Frame]) -> Contact:
    """Return the contact of a wheel with the ground (see :class:`~singletrack.multibody.Wheel`)."""
    frame = frames[wheel.body]
    axle = frame.rotation @ unit(wheel.axle)
    across = ca.cross(axle, DOWN)
    level = ca.norm_2(across)
    downward = (DOWN - axle[2] * axle) / level
    arm = frame.arm(column(wheel.centre)) + (wheel.radius - wheel.crown) * downward + wheel.crown * DOWN
    heading = across / level
    side = ca.cross(DOWN, heading)
    velocity = frame.point_velocity(arm)
    point = frame.position + arm
    return Contact(point, point[2], heading, side, ca.vertcat(ca.dot(heading, velocity), ca.dot(side, velocity)))


def holonomic_residual(system: System, frames: Mapping[str, Frame], contacts: Mapping[str, Contact]) -> SX:
    """Return everything that must vanish in position: loops, then wheel heights."""
    loops = [closure_residual(closure, frames) for closure in system.closures]
    return ca.vertcat(ca.SX(0, 1), *loops, *(contacts[wheel.name].height for wheel in system.wheels))


def rolling_residual(system: System, contacts: Mapping[str, Contact]) -> SX:
    """Return everything that must vanish in velocity only: the slip of the wheels."""
    return ca.vertcat(ca.SX(0, 1), *(contacts[wheel.name].slip for wheel in system.wheels))
