"""Accelerations of a tree in as many operations as it has bodies (articulated bodies, Featherstone).

Seen from its joint, all that hangs on it is one body whose inertia depends on how it can give way. From the tips to
the ground each motion's share is taken out of that inertia; back outwards the accelerations follow one after the
other. All is in the ground's axes, at the anchors of the bodies, so that going from body to body is a shift.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

import casadi as ca

from singletrack.multibody.engine.kinematics import (
    SX,
    column,
    coordinates_by_joint,
    forward,
    inertia_matrix,
    tree_order,
)

if TYPE_CHECKING:
    from collections.abc import Mapping

    from singletrack.multibody.engine.elements import Body
    from singletrack.multibody.engine.equations import Equations
    from singletrack.multibody.engine.kinematics import Frame, Link
    from singletrack.multibody.engine.system import System

__all__ = ["tree_expression"]


class _Inertia(NamedTuple):
    """``moment = A alpha + B a, force = B^T alpha + C a`` at an anchor, each (3, 3)."""

    A: SX
    B: SX
    C: SX

    def __add__(self, other: Any) -> _Inertia:
        return _Inertia(self.A + other.A, self.B + other.B, self.C + other.C)


class _Share(NamedTuple):
    """What a motion takes: its directions, what it pushes (moment and force), its inertia and the force left."""

    turn: SX
    slide: SX
    moment: SX
    force: SX
    size: SX
    left: SX


def _of_body(body: Body, frame: Frame) -> _Inertia:
    arm, mass = frame.arm(column(body.centre)), ca.SX(body.mass)
    across = ca.skew(arm)
    own = frame.rotation @ inertia_matrix(body) @ frame.rotation.T
    return _Inertia(own - mass * across @ across, mass * across, mass * ca.SX.eye(3))


def _shifted(one: _Inertia, arm: SX) -> _Inertia:
    """Return the inertia at the parent's anchor, from which the child's lies at ``arm``."""
    across = ca.skew(arm)
    coupling = one.B + across @ one.C
    return _Inertia(one.A - one.B @ across + across @ coupling.T, coupling, one.C)


def _taken_out(one: _Inertia, share: _Share) -> _Inertia:
    m, f, d = share.moment, share.force, share.size
    return _Inertia(one.A - m @ m.T / d, one.B - m @ f.T / d, one.C - f @ f.T / d)


def _solve_tree(system: System, frames: Mapping[str, Frame], links: Mapping[str, Link], forces: list[SX]) -> SX:
    """Return M^-1 forces, (n,), for a tree."""
    order, place = tree_order(system), coordinates_by_joint(system)
    bodies = {body.name: body for body in system.bodies}
    whole = {name: _of_body(body, frames[name]) for name, body in bodies.items()}
    pushed = {name: (ca.SX(3, 1), ca.SX(3, 1)) for name in bodies}
    shares: dict[int, _Share] = {}
    for joint in reversed(order):
        inertia, (moment, force), link = whole[joint.child], pushed[joint.child], links[joint.name]
        motions = list(zip(joint.motions, link.axes, link.levers, strict=True))
        for i, (motion, axis, lever) in reversed(list(enumerate(motions))):
            turn, slide = (axis, ca.cross(axis, lever)) if motion.rotates else (ca.SX(3, 1), axis)
            m, f = inertia.A @ turn + inertia.B @ slide, inertia.B.T @ turn + inertia.C @ slide
            left = forces[place[joint.name].start + i] - ca.dot(turn, moment) - ca.dot(slide, force)
            share = _Share(turn, slide, m, f, ca.dot(turn, m) + ca.dot(slide, f), left)
            shares[place[joint.name].start + i] = share
            inertia = _taken_out(inertia, share)
            moment, force = moment + m * (left / share.size), force + f * (left / share.size)
        if joint.parent in whole:
            m, f = pushed[joint.parent]
            whole[joint.parent] = whole[joint.parent] + _shifted(inertia, link.arm)
            pushed[joint.parent] = (m + moment + ca.cross(link.arm, force), f + force)
    found: dict[int, SX] = {}
    moved = {"ground": (ca.SX(3, 1), ca.SX(3, 1))}
    for joint in order:
        alpha, a = moved[joint.parent]
        a = a + ca.cross(alpha, links[joint.name].arm)
        for i in range(place[joint.name].start, place[joint.name].stop):
            share = shares[i]
            found[i] = (share.left - ca.dot(share.moment, alpha) - ca.dot(share.force, a)) / share.size
            alpha, a = alpha + share.turn * found[i], a + share.slide * found[i]
        moved[joint.child] = alpha, a
    return ca.vertcat(*(found[i] for i in range(len(found))))


def tree_expression(system: System, equations: Equations) -> ca.Function:
    """Return the function (q, u_i, f, p) -> u (n,), a (n,), no multipliers, for a tree without constraints.

    Parameters
    ----------
    system : System
        Whose joints form a tree and whose wheels, if any, are free.
    equations : Equations
        Its equations of motion.
    """
    n = len(system.coordinates)
    q, u = ca.SX.sym("q ", n), ca.SX.sym("u ", n)
    f, p = ca.SX.sym("f", len(system.inputs)), ca.SX.sym("p", len(equations.parameter_names))
    frames, links = forward(system, q, u, ca.SX(n, 1))
    h = equations.bias(q, u, f, p)[0]
    a = _solve_tree(system, frames, links, [-h[i] for i in range(n)])
    known = {symbol.name(): symbol for symbol in ca.symvar(a)}
    given = [(known[name], p[i]) for i, name in enumerate(equations.parameter_names) if name in known]
    if given:
        a = ca.substitute(a, ca.vertcat(*(one for one, _ in given)), ca.vertcat(*(other for _, other in given)))
    return ca.Function("tree", [q, u, f, p], ca.cse([u, ca.densify(a), ca.SX(0, 1)]))
