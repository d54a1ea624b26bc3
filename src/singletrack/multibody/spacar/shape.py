"""Statements that say what the mechanism is: elements, the drawing, what moves and how."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from singletrack.multibody.spacar.description import Element
from singletrack.multibody.spacar.kinds import KINDS
from singletrack.multibody.spacar.reader import NODES

if TYPE_CHECKING:
    from collections.abc import Callable

    from singletrack.multibody.spacar.reader import Reader

__all__ = ["add_element", "draw", "initial_value", "line_freedom", "mark", "pair_slip", "prescribe"]


def add_element(reader: Reader) -> None:
    """One of the elements, by its own keyword.

    Parameters
    ----------
    reader : Reader
        At the statement; what it says is put into its description.
    """
    d, kind = reader.description, KINDS[reader.statement.keyword]
    nodes = len(kind.nodes)
    plain = 1 + nodes
    axis = "" if not kind.numbers else f" and {kind.numbers} components of its axis"
    if len(reader.numbers) not in {plain, plain + kind.numbers}:
        raise reader.refuse(f"found {len(reader.numbers)} numbers, must have a number, {nodes} nodes{axis}")
    number = reader.whole(0, "element")
    if number in d.elements:
        raise reader.refuse(f"element {number} is given twice (first on line {d.elements[number].line})")
    named = tuple(reader.whole(i, "node") for i in range(1, plain))
    # A rigid body may be a beam with one orientation at both ends; nothing else joins a node to itself.
    body = kind.mass in {"beam2", "beam3"} and named[1] == named[3]
    apart = named[:3] if body else named
    if len(set(apart)) != len(apart):
        raise reader.refuse(f"names node {max(named, key=named.count)} twice")
    for node, wanted in zip(named, kind.nodes, strict=True):
        found = d.nodes.setdefault(node, wanted)
        if found != wanted:
            raise reader.refuse(f"node {node} is {NODES[found]} to another element, must be {NODES[wanted]} here")
    if kind.name in {"HINGE", "BEARING", "WHEEL"} and len(reader.numbers) == plain:
        raise reader.refuse("has no axis, must have three components of it")
    name = kind.name
    if reader.source.dialect == "twente" and name in {"BEAM", "PLBEAM"}:
        name += "NL"  # the program of Twente links the elongation of every beam to its bending
    d.elements[number] = Element(name, named, reader.numbers[plain:], reader.statement.line)


def draw(reader: Reader) -> None:
    """X, XY, XYZ, BETA, LAMBDA: where a node is drawn.

    Parameters
    ----------
    reader : Reader
        At the statement; what it says is put into its description.
    """
    d = reader.description
    reader.count(2, 5, "a node and its coordinates")
    node = reader.node()
    values, width = reader.numbers[1:], d.width(node)
    orientation = d.nodes[node].startswith("o")
    if orientation != (reader.statement.keyword in {"BETA", "LAMBDA"}):
        raise reader.refuse(f"node {node} is {NODES[d.nodes[node]]}")
    if len(values) > width or (orientation and len(values) != width):
        raise reader.refuse(f"node {node} has {width} coordinates, found {len(values)}")
    length = sum(value * value for value in values)
    if d.nodes[node] == "o3" and abs(length - 1.0) > 1e-3:
        raise reader.refuse(f"Euler parameters of node {node} have length {length**0.5:.4g}, must be 1")
    if d.nodes[node] == "o3":
        values = tuple(value / length**0.5 for value in values)
    if max(map(abs, values)) > 1e9:
        raise reader.refuse(f"coordinate {max(values, key=abs):g} is beyond 1e9")
    d.drawn[node] = values + (0.0,) * (width - len(values))


def mark(what: str, freedom: str) -> Callable[[Reader], None]:
    """Return a handler that says what coordinates (x) or deformations (e) are.

    Parameters
    ----------
    what : str
        ``x`` or ``e``.
    freedom : str
        What the named ones become.
    """

    def handler(reader: Reader) -> None:
        d = reader.description
        freedoms = d.x_freedoms if what == "x" else d.e_freedoms
        for key in reader.node_keys() if what == "x" else reader.element_keys():
            before = freedoms.get(key)
            if before is not None and before != freedom:
                name = "coordinate" if what == "x" else "deformation"
                raise reader.refuse(f"{name} {key[1]} of {key[0]} is already {before}, cannot also be {freedom}")
            freedoms[key] = freedom

    return handler


def prescribe(what: str) -> Callable[[Reader], None]:
    """Return a handler of INPUTX and INPUTE: marks, and with more numbers initial value, rate and acceleration.

    Parameters
    ----------
    what : str
        ``x`` or ``e``.
    """

    def handler(reader: Reader) -> None:
        d = reader.description
        reader.count(1, 5, "a number, a component and, if given, value, rate and acceleration")
        numbers = reader.numbers
        reader.numbers = numbers[:2]
        keys = reader.node_keys() if what == "x" else reader.element_keys()
        freedoms, initial = (d.x_freedoms, d.initial_x) if what == "x" else (d.e_freedoms, d.initial_e)
        for key in keys:
            before = freedoms.get(key)
            if before in {"dynamic", "kinematic"}:
                # What the program itself does with such a line; known files have one.
                reader.remark(f"component {key[1]} of {key[0]} is {before}; the line has no effect")
                continue
            if before not in {None, "prescribed"}:
                raise reader.refuse(f"component {key[1]} of {key[0]} is already {before}")
            freedoms[key] = "prescribed"
            if len(numbers) > 2:
                value, rate, acceleration = (*numbers[2:], 0.0, 0.0)[:3]
                initial[key] = (value, rate, acceleration)

    return handler


def initial_value(what: str, order: int) -> Callable[[Reader], None]:
    """Return a handler of XD, XDD, E, ED, EDD: an initial value, rate or acceleration.

    Parameters
    ----------
    what : str
        ``x`` or ``e``.
    order : int
        0 for the value, 1 for the rate, 2 for the acceleration.
    """

    def handler(reader: Reader) -> None:
        d = reader.description
        reader.count(3, 3, "a number, a component and a value")
        initial = d.initial_x if what == "x" else d.initial_e
        number = reader.node() if what == "x" else reader.element()
        most = d.width(number) if what == "x" else d.components(number)
        key = (number, reader.component(1, most, f"{'node' if what == 'x' else 'element'} {number}"))
        values = list(initial.get(key, (math.nan, 0.0, 0.0)))
        values[order] = reader.numbers[2]
        initial[key] = (values[0], values[1], values[2])

    return handler


def pair_slip(reader: Reader) -> None:
    """ENHC: a nonholonomic deformation and the kinematic coordinate that goes with it.

    Parameters
    ----------
    reader : Reader
        At the statement; what it says is put into its description.
    """
    d = reader.description
    reader.count(4, 4, "element and component of the slip, then of its kinematic coordinate")
    number = reader.element()
    kind = KINDS[d.elements[number].kind]
    component = reader.component(1, len(kind.components), f"element {number}")
    if component <= kind.holonomic:
        raise reader.refuse(f"deformation {component} of element {number} ({kind.name}) is no slip of a wheel")
    reader.numbers = reader.numbers[2:]
    key = reader.element_keys()[0]
    if d.e_freedoms.get(key, "kinematic") != "kinematic":
        raise reader.refuse(f"deformation {key[1]} of {key[0]} is already {d.e_freedoms[key]}")
    d.e_freedoms[key] = "kinematic"


def line_freedom(reader: Reader) -> None:
    """LINE: a deformation that is a freedom of the linear model.

    Parameters
    ----------
    reader : Reader
        At the statement; what it says is put into its description.
    """
    d = reader.description
    d.more_freedoms += [key for key in reader.element_keys() if key not in d.more_freedoms]
