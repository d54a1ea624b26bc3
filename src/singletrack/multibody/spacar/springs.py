"""Stresses of springs: linear in the deformations, but for beams whose deformations are corrected for bending.

With bending deformations e = l sin(theta) of the end tangents against the chord, stresses that are linear in e are
wrong by the square of theta, which makes large deflections converge with the square of the element's length only.
BEAMNL and PLBEAMNL therefore have the energy of the angles themselves, to fourth order:

    theta_i = (e_i / l0) (1 + (e_i / l0)^2 / 6 + s),    s = shortening of the chord by bending,

where e_i^2 sums both planes; in space what couples bending and twist within the element (docs/reference/spacar.md).
For small deflections nothing changes.
"""

from __future__ import annotations

from functools import lru_cache
from typing import TYPE_CHECKING, Any

import casadi as ca
import numpy as np

from singletrack.multibody.spacar.derive import Mapped

if TYPE_CHECKING:
    from singletrack.arrays import Array
    from singletrack.multibody.spacar.layout import Layout

__all__ = ["spring_stresses", "spring_tangent"]


def _corrected(a: Any, b: Any) -> tuple[Any, Any]:
    """Return the end angles of which deformations (divided by length) of both ends by plane are the sines."""
    short = (2 * ca.dot(a, a) + ca.dot(a, b) + 2 * ca.dot(b, b)) / 30
    return a * (1 + ca.dot(a, a) / 6 + short), b * (1 + ca.dot(b, b) / 6 + short)


def _bending(a: Any, b: Any, stiffness: Any, length: Any) -> Any:
    return ca.dot(stiffness, 4 * a**2 - 4 * a * b + 4 * b**2) / (2 * length)


def _planar_energy(e: Any, p: Any) -> Any:
    """Return the energy beyond the linear one; parameters are length and EI."""
    a, b = e[0] / p[0], e[1] / p[0]
    return _bending(*_corrected(a, b), p[1], p[0]) - _bending(a, b, p[1], p[0])


def _energy(e: Any, p: Any) -> Any:
    """Return the energy beyond the linear one; parameters are length, GIp, EIy and EIz."""
    length, twist, stiffness = p[0], e[0] / p[0], p[2:4]
    a, b = ca.vertcat(e[1], e[3]) / length, ca.vertcat(e[2], e[4]) / length
    turned = twist * (a + b) / 6
    at_a, at_b = _corrected(a + ca.vertcat(turned[1], -turned[0]), b - ca.vertcat(turned[1], -turned[0]))
    # The torque grows along the beam by (EIy - EIz) times both curvatures; the twist follows within the element.
    bend = a + b
    within = ca.if_else(p[1] > 0, ((p[2] - p[3]) * bend[0] * bend[1]) ** 2 / (24 * ca.fmax(p[1], 1e-300) * length), 0)
    return _bending(at_a, at_b, stiffness, length) - _bending(a, b, stiffness, length) - within


@lru_cache(maxsize=64)
def _bent(kind: str, count: int) -> Mapped:
    size, parameters, energy = (2, 2, _planar_energy) if kind == "PLBEAMNL" else (5, 4, _energy)
    e, p = ca.SX.sym("e", size), ca.SX.sym("p", parameters)
    tangent, stress = ca.hessian(energy(e, p), e)
    return Mapped(ca.Function("bent", [e, p], [ca.densify(stress), ca.densify(tangent)]), count)


def spring_stresses(layout: Layout, e: Array) -> Array:
    """Return the stresses of springs (m,) of deformations (m,).

    Parameters
    ----------
    layout : Layout
        The model as arrays.
    e : array, shape (m,)
        Deformations.
    """
    stresses: Array = layout.elastic @ e
    for group in layout.bending:
        stresses[group.e] += _bent(group.kind, len(group.e))((e[group.e], group.p))[0][:, :, 0]
    return stresses


def spring_tangent(layout: Layout, e: Array) -> Array:
    """Return how the stresses of springs vary with the deformations, (m, m).

    Parameters
    ----------
    layout : Layout
        The model as arrays.
    e : array, shape (m,)
        Deformations.
    """
    tangent: Array = layout.elastic.copy()
    for group in layout.bending:
        blocks = _bent(group.kind, len(group.e))((e[group.e], group.p))[1]
        np.add.at(tangent, (group.e[:, :, None], group.e[:, None, :]), blocks)
    return tangent
