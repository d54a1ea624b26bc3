"""A bicycle from its right side, in characters, for the terminal."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from singletrack.body import skeleton

if TYPE_CHECKING:
    from singletrack.parameters import Bicycle, Rider

__all__ = ["side_view"]

# Each character has two dots across and four up (braille); dot (column, row from the top) to its bit.
_BITS = np.array([[0x01, 0x08], [0x02, 0x10], [0x04, 0x20], [0x40, 0x80]])


class _Canvas:
    """Dots in a window of x forward, z down, in m."""

    def __init__(self, low: np.ndarray, high: np.ndarray, width: int) -> None:
        self._low, self._high, self._step = low, high, (high[0] - low[0]) / (2 * width - 1)
        rows = math.ceil(((high[1] - low[1]) / self._step + 1) / 4)
        self._dots = np.zeros((4 * rows, 2 * width), dtype=bool)
        self._marks: dict[tuple[int, int], str] = {}

    def curve(self, points: np.ndarray) -> None:
        index = np.rint((points - self._low) / self._step).astype(int)
        inside = (index >= 0).all(axis=1) & (index[:, 0] < self._dots.shape[1]) & (index[:, 1] < self._dots.shape[0])
        self._dots[index[inside, 1], index[inside, 0]] = True

    def line(self, start: np.ndarray, end: np.ndarray) -> None:
        count = 2 + int(2 * np.abs(end - start).max() / self._step)
        self.curve(start + np.linspace(0, 1, count)[:, None] * (end - start))

    def circle(self, centre: np.ndarray, radius: float) -> None:
        angle = np.linspace(0, 2 * math.pi, 16 + int(16 * radius / self._step))
        self.curve(centre + radius * np.stack([np.cos(angle), np.sin(angle)], axis=-1))

    def mark(self, point: np.ndarray, text: str) -> None:
        column, row = ((point - self._low) / self._step / np.array([2, 4])).astype(int)
        for i, character in enumerate(text):
            self._marks[int(row), int(column) + i] = character

    def text(self) -> str:
        rows, columns = self._dots.shape[0] // 4, self._dots.shape[1] // 2
        bits = (self._dots.reshape(rows, 4, columns, 2) * _BITS[None, :, None, :]).sum(axis=(1, 3))
        lines = [
            "".join(
                self._marks.get((r, c)) or (chr(0x2800 + bits[r, c]) if bits[r, c] else " ") for c in range(columns)
            )
            for r in range(rows)
        ]
        return "\n".join(line.rstrip() for line in lines)


def side_view(bicycle: Bicycle, rider: Rider | None = None, width: int = 64) -> str:
    """Return a drawing of a bicycle, with its rider if given, to scale.

    Parameters
    ----------
    bicycle : Bicycle
        A single design; with frame geometry its tubes are drawn, without, only wheels and steer axis.
    rider : Rider, optional
        Needs frame geometry and a forward lean angle.
    width : int
        In characters.

    Returns
    -------
    str
        Lines of Braille characters; R, B, H and F mark the centres of mass of the four bodies.

    Examples
    --------
    >>> from singletrack import load_bicycle
    >>> drawing = side_view(load_bicycle("benchmark"), width=40)
    >>> all(letter in drawing for letter in "RBHF")
    True
    """
    base, rear, front = (float(x) for x in (bicycle.wheel_base, bicycle.rear_wheel_radius, bicycle.front_wheel_radius))
    lines = _tubes(bicycle, rider)
    head = _head(bicycle, rider)
    centres = {
        "R": (0.0, -rear),
        "B": (float(bicycle.rear_frame_x), float(bicycle.rear_frame_z)),
        "H": (float(bicycle.front_frame_x), float(bicycle.front_frame_z)),
        "F": (base, -front),
    }
    corners = [(-rear, 0.0), (base + front, 0.0), *centres.values(), *(point for line in lines for point in line)]
    corners += [(head[0][0], head[0][1] - head[1])] if head else []
    low, high = np.min(corners, axis=0) - 0.02, np.max(corners, axis=0) + np.array([0.02, 0.01])
    canvas = _Canvas(low, high, width)
    canvas.circle(np.array([0.0, -rear]), rear)
    canvas.circle(np.array([base, -front]), front)
    for start, end in lines:
        canvas.line(np.array(start), np.array(end))
    if head:
        canvas.circle(np.array(head[0]), head[1])
    for letter, place in centres.items():
        canvas.mark(np.array(place), letter)
    return canvas.text()


_Line = tuple[tuple[float, float], tuple[float, float]]


def _tubes(bicycle: Bicycle, rider: Rider | None) -> list[_Line]:
    """Return the lines of the frame and of the rider's limbs; of the steer axis alone without frame geometry."""
    base, front = float(bicycle.wheel_base), float(bicycle.front_wheel_radius)
    if bicycle.missing_geometry():
        foot, tan = base + float(bicycle.trail), math.tan(float(bicycle.steer_axis_tilt))
        height = -float(bicycle.front_frame_z) + 0.1
        return [((foot, 0.0), (foot - height * tan, -height)), ((base, -front), (foot - front * tan, -front))]
    pairs = [(2, 5), (5, 10), (10, 13), (2, 10), (10, 12), (5, 11), (11, 7), (11, 16), (16, 19)]
    if rider is not None:
        pairs += [(13, 15), (21, 23), (23, 19), (30, 28), (28, 26)]
    points = np.asarray(_points(bicycle, rider))[:, [0, 2]]
    return [(tuple(map(float, points[a - 1])), tuple(map(float, points[b - 1]))) for a, b in pairs]  # type: ignore[misc]


def _points(bicycle: Bicycle, rider: Rider | None) -> np.ndarray:
    from singletrack.body.skeleton import frame_points

    if rider is not None:
        points: np.ndarray = skeleton(bicycle, rider).points
        return points
    found = frame_points(bicycle)
    return np.stack([found.get(number, np.zeros(3)) for number in range(1, 32)])


def _head(bicycle: Bicycle, rider: Rider | None) -> tuple[tuple[float, float], float] | None:
    if rider is None:
        return None
    centre = skeleton(bicycle, rider)[25]
    return (float(centre[0]), float(centre[2])), float(rider.head_circumference) / (2 * math.pi)
