"""What can be seen of a bicycle and its rider: lines on the bodies of the machine, and where they are in a motion."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from singletrack.arrays import Array
from singletrack.body.skeleton import frame_points
from singletrack.posture import Options, seat

if TYPE_CHECKING:
    from singletrack.multibody.engine.model import Model
    from singletrack.parameters import Bicycle, Rider

__all__ = ["Line", "drawn_lines", "placed"]

_TUBES = ((2, 5), (5, 10), (10, 13), (2, 10), (10, 12), (5, 11))
_FRONT = ((7, 11), (11, 16), (16, 19))
_HALF_BAR = 0.2
_RIM = np.linspace(0.0, 2.0 * np.pi, 33)


@dataclass(frozen=True, eq=False)
class Line:
    """A line on a body of the machine, as drawn: its body, what it is part of, and its points (k, 3), m.

    The part is ``wheel``, ``frame``, ``front`` or ``rider``.
    """

    body: str
    part: str
    points: Array


def drawn_lines(bicycle: Bicycle, rider: Rider | None = None, options: Options | str = "rigid") -> tuple[Line, ...]:
    """Return the lines of a bicycle: wheels, tubes, bar, limbs.

    Parameters
    ----------
    bicycle, rider
        One design. Without frame geometry there are wheels, fork and a bar on the steer axis.
    options
        How the rider sits, or a posture's name.

    Examples
    --------
    >>> from singletrack import load_bicycle
    >>> sorted({line.part for line in drawn_lines(load_bicycle("benchmark"))})
    ['frame', 'front', 'wheel']
    """
    lines = [*_wheel(bicycle, "rear", 0.0), *_wheel(bicycle, "front", float(bicycle.wheel_base))]
    if bicycle.missing_geometry():
        lines += _steer_axis(bicycle)
    else:
        points = {number: np.asarray(point, dtype=float) for number, point in frame_points(bicycle).items()}
        lines += [Line("rear frame", "frame", np.array([points[a], points[b]])) for a, b in _TUBES]
        lines += [Line("front frame", "front", np.array([points[a], points[b]])) for a, b in _FRONT]
        lines.append(_bar(points[19]))
    if rider is not None:
        lines += _limbs(bicycle, rider, Options.of(options))
    return tuple(line for line in lines if np.all(np.isfinite(line.points)))


def _wheel(bicycle: Bicycle, end: str, x: float) -> list[Line]:
    radius = float(getattr(bicycle, f"{end}_wheel_radius"))
    rim = np.array([x + radius * np.cos(_RIM), 0.0 * _RIM, -radius + radius * np.sin(_RIM)]).T
    spoke = np.array([rim[0], rim[16]])
    return [Line(f"{end} wheel", "wheel", rim), Line(f"{end} wheel", "wheel", spoke)]


def _bar(middle: Array, half: float = _HALF_BAR) -> Line:
    across = np.array([0.0, half, 0.0])
    return Line("front frame", "front", np.array([middle + across, middle - across]))


def _steer_axis(bicycle: Bicycle) -> list[Line]:
    base, tilt = float(bicycle.wheel_base), float(bicycle.steer_axis_tilt)
    front, rear = float(bicycle.front_wheel_radius), float(bicycle.rear_wheel_radius)
    foot, axis = base + float(bicycle.trail), np.array([np.sin(tilt), 0.0, np.cos(tilt)])
    hub = np.array([base, 0.0, -front])
    low, top = (np.array([foot, 0.0, 0.0]) - height / np.cos(tilt) * axis for height in (2.0 * front, 3.0 * front))
    fork = Line("front frame", "front", np.array([hub, low, top]))
    tubes = Line("rear frame", "frame", np.array([[0.0, 0.0, -rear], [0.4 * base, 0.0, -2.6 * front], low]))
    return [fork, tubes, _bar(top)]


def _limbs(bicycle: Bicycle, rider: Rider, options: Options) -> list[Line]:
    posture = seat(bicycle, rider, options)
    carried, lines = posture.carried_by or {}, []
    for name, segment in posture.segments.items():
        joint = carried.get(name)
        start, end = np.asarray(segment.start, dtype=float), np.asarray(segment.end, dtype=float)
        points = np.array([start, end])
        if np.allclose(start, end):
            radius = float(segment.radius)
            points = start + radius * np.array([np.cos(_RIM), 0.0 * _RIM, np.sin(_RIM)]).T
        lines.append(Line(f"{joint} link" if joint else "rear frame", "rider", points))
        if name == "torso":
            across = np.array([0.0, float(rider.shoulder_to_shoulder) / 2.0, 0.0])
            lines.append(Line(lines[-1].body, "rider", np.array([end - across, end + across])))
    return lines


def placed(model: Model, lines: tuple[Line, ...], q: Array) -> list[Array]:
    """Return where the points of each line are, (t, k, 3), m, for coordinates q (t, n) of the machine.

    Parameters
    ----------
    model : Model
        The machine.
    lines : tuple of Line
        Whose points are told in the bodies that carry them.
    q : array, shape (t, n)
        The machine's coordinates, m or rad.
    """
    p, bodies = model.parameters(), [body.name for body in model.system.bodies]
    translations, rotations = (part.full() for part in model.equations.poses(q.T, p))
    count = len(q)
    t = translations.T.reshape(count, len(bodies), 3)
    turns = rotations.T.reshape(count, len(bodies), 3, 3).transpose(0, 1, 3, 2)
    found = []
    for line in lines:
        i = bodies.index(line.body)
        found.append(t[:, i, None, :] + np.einsum("tij,kj->tki", turns[:, i], line.points))
    return found
