"""The kinds of elements: which nodes they join and how their deformations follow from the coordinates of these.

Nodes and deformations as in Jonker and Meijaard (1990), SPACAR - computer program for dynamic analysis of flexible
spatial mechanisms and manipulators, in: Multibody Systems Handbook; the correction of a beam's elongation and torsion
for its bending from Jonker and Meijaard (2013), Multibody System Dynamics 29.

Every deformation is zero in the drawn configuration. A kind has functions of CasADi expressions: the coordinates
``x`` of its nodes, one after the other, and its parameters ``p``.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import casadi as ca

__all__ = ["KINDS", "WIDTHS", "Kind", "body_rates", "rotation"]

#: Coordinates of a node: position or orientation, in the plane or in space (Euler parameters).
WIDTHS = {"p2": 2, "o2": 1, "p3": 3, "o3": 4}


@dataclass(frozen=True)
class Kind:
    """One kind of element.

    Attributes
    ----------
    name
        Its keyword, in capitals.
    nodes
        Kinds of its nodes, of :data:`WIDTHS`.
    numbers
        How many numbers (components of an axis) follow the nodes; none may also be given where it has a default.
    components
        What each deformation is; one a component.
    parameters
        How many parameters.
    strain
        From x and p to the deformations that are functions of position, (e,).
    slip
        From x and p to rows that give nonholonomic deformation rates from the nodes' rates, or None; these deformations
        come last.
    angles
        Components that are angles and go on beyond a turn.
    mass
        Kind of distributed mass, or None.
    """

    name: str
    nodes: tuple[str, ...]
    numbers: int
    components: tuple[str, ...]
    parameters: int
    strain: Callable[[Any, Any], Any]
    slip: Callable[[Any, Any], Any] | None = None
    angles: tuple[int, ...] = ()
    mass: str | None = None

    @property
    def width(self) -> int:
        """Number of coordinates of its nodes."""
        return sum(WIDTHS[node] for node in self.nodes)

    @property
    def holonomic(self) -> int:
        """Number of deformations that are functions of position."""
        return len(self.components) - (2 if self.name == "WHEEL" else 1 if self.name == "PLWHEEL" else 0)


def rotation(l: Any) -> Any:
    """Return the rotation matrix (3, 3) of Euler parameters, the scalar first; for parameters of unit length."""
    s, v = l[0], l[1:4]
    return (s * s - ca.dot(v, v)) * ca.SX.eye(3) + 2 * v @ v.T + 2 * s * ca.skew(v)


def body_rates(l: Any) -> Any:
    """Return the matrix (3, 4) from the rates of Euler parameters to the angular velocity in the body's frame."""
    s, v = l[0], l[1:4]
    return 2 * ca.horzcat(-v, s * ca.SX.eye(3) - ca.skew(v))


def _split(x: Any, nodes: tuple[str, ...]) -> list[Any]:
    parts, start = [], 0
    for node in nodes:
        parts.append(x[start : start + WIDTHS[node]])
        start += WIDTHS[node]
    return parts


def _turn2(angle: Any) -> Any:
    c, s = ca.cos(angle), ca.sin(angle)
    return ca.vertcat(ca.horzcat(c, -s), ca.horzcat(s, c))


def _truss(x: Any, p: Any) -> Any:
    half = x.shape[0] // 2
    return ca.norm_2(x[half:] - x[:half]) - p[0]


def _planar_beam(x: Any, p: Any) -> Any:
    """Parameters: length, direction of the drawn beam as seen from both ends (2 + 2)."""
    a, turn_a, b, turn_b = _split(x, ("p2", "o2", "p2", "o2"))
    chord = b - a
    normal_a, normal_b = (_turn2(turn) @ ca.vertcat(-d[1], d[0]) for turn, d in ((turn_a, p[1:3]), (turn_b, p[3:5])))
    return ca.vertcat(ca.norm_2(chord) - p[0], -ca.dot(normal_a, chord), ca.dot(normal_b, chord))


