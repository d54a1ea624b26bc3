"""What a side view of a bicycle shows, as data: lines, circles and centres of mass in the plane of symmetry."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from singletrack.body import skeleton
from singletrack.body.skeleton import frame_points
from singletrack.parameters.bodies import bicycle_bodies
from singletrack.posture import steered_skeleton

if TYPE_CHECKING:
    from singletrack.parameters import Bicycle, Rider
    from singletrack.posture import Posture

__all__ = ["Outline", "Turned", "outline", "turned"]

# Tubes and limbs of the right side between skeleton points (Table 3 of the paper).
_TUBES = ((2, 5), (5, 10), (10, 13), (2, 10), (10, 12), (5, 11), (11, 7), (11, 16), (16, 19))
_LIMBS = ((13, 15), (21, 23), (23, 19), (30, 28), (28, 26))
# Arms, whole or in two parts, between skeleton points.
_ARMS = {
    "right_upper_arm": (21, 23),
    "right_lower_arm": (23, 19),
    "left_upper_arm": (22, 24),
    "left_lower_arm": (24, 20),
    "right_arm": (21, 19),
    "left_arm": (22, 20),
}
#: Steer angles in degrees to choose from: the largest at which second order keeps the arms' lengths to so many m.
_STEER_ANGLES = (20, 15, 10, 5, 2)
_LENGTH_ERROR = 0.01
_LETTERS = {"rear wheel": "R", "rear frame": "B", "front frame": "H", "front wheel": "F"}


@dataclass(frozen=True, eq=False)
class Outline:
    """A bicycle from its right side; x forward, z down from the ground, in m.

    Attributes
    ----------
    lines : array, shape (k, 2, 2)
        Start and end of each tube and limb.
    circles : array, shape (m, 3)
        Centre and radius of the wheels and of the head.
    centres : mapping of str to array, shape (2,)
        Centres of mass by letter: R rear wheel, B rear frame, H front frame, F front wheel.
    """

    lines: np.ndarray
    circles: np.ndarray
    centres: dict[str, np.ndarray]


def outline(bicycle: Bicycle, rider: Rider | None = None) -> Outline:
    """Return the outline of a bicycle, with its rider if given.

    Parameters
    ----------
    bicycle : Bicycle
        A single design. Without frame geometry there are only wheels, fork and steer axis; tubes that cannot be where
        the geometry has them are left out.
    rider : Rider, optional
        Needs frame geometry and a forward lean angle.

    Raises
    ------
    SingletrackError
        If the rider does not fit the bicycle.

    Examples
    --------
    >>> from singletrack import load_bicycle
    >>> found = outline(load_bicycle("benchmark"))
    >>> found.lines.shape, found.circles.shape, sorted(found.centres)
    ((2, 2, 2), (2, 3), ['B', 'F', 'H', 'R'])
    """
    bodies = {_LETTERS[name]: np.array([body.x, body.z], dtype=float) for name, body in bicycle_bodies(bicycle).items()}
    radii = (float(bicycle.rear_wheel_radius), float(bicycle.front_wheel_radius))
    circles = [(*bodies[letter], radius) for letter, radius in zip("RF", radii, strict=True)]
    if bicycle.missing_geometry():
        lines = _steer_axis(bicycle, -bodies["H"][1] + 0.1, radii[1])
    elif rider is None:
        points = {number: np.asarray(point)[[0, 2]] for number, point in frame_points(bicycle).items()}
        lines = np.array([(points[start], points[end]) for start, end in _TUBES])
    else:
        seated = skeleton(bicycle, rider)
        lines = np.array([(seated[a][[0, 2]], seated[b][[0, 2]]) for a, b in (*_TUBES, *_LIMBS)])
        circles.append((*seated[25][[0, 2]], float(rider.head_circumference) / (2 * math.pi)))
    return Outline(lines[np.isfinite(lines).all(axis=(1, 2))], np.array(circles), bodies)


def _steer_axis(bicycle: Bicycle, height: float, front: float) -> np.ndarray:
    """Return the steer axis from the ground to a height, and the fork along it from the hub to the ground."""
    base, tan = float(bicycle.wheel_base), math.tan(float(bicycle.steer_axis_tilt))
    foot = base + float(bicycle.trail)
    return np.array([[(foot, 0.0), (foot - height * tan, -height)], [(base, -front), (foot - front * tan, -front)]])


@dataclass(frozen=True, eq=False)
class Turned:
    """A rider with the handlebar turned.

    Attributes
    ----------
    steer : float
        In rad, to the right.
    points : array, shape (31, 3)
        The skeleton, to second order.
    """

    steer: float
    points: np.ndarray


def turned(bicycle: Bicycle, posture: Posture) -> Turned | None:
    """Return a rider with the handlebar turned as far as second order is good enough; nothing without hands on it.

    Parameters
    ----------
    bicycle : Bicycle
    posture : Posture
        Of a single design.
    """
    if not posture.loops:
        return None
    straight = np.asarray(posture.skeleton.points, dtype=float)
    for steer in np.radians(_STEER_ANGLES):
        moved = np.asarray(steered_skeleton(posture, bicycle, np.asarray(steer)), dtype=float)
        lengths = [
            np.linalg.norm(points[end - 1] - points[start - 1])
            for points in (moved, straight)
            for name, (start, end) in _ARMS.items()
            if name in posture.segments
        ]
        before, after = np.split(np.array(lengths), 2)
        if np.abs(after - before).max(initial=0.0) < _LENGTH_ERROR:
            break
    return Turned(float(steer), moved)
