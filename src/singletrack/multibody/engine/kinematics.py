"""Where the bodies are, how they move, and which joint forces that takes (recursive Newton-Euler), as expressions.

All vectors are in the frame of the ground. A body is placed by its anchor, the point of the joint it hangs from:
the drawn point ``x`` is at ``position + rotation (x - anchor)``. Relative vectors are added up along the tree, so a
machine far from the origin loses no digits.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, TypeAlias

import casadi as ca

from singletrack.multibody.engine.elements import GROUND

if TYPE_CHECKING:
    from collections.abc import Mapping

    from singletrack.multibody.engine.elements import Body, Joint, Vector
    from singletrack.multibody.engine.system import System

__all__ = ["Frame", "Wrench", "forward", "inverse", "rotation_about"]

SX: TypeAlias = ca.SX
DOWN = ca.SX([0, 0, 1])


def column(vector: Vector) -> SX:
    """Return three numbers or parameters as a column."""
    return ca.vertcat(*(ca.SX(component) for component in vector))


def unit(vector: Vector) -> SX:
    """Return a column of length one; numbers were normalised when the element was made."""
    axis = column(vector)
    return axis if axis.is_constant() else axis / ca.norm_2(axis)


def rotation_about(axis: SX, angle: SX) -> SX:
    """Return the rotation matrix about a unit axis (Rodrigues).

    Parameters
    ----------
    axis : SX, shape (3,)
        A unit vector.
    angle : SX, scalar
        In rad.
    """
    c, s = ca.cos(angle), ca.sin(angle)
    return c * ca.SX.eye(3) + s * ca.skew(axis) + (1 - c) * (axis @ axis.T)


@dataclass(frozen=True, eq=False)
class Frame:
    """Pose, velocity and acceleration of a body, at its anchor."""

    anchor: SX
    position: SX
    rotation: SX
    velocity: SX
    spin: SX
    acceleration: SX
    angular_acceleration: SX

    def arm(self, point: SX) -> SX:
        """Return the vector from the anchor to a drawn point of the body."""
        return self.rotation @ (point - self.anchor)

    def point(self, point: SX) -> SX:
        """Return the place of a drawn point, m."""
        return self.position + self.arm(point)

    def point_velocity(self, arm: SX) -> SX:
        """Return the velocity of the body's material point at ``arm`` from the anchor, m/s."""
        return self.velocity + ca.cross(self.spin, arm)

    def point_acceleration(self, arm: SX) -> SX:
        """Return the acceleration of the body's material point at ``arm`` from the anchor, m/s^2."""
        turning = ca.cross(self.angular_acceleration, arm) + ca.cross(self.spin, ca.cross(self.spin, arm))
        return self.acceleration + turning


@dataclass(frozen=True, eq=False)
class Wrench:
    """A force (N) on a body and its moment (N m) about the body's anchor."""

    force: SX
    moment: SX

    def __add__(self, other: Wrench) -> Wrench:
        return Wrench(self.force + other.force, self.moment + other.moment)


@dataclass(frozen=True, eq=False)
class Link:
    """A joint in motion: the arm from the parent's anchor to the child's, and the axes of its motions.

    ``levers`` lead from where each motion turns to the child's anchor: not zero where a slide follows a turn.
    """

    arm: SX
    axes: tuple[SX, ...]
    levers: tuple[SX, ...]


def ground_frame() -> Frame:
    """Return the frame that never moves."""
    zero = ca.SX(3, 1)
    return Frame(zero, zero, ca.SX.eye(3), zero, zero, zero, zero)


def quaternion_turn(q: SX) -> tuple[SX, SX]:
    """Return the rotation (3, 3) of a quaternion less (1, 0, 0, 0), and the matrix (3, 4) from its rate to the spin.

    Both hold for quaternions of any length, so that rounding in the length does no harm.
    """
    e, v = 1 + q[0], q[1:]
    square = e * e + ca.dot(v, v)
    turn = (2 * (v @ v.T) + (e * e - ca.dot(v, v)) * ca.SX.eye(3) + 2 * e * ca.skew(v)) / square
    return turn, 2 * ca.horzcat(-v, e * ca.SX.eye(3) + ca.skew(v)) / square


