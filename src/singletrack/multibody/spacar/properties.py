"""Statements that say what acts: mass, springs, loads, inputs and outputs, time."""

from __future__ import annotations

from typing import TYPE_CHECKING

from singletrack.multibody.spacar.description import Input, Output
from singletrack.multibody.spacar.kinds import KINDS
from singletrack.multibody.spacar.reader import NODES

if TYPE_CHECKING:
    from collections.abc import Callable

    from singletrack.multibody.spacar.reader import Reader

__all__ = [
    "add_force",
    "add_line_mass",
    "add_mass",
    "add_port",
    "add_torque",
    "constants",
    "set_gravity",
    "set_steps",
    "set_tolerance",
]

MOST_STEPS = 100_000


def add_mass(reader: Reader) -> None:
    """MASS, XM: mass of a position, moments of inertia of an orientation.

    Parameters
    ----------
    reader : Reader
        At the statement; what it says is put into its description.
    """
    d = reader.description
    reader.count(2, 7, "a node and its mass or moments of inertia")
    node, values = reader.node(), reader.numbers[1:]
    wanted = 6 if d.nodes[node] == "o3" else 1
    if len(values) != wanted:
        kind = "Ixx Ixy Ixz Iyy Iyz Izz" if wanted == 6 else "one number"
        raise reader.refuse(f"node {node} is {NODES[d.nodes[node]]}, must have {kind}; found {len(values)} numbers")
    if wanted == 1:
        reader.not_negative(values, "mass")
    elif min(values[0], values[3], values[5]) < 0.0:
        raise reader.refuse("a moment of inertia is negative")
    d.masses[node] = values


def add_line_mass(reader: Reader) -> None:
    """EMASS, EM: mass per length of a beam or truss.

    Parameters
    ----------
    reader : Reader
        At the statement; what it says is put into its description.
    """
    d = reader.description
    reader.count(2, 3, "an element, its mass per length and, for a beam in space, its moment of inertia per length")
    number = reader.element()
    kind = KINDS[d.elements[number].kind]
    if kind.mass is None:
        raise reader.refuse(f"element {number} is a {kind.name}, which has no length to carry mass")
    values = reader.not_negative(reader.numbers[1:], "mass per length")
    if len(values) == 2 and kind.mass != "beam3":
        raise reader.refuse(f"element {number} is a {kind.name}: one number only")
    d.line_masses[number] = values


def constants(name: str) -> Callable[[Reader], None]:
    """Return a handler of stiffness and damping.

    Parameters
    ----------
    name : str
        Of the table in the description: ``stiffness`` or ``damping``.
    """

    def handler(reader: Reader) -> None:
        d = reader.description
        number = reader.element()
        kind = KINDS[d.elements[number].kind]
        slips = len(kind.components) - kind.holonomic
        if kind.name == "PINBODY" or (slips and name == "stiffness"):
            raise reader.refuse(f"element {number} is a {kind.name}, which is rigid")
        # Of a wheel, only slip has rates that a damper can work on: a tyre at low frequency.
        most = slips or {"beam3": 4, "beam2": 2}.get(kind.mass or "", len(kind.components))
        reader.count(2, 1 + most, f"an element and up to {most} constants of a {kind.name}")
        values = reader.not_negative(reader.numbers[1:], name)
        getattr(d, name)[number] = values + (0.0,) * (most - len(values))

    return handler


def add_force(reader: Reader) -> None:
    """FORCE, XF: a constant force or moment on a node.

    Parameters
    ----------
    reader : Reader
        At the statement; what it says is put into its description.
    """
    d = reader.description
    node, values = reader.node(), reader.numbers[1:]
    kind, width = d.nodes[node], d.width(node)
    # Components that are left away are zero, but for orientations in space, where their number tells what is meant.
    allowed = (3, 4) if kind == "o3" else tuple(range(1, width + 1))
    if len(values) not in allowed:
        wanted = " or ".join(map(str, allowed))
        raise reader.refuse(f"node {node} is {NODES[kind]}, must have {wanted} components; found {len(values)}")
    values += (0.0,) * (width - len(values)) if kind != "o3" else ()
    d.forces[node] = values


def add_torque(reader: Reader) -> None:
    """TORQUEL: a constant torque in the axes of a body.

    Parameters
    ----------
    reader : Reader
        At the statement; what it says is put into its description.
    """
    d = reader.description
    reader.count(4, 4, "an orientation in space and three components in the body's axes")
    node = reader.node()
    if d.nodes[node] != "o3":
        raise reader.refuse(f"node {node} is {NODES[d.nodes[node]]}, must be {NODES['o3']}")
    d.torques[node] = reader.numbers[1:]


def set_gravity(reader: Reader) -> None:
    """GRAVITY: the acceleration of falling.

    Parameters
    ----------
    reader : Reader
        At the statement; what it says is put into its description.
    """
    reader.count(2, 3, "two or three components")
    reader.description.gravity = reader.numbers


def add_port(what: str, direction: str) -> Callable[[Reader], None]:
    """Return a handler of inputs and outputs of the linear model.

    Parameters
    ----------
    what : str
        ``x`` for a coordinate, ``e`` for a deformation.
    direction : str
        ``inputs`` or ``outputs``.
    """

    def handler(reader: Reader) -> None:
        d = reader.description
        reader.count(3, 3, f"the number of the {direction}, then element (or node) and component")
        number = reader.whole(0, direction)
        reader.numbers = reader.numbers[1:]
        key = (reader.node_keys() if what.startswith("x") else reader.element_keys())[0]
        ports: list[Input] | list[Output] = d.inputs if direction == "input" else d.outputs
        if any(port.number == number for port in ports):
            raise reader.refuse(f"{direction} {number} is given twice")
        if direction == "input":
            d.inputs.append(Input(number, what, key))
        else:
            d.outputs.append(Output(number, what, key))

    return handler


def set_steps(reader: Reader) -> None:
    """TIMESTEP: steps and time of the simulation; the dialects have opposite orders.

    Parameters
    ----------
    reader : Reader
        At the statement; what it says is put into its description.
    """
    reader.count(2, 2, "the number of steps and the time")
    steps, duration = reader.numbers if reader.source.dialect == "delft" else reader.numbers[::-1]
    order = "steps, then time" if reader.source.dialect == "delft" else "time, then steps"
    if steps != int(steps) or not 1 <= steps <= MOST_STEPS:
        raise reader.refuse(f"found {steps:g} steps, must be a whole number from 1 to {MOST_STEPS} ({order})")
    if not 0.0 < duration <= 1e6:
        raise reader.refuse(f"found a time of {duration:g} s, must be above 0 and at most 1e6 ({order})")
    reader.description.steps, reader.description.duration = int(steps), duration


def set_tolerance(reader: Reader) -> None:
    """EPSKIN, EPSINT, EPSIND, HMAX: tolerances and the longest step.

    Parameters
    ----------
    reader : Reader
        At the statement; what it says is put into its description.
    """
    reader.count(1, 1, "one number")
    if reader.numbers[0] <= 0.0:
        raise reader.refuse(f"found {reader.numbers[0]:g}, must be positive")
    reader.description.settings[reader.statement.keyword] = reader.numbers[0]
