"""Parameters of the elements from the drawing: lengths, axes and distances as their nodes see them."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from singletrack.errors import InputError

if TYPE_CHECKING:
    from singletrack.arrays import Array
    from singletrack.multibody.spacar.description import Description, Element

__all__ = ["Placing", "rotation_matrix"]


def rotation_matrix(l: Array) -> Array:
    """Return the rotation matrix of Euler parameters, the scalar first.

    >>> rotation_matrix(np.array([0.0, 0.0, 0.0, 1.0])).diagonal().tolist()
    [-1.0, -1.0, 1.0]
    """
    s, v = l[0], l[1:]
    skew = np.array([[0.0, -v[2], v[1]], [v[2], 0.0, -v[0]], [-v[1], v[0], 0.0]])
    return (s * s - v @ v) * np.eye(3) + 2.0 * np.outer(v, v) + 2.0 * s * skew


class Placing:
    """Parameters of elements from the drawing."""

    def __init__(self, d: Description) -> None:
        self.d = d

    def refuse(self, number: int, reason: str) -> InputError:
        """Return the error that names file, line and element.

        Parameters
        ----------
        number : int
            Of the element.
        reason : str
            What is wrong with it.
        """
        e = self.d.elements[number]
        return InputError(f"{self.d.where}, line {e.line}: {e.kind} {number}: {reason}")

    def at(self, node: int) -> Array:
        """Return the drawn coordinates of a node.

        Shape (2,) or (3,) for a position, (1,) or (4,) for an orientation.

        Parameters
        ----------
        node : int
        """
        return np.array(self.d.coordinates(node))

    def turn(self, node: int) -> Array:
        """Return the drawn rotation matrix of an orientation.

        Shape (3, 3).

        Parameters
        ----------
        node : int
        """
        values = self.at(node)
        if values.size == 4:
            return rotation_matrix(values)
        c, s = np.cos(values[0]), np.sin(values[0])
        return np.array([[c, -s], [s, c]])

    def line(self, number: int, a: int, b: int) -> tuple[float, Array]:
        """Return length and direction between two positions.

        The direction has the shape of the positions, (2,) or (3,).

        Parameters
        ----------
        number : int
            Of the element, for a message.
        a, b : int
            Nodes.
        """
        away = self.at(b) - self.at(a)
        length = float(np.linalg.norm(away))
        if not length > 1e-12:
            raise self.refuse(number, f"nodes {a} and {b} are drawn at the same place")
        return length, away / length

    def axes(self, number: int, axis: Array) -> Array:
        """Return three perpendicular unit axes (rows), the first along an axis.

        Shape (3, 3).

        Parameters
        ----------
        number : int
            Of the element, for a message.
        axis : array, shape (3,)
        """
        length = float(np.linalg.norm(axis))
        if not length > 1e-12:
            raise self.refuse(number, "its axis is zero")
        x = axis / length
        # The axis of the ground that is most perpendicular, the last where there are several: as recordings of the
        # program itself show.
        other = np.eye(3)[2 - int(np.argmin(np.round(abs(x[::-1]), 9)))]
        y = np.cross(x, other)
        y /= np.linalg.norm(y)
        return np.stack([x, y, np.cross(x, y)])

    def beam_axes(self, number: int, e: Element, x: Array) -> Array:
        """Return the axes of a beam's section (rows): along, and the given y axis made perpendicular.

        Shape (3, 3).

        Parameters
        ----------
        number : int
            Of the element, for a message.
        e : Element
            What the file says of it.
        x : array, shape (3,)
            Unit vector along the beam.
        """
        # Without a given axis: the axis of the ground that is most perpendicular, y where there are several.
        order = np.array([1, 2, 0])
        plain = int(order[np.argmin(np.round(abs(x[order]), 9))])
        given: Array = np.array(e.axis) if e.axis else np.eye(3)[plain]
        across = given - np.dot(given, x) * x
        if float(np.linalg.norm(across)) <= 1e-9 * float(np.linalg.norm(given)):
            raise self.refuse(number, "its y axis is zero or lies along the beam")
        y = across / np.linalg.norm(across)
        return np.stack([x, y, np.cross(x, y)])

    def parameters(self, number: int) -> Array:
        """Return the parameters of an element, as its kind wants them.

        Shape (p,), p by the kind.

        Parameters
        ----------
        number : int
            Of the element.
        """
        e = self.d.elements[number]
        n, kind = e.nodes, e.kind
        if kind in {"BEAM", "BEAMNL"}:
            length, x = self.line(number, n[0], n[2])
            axes = self.beam_axes(number, e, x)
            return np.concatenate([[length], *((axes @ self.turn(node)).ravel() for node in (n[1], n[3]))])
        if kind in {"PLBEAM", "PLBEAMNL"}:
            length, x = self.line(number, n[0], n[2])
            return np.concatenate([[length], x @ self.turn(n[1]), x @ self.turn(n[3])])
        if kind in {"TRUSS", "PLTRUSS"}:
            return np.array([self.line(number, n[0], n[1])[0]])
        if kind == "PINBODY":
            return self.turn(n[1]).T @ (self.at(n[2]) - self.at(n[0]))
        if kind == "PLHINGE":
            return self.at(n[1]) - self.at(n[0])
        return self.joint(number, e)

    def joint(self, number: int, e: Element) -> Array:
        """Return the parameters of a hinge, bearing or wheel.

        Shape (p,), p by the kind.

        Parameters
        ----------
        number : int
            Of the element.
        e : Element
            What the file says of it.
        """
        n = e.nodes
        if e.kind == "PLBEAR":
            axis = np.array(e.axis or (1.0, 0.0))
            if not np.linalg.norm(axis) > 1e-12:
                raise self.refuse(number, "its axis is zero")
            along = (axis / float(np.linalg.norm(axis))) @ self.turn(n[1])
            away = (self.at(n[2]) - self.at(n[0])) @ self.turn(n[1])
            across = np.array([-along[1], along[0]])
            return np.concatenate([self.at(n[3]) - self.at(n[1]), along, [along @ away, across @ away]])
        if e.kind in {"WHEEL", "PLWHEEL"}:
            return self.wheel(number, e)
        axes = self.axes(number, np.array(e.axis))
        first, second = (n[0], n[1]) if e.kind == "HINGE" else (n[1], n[3])
        turns = np.concatenate([(axes @ self.turn(first)).ravel(), (axes @ self.turn(second)).ravel()])
        if e.kind == "HINGE":
            return turns
        return np.concatenate([turns, axes @ (self.at(n[2]) - self.at(n[0]))])

    def wheel(self, number: int, e: Element) -> Array:
        """Return the parameters of a wheel, which must be drawn on the ground.

        Shape (p,), p by the kind.

        Parameters
        ----------
        number : int
            Of the element.
        e : Element
            What the file says of it.
        """
        hub, contact = self.at(e.nodes[0]), self.at(e.nodes[2])
        radius = self.line(number, e.nodes[0], e.nodes[2])[0]
        if e.kind == "PLWHEEL":
            if abs(contact[0] - hub[0]) > 1e-9 * radius or abs(contact[1]) > 1e-9 * radius or hub[1] < 0:
                raise self.refuse(number, "must be drawn with its contact on the ground (y = 0) straight under the hub")
            return np.array([radius])
        axle = np.array(e.axis)
        if not np.linalg.norm(axle) > 1e-12:
            raise self.refuse(number, "its axle is zero")
        axle = axle / np.linalg.norm(axle)
        if abs(axle[2]) > 1.0 - 1e-9:
            raise self.refuse(number, "its axle is vertical: the wheel lies flat")
        spoke = contact - hub
        heading = np.cross(axle, (0.0, 0.0, 1.0))
        off = max(abs(spoke @ axle), abs(contact[2]), abs(spoke @ heading))
        if off > 1e-9 * radius or hub[2] < 0.0:
            raise self.refuse(
                number, "must be drawn upright on the ground (z = 0): contact in the wheel's plane, lowest"
            )
        return np.array([*(axle @ self.turn(e.nodes[1])), radius])
