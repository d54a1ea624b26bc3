"""What a model's nodes and elements carry: masses, springs and dampers, loads, as arrays."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from singletrack.arrays import Array
from singletrack.multibody.spacar.kinds import KINDS

if TYPE_CHECKING:
    from singletrack.multibody.spacar.description import Description, Key

__all__ = ["Group", "bending", "distributed_masses", "lump", "point_loads", "point_masses", "springs"]


@dataclass(frozen=True, eq=False)
class Group:
    """All elements (or masses) of a kind: coordinates (n, width), deformations (n, e), parameters (n, p)."""

    kind: str
    x: Array
    e: Array
    p: Array


def _gravity(d: Description, dimension: int) -> Array:
    return np.array([*d.gravity, 0.0, 0.0, 0.0][:dimension])


def distributed_masses(d: Description, groups: list[Group], x_index: dict[Key, int]) -> list[Group]:
    """Return distributed masses by kind, and rotors.

    Parameters
    ----------
    d : Description
        What the file says.
    groups : list of Group
        The elements by kind.
    x_index : dict
        Index of a coordinate by (node, component).
    """
    masses = []
    for group in groups:
        mass = KINDS[group.kind].mass
        numbers = [k for k, e in d.elements.items() if e.kind == group.kind]
        carry = [i for i, k in enumerate(numbers) if k in d.line_masses]
        if mass is None or not carry:
            continue
        line = np.array([(*d.line_masses[numbers[i]], 0.0)[:2] for i in carry])
        p, length = group.p[carry], group.p[carry, :1]
        gravity = np.tile(_gravity(d, int(mass[-1])), (len(carry), 1))
        parts = [line[:, :1] * length, gravity]
        if mass == "beam3":
            parts += [length, p[:, 1:4], p[:, 10:13], line[:, 1:] * length]
        elif mass == "beam2":
            parts += [length, p[:, 1:]]
        masses.append(Group(mass, group.x[carry], np.zeros((len(carry), 0), int), np.concatenate(parts, axis=1)))
    rotors = [node for node in d.masses if d.nodes[node] == "o3"]
    if rotors:
        x = np.array([[x_index[node, i] for i in (1, 2, 3, 4)] for node in rotors])
        masses.append(Group("rotor", x, np.zeros((len(rotors), 0), int), np.array([d.masses[n] for n in rotors])))
    return masses


def lump(d: Description, groups: list[Group], lumped: Array, weights: Array) -> None:
    """Put half of the mass of every element on its end positions.

    Parameters
    ----------
    d : Description
        What the file says.
    groups : list of Group
        The elements by kind.
    lumped, weights : array, shape (n,)
        Diagonal of the mass matrix, and weight; both are added to.
    """
    for group in groups:
        if KINDS[group.kind].mass is None:
            continue
        for number, x, p in zip(
            [k for k, e in d.elements.items() if e.kind == group.kind], group.x, group.p, strict=True
        ):
            if number in d.line_masses:
                dimension = int(str(KINDS[group.kind].mass)[-1])
                half = d.line_masses[number][0] * p[0] / 2
                for start in (0, len(x) // 2):
                    ends = x[start : start + dimension]
                    lumped[ends] += half
                    weights[ends] += half * _gravity(d, dimension)


def springs(
    d: Description, e_index: dict[Key, int], groups: list[Group], constants: dict[int, Any], size: int
) -> Array:
    """Return the matrix (size, size) from deformations to stresses, or from their rates.

    Parameters
    ----------
    d : Description
        What the file says.
    e_index : dict
        Index of a deformation by (element, component).
    groups : list of Group
        The elements by kind.
    constants : dict
        Stiffness or damping by element.
    size : int
        The number of deformations.
    """
    matrix = np.zeros((size, size))
    lengths = {
        k: p[0]
        for g in groups
        for k, p in zip([k for k, e in d.elements.items() if e.kind == g.kind], g.p, strict=True)
    }
    bending = np.array([[4.0, -2.0], [-2.0, 4.0]])
    for number, values in constants.items():
        kind = KINDS[d.elements[number].kind]
        i = e_index[number, 1]
        if kind.mass is None:
            # Of a wheel, the constants are those of its slips, which come last.
            i += len(kind.components) - len(values)
            for k, value in enumerate(values):
                matrix[i + k, i + k] = value
            continue
        length = lengths[number]
        matrix[i, i] = values[0] / length
        if kind.mass == "beam3":
            matrix[i + 1, i + 1] = values[1] / length**3
            matrix[i + 2 : i + 4, i + 2 : i + 4] = values[2] / length**3 * bending
            matrix[i + 4 : i + 6, i + 4 : i + 6] = values[3] / length**3 * bending
        elif kind.mass == "beam2":
            matrix[i + 1 : i + 3, i + 1 : i + 3] = values[1] / length**3 * bending
    return matrix


def point_masses(d: Description, x_index: dict[Key, int]) -> tuple[Array, Array]:
    """Return the diagonal of point masses and their weight, (n,) each.

    Parameters
    ----------
    d : Description
        What the file says.
    x_index : dict
        Index of a coordinate by (node, component).
    """
    lumped, weights = np.zeros(len(x_index)), np.zeros(len(x_index))
    for node, values in d.masses.items():
        if d.nodes[node] != "o3":
            width = d.width(node)
            own = slice(x_index[node, 1], x_index[node, 1] + width)
            lumped[own] += values[0]
            if d.nodes[node].startswith("p"):
                weights[own] += values[0] * _gravity(d, width)
    return lumped, weights


def point_loads(d: Description, x_index: dict[Key, int]) -> tuple[Array, tuple[tuple[int, Array, Array], ...]]:
    """Return constant generalised forces (n,), and moments on orientations in space.

    Parameters
    ----------
    d : Description
        What the file says.
    x_index : dict
        Index of a coordinate by (node, component).
    """
    loads, moments = np.zeros(len(x_index)), []
    for node in sorted({*d.forces, *d.torques}):
        first, force = x_index[node, 1], d.forces.get(node, ())
        if d.nodes[node] != "o3" or len(force) == 4:
            loads[first : first + d.width(node)] += force
            force = ()
        if d.nodes[node] == "o3":
            moments.append((first, np.array(force or (0.0,) * 3), np.array(d.torques.get(node, (0.0,) * 3))))
    return loads, tuple(moments)


def bending(d: Description, groups: list[Group]) -> tuple[Group, ...]:
    """Return the beams whose deformations are corrected for bending and that have bending stiffness.

    Parameters
    ----------
    d : Description
        What the file says.
    groups : list of Group
        The elements by kind.
    """
    found = []
    for group in groups:
        if group.kind not in {"BEAMNL", "PLBEAMNL"}:
            continue
        numbers = [k for k, e in d.elements.items() if e.kind == group.kind]
        own = [i for i, k in enumerate(numbers) if any(d.stiffness.get(k, ())[1:])]
        if own:
            stiffness = np.array([d.stiffness[numbers[i]][1:] for i in own])
            p = np.concatenate([group.p[own, :1], stiffness], axis=1)
            found.append(Group(group.kind, group.x[own], group.e[own, 1:], p))
    return tuple(found)