def _carry(parent: Frame, joint: Joint, q: SX, u: SX, a: SX) -> tuple[Frame, Link]:
    point = column(joint.point)
    arm = parent.arm(point)
    rotation, spin, angular = parent.rotation, parent.spin, parent.angular_acceleration
    velocity, acceleration = parent.point_velocity(arm), parent.point_acceleration(arm)
    axes, reached = [], []
    simple = joint.motions[:-4] if joint.quaternion else joint.motions
    for i, motion in enumerate(simple):
        drawn = unit(motion.axis)
        axis = rotation @ drawn
        axes.append(axis)
        reached.append(arm)
        if motion.rotates:
            angular = angular + axis * a[i] + ca.cross(spin, axis) * u[i]
            spin = spin + axis * u[i]
            rotation = rotation @ rotation_about(drawn, q[i])
        else:
            slid, moving = axis * q[i], axis * u[i]
            arm = arm + slid
            velocity = velocity + ca.cross(spin, slid) + moving
            turning = ca.cross(angular, slid) + ca.cross(spin, ca.cross(spin, slid))
            acceleration = acceleration + turning + 2 * ca.cross(spin, moving) + axis * a[i]
    if joint.quaternion:
        turn, columns = quaternion_turn(q[-4:])
        relative, change = columns @ u[-4:], columns @ a[-4:] + ca.jtimes(columns @ u[-4:], q[-4:], u[-4:])
        angular = angular + rotation @ change + ca.cross(spin, rotation @ relative)
        spin = spin + rotation @ relative
        axes += [rotation @ columns[:, i] for i in range(4)]
        reached += [arm] * 4
        rotation = rotation @ turn
    frame = Frame(point, parent.position + arm, rotation, velocity, spin, acceleration, angular)
    return frame, Link(arm, tuple(axes), tuple(arm - before for before in reached))


def tree_order(system: System) -> list[Joint]:
    """Return the joints from the ground outwards."""
    order: list[Joint] = []
    reached, waiting = {GROUND}, list(system.joints)
    while waiting:
        ready = [joint for joint in waiting if joint.parent in reached]
        order += ready
        reached |= {joint.child for joint in ready}
        waiting = [joint for joint in waiting if joint.child not in reached]
    return order


def coordinates_by_joint(system: System) -> dict[str, slice]:
    """Return which coordinates belong to each joint."""
    found, start = {}, 0
    for joint in system.joints:
        found[joint.name] = slice(start, start + len(joint.motions))
        start += len(joint.motions)
    return found


def forward(system: System, q: SX, u: SX, a: SX) -> tuple[dict[str, Frame], dict[str, Link]]:
    """Return the frames of all bodies and the links of all joints for coordinates, speeds and accelerations (n,).

    Parameters
    ----------
    system : System
        The machine.
    q, u, a : SX, shape (n,)
        Joint coordinates, speeds and accelerations.
    """
    frames, links = {GROUND: ground_frame()}, {}
    place = coordinates_by_joint(system)
    for joint in tree_order(system):
        own = place[joint.name]
        frames[joint.child], links[joint.name] = _carry(frames[joint.parent], joint, q[own], u[own], a[own])
    return frames, links


def inertia_matrix(body: Body) -> SX:
    """Return the inertia about the centre of mass in the drawing, kg m^2, (3, 3)."""
    xx, yy, zz, xy, yz, xz = (ca.SX(value) for value in body.inertia)
    return ca.vertcat(ca.horzcat(xx, xy, xz), ca.horzcat(xy, yy, yz), ca.horzcat(xz, yz, zz))


def inertial_wrench(body: Body, frame: Frame) -> Wrench:
    """Return the wrench that a body's motion takes (Newton and Euler)."""
    if ca.SX(body.mass).is_zero() and inertia_matrix(body).nnz() == 0:
        return Wrench(ca.SX(3, 1), ca.SX(3, 1))
    arm = frame.arm(column(body.centre))
    force = ca.SX(body.mass) * frame.point_acceleration(arm)
    to_body, inertia = frame.rotation.T, inertia_matrix(body)
    spin = to_body @ frame.spin
    change = inertia @ (to_body @ frame.angular_acceleration) + ca.cross(spin, inertia @ spin)
    return Wrench(force, ca.cross(arm, force) + frame.rotation @ change)


def inverse(
    system: System, frames: Mapping[str, Frame], links: Mapping[str, Link], applied: Mapping[str, Wrench]
) -> tuple[SX, dict[str, Wrench]]:
    """Return the generalised forces (n,) that the motion takes beyond the applied wrenches, and the joints' wrenches.

    Recursive Newton-Euler: the wrench every joint must transmit, from the tips of the tree to the ground.

    Parameters
    ----------
    system : System
        The machine.
    frames, links : mapping
        Of :func:`forward`, by name.
    applied : mapping
        Wrenches by body.
    """
    bodies = {body.name: body for body in system.bodies}
    carried: dict[str, Wrench] = {}
    through: dict[str, Wrench] = {}
    place = coordinates_by_joint(system)
    forces: dict[int, SX] = {}
    for joint in reversed(tree_order(system)):
        child, link = joint.child, links[joint.name]
        wrench = inertial_wrench(bodies[child], frames[child])
        if child in carried:
            wrench = wrench + carried[child]
        if child in applied:
            wrench = wrench + Wrench(-applied[child].force, -applied[child].moment)
        through[joint.name] = wrench
        for i, (motion, axis, lever) in enumerate(zip(joint.motions, link.axes, link.levers, strict=True)):
            along = wrench.moment + ca.cross(lever, wrench.force) if motion.rotates else wrench.force
            forces[place[joint.name].start + i] = ca.dot(axis, along)
        handed = Wrench(wrench.force, wrench.moment + ca.cross(link.arm, wrench.force))
        carried[joint.parent] = carried[joint.parent] + handed if joint.parent in carried else handed
    return ca.vertcat(ca.SX(0, 1), *(forces[i] for i in range(len(forces)))), through
