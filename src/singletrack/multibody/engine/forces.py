"""Gravity, springs, joint laws and inputs as expressions: wrenches on bodies and forces on coordinates."""

from __future__ import annotations

from typing import TYPE_CHECKING

import casadi as ca

from singletrack.multibody.engine.connections import CoordinateForce, Force
from singletrack.multibody.engine.kinematics import SX, Wrench, column, inertia_matrix, unit

if TYPE_CHECKING:
    from collections.abc import Mapping

    from singletrack.multibody.engine.closures import Closure
    from singletrack.multibody.engine.connections import Spring
    from singletrack.multibody.engine.kinematics import Frame
    from singletrack.multibody.engine.system import System

__all__ = ["apart", "applied_wrenches", "coordinate_forces", "potential_energy"]


def apart(spring: Spring | Closure, frames: Mapping[str, Frame]) -> SX:
    """Return the vector from the first end to the second, of a spring or a loop.

    Parameters
    ----------
    spring : Spring or Closure
    frames : mapping
        Of all bodies, by name.
    """
    first, second = frames[spring.first], frames[spring.second]
    second_arm, first_arm = second.arm(column(spring.second_point)), first.arm(column(spring.first_point))
    return second.position + second_arm - first.position - first_arm


def _stretch(spring: Spring, frames: Mapping[str, Frame]) -> tuple[SX, SX, SX, SX, SX]:
    first, second = frames[spring.first], frames[spring.second]
    arms = first.arm(column(spring.first_point)), second.arm(column(spring.second_point))
    between = apart(spring, frames)
    length = ca.norm_2(between)
    direction = between / length
    rate = ca.dot(direction, second.point_velocity(arms[1]) - first.point_velocity(arms[0]))
    return arms[0], arms[1], direction, length, rate


def applied_wrenches(system: System, frames: Mapping[str, Frame], gravity: SX, inputs: SX) -> dict[str, Wrench]:
    """Return the wrenches of gravity, springs and inputs on every body, about the anchors.

    Parameters
    ----------
    system : System
        The machine.
    frames : mapping
        Of all bodies, by name.
    gravity : SX, scalar
        In m/s^2, down.
    inputs : SX, shape (inputs,)
        N or N m.
    """
    wrenches: dict[str, Wrench] = {}

    def push(body: str, arm: SX | None, force: SX, torque: SX | None = None) -> None:
        moment = ca.SX(3, 1) if arm is None else ca.cross(arm, force)
        wrench = Wrench(force, moment if torque is None else moment + torque)
        wrenches[body] = wrenches[body] + wrench if body in wrenches else wrench

    pull = gravity * unit(system.down)
    for body in system.bodies:
        push(body.name, frames[body.name].arm(column(body.centre)), body.mass * pull)
    for spring in system.springs:
        first, second, direction, length, rate = _stretch(spring, frames)
        tension = spring.stiffness * (length - spring.rest) + spring.damping * rate + spring.preload
        pulled = tension * direction
        if spring.is_linear:  # smooth where its ends meet
            pulled = spring.stiffness * apart(spring, frames)
        push(spring.first, first, pulled)
        push(spring.second, second, -pulled)
    for i, given in enumerate(system.inputs):
        if isinstance(given, CoordinateForce):
            continue
        frame = frames[given.body]
        direction = unit(given.direction)
        action = inputs[i] * (frame.rotation @ direction if given.follows else direction)
        if isinstance(given, Force):
            push(given.body, frame.arm(column(given.point)), action)
        else:
            push(given.body, None, ca.SX(3, 1), action)
            push(given.reaction, None, ca.SX(3, 1), -action)
    return wrenches


def coordinate_forces(system: System, q: SX, u: SX, inputs: SX) -> SX:
    """Return the forces (n,) on the joint coordinates: preload, springs, dampers and inputs.

    Parameters
    ----------
    system : System
        The machine.
    q, u : SX, shape (n,)
        Joint coordinates and speeds.
    inputs : SX, shape (inputs,)
        N or N m.
    """
    motions = [motion for joint in system.joints for motion in joint.motions]
    forces = [m.preload - m.stiffness * q[i] - m.damping * u[i] for i, m in enumerate(motions)]
    names = system.coordinates
    for i, given in enumerate(system.inputs):
        if isinstance(given, CoordinateForce):
            forces[names.index(given.coordinate)] += inputs[i]
    return ca.vertcat(ca.SX(0, 1), *forces)


def kinetic_energy(system: System, frames: Mapping[str, Frame]) -> SX:
    """Return the kinetic energy, J."""
    energy = ca.SX(0)
    for body in system.bodies:
        frame = frames[body.name]
        velocity = frame.point_velocity(frame.arm(column(body.centre)))
        spin = frame.rotation.T @ frame.spin
        energy += 0.5 * body.mass * ca.dot(velocity, velocity) + 0.5 * ca.dot(spin, inertia_matrix(body) @ spin)
    return energy


def potential_energy(system: System, frames: Mapping[str, Frame], gravity: SX, q: SX) -> SX:
    """Return the potential energy of gravity, springs and joint laws, J.

    Parameters
    ----------
    system : System
        The machine.
    frames : mapping
        Of all bodies, by name.
    gravity : SX, scalar
        In m/s^2, down.
    q : SX, shape (n,)
        Joint coordinates.
    """
    energy = ca.SX(0)
    down = unit(system.down)
    for body in system.bodies:
        energy -= body.mass * gravity * ca.dot(down, frames[body.name].point(column(body.centre)))
    for spring in system.springs:
        if spring.is_linear:
            between = apart(spring, frames)
            energy += 0.5 * spring.stiffness * ca.dot(between, between)
            continue
        length = _stretch(spring, frames)[3]
        energy += 0.5 * spring.stiffness * (length - spring.rest) ** 2 + spring.preload * length
    motions = [motion for joint in system.joints for motion in joint.motions]
    for i, motion in enumerate(motions):
        energy += 0.5 * motion.stiffness * q[i] ** 2 - motion.preload * q[i]
    return energy
