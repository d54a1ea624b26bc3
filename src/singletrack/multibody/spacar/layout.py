"""A described model as arrays: where each coordinate and deformation stands, and the parameters of all elements."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from singletrack.arrays import Array
from singletrack.errors import InputError
from singletrack.multibody.spacar.description import Description, Key
from singletrack.multibody.spacar.kinds import KINDS
from singletrack.multibody.spacar.placing import Placing

__all__ = ["Group", "Layout", "lay_out"]


@dataclass(frozen=True, eq=False)
class Group:
    """All elements (or masses) of a kind: coordinates (n, width), deformations (n, e), parameters (n, p)."""

    kind: str
    x: Array
    e: Array
    p: Array


@dataclass(frozen=True, eq=False)
class Layout:
    """Where everything is.

    Attributes
    ----------
    description
        What the file says.
    x_index, e_index
        Index of a coordinate or deformation by key; hidden deformations (unit length of Euler parameters) come after
        those of the elements.
    drawn
        Drawn coordinates, (n,).
    groups, masses
        Elements by kind; distributed masses and rotors by kind.
    lumped
        Diagonal of point masses, (n,).
    x_is, e_is
        What each coordinate (n,) and deformation (m,) is, of ``FREEDOMS``.
    holonomic
        Whether a deformation is a function of position, (m,).
    angles
        Indices of deformations that are angles beyond a turn.
    elastic, viscous
        From deformations to stresses, from their rates to stresses, (m, m).
    loads, weights
        Constant generalised forces on coordinates, (n,): given ones, and the weight of point masses.
    moments
        (node's first coordinate, moment in the ground's frame, torque in the body's axes) for orientations in space.
    e_motion, x_motion
        What is prescribed: value, rate, acceleration of deformations (3, m) and coordinates (3, n); else zero. The
        value of a coordinate without one is that of the drawing.
    """

    description: Description
    x_index: dict[Key, int]
    e_index: dict[Key, int]
    drawn: Array
    groups: tuple[Group, ...]
    masses: tuple[Group, ...]
    lumped: Array
    x_is: Array
    e_is: Array
    holonomic: Array
    angles: Array
    elastic: Array
    viscous: Array
    loads: Array
    weights: Array
    moments: tuple[tuple[int, Array, Array], ...]
    e_motion: Array
    x_motion: Array


def _groups(d: Description, x_index: dict[Key, int], e_index: dict[Key, int]) -> list[Group]:
    placing = Placing(d)
    by_kind: dict[str, list[int]] = {}
    for number, element in d.elements.items():
        by_kind.setdefault(element.kind, []).append(number)
    groups = []
    for kind, numbers in by_kind.items():
        x = [[x_index[node, i + 1] for node in d.elements[k].nodes for i in range(d.width(node))] for k in numbers]
        e = [[e_index[k, i + 1] for i in range(d.components(k))] for k in numbers]
        p = [placing.parameters(k) for k in numbers]
        groups.append(Group(kind, np.array(x), np.array(e), np.array(p)))
    return groups


def _gravity(d: Description, dimension: int) -> Array:
    return np.array([*d.gravity, 0.0, 0.0, 0.0][:dimension])


def _masses(d: Description, groups: list[Group], x_index: dict[Key, int]) -> list[Group]:
    """Return distributed masses by kind, and rotors."""
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


def _lump(d: Description, groups: list[Group], lumped: Array, weights: Array) -> None:
    """Put half of the mass of every element on its end positions."""
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


def _springs(d: Description, e_index: dict[Key, int], groups: list[Group], constants: dict[int, Any]) -> Array:
    size = len(e_index)
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


def lay_out(d: Description, mass: str = "consistent") -> Layout:
    """Return a description as arrays.

    Parameters
    ----------
    d
        What a file says.
    mass
        ``consistent`` or ``lumped``: distributed mass by interpolation, or on the end positions.

    Raises
    ------
    InputError
        For an element that is drawn badly: no length, no axis, a wheel beside the ground.
    """
    if mass not in {"consistent", "lumped"}:
        raise InputError(f"mass is {mass!r}, must be consistent or lumped")
    x_index: dict[Key, int] = {}
    for node in d.nodes:
        x_index |= {(node, i + 1): len(x_index) + i for i in range(d.width(node))}
    e_index: dict[Key, int] = {}
    for number in d.elements:
        e_index |= {(number, i + 1): len(e_index) + i for i in range(d.components(number))}
    groups = _groups(d, x_index, e_index)
    n = len(x_index)
    drawn = np.array([value for node in d.nodes for value in d.coordinates(node)])
    x_is = np.full(n, "calculated", dtype=object)
    for key, freedom in d.x_freedoms.items():
        x_is[x_index[key]] = freedom
    hidden = [
        [x_index[node, i] for i in (1, 2, 3, 4)]
        for node, kind in d.nodes.items()
        if kind == "o3" and any(d.x_freedoms.get((node, i)) != "fixed" for i in (1, 2, 3, 4))
    ]
    m = len(e_index)
    e_is = np.full(m + len(hidden), "fixed", dtype=object)
    for key, freedom in d.e_freedoms.items():
        e_is[e_index[key]] = freedom
    springs, dampers = (_springs(d, e_index, groups, c) for c in (d.stiffness, d.damping))
    if hidden:
        rows = np.arange(m, m + len(hidden))[:, None]
        groups.append(Group("EULER", np.array(hidden), rows, np.zeros((len(hidden), 0))))
    lumped, weights = _point_masses(d, x_index, n)
    loads, moments = _loads(d, x_index, n)
    masses = _masses(d, groups[: len(groups) - bool(hidden)], x_index)
    if mass == "lumped":
        _lump(d, groups[: len(groups) - bool(hidden)], lumped, weights)
        masses = [group for group in masses if group.kind == "rotor"]
    slips = [
        group.e[:, KINDS[group.kind].holonomic :].ravel() for group in groups if group.kind in {"WHEEL", "PLWHEEL"}
    ]
    holonomic = np.ones(len(e_is), dtype=bool)
    for slip in slips:
        holonomic[slip] = False
    angles = [e_index[k, a + 1] for k, e in d.elements.items() for a in KINDS[e.kind].angles]
    pad = ((0, len(hidden)), (0, len(hidden)))
    return Layout(
        d,
        x_index,
        e_index,
        drawn,
        tuple(groups),
        tuple(masses),
        lumped,
        x_is,
        e_is,
        holonomic,
        np.array(angles, dtype=int),
        np.pad(springs, pad),
        np.pad(dampers, pad),
        loads,
        weights,
        moments,
        _prescribed(e_is, e_index, d.initial_e, np.zeros(len(e_is))),
        _prescribed(x_is, x_index, d.initial_x, drawn),
    )


def _prescribed(
    is_: Array, index: dict[Key, int], initial: dict[Key, tuple[float, float, float]], drawn: Array
) -> Array:
    motion = np.zeros((3, len(is_)))
    for key, i in index.items():
        if is_[i] == "prescribed":
            motion[:, i] = initial.get(key, (np.nan, 0.0, 0.0))
            if np.isnan(motion[0, i]):
                motion[0, i] = drawn[i]
    return motion


def _point_masses(d: Description, x_index: dict[Key, int], n: int) -> tuple[Array, Array]:
    """Return the diagonal of point masses and their weight, (n,) each."""
    lumped, weights = np.zeros(n), np.zeros(n)
    for node, values in d.masses.items():
        if d.nodes[node] != "o3":
            width = d.width(node)
            own = slice(x_index[node, 1], x_index[node, 1] + width)
            lumped[own] += values[0]
            if d.nodes[node].startswith("p"):
                weights[own] += values[0] * _gravity(d, width)
    return lumped, weights


def _loads(d: Description, x_index: dict[Key, int], n: int) -> tuple[Array, tuple[tuple[int, Array, Array], ...]]:
    """Return constant generalised forces (n,), and moments on orientations in space."""
    loads, moments = np.zeros(n), []
    for node in sorted({*d.forces, *d.torques}):
        first, force = x_index[node, 1], d.forces.get(node, ())
        if d.nodes[node] != "o3" or len(force) == 4:
            loads[first : first + d.width(node)] += force
            force = ()
        if d.nodes[node] == "o3":
            moments.append((first, np.array(force or (0.0,) * 3), np.array(d.torques.get(node, (0.0,) * 3))))
    return loads, tuple(moments)
