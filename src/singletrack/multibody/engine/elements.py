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
    "parameter",
    "parameters",
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
