"""What acts on the bodies of a machine: rolling wheels, springs, forces, and what is measured."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np

from singletrack.errors import ModelError
from singletrack.multibody.engine.checks import check_axis, check_number, check_vector, is_number
from singletrack.multibody.engine.elements import GROUND, Scalar, Vector

__all__ = ["CoordinateForce", "Force", "Sensor", "Spring", "Torque", "Wheel"]


@dataclass(frozen=True, eq=False)
class Wheel:
    """A wheel that rolls on the level ground z = 0 without slip.

    A torus of outer radius ``radius`` whose cross-section has the radius ``crown`` (0: a knife edge). It touches at
    ``p + (radius - crown) d + crown k``, k down, ``d = (k - (k.e) e)/|.|``, with centre p and axle e.

    Parameters
    ----------
    name, body
        Its name, and the body that turns with it.
    centre, axle
        Centre (m) and axle in the drawing. The longitudinal direction is axle x down: forward for an axle to the
        right, about which a wheel that rolls forward turns by a negative angle.
    radius, crown
        Radii, m.
    """

    name: str
    body: str
    centre: Vector
    radius: Scalar
    axle: Vector = (0.0, 1.0, 0.0)
    crown: Scalar = 0.0

    def __post_init__(self) -> None:
        element = f"wheel {self.name}"
        object.__setattr__(self, "centre", check_vector(element, "centre", self.centre))
        object.__setattr__(self, "axle", check_axis(element, "axle", self.axle))
        object.__setattr__(self, "radius", check_number(element, "radius", self.radius, low=1e-12))
        object.__setattr__(self, "crown", check_number(element, "crown", self.crown, low=0.0))
        if is_number(self.radius) and is_number(self.crown) and self.crown > self.radius:
            raise ModelError(f"{element}: crown is {self.crown:g} m; allowed: at most the radius, {self.radius:g} m")


@dataclass(frozen=True, eq=False)
class Spring:
    """A spring and damper between a point of one body and a point of another.

    It pulls the points together with ``stiffness (l - rest) + damping l' + preload`` (N), l the distance.
    """

    name: str
    first: str
    second: str
    first_point: Vector
    second_point: Vector
    stiffness: Scalar = 0.0
    damping: Scalar = 0.0
    rest: Scalar = 0.0
    preload: Scalar = 0.0

    def __post_init__(self) -> None:
        element = f"spring {self.name}"
        for name in ("first_point", "second_point"):
            object.__setattr__(self, name, check_vector(element, name.replace("_", " "), getattr(self, name)))
        for name, low in (("stiffness", -np.inf), ("damping", -np.inf), ("rest", 0.0), ("preload", -np.inf)):
            object.__setattr__(self, name, check_number(element, name, getattr(self, name), low))

    @property
    def is_linear(self) -> bool:
        """Whether it pulls by its stiffness alone, from no length on: then it needs no direction."""
        return all(is_number(value) and value == 0.0 for value in (self.damping, self.rest, self.preload))


@dataclass(frozen=True, eq=False)
class Force:
    """An input: a force (N) on a point of a body, along a direction of the ground or (``follows``) of the body."""

    name: str
    body: str
    point: Vector
    direction: Vector
    follows: bool = False

    def __post_init__(self) -> None:
        object.__setattr__(self, "point", check_vector(f"input {self.name}", "point", self.point))
        object.__setattr__(self, "direction", check_axis(f"input {self.name}", "direction", self.direction))


@dataclass(frozen=True, eq=False)
class Torque:
    """An input: a torque (N m) on a body about a direction of the ground or (``follows``) of that body.

    The reaction acts on the body ``reaction`` (the ground by default).
    """

    name: str
    body: str
    direction: Vector
    reaction: str = GROUND
    follows: bool = False

    def __post_init__(self) -> None:
        object.__setattr__(self, "direction", check_axis(f"input {self.name}", "direction", self.direction))


@dataclass(frozen=True, eq=False)
class CoordinateForce:
    """An input: the generalised force (N or N m) on one joint coordinate, such as a steer torque."""

    name: str
    coordinate: str


@dataclass(frozen=True, eq=False)
class Sensor:
    """An output: position (m), velocity (m/s) or angular velocity (rad/s) of a body's point along a direction.

    The direction is of the ground, or of the body if it ``follows``.
    """

    name: str
    body: str
    point: Vector = (0.0, 0.0, 0.0)
    direction: Vector = (1.0, 0.0, 0.0)
    kind: Literal["position", "velocity", "rate"] = "position"
    follows: bool = False

    def __post_init__(self) -> None:
        object.__setattr__(self, "point", check_vector(f"sensor {self.name}", "point", self.point))
        object.__setattr__(self, "direction", check_axis(f"sensor {self.name}", "direction", self.direction))
