"""What closes loops: points held together, axes kept parallel, rods, and ratios between coordinates (gears, chains)."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Literal

import numpy as np

from singletrack.errors import ModelError
from singletrack.multibody.engine.checks import check_axis, check_number, check_vector, is_number
from singletrack.multibody.engine.elements import Scalar, Vector

__all__ = ["Closure", "Ratio", "close_direction", "close_distance", "close_joint", "close_point"]

ClosingKind = Literal["fixed", "revolute", "prismatic", "cylindrical", "universal", "planar"]
_CLOSING_KINDS = ("fixed", "revolute", "prismatic", "cylindrical", "universal", "planar")


def perpendiculars(axis: tuple[float, ...]) -> tuple[tuple[float, ...], tuple[float, ...]]:
    """Return two unit vectors that complete a unit vector of numbers to a right-handed frame."""
    n = np.array(axis)
    first = np.cross(n, np.eye(3)[np.argmin(abs(n))])
    first /= np.linalg.norm(first)
    return tuple(first.tolist()), tuple(np.cross(n, first).tolist())


@dataclass(frozen=True, eq=False)
class Closure:
    """A closed loop: how the second body is bound to the first, beyond the tree of joints.

    ``directions`` are the directions, fixed in the first body, along which the two points may not part;
    ``orthogonal`` are pairs of a direction of the first body and one of the second that stay perpendicular;
    ``length`` is a fixed distance between the points instead. Points and directions are of the drawing.
    """

    name: str
    first: str
    second: str
    first_point: Vector = (0.0, 0.0, 0.0)
    second_point: Vector = (0.0, 0.0, 0.0)
    directions: tuple[Vector, ...] = ()
    orthogonal: tuple[tuple[Vector, Vector], ...] = ()
    length: Scalar = None

    def __post_init__(self) -> None:
        element = f"loop {self.name}"
        for side in ("first_point", "second_point"):
            object.__setattr__(self, side, check_vector(element, side.replace("_", " "), getattr(self, side)))
        directions = tuple(check_axis(element, "direction", direction) for direction in self.directions)
        pairs = tuple(tuple(check_axis(element, "direction", one) for one in pair) for pair in self.orthogonal)
        object.__setattr__(self, "directions", directions)
        object.__setattr__(self, "orthogonal", pairs)

    @property
    def rows(self) -> tuple[str, ...]:
        """The names of its constraint equations."""
        if self.length is not None:
            return (f"{self.name} (distance)",)
        points = [f"{self.name} (point {i + 1})" for i in range(len(self.directions))]
        return tuple(points + [f"{self.name} (angle {i + 1})" for i in range(len(self.orthogonal))])


_AXES = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))


def close_point(
    name: str,
    first: str,
    second: str,
    point: Vector,
    *,
    second_point: Vector | None = None,
    normal: Vector | None = None,
) -> Closure:
    """Return a loop closed by a ball joint: ``second_point`` of the second body stays on ``point`` of the first.

    For a plane mechanism give the plane's ``normal``: then the points may part along it, and the trivial equation
    is left out.

    Parameters
    ----------
    name : str
        Of the loop.
    first, second : str
        Names of the bodies.
    point, second_point : three numbers or parameters
        In m, in the drawing; by default both bodies share the point.
    normal : three numbers, optional
        Of the plane.

    Examples
    --------
    >>> close_point("left hand", "bar", "arm", (0.4, -0.2, -1.1)).rows
    ('left hand (point 1)', 'left hand (point 2)', 'left hand (point 3)')
    >>> len(close_point("pin", "rod", "rocker", (1, 0, 0), normal=(0, 1, 0)).rows)
    2
    """
    directions: tuple[Vector, ...] = _AXES
    if normal is not None:
        directions = perpendiculars(check_axis(f"loop {name}", "normal", normal))
    return Closure(name, first, second, point, point if second_point is None else second_point, directions)


def close_distance(name: str, first: str, second: str, points: tuple[Vector, Vector], length: Scalar) -> Closure:
    """Return a loop closed by a massless rod of fixed length (m) between two points.

    Parameters
    ----------
    name : str
        Of the loop.
    first, second : str
        Names of the bodies.
    points : pair of three numbers or parameters
        Where the rod ends on the first and on the second body, in m, in the drawing.
    length : number or parameter
        In m.

    Examples
    --------
    >>> close_distance("rod", "crank", "rocker", ((0, 0, 0), (1, 0, 0)), 1.2).rows
    ('rod (distance)',)
    """
    length = check_number(f"loop {name}", "length", length, low=1e-12)
    return Closure(name, first, second, *points, length=length)


def close_joint(
    name: str,
    kind: ClosingKind,
    first: str,
    second: str,
    *,
    point: Vector,
    axis: Vector = (0.0, 0.0, 1.0),
    second_point: Vector | None = None,
    second_axis: Vector | None = None,
) -> Closure:
    """Return a loop closed by a joint of the given kind: the point and axis of both bodies are brought together.

    ``axis`` is the hinge or sliding axis, the normal of a ``planar`` joint, or the first body's axis of a
    ``universal`` joint, whose ``second_axis`` must be given; elsewhere ``second_axis`` is ``axis`` as drawn.

    Parameters
    ----------
    name : str
        Of the loop.
    kind : str
        ``revolute``, ``prismatic``, ``universal``, ... as the joints are called.
    first, second : str
        Names of the bodies.
    point, second_point : three numbers or parameters
        In m, in the drawing; by default both bodies share the point.
    axis, second_axis : three numbers
        Directions in the drawing, of any length.

    Raises
    ------
    ModelError
        For an unknown kind, or axes that are parameters.

    Examples
    --------
    >>> len(close_joint("hinge", "revolute", "last", "first", point=(0, 0, 0), axis=(0, 0, 1)).rows)
    5
    """
    element = f"loop {name}"
    if kind not in _CLOSING_KINDS:
        raise ModelError(f"{element}: unknown kind {kind!r} (known: {', '.join(_CLOSING_KINDS)})")
    axis = check_axis(element, "axis", axis)
    second_axis = axis if second_axis is None else check_axis(element, "second axis", second_axis)
    if not all(is_number(c) for c in (*axis, *second_axis)):
        raise ModelError(f"{element}: the axes of a closing joint must be numbers")
    across = perpendiculars(axis)
    closure = close_point(name, first, second, point, second_point=second_point)
    parallel = tuple((direction, second_axis) for direction in across)
    keyed = (*parallel, (across[0], perpendiculars(second_axis)[1]))
    if kind == "universal":
        return replace(closure, orthogonal=((axis, second_axis),))
    directions = {"cylindrical": across, "prismatic": across, "planar": (axis,)}.get(kind, closure.directions)
    return replace(closure, directions=directions, orthogonal=keyed if kind in {"fixed", "prismatic"} else parallel)


def close_direction(name: str, first: str, second: str, axis: Vector, *, second_axis: Vector | None = None) -> Closure:
    """Return a loop that keeps an axis of the second body parallel to one of the first, wherever they are.

    Parameters
    ----------
    name : str
        Of the loop.
    first, second : str
        Names of the bodies.
    axis, second_axis : three numbers
        Directions in the drawing; by default both bodies share the axis.

    Examples
    --------
    >>> close_direction("level", "ground", "tray", (0, 0, 1)).rows
    ('level (angle 1)', 'level (angle 2)')
    """
    own = check_axis(f"loop {name}", "axis", axis)
    other = own if second_axis is None else check_axis(f"loop {name}", "second axis", second_axis)
    return Closure(name, first, second, orthogonal=tuple((direction, other) for direction in perpendiculars(own)))


@dataclass(frozen=True, eq=False)
class Ratio:
    """A fixed ratio between joint coordinates, as gears and chains make it: ``sum of factor q = offset``.

    Parameters
    ----------
    name
        Its name.
    factors
        Factor of each coordinate, by name.
    offset
        In the coordinates' units.

    Examples
    --------
    A chain from 44 to 16 teeth:

    >>> Ratio("chain", {"crank": 44.0, "rear wheel": -16.0}).offset
    0.0
    """

    name: str
    factors: Mapping[str, Scalar]
    offset: Scalar = 0.0

    def __post_init__(self) -> None:
        element = f"ratio {self.name}"
        checked = {name: check_number(element, f"factor of {name}", value) for name, value in self.factors.items()}
        if not any(not is_number(value) or value for value in checked.values()):
            raise ModelError(f"{element}: needs a coordinate with a factor that is not zero")
        object.__setattr__(self, "factors", checked)
        object.__setattr__(self, "offset", check_number(element, "offset", self.offset))