def _planar_beam_nl(x: Any, p: Any) -> Any:
    e = _planar_beam(x, p)
    return ca.vertcat(e[0] + (2 * e[1] ** 2 + e[1] * e[2] + 2 * e[2] ** 2) / (30 * p[0]), e[1:])


def _beam(x: Any, p: Any) -> Any:
    """Parameters: length, then x, y, z axes of the drawn beam as seen from both ends (9 + 9)."""
    a, turn_a, b, turn_b = _split(x, ("p3", "o3", "p3", "o3"))
    chord = b - a
    y_a, z_a = rotation(turn_a) @ p[4:7], rotation(turn_a) @ p[7:10]
    y_b, z_b = rotation(turn_b) @ p[13:16], rotation(turn_b) @ p[16:19]
    return ca.vertcat(
        ca.norm_2(chord) - p[0],
        p[0] * (ca.dot(z_a, y_b) - ca.dot(y_a, z_b)) / 2,
        -ca.dot(z_a, chord),
        ca.dot(z_b, chord),
        ca.dot(y_a, chord),
        -ca.dot(y_b, chord),
    )


def _beam_nl(x: Any, p: Any) -> Any:
    e = _beam(x, p)
    bent = 2 * e[2] ** 2 + e[2] * e[3] + 2 * e[3] ** 2 + 2 * e[4] ** 2 + e[4] * e[5] + 2 * e[5] ** 2
    return ca.vertcat(e[0] + bent / (30 * p[0]), e[1] + (e[3] * e[4] - e[2] * e[5]) / p[0], e[2:])


def _hinge(x: Any, p: Any) -> Any:
    """Parameters: axis and two axes across it, as seen from the first body (9) and from the second (9)."""
    turn_a, turn_b = _split(x, ("o3", "o3"))
    return _hinge_angles(turn_a, turn_b, p)


def _hinge_angles(turn_a: Any, turn_b: Any, p: Any) -> Any:
    a, b = rotation(turn_a), rotation(turn_b)
    y_a, z_a = a @ p[3:6], a @ p[6:9]
    x_b, y_b, z_b = b @ p[9:12], b @ p[12:15], b @ p[15:18]
    # The turn about the axis; exact for any angle where the axes agree.
    angle = ca.atan2(ca.dot(z_a, y_b) - ca.dot(y_a, z_b), ca.dot(y_a, y_b) + ca.dot(z_a, z_b))
    return ca.vertcat(angle, -ca.dot(z_a, x_b), ca.dot(y_a, x_b))


def _bearing(x: Any, p: Any) -> Any:
    """Parameters: those of a hinge, then the drawn distance in the first body's axes (3)."""
    a, turn_a, b, turn_b = _split(x, ("p3", "o3", "p3", "o3"))
    turns = _hinge_angles(turn_a, turn_b, p)
    axes = ca.horzcat(p[0:3], p[3:6], p[6:9])
    away = axes.T @ (rotation(turn_a).T @ (b - a)) - p[18:21]
    return ca.vertcat(turns[0], away, turns[1:])


def _pinbody(x: Any, p: Any) -> Any:
    """Parameters: the drawn distance as seen from the body (3)."""
    a, turn, b = _split(x, ("p3", "o3", "p3"))
    return rotation(turn).T @ (b - a) - p[0:3]


def _planar_hinge(x: Any, p: Any) -> Any:
    return x[1] - x[0] - p[0]


def _planar_bearing(x: Any, p: Any) -> Any:
    """Parameters: drawn turn, axis along (2) as seen from the first body, drawn distance along and across."""
    a, turn_a, b, turn_b = _split(x, ("p2", "o2", "p2", "o2"))
    away = _turn2(turn_a).T @ (b - a)
    along, across = p[1:3], ca.vertcat(-p[2], p[1])
    return ca.vertcat(turn_b - turn_a - p[0], ca.dot(along, away) - p[3], ca.dot(across, away) - p[4])


