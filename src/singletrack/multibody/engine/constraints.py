"""Closed loops and rolling wheels as expressions: what must vanish, and the forces that keep it so."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import casadi as ca

from singletrack.multibody.engine.elements import GROUND
from singletrack.multibody.engine.kinematics import DOWN, SX, Wrench, column, coordinates_by_joint, forward, unit

if TYPE_CHECKING:
    from collections.abc import Mapping

    from singletrack.multibody.engine.closures import Closure, Ratio
    from singletrack.multibody.engine.connections import Wheel
    from singletrack.multibody.engine.kinematics import Frame
    from singletrack.multibody.engine.system import System

__all__ = [
    "Contact",
    "closure_wrench",
    "constraint_rate_changes",
    "constraint_rates",
    "constraint_wrenches",
    "holonomic_residual",
    "wheel_contact",
]


def closure_residual(closure: Closure, frames: Mapping[str, Frame]) -> SX:
    """Return what must vanish for the loop to be closed: one entry for each of the closure's rows."""
    first, second = frames[closure.first], frames[closure.second]
    apart = second.point(column(closure.second_point)) - first.point(column(closure.first_point))
    if closure.length is not None:
        return ca.norm_2(apart) - ca.SX(closure.length)
    rows = [ca.dot(first.rotation @ column(direction), apart) for direction in closure.directions]
    rows += [ca.dot(first.rotation @ column(one), second.rotation @ column(other)) for one, other in closure.orthogonal]
    return ca.vertcat(*rows)


def closure_rate(closure: Closure, frames: Mapping[str, Frame]) -> SX:
    """Return the rate of :func:`closure_residual`, from the velocities of the bodies."""
    first, second = frames[closure.first], frames[closure.second]
    arms = first.arm(column(closure.first_point)), second.arm(column(closure.second_point))
    apart = second.position + arms[1] - first.position - arms[0]
    parting = second.point_velocity(arms[1]) - first.point_velocity(arms[0])
    if closure.length is not None:
        return ca.dot(apart, parting) / ca.norm_2(apart)
    # seen from the first body, so that the direction rests: one cross product for all directions
    seen = parting - ca.cross(first.spin, apart)
    rows = [ca.dot(first.rotation @ column(direction), seen) for direction in closure.directions]
    turning = second.spin - first.spin
    for one, other in closure.orthogonal:
        axis = ca.cross(second.rotation @ column(other), first.rotation @ column(one))
        rows.append(ca.dot(turning, axis))
    return ca.vertcat(*rows)


def closure_wrench(closure: Closure, frames: Mapping[str, Frame], multipliers: SX) -> tuple[SX, SX]:
    """Return the force (N) and torque (N m) of the first body on the second, at its point, in the ground's frame.

    Parameters
    ----------
    closure : Closure
        The loop.
    frames : mapping
        Of all bodies, by name.
    multipliers : SX, shape (k,)
        Of its rows.
    """
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
    """Where and how a wheel touches the ground: point, heading, and the velocity of the wheel's material there.

    ``level`` is the length of axle x down: zero where the wheel lies flat. The velocity has three parts: forward
    along the heading, to the side, down. The contact sinks as fast as the material in it, as the wheel is lowest there.
    """

    point: SX
    heading: SX
    velocity: SX
    level: SX


def wheel_contact(wheel: Wheel, frames: Mapping[str, Frame]) -> Contact:
    """Return the contact of a wheel with the ground (see :class:`~singletrack.multibody.Wheel`).

    Parameters
    ----------
    wheel : Wheel
        The wheel.
    frames : mapping
        Of all bodies, by name.
    """
    frame = frames[wheel.body]
    axle = frame.rotation @ unit(wheel.axle)
    across = ca.cross(axle, DOWN)
    level = ca.norm_2(across)
    downward = (DOWN - axle[2] * axle) / level
    arm = frame.arm(column(wheel.centre)) + (wheel.radius - wheel.crown) * downward + wheel.crown * DOWN
    heading = across / level
    side = ca.cross(DOWN, heading)
    velocity = frame.point_velocity(arm)
    parts = ca.vertcat(ca.dot(heading, velocity), ca.dot(side, velocity), velocity[2])
    return Contact(frame.position + arm, heading, parts, level)


def _quaternions(system: System, q: SX) -> list[SX]:
    """Return the coordinates of every quaternion (each less one in its first component)."""
    place = coordinates_by_joint(system)
    return [q[place[joint.name]][-4:] for joint in system.joints if joint.quaternion]


def _combined(system: System, ratio: Ratio, q: SX) -> SX:
    return sum((factor * q[system.coordinates.index(name)] for name, factor in ratio.factors.items()), ca.SX(0))


def holonomic_residual(system: System, frames: Mapping[str, Frame], contacts: Mapping[str, Contact], q: SX) -> SX:
    """Return everything that must vanish in position: loops, lengths of quaternions, wheel heights.

    Parameters
    ----------
    system : System
        The machine.
    frames, contacts : mapping
        Of all bodies, of all wheels, by name.
    q : SX, shape (n,)
        Joint coordinates.
    """
    loops = [closure_residual(closure, frames) for closure in system.closures]
    loops += [_combined(system, ratio, q) - ratio.offset for ratio in system.ratios]
    lengths = [2 * part[0] + ca.dot(part, part) for part in _quaternions(system, q)]
    return ca.vertcat(ca.SX(0, 1), *loops, *lengths, *(contacts[wheel.name].point[2] for wheel in system.wheels))


