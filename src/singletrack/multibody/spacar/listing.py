"""A listing that says what was understood of a file."""

from __future__ import annotations

from typing import TYPE_CHECKING

from singletrack.multibody.spacar.kinds import KINDS
from singletrack.multibody.spacar.rows import names_of

if TYPE_CHECKING:
    from collections.abc import Iterable

    from singletrack.multibody.spacar.description import Description
    from singletrack.multibody.spacar.layout import Layout
    from singletrack.multibody.spacar.rows import Rows

__all__ = ["listing"]

_NODES = {"p2": "position", "o2": "angle", "p3": "position", "o3": "orientation"}


def listing(layout: Layout, rows: Rows) -> str:
    r"""Return a text that says what was understood: nodes, elements, masses, loads, freedoms.

    Parameters
    ----------
    layout
        The model as arrays, with what the file says.
    rows
        Its chosen constraints and generalised coordinates.

    Examples
    --------
    >>> from singletrack.multibody.spacar.model import read_text
    >>> model = read_text("PLHINGE 1 1 2\nFIX 1\nDYNE 1 1\nMASS 2 2.0", "turn.dat")
    >>> print(listing(model.layout, model.rows))  # doctest: +ELLIPSIS
    turn.dat: dialect of delft, in the plane, 2 nodes, 1 elements
    ...
    """
    d = layout.description
    parts = [[_head(d)], _nodes(d), _elements(d), _carried(d), _freedoms(layout, rows)]
    if d.remarks:
        parts.append(["without effect", *(f"  {remark}" for remark in d.remarks)])
    return "\n\n".join("\n".join(part) for part in parts if part)


def _head(d: Description) -> str:
    spaces = {kind[-1] for kind in d.nodes.values()}
    where = " and ".join({"2": "in the plane", "3": "in space"}[kind] for kind in sorted(spaces))
    return f"{d.where}: dialect of {d.dialect}, {where}, {len(d.nodes)} nodes, {len(d.elements)} elements"


def _numbers(values: Iterable[float]) -> str:
    return " ".join(f"{value:.6g}" for value in values)


def _nodes(d: Description) -> list[str]:
    lines = ["nodes"]
    for node, kind in d.nodes.items():
        marks = [d.x_freedoms.get((node, i + 1), "") for i in range(d.width(node))]
        said = ", ".join(f"{i + 1} {mark}" for i, mark in enumerate(marks) if mark)
        lines.append(
            f"  {node:5d}  {_NODES[kind]:11s}  {_numbers(d.coordinates(node))}{'  (' + said + ')' if said else ''}"
        )
    return lines


def _elements(d: Description) -> list[str]:
    lines = ["elements; a deformation that is not named is fixed"]
    for number, element in d.elements.items():
        components = KINDS[element.kind].components
        said = ", ".join(
            f"{i} {name} {'released' if d.e_freedoms[number, i] == 'calculated' else d.e_freedoms[number, i]}"
            for i, name in enumerate(components, start=1)
            if (number, i) in d.e_freedoms
        )
        axis = f"  axis {_numbers(element.axis)}" if element.axis else ""
        nodes = " ".join(map(str, element.nodes))
        lines.append(f"  {number:5d}  {element.kind:8s}  nodes {nodes}{axis}{'  (' + said + ')' if said else ''}")
    return lines


def _carried(d: Description) -> list[str]:
    lines = [f"  node {node}: mass {_numbers(values)}" for node, values in sorted(d.masses.items())]
    for title, what in (("mass per length", d.line_masses), ("stiffness", d.stiffness), ("damping", d.damping)):
        lines += [f"  element {number}: {title} {_numbers(values)}" for number, values in sorted(what.items())]
    lines += [f"  node {node}: force {_numbers(values)}" for node, values in sorted(d.forces.items())]
    lines += [f"  node {node}: torque in the body {_numbers(values)}" for node, values in sorted(d.torques.items())]
    lines += [f"  gravity {_numbers(d.gravity)}"] if d.gravity else []
    return ["masses, springs, loads", *lines] if lines else []


def _freedoms(layout: Layout, rows: Rows) -> list[str]:
    d = layout.description
    lines = ["freedoms", f"  dynamic: {', '.join(rows.names()) or 'none'}"]
    kinds = {kind: names_of(layout, kind) for kind in ("prescribed", "kinematic")}
    lines += [f"  {kind}: {', '.join(names)}" for kind, names in kinds.items() if names]
    fixed = sum(layout.e_is == "fixed")
    redundant = fixed - len(rows.constraints)
    lines.append(f"  {len(rows.free)} free coordinates, {fixed} constraints, {redundant} of them redundant")
    ports = [f"{port.number} force on {port.what} {port.key[0]} {port.key[1]}" for port in d.inputs]
    lines += [f"  inputs: {', '.join(ports)}"] if ports else []
    ports = [f"{port.number} {port.what} {port.key[0]} {port.key[1]}" for port in d.outputs]
    lines += [f"  outputs: {', '.join(ports)}"] if ports else []
    if d.steps:
        lines.append(f"  {d.steps} steps in {d.duration:g} s")
    return lines
