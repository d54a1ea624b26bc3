"""A described model as arrays: where each coordinate and deformation stands, and the parameters of all elements."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from singletrack.arrays import Array
from singletrack.errors import InputError
from singletrack.multibody.spacar.description import Description, Key
from singletrack.multibody.spacar.kinds import KINDS
from singletrack.multibody.spacar.loading import (
    Group,
    bending,
    distributed_masses,
    lump,
    point_loads,
    point_masses,
    springs,
)
from singletrack.multibody.spacar.placing import Placing

__all__ = ["Group", "Layout", "lay_out"]


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
    bending
        Beams that bend by the energy of their angles; parameters are length and bending stiffness.
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
    bending: tuple[Group, ...]
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
    drawn = np.array([value for node in d.nodes for value in d.coordinates(node)])
    elements, hidden = _groups(d, x_index, e_index), _unit_lengths(d, x_index, len(e_index))
    size = len(e_index) + sum(len(group.e) for group in hidden)
    x_is = _freedoms(len(x_index), x_index, d.x_freedoms, "calculated")
    e_is = _freedoms(size, e_index, d.e_freedoms, "fixed")
    lumped, weights = point_masses(d, x_index)
    masses = distributed_masses(d, elements, x_index)
    if mass == "lumped":
        lump(d, elements, lumped, weights)
        masses = [group for group in masses if group.kind == "rotor"]
    loads, moments = point_loads(d, x_index)
    return Layout(
        description=d,
        x_index=x_index,
        e_index=e_index,
        drawn=drawn,
        groups=(*elements, *hidden),
        masses=tuple(masses),
        lumped=lumped,
        x_is=x_is,
        e_is=e_is,
        holonomic=_holonomic(elements, size),
        angles=np.array([e_index[k, a + 1] for k, e in d.elements.items() for a in KINDS[e.kind].angles], dtype=int),
        elastic=springs(d, e_index, elements, d.stiffness, size),
        viscous=springs(d, e_index, elements, d.damping, size),
        bending=bending(d, elements),
        loads=loads,
        weights=weights,
        moments=moments,
        e_motion=_prescribed(e_is, e_index, d.initial_e, np.zeros(size)),
        x_motion=_prescribed(x_is, x_index, d.initial_x, drawn),
    )


def _freedoms(size: int, index: dict[Key, int], given: dict[Key, str], default: str) -> Array:
    freedoms = np.full(size, default, dtype=object)
    for key, freedom in given.items():
        freedoms[index[key]] = freedom
    return freedoms


def _unit_lengths(d: Description, x_index: dict[Key, int], first: int) -> list[Group]:
    """Return the hidden elements that keep the length of Euler parameters, where these are not all fixed."""
    components = (1, 2, 3, 4)
    x = [
        [x_index[node, i] for i in components]
        for node, kind in d.nodes.items()
        if kind == "o3" and any(d.x_freedoms.get((node, i)) != "fixed" for i in components)
    ]
    if not x:
        return []
    return [Group("EULER", np.array(x), np.arange(first, first + len(x))[:, None], np.zeros((len(x), 0)))]


def _holonomic(elements: list[Group], size: int) -> Array:
    holonomic = np.ones(size, dtype=bool)
    for group in elements:
        holonomic[group.e[:, KINDS[group.kind].holonomic :]] = False
    return holonomic


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