def _wheel(x: Any, p: Any) -> Any:
    """Parameters: axle as seen from the wheel (3), radius. The ground is z = 0, up is z."""
    hub, turn, contact = _split(x, ("p3", "o3", "p3"))
    axle, spoke = rotation(turn) @ p[0:3], contact - hub
    heading = ca.cross(axle, ca.SX([0, 0, 1]))
    return ca.vertcat(ca.norm_2(spoke) - p[3], ca.dot(spoke, axle), contact[2], ca.dot(spoke, heading))


def _wheel_slip(x: Any, p: Any) -> Any:
    """Return the rows that give the slip along the heading and across: radius times velocity of the material."""
    hub, turn, contact = _split(x, ("p3", "o3", "p3"))
    axle, spoke = rotation(turn) @ p[0:3], contact - hub
    heading = ca.cross(axle, ca.SX([0, 0, 1]))
    heading /= ca.norm_2(heading)
    across = ca.cross(ca.SX([0, 0, 1]), heading)
    spin = -ca.skew(spoke) @ rotation(turn) @ body_rates(turn)
    material = heading.T @ ca.horzcat(ca.SX.eye(3), spin, ca.SX.zeros(3, 3))
    # Across, the contact moves as the wheel's material does: along the rim it runs along the heading.
    contact_across = across.T @ ca.horzcat(ca.SX.zeros(3, 7), ca.SX.eye(3))
    return p[3] * ca.vertcat(material, contact_across)


def _planar_wheel(x: Any, p: Any) -> Any:
    """Parameters: radius. The ground is y = 0."""
    hub, contact = x[0:2], x[3:5]
    return ca.vertcat(hub[1] - contact[1] - p[0], contact[1], contact[0] - hub[0])


def _planar_wheel_slip(x: Any, _p: Any) -> Any:
    return ca.horzcat(1, 0, x[1] - x[4], 0, 0)


_BEAM = ("elongation", "torsion", "bending", "bending", "bending", "bending")
_PLANAR = ("elongation", "bending", "bending")
_ENDS, _PLANAR_ENDS = ("p3", "o3", "p3", "o3"), ("p2", "o2", "p2", "o2")
_TURNS = ("rotation", "turn across", "turn across")

#: Kinds of elements by keyword. TRUSS is in space, PLTRUSS in the plane.
KINDS = {
    kind.name: kind
    for kind in (
        Kind("BEAM", _ENDS, 3, _BEAM, 19, _beam, mass="beam3"),
        Kind("BEAMNL", _ENDS, 3, _BEAM, 19, _beam_nl, mass="beam3"),
        Kind("TRUSS", ("p3", "p3"), 0, ("elongation",), 1, _truss, mass="truss3"),
        Kind("HINGE", ("o3", "o3"), 3, _TURNS, 18, _hinge, angles=(0,)),
        Kind(
            "BEARING",
            _ENDS,
            3,
            ("rotation", "sliding", "shift across", "shift across", "turn across", "turn across"),
            21,
            _bearing,
            angles=(0,),
        ),
        Kind("PINBODY", ("p3", "o3", "p3"), 0, ("x", "y", "z"), 3, _pinbody),
        Kind(
            "WHEEL",
            ("p3", "o3", "p3"),
            3,
            ("radius", "plane", "contact", "lowest", "slip along", "slip across"),
            4,
            _wheel,
            slip=_wheel_slip,
        ),
        Kind("PLBEAM", _PLANAR_ENDS, 0, _PLANAR, 5, _planar_beam, mass="beam2"),
        Kind("PLBEAMNL", _PLANAR_ENDS, 0, _PLANAR, 5, _planar_beam_nl, mass="beam2"),
        Kind("PLTRUSS", ("p2", "p2"), 0, ("elongation",), 1, _truss, mass="truss2"),
        Kind("PLHINGE", ("o2", "o2"), 0, ("rotation",), 1, _planar_hinge),
        Kind("PLBEAR", _PLANAR_ENDS, 2, ("rotation", "sliding", "shift across"), 5, _planar_bearing),
        Kind(
            "PLWHEEL",
            ("p2", "o2", "p2"),
            0,
            ("radius", "contact", "lowest", "slip"),
            1,
            _planar_wheel,
            slip=_planar_wheel_slip,
        ),
    )
}
