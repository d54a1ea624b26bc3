"""The equations of motion of a machine as compiled CasADi functions.

With the coordinates q (n,), speeds u = q' (n,), accelerations a = u' (n,), inputs f and multipliers m of the
constraints, the motion obeys

    R = M(q) a + h(q, u, f) - C(q)^T m = 0,    phi(q) = 0,    C(q) u = 0,    C(q) a + c(q, u) = 0,

where C stacks the gradient of the holonomic constraints phi and the rows of the rolling constraints. Everything is
built once for a machine; its parameters stay symbols. No derivative is a finite difference.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import casadi as ca

from singletrack.errors import ModelError
from singletrack.multibody.engine.constraints import (
    Contact,
    closure_wrench,
    constraint_rate_changes,
    constraint_rates,
    constraint_wrenches,
    holonomic_residual,
    wheel_contact,
)
from singletrack.multibody.engine.forces import (
    apart,
    applied_wrenches,
    coordinate_forces,
    kinetic_energy,
    potential_energy,
)
from singletrack.multibody.engine.kinematics import SX, Frame, Wrench, column, forward, inverse, unit

if TYPE_CHECKING:
    from singletrack.multibody.engine.closures import Closure
    from singletrack.multibody.engine.connections import Spring
    from singletrack.multibody.engine.system import System

__all__ = ["Equations", "derive"]


@dataclass(frozen=True, eq=False)
class Equations:
    """The compiled functions of a machine; every one takes the parameters ``p`` last.

    Attributes
    ----------
    parameter_names
        Names of the parameters p.
    holonomic
        (q, p) -> phi, its gradient (holonomic rows, n).
    kinetics
        (q, p) -> constraint Jacobian C (rows, n), mass matrix M (n, n).
    bias
        (q, u, f, p) -> h (n,), c (rows,).
    demand
        (q, u, a, f, p) -> M a + h (n,), in one pass.
    inertia
        (q, v, p) -> M v (n,), without M.
    tangent
        (q, u, a, m, f, dq, du, p) -> the changes of R, C u and C a + c in the direction (dq, du), the latter two
        with the rates themselves held.
    input_matrix
        (q, p) -> derivative of -h with respect to the inputs, (n, inputs).
    energy
        (q, u, p) -> kinetic and potential energy, J.
    contacts
        (q, p) -> contact points (3, wheels), headings (3, wheels), how upright the wheels are (1, wheels): one upright,
        zero where the axle is vertical.
    reactions
        (q, u, a, m, f, p) -> forces (3, joints) and moments (3, joints) of parents on children, about their anchors.
    poses
        (q, p) -> translations (3, bodies) and rotations (3, 3 bodies): a drawn point x of a body is at t + R x.
    lengths
        (q, p) -> lengths of the springs that need a direction, then of the rods of fixed length.
    loop_wrenches
        (q, m, p) -> forces (3, loops), torques (3, loops) of first on second bodies.
    sensors
        (q, u, p) -> outputs.
    """

    parameter_names: tuple[str, ...]
    holonomic: ca.Function
    kinetics: ca.Function
    bias: ca.Function
    demand: ca.Function
    inertia: ca.Function
    tangent: ca.Function
    input_matrix: ca.Function
    energy: ca.Function
    contacts: ca.Function
    poses: ca.Function
    reactions: ca.Function
    lengths: ca.Function
    loop_wrenches: ca.Function
    sensors: ca.Function


@dataclass(frozen=True, eq=False)
class _Symbols:
    """The symbols of a machine and what is expressed in them."""

    q: SX
    u: SX
    a: SX
    f: SX
    m: SX
    gravity: SX
    frames: dict[str, Frame]
    contacts: dict[str, Contact]
    demand: SX
    phi: SX
    rate: SX
    reactions: dict[str, Wrench]


def _express(system: System) -> _Symbols:
    n = len(system.coordinates)
    q, u, a = (ca.SX.sym(f"{name} ", n) for name in ("q", "u", "a"))  # the space keeps parameters apart
    f, m = ca.SX.sym("f", len(system.inputs)), ca.SX.sym("m", len(system.rows))
    gravity = ca.SX.sym("gravity")
    frames, links = forward(system, q, u, a)
    contacts = {wheel.name: wheel_contact(wheel, frames) for wheel in system.wheels}
    wrenches = applied_wrenches(system, frames, gravity, f)
    demand = inverse(system, frames, links, wrenches)[0] - coordinate_forces(system, q, u, f)
    constrained = constraint_wrenches(system, frames, contacts, m, wrenches)
    reactions = inverse(system, frames, links, constrained)[1]
    phi = holonomic_residual(system, frames, contacts, q)
    rate = constraint_rates(system, frames, contacts, q, u)
    return _Symbols(q, u, a, f, m, gravity, frames, contacts, demand, phi, rate, reactions)


def _sensor_outputs(system: System, frames: dict[str, Frame]) -> SX:
    outputs = []
    for sensor in system.sensors:
        frame, direction = frames[sensor.body], unit(sensor.direction)
        along = frame.rotation @ direction if sensor.follows else direction
        arm = frame.arm(column(sensor.point))
        value = {"position": frame.position + arm, "velocity": frame.point_velocity(arm), "rate": frame.spin}
        if sensor.kind not in value:
            raise ModelError(f"sensor {sensor.name}: unknown kind {sensor.kind!r} (known: {', '.join(value)})")
        outputs.append(ca.dot(along, value[sensor.kind]))
    return ca.vertcat(ca.SX(0, 1), *outputs)


def _matrix(columns: list[SX]) -> SX:
    return ca.horzcat(ca.SX(3, 0), *columns)


def _poses(system: System, frames: dict[str, Frame]) -> tuple[SX, SX]:
    placed = [frames[body.name] for body in system.bodies]
    translations = [frame.position - frame.rotation @ frame.anchor for frame in placed]
    return _matrix(translations), ca.horzcat(ca.SX(3, 0), *(frame.rotation for frame in placed))


def _reactions(system: System, s: _Symbols) -> tuple[SX, SX]:
    """Return forces (3, joints) and moments (3, joints) of the parents on the children, about the joints' points."""
    wrenches = [s.reactions[joint.name] for joint in system.joints]
    return _matrix([wrench.force for wrench in wrenches]), _matrix([wrench.moment for wrench in wrenches])


