"""The model at a state: deformations and their rows, mass and forces, and how all of these vary."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from singletrack.arrays import Array
from singletrack.multibody.spacar.derive import per_element

if TYPE_CHECKING:
    from singletrack.multibody.spacar.layout import Layout

__all__ = ["Variation", "convective_rates", "inertia", "load", "strains", "vary"]


def _scatter(matrix: Array, rows: Array, columns: Array, blocks: Array) -> None:
    """Add blocks (n, r, c) at rows (n, r) and columns (n, c); an element may name a node twice."""
    np.add.at(matrix, (rows[:, :, None], columns[:, None, :]), blocks)


def strains(layout: Layout, x: Array) -> tuple[Array, Array]:
    """Return the deformations (m,), zero for those that are no functions of position, and their rows (m, n).

    Parameters
    ----------
    layout : Layout
        The model as arrays.
    x : array, shape (n,)
        Coordinates.
    """
    e, rows = np.zeros(len(layout.e_is)), np.zeros((len(layout.e_is), len(x)))
    for group in layout.groups:
        values, blocks = per_element("strain", group.kind, "value", x[group.x], group.p)
        e[group.e[:, : values.shape[1]]] = values[:, :, 0]
        _scatter(rows, group.e, group.x, blocks)
    return e, rows


def convective_rates(layout: Layout, x: Array, v: Array) -> Array:
    """Return what the deformations' accelerations have beside rows times accelerations, (m,).

    Parameters
    ----------
    layout : Layout
        The model as arrays.
    x, v : array, shape (n,)
        Coordinates and their rates.
    """
    c = np.zeros(len(layout.e_is))
    for group in layout.groups:
        (values,) = per_element("strain", group.kind, "rate", x[group.x], group.p, v[group.x])
        c[group.e] = values[:, :, 0]
    return c


def inertia(layout: Layout, x: Array, v: Array) -> tuple[Array, Array]:
    """Return the mass matrix (n, n) and the convective forces less the weight of distributed mass (n,).

    Parameters
    ----------
    layout : Layout
        The model as arrays.
    x, v : array, shape (n,)
        Coordinates and their rates.
    """
    mass, force = np.diag(layout.lumped), np.zeros(len(x))
    for group in layout.masses:
        blocks, values = per_element("mass", group.kind, "force", x[group.x], group.p, v[group.x])
        _scatter(mass, group.x, group.x, blocks)
        np.add.at(force, group.x, values[:, :, 0])
    return mass, force


def _moment(l: Array, moment: Array, torque: Array) -> tuple[Array, Array]:
    """Return the generalised force of a moment on Euler parameters (4,), and its derivative (4, 4)."""
    # A moment m in the ground's frame does the work m . G dl, with G linear in l; a torque in the body likewise.
    basis = np.eye(4)
    ground, body = (np.stack([_rates(unit, sign) for unit in basis]) for sign in (1.0, -1.0))
    derivative = np.einsum("kia,i->ak", ground, moment) + np.einsum("kia,i->ak", body, torque)
    return derivative @ l, derivative


def _rates(l: Array, sign: float) -> Array:
    """Return the matrix (3, 4) from the rates of Euler parameters to the angular velocity in the ground or body."""
    s, (a, b, c) = l[0], l[1:]
    skew = np.array([[0.0, -c, b], [c, 0.0, -a], [-b, a, 0.0]])
    return 2.0 * np.column_stack([-l[1:], s * np.eye(3) + sign * skew])


def load(layout: Layout, x: Array, factor: float = 1.0) -> Array:
    """Return the constant generalised forces on the coordinates, (n,): the given ones times a factor, and weight.

    Parameters
    ----------
    layout : Layout
        The model as arrays.
    x : array, shape (n,)
        Coordinates.
    factor : float
        Of the given forces; the weight stays.
    """
    total = factor * layout.loads + layout.weights
    for first, moment, torque in layout.moments:
        own = slice(first, first + 4)
        total[own] += factor * _moment(x[own], moment, torque)[0]
    return total


@dataclass(frozen=True, eq=False)
class Variation:
    """How the equations vary: rates A v by x; accelerations A a + c by x and v; forces by x and v.

    Forces are M a + h - loads + A^T s with a and s held.
    """

    rates: Array
    accelerations_x: Array
    accelerations_v: Array
    forces_x: Array
    forces_v: Array


def vary(layout: Layout, x: Array, v: Array, a: Array, s: Array, factor: float = 1.0) -> Variation:
    """Return how the equations vary about a state with accelerations a (n,) and stresses s (m,).

    Parameters
    ----------
    layout : Layout
        The model as arrays.
    x, v, a : array, shape (n,)
        Coordinates, rates, accelerations.
    s : array, shape (m,)
        Stresses.
    factor : float
        Of the given forces.
    """
    m, n = len(layout.e_is), len(x)
    rates, by_x, by_v = np.zeros((m, n)), np.zeros((m, n)), np.zeros((m, n))
    forces_x, forces_v = np.zeros((n, n)), np.zeros((n, n))
    for group in layout.groups:
        parts = per_element("strain", group.kind, "vary", x[group.x], group.p, v[group.x], a[group.x], s[group.e])
        for matrix, part in zip((rates, by_x, by_v), parts, strict=False):
            _scatter(matrix, group.e, group.x, part)
        _scatter(forces_x, group.x, group.x, parts[3])
    for group in layout.masses:
        parts = per_element("mass", group.kind, "vary", x[group.x], group.p, v[group.x], a[group.x])
        _scatter(forces_x, group.x, group.x, parts[0])
        _scatter(forces_v, group.x, group.x, parts[1])
    for first, moment, torque in layout.moments:
        own = slice(first, first + 4)
        forces_x[own, own] -= factor * _moment(x[own], moment, torque)[1]
    return Variation(rates, by_x, by_v, forces_x, forces_v)
