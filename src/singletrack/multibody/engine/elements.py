"""What a machine is made of: bodies and the joints of its tree.

A machine is *drawn* in one configuration, in the frame of the ground (x forward, y right, z down): every point, axis,
centre of mass and inertia is given there, for all bodies alike. Joint coordinates are zero in the drawing. Loops need
not close in the drawing: :func:`~singletrack.multibody.assemble` closes them.

Any number may be a :func:`parameter`, whose value is chosen when the model is used, not when it is built.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache
from typing import Any, TypeAlias

import casadi as ca

from singletrack.errors import ModelError
from singletrack.multibody.engine.checks import check_axis, check_inertia, check_number, check_vector, is_number

__all__ = [
    "GROUND",
    "Body",
    "Joint",
    "Motion",
    "cylindrical",
    "fixed",
    "free",
    "parameter",
    "parameters",
    "planar",
    "prismatic",
    "revolute",
    "spherical",
    "universal",
]

GROUND = "ground"
X, Y, Z = (1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)

Scalar: TypeAlias = Any
"""A number or a parameter."""
Vector: TypeAlias = "Sequence[Scalar]"
"""Three numbers or parameters."""


@cache
def parameter(name: str) -> Scalar:
    """Return a number that gets its value when the model is used; the same name is the same number.

    The strength of gravity is one already: ``gravity``.

    Raises
    ------
    ModelError
        For the name ``gravity``.

    Examples
    --------
    >>> parameter("trail")
    SX(trail)
    """
    if name == "gravity":
        raise ModelError("parameter gravity: the name is taken by the strength of gravity; choose another")
    return ca.SX.sym(name)


def parameters(*names: str) -> tuple[Scalar, ...]:
    """Return several parameters, one a name.

    >>> parameters("saddle.x", "saddle.z")
    (SX(saddle.x), SX(saddle.z))
    """
    return tuple(parameter(name) for name in names)


@dataclass(frozen=True, eq=False)
class Body:
    """A rigid body.

    Parameters
    ----------
    name
        Its name.
    mass
        Mass, kg.
    centre
        Centre of mass in the drawing, m.
    inertia
        (Ixx, Iyy, Izz, Ixy, Iyz, Ixz) about the centre of mass, axes of the drawing, kg m^2; off-diagonal terms are
        the elements of the inertia matrix.

    Raises
    ------
    ModelError
        For a mass or an inertia that no body can have.

    Examples
    --------
    >>> Body("flywheel", 3.0, (0, 0, -0.3), (0.06, 0.12, 0.06)).mass
    3.0
    >>> Body("plate", 1.0, inertia=(1.0, 1.0, 3.0))
    Traceback (most recent call last):
    ...
    singletrack.errors.ModelError: body plate: no body has the principal inertias 1, 1, 3 kg m^2 ...
    """

    name: str
    mass: Scalar = 0.0
    centre: Vector = (0.0, 0.0, 0.0)
    inertia: Sequence[Scalar] = (0.0, 0.0, 0.0)

    def __post_init__(self) -> None:
        element = f"body {self.name}"
        object.__setattr__(self, "mass", check_number(element, "mass", self.mass, low=0.0))
        object.__setattr__(self, "centre", check_vector(element, "centre", self.centre))
        inertia = tuple(self.inertia)
        if len(inertia) not in {3, 6}:
            raise ModelError(f"{element}: inertia must have 3 or 6 components, found {len(inertia)}")
        inertia = tuple(check_number(element, "inertia", value) for value in inertia + (0.0,) * (6 - len(inertia)))
        object.__setattr__(self, "inertia", inertia)
        if all(is_number(value) for value in inertia):
            check_inertia(element, inertia)


@dataclass(frozen=True, eq=False)
class Motion:
    """One degree of freedom of a joint: a translation along or a rotation about an axis, with spring and damper.

    The generalised force is ``preload - stiffness q - damping q'`` (N or N m; stiffness in N/m or N m/rad). Any joint
    is a succession of motions, each carried along by those before.

    Examples
    --------
    A telescopic crane: it turns, rises, and then slides out along its boom.

    >>> turns = [Motion("slew", rotates=True, axis=(0, 0, 1)), Motion("luff", rotates=True, axis=(0, 1, 0))]
    >>> reach = Motion("reach", rotates=False, axis=(1, 0, 0))
    >>> Joint("crane", "ground", "boom", (0, 0, -1), (*turns, reach)).coordinates
    ('slew', 'luff', 'reach')
    """

    name: str
    rotates: bool
    axis: Vector
    stiffness: Scalar = 0.0
    damping: Scalar = 0.0
    preload: Scalar = 0.0

    def __post_init__(self) -> None:
        element = f"motion {self.name}"
        object.__setattr__(self, "axis", check_axis(element, "axis", self.axis))
        for name in ("stiffness", "damping", "preload"):
            object.__setattr__(self, name, check_number(element, name, getattr(self, name)))


@dataclass(frozen=True, eq=False)
class Joint:
    """A joint of the tree: the child moves relative to the parent by motions in succession.

    Rotations turn about ``point`` (drawing, m), slid along by the translations before; each axis is carried along. With
    ``quaternion``, the last four coordinates are a unit quaternion less (1, 0, 0, 0), and one more constraint.
    """

    name: str
    parent: str
    child: str
    point: Vector
    motions: tuple[Motion, ...]
    quaternion: bool = False

    def __post_init__(self) -> None:
        object.__setattr__(self, "point", check_vector(f"joint {self.name}", "point", self.point))
        object.__setattr__(self, "motions", tuple(self.motions))

    @property
    def coordinates(self) -> tuple[str, ...]:
        """The names of its coordinates, in order."""
        return tuple(motion.name for motion in self.motions)


def _joint(
    name: str,
    parent: str,
    child: str,
    point: Vector,
    motions: Sequence[tuple[bool, Vector]],
    *,
    defaults: Sequence[str],
    coordinates: Sequence[str] | None = None,
    stiffness: Any = 0.0,
    damping: Any = 0.0,
    preload: Any = 0.0,
) -> Joint:
    element, count = f"joint {name}", len(motions)
    names = tuple(defaults) if coordinates is None else tuple(coordinates)
    if len(names) != count:
        raise ModelError(f"{element}: {count} coordinates need {count} names, found {names}")

    def spread(quantity: str, value: Any) -> list[Scalar]:
        values = list(value) if isinstance(value, (tuple, list)) else [value] * count
        if len(values) != count:
            raise ModelError(f"{element}: {quantity} must be one number or {count}, found {len(values)}")
        return [check_number(element, quantity, number) for number in values]

    laws = zip(spread("stiffness", stiffness), spread("damping", damping), spread("preload", preload), strict=True)
    return Joint(
        name,
        parent,
        child,
        point,
        tuple(
            Motion(coordinate, rotates, check_axis(element, "axis", axis), *law)
            for coordinate, (rotates, axis), law in zip(names, motions, laws, strict=True)
        ),
    )


def fixed(name: str, parent: str, child: str) -> Joint:
    """Return a joint that lets nothing move.

    >>> fixed("weld", "frame", "rack").coordinates
    ()
    """
    return Joint(name, parent, child, (0.0, 0.0, 0.0), ())


def revolute(name: str, parent: str, child: str, point: Vector, axis: Vector, **law: Any) -> Joint:
    """Return a hinge about ``axis`` through ``point``; its coordinate (rad) has the joint's name.

    ``law`` may set ``stiffness`` (N m/rad), ``damping`` (N m s/rad), ``preload`` (N m) and ``coordinates``.

    >>> revolute("steer", "frame", "fork", (1.1, 0, 0), (0.3, 0, 0.95)).coordinates
    ('steer',)
    """
    return _joint(name, parent, child, point, [(True, axis)], defaults=(name,), **law)


def prismatic(name: str, parent: str, child: str, axis: Vector, **law: Any) -> Joint:
    """Return a slider along ``axis``; its coordinate (m) has the joint's name.

    >>> prismatic("seat post", "frame", "saddle", (0, 0, 1), stiffness=1e4).motions[0].stiffness
    10000.0
    """
    return _joint(name, parent, child, (0.0, 0.0, 0.0), [(False, axis)], defaults=(name,), **law)


def cylindrical(name: str, parent: str, child: str, point: Vector, axis: Vector, **law: Any) -> Joint:
    """Return a joint that slides along (m) and turns about (rad) one axis.

    >>> cylindrical("tube", "frame", "post", (0, 0, 0), (0, 0, 1)).coordinates
    ('tube.slide', 'tube.turn')
    """
    return _joint(
        name, parent, child, point, [(False, axis), (True, axis)], defaults=(f"{name}.slide", f"{name}.turn"), **law
    )


def universal(name: str, parent: str, child: str, point: Vector, axes: tuple[Vector, Vector], **law: Any) -> Joint:
    """Return a Cardan joint: a turn about the first axis, then about the second, carried along (rad).

    >>> universal("shoulder", "torso", "arm", (0, 0.2, -1), ((0, 1, 0), (0, 0, 1))).coordinates
    ('shoulder.1', 'shoulder.2')
    """
    return _joint(
        name, parent, child, point, [(True, axis) for axis in axes], defaults=(f"{name}.1", f"{name}.2"), **law
    )


def spherical(
    name: str,
    parent: str,
    child: str,
    point: Vector,
    axes: Sequence[Vector] = (Z, X, Y),
    *,
    quaternion: bool = False,
    **law: Any,
) -> Joint:
    """Return a ball joint: turns about three axes in succession (rad), by default z, x, y.

    The angles are singular where the second turn brings the third axis onto the first. A ``quaternion`` never is; it
    takes four coordinates, and no springs or dampers.

    >>> spherical("hip", "frame", "torso", (0, 0, -1)).coordinates
    ('hip.1', 'hip.2', 'hip.3')
    """
    if quaternion:
        return _quaternion_joint(name, parent, child, point, [], law)
    names = tuple(f"{name}.{i}" for i in (1, 2, 3))
    return _joint(name, parent, child, point, [(True, axis) for axis in axes], defaults=names, **law)


def _quaternion_joint(
    name: str, parent: str, child: str, point: Vector, slides: Sequence[Motion], law: dict[str, Any]
) -> Joint:
    if law:
        raise ModelError(f"joint {name}: a quaternion takes no {', '.join(law)}; use angles instead")
    turns = tuple(Motion(f"{name}.q{i}", rotates=True, axis=X) for i in range(4))
    return Joint(name, parent, child, point, (*slides, *turns), quaternion=True)


def planar(name: str, parent: str, child: str, point: Vector, *, normal: Vector, along: Vector, **law: Any) -> Joint:
    """Return a joint that slides along ``along`` and ``normal x along`` (m) and turns about ``normal`` (rad).

    >>> planar("puck", "ground", "disc", (0, 0, 0), normal=(0, 0, 1), along=(1, 0, 0)).motions[1].axis
    (0.0, 1.0, 0.0)
    """
    n, a = check_axis(f"joint {name}", "normal", normal), check_axis(f"joint {name}", "along", along)
    across = (n[1] * a[2] - n[2] * a[1], n[2] * a[0] - n[0] * a[2], n[0] * a[1] - n[1] * a[0])
    names = (f"{name}.along", f"{name}.across", f"{name}.turn")
    return _joint(name, parent, child, point, [(False, a), (False, across), (True, n)], defaults=names, **law)


def free(
    name: str,
    parent: str,
    child: str,
    point: Vector = (0, 0, 0),
    axes: Sequence[Vector] = (Z, X, Y),
    *,
    quaternion: bool = False,
    **law: Any,
) -> Joint:
    """Return six degrees of freedom: x, y, z of ``point`` (m), then turns about three axes in succession (rad).

    With the default axes the turns are yaw, lean and pitch; for ``quaternion`` see :func:`spherical`.

    >>> free("frame", GROUND, "rear frame").coordinates
    ('frame.x', 'frame.y', 'frame.z', 'frame.1', 'frame.2', 'frame.3')
    """
    slides = [(f"{name}.{part}", axis) for part, axis in zip("xyz", (X, Y, Z), strict=True)]
    if quaternion:
        motions = [Motion(slide, rotates=False, axis=axis) for slide, axis in slides]
        return _quaternion_joint(name, parent, child, point, motions, law)
    names = (*(slide for slide, _ in slides), *(f"{name}.{i}" for i in (1, 2, 3)))
    turns = [(False, axis) for _, axis in slides] + [(True, axis) for axis in axes]
    return _joint(name, parent, child, point, turns, defaults=names, **law)