def _lengths(system: System, frames: dict[str, Frame]) -> SX:
    ends: list[Spring | Closure] = [spring for spring in system.springs if not spring.is_linear]
    ends += [closure for closure in system.closures if closure.length is not None]
    return ca.vertcat(ca.SX(0, 1), *(ca.norm_2(apart(end, frames)) for end in ends))


def _loop_wrenches(system: System, s: _Symbols) -> tuple[SX, SX]:
    forces, torques, start = [], [], 0
    for closure in system.closures:
        stop = start + len(closure.rows)
        force, torque = closure_wrench(closure, s.frames, s.m[start:stop])
        forces.append(force)
        torques.append(torque)
        start = stop
    return _matrix(forces), _matrix(torques)


def derive(system: System) -> Equations:
    """Derive the equations of motion of a machine (see the module's text).

    Parameters
    ----------
    system : System
        Bodies, joints, loops, wheels, forces.

    Raises
    ------
    ModelError
        Where a sensor is of no known kind.

    Examples
    --------
    >>> from singletrack.multibody import Body, System, revolute
    >>> bob = Body("bob", 2.0, (0, 0, 3))
    >>> swing = revolute("swing", "ground", "bob", (0, 0, 0), (0, 1, 0))
    >>> jacobian, mass = derive(System([bob], [swing])).kinetics([0.3], [9.81])
    >>> float(mass)
    18.0
    """
    s = _express(system)
    n = len(system.coordinates)
    zero = ca.SX.zeros(n)
    jacobian, mass = ca.jacobian(s.rate, s.u), ca.jacobian(s.demand, s.a)
    rate_change = constraint_rate_changes(system, s.frames, s.q, s.u)
    bias = ca.substitute(s.demand, s.a, zero)
    residual = s.demand - ca.jtimes(s.rate, s.u, s.m, True)  # noqa: FBT003  # CasADi's flag: transposed
    dq, du = ca.SX.sym("dq", n), ca.SX.sym("du", n)
    acceleration_level = rate_change + ca.jtimes(s.rate, s.u, s.a)
    change = ca.jtimes(ca.vertcat(residual, acceleration_level), ca.vertcat(s.q, s.u), ca.vertcat(dq, du))
    points = _matrix([s.contacts[wheel.name].point for wheel in system.wheels])
    headings = _matrix([s.contacts[wheel.name].heading for wheel in system.wheels])
    levels = ca.horzcat(ca.SX(1, 0), *(s.contacts[wheel.name].level for wheel in system.wheels))
    outputs = {
        "holonomic": ((s.q,), (s.phi, jacobian[: s.phi.numel(), :])),
        "kinetics": ((s.q,), (jacobian, mass)),
        "bias": ((s.q, s.u, s.f), (bias, rate_change)),
        "demand": ((s.q, s.u, s.a, s.f), (s.demand,)),
        "inertia": ((s.q, dq), (ca.jtimes(s.demand, s.a, dq),)),
        "tangent": (
            (s.q, s.u, s.a, s.m, s.f, dq, du),
            (change[:n], ca.jtimes(s.rate, s.q, dq), change[n:]),
        ),
        "input_matrix": ((s.q,), (-ca.jacobian(bias, s.f),)),
        "energy": (
            (s.q, s.u),
            (kinetic_energy(system, s.frames), potential_energy(system, s.frames, s.gravity, s.q)),
        ),
        "contacts": ((s.q,), (points, headings, levels)),
        "poses": ((s.q,), _poses(system, s.frames)),
        "reactions": ((s.q, s.u, s.a, s.m, s.f), _reactions(system, s)),
        "lengths": ((s.q,), (_lengths(system, s.frames),)),
        "loop_wrenches": ((s.q, s.m), _loop_wrenches(system, s)),
        "sensors": ((s.q, s.u), (_sensor_outputs(system, s.frames),)),
    }
    return _compile(outputs, s.gravity)


def _compile(outputs: dict[str, tuple[tuple[SX, ...], tuple[SX, ...]]], gravity: SX) -> Equations:
    free: dict[str, SX] = {}
    for arguments, results in outputs.values():
        own = {symbol.name() for argument in arguments for symbol in ca.symvar(argument)}
        for result in results:
            free |= {symbol.name(): symbol for symbol in ca.symvar(result) if symbol.name() not in own}
    free.pop("gravity", None)
    names = sorted(free)
    p = ca.vertcat(gravity, *(free[name] for name in names))
    functions = {
        name: ca.Function(name, [*arguments, p], ca.cse([ca.densify(result) for result in results]))
        for name, (arguments, results) in outputs.items()
    }
    return Equations(("gravity", *names), **functions)