def constraint_rates(system: System, frames: Mapping[str, Frame], contacts: Mapping[str, Contact], q: SX, u: SX) -> SX:
    """Return everything that must vanish in velocity: rates of the holonomic residual, then the slip of wheels.

    Parameters
    ----------
    system : System
        The machine.
    frames, contacts : mapping
        Of all bodies, of all wheels, by name.
    q, u : SX, shape (n,)
        Joint coordinates and speeds.
    """
    touching = [contacts[wheel.name].velocity for wheel in system.wheels]
    loops = [closure_rate(closure, frames) for closure in system.closures]
    loops += [_combined(system, ratio, u) for ratio in system.ratios]
    pairs = zip(_quaternions(system, q), _quaternions(system, u), strict=True)
    lengths = [2 * rate[0] + 2 * ca.dot(part, rate) for part, rate in pairs]
    sinking, slipping = [v[2] for v in touching], [v[:2] for v in touching]
    return ca.vertcat(ca.SX(0, 1), *loops, *lengths, *sinking, *slipping)


def constraint_rate_changes(system: System, frames: Mapping[str, Frame], q: SX, u: SX) -> SX:
    """Return how the rates of :func:`constraint_rates` change by the speeds alone, without accelerations.

    The rates depend on the poses and velocities of a few bodies, of which the velocities and the accelerations that go
    with the speeds are known: that takes far fewer operations than their derivative by all coordinates.

    Parameters
    ----------
    system : System
        The machine.
    frames : mapping
        Of all bodies, by name.
    q, u : SX, shape (n,)
        Joint coordinates and speeds.
    """
    steady = forward(system, q, u, ca.SX(len(system.coordinates), 1))[0]
    touched = [end for closure in system.closures for end in (closure.first, closure.second)]
    touched += [wheel.body for wheel in system.wheels]
    seen, symbols, values, changes = dict(frames), [q], [q], [u]
    for name in dict.fromkeys(touched):
        frame = frames[name]
        if name == GROUND:
            continue
        now = (frame.position, ca.densify(ca.vec(frame.rotation)), frame.velocity, frame.spin)
        turning = ca.vec(ca.skew(frame.spin) @ frame.rotation)
        own = [ca.SX.sym(f"{name} {k}", value.numel()) for k, value in enumerate(now)]
        position, turned, velocity, spin = own
        seen[name] = replace(frame, position=position, rotation=ca.reshape(turned, 3, 3), velocity=velocity, spin=spin)
        symbols += own
        values += now
        changes += [frame.velocity, turning, steady[name].acceleration, steady[name].angular_acceleration]
    contacts = {wheel.name: wheel_contact(wheel, seen) for wheel in system.wheels}
    rates = constraint_rates(system, seen, contacts, q, u)
    every, change = ca.vertcat(*symbols), ca.SX.sym("change", sum(symbol.numel() for symbol in symbols))
    along = ca.jtimes(rates, every, change)
    return ca.substitute(along, ca.vertcat(every, change), ca.densify(ca.vertcat(*values, *changes)))


def constraint_wrenches(
    system: System,
    frames: Mapping[str, Frame],
    contacts: Mapping[str, Contact],
    m: SX,
    applied: Mapping[str, Wrench],
) -> dict[str, Wrench]:
    """Return the applied wrenches together with those of loops and wheels, for multipliers m, about the anchors.

    Parameters
    ----------
    system : System
        The machine.
    frames, contacts : mapping
        Of all bodies, of all wheels, by name.
    m : SX, shape (rows,)
        The multipliers.
    applied : mapping
        Wrenches by body.
    """
    wrenches = dict(applied)

    def push(body: str, arm: SX, force: SX, torque: SX) -> None:
        wrench = Wrench(force, ca.cross(arm, force) + torque)
        wrenches[body] = wrenches[body] + wrench if body in wrenches else wrench

    start = 0
    for closure in system.closures:
        stop = start + len(closure.rows)
        force, torque = closure_wrench(closure, frames, m[start:stop])
        second = frames[closure.second].point(column(closure.second_point))
        # the force on the first body acts where the second is held, also where the points may part
        push(closure.second, second - frames[closure.second].position, force, torque)
        push(closure.first, second - frames[closure.first].position, -force, -torque)
        start = stop
    holonomic, wheels, zero = len(system.holonomic_rows), len(system.wheels), ca.SX(3, 1)
    for i, wheel in enumerate(system.wheels):
        contact = contacts[wheel.name]
        along, across = m[holonomic + 2 * i], m[holonomic + 2 * i + 1]
        force = along * contact.heading + across * ca.cross(DOWN, contact.heading) + m[holonomic - wheels + i] * DOWN
        push(wheel.body, contact.point - frames[wheel.body].position, force, zero)
    return wrenches
