"""A bicycle from its right side, in characters, for the terminal."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from singletrack.analysis.outline import Outline

__all__ = ["side_view"]

# Each character has two dots across and four up (braille); dot (column, row from the top) to its bit.
_BITS = np.array([[0x01, 0x08], [0x02, 0x10], [0x04, 0x20], [0x40, 0x80]])
_MOST_ROWS = 60


class _Canvas:
    """Dots in a window of x forward, z down, in m."""

    def __init__(self, low: np.ndarray, high: np.ndarray, width: int) -> None:
        size = high - low
        # Two dots a column, four a row; what is very high is drawn smaller, so that it fits a screen.
        self._low, self._step = low, max(size[0] / (2 * width - 1), size[1] / (4 * _MOST_ROWS - 1))
        rows = math.ceil((size[1] / self._step + 1) / 4)
        self._dots = np.zeros((4 * rows, 2 * width), dtype=bool)
        self._marks: dict[tuple[int, int], str] = {}

    def curve(self, points: np.ndarray) -> None:
        index = np.rint((points - self._low) / self._step).astype(int)
        inside = (index >= 0).all(axis=1) & (index[:, 0] < self._dots.shape[1]) & (index[:, 1] < self._dots.shape[0])
        self._dots[index[inside, 1], index[inside, 0]] = True

    def line(self, start: np.ndarray, end: np.ndarray) -> None:
        count = 2 + int(2 * np.abs(end - start).max() / self._step)  # at most the canvas across and down
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


def side_view(outline: Outline, width: int = 64) -> str:
    """Return a drawing of a bicycle, to scale.

    Parameters
    ----------
    outline : Outline
        Of a bicycle, with or without its rider.
    width : int
        In characters, at most.

    Returns
    -------
    str
        Lines of Braille characters; R, B, H and F mark the centres of mass of the four bodies.

    Examples
    --------
    >>> from singletrack import load_bicycle
    >>> from singletrack.analysis.outline import outline
    >>> drawing = side_view(outline(load_bicycle("benchmark")), width=40)
    >>> all(letter in drawing for letter in "RBHF")
    True
    """
    centres, radii = outline.circles[:, :2], outline.circles[:, 2:]
    ends = outline.lines.reshape(-1, 2)
    corners = np.concatenate([centres - radii, centres + radii, ends, list(outline.centres.values())])
    canvas = _Canvas(corners.min(axis=0) - 0.02, corners.max(axis=0) + np.array([0.02, 0.01]), width)
    for centre, radius in zip(centres, outline.circles[:, 2], strict=True):
        canvas.circle(centre, float(radius))
    for start, end in outline.lines:
        canvas.line(start, end)
    for letter, place in outline.centres.items():
        canvas.mark(place, letter)
    return canvas.text()
