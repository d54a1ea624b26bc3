"""Eigenmotions as phasors: lean and steer of each mode in the complex plane."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from singletrack.present.style import COLOURS, new_figure, style
from singletrack.present.tables import format_root

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from singletrack.linear import Modes

__all__ = ["phasor_figure"]

#: Word, colour and width of each coordinate's phasor; the widest lies lowest.
_COORDINATES = (
    ("lean", COLOURS["weave"], 3.2),
    ("steer", COLOURS["capsize"], 1.6),
    ("torso", COLOURS["castering"], 1.6),
)
_REACH = 1.25
_CLEAR = 0.05


def phasor_figure(rows: list[tuple[str, Modes]], speed_index: int, title: str) -> Figure:
    """Return the eigenmotions of several models at one speed: a row for each model, a column for each mode.

    Parameters
    ----------
    rows : list of (str, Modes)
        Name of each model and its modes.
    speed_index : int
        Which of the speeds.
    title : str

    Notes
    -----
    The longer phasor of the two has length one; lean points to the right. Steer that points up leads lean by a
    quarter of a period.
    """
    with style():
        figure = new_figure(7.2, 0.6 + 2.35 * len(rows))
        figure.suptitle(title, x=0.01, ha="left", fontsize=10)
        columns = [0, *range(2, len(rows[0][1].names))]  # a pair of roots is one motion
        grid = figure.subplots(len(rows), len(columns), squeeze=False)
        for axes_row, (name, modes) in zip(grid, rows, strict=True):
            for axes, column in zip(axes_row, columns, strict=True):
                _draw_phasors(axes, modes, speed_index, column)
            axes_row[0].set_ylabel(f"{name}\nIm", fontsize=8)
        for axes in grid[-1]:
            axes.set_xlabel("Re", fontsize=8)
    return figure


def _draw_phasors(axes: Axes, modes: Modes, index: int, column: int) -> None:
    from matplotlib.patches import Circle

    axes.set_aspect("equal")
    axes.set(xlim=(-_REACH, _REACH), ylim=(-_REACH, _REACH), xticks=[-1, 0, 1], yticks=[-1, 0, 1])
    axes.tick_params(labelsize=7)
    axes.add_patch(Circle((0, 0), 1.0, fill=False, ec="#CCCCCC", lw=0.6))
    axes.axhline(0, color="#CCCCCC", lw=0.6, zorder=0)
    axes.axvline(0, color="#CCCCCC", lw=0.6, zorder=0)
    roots = modes.eigenvalues[index]
    motion = modes.eigenmotions[index, column]
    motion = motion / np.abs(motion).max()
    text = format_root(roots[0], roots[1]) if column == 0 else format_root(roots[column])
    name = modes.names[column] if modes.applies[index, column] else f"({modes.names[column]})"
    axes.set_title(f"{name}: {text} 1/s", fontsize=8)
    taken: list[np.ndarray] = []
    phasors = [np.array([phasor.real, phasor.imag]) for phasor in motion]
    for phasor, (word, colour, width) in zip(phasors, _COORDINATES, strict=False):
        _draw_arrow(axes, phasor, colour, width)
        at = _place(phasor, phasors, taken, word)
        taken.append(at)
        axes.text(float(at[0]), float(at[1]), word, color=colour, fontsize=8, ha="center", va="center")


def _draw_arrow(axes: Axes, tip: np.ndarray, colour: str, width: float) -> None:
    """Draw an arrow from the origin whose head is shorter than itself: it points its own way however short it is."""
    from matplotlib.patches import Polygon

    length = max(float(np.hypot(*tip)), 1e-12)
    along, across = tip / length, np.array([-tip[1], tip[0]]) / length
    head, half = min(0.14, 0.6 * length), min(0.03 + 0.012 * width, 0.4 * length)
    foot = tip - head * along
    axes.plot([0, foot[0]], [0, foot[1]], color=colour, lw=width, solid_capstyle="butt", zorder=3)
    corners = [tip, foot + half * across, foot - half * across]
    axes.add_patch(Polygon(corners, closed=True, fc=colour, ec="none", zorder=3))


def _place(own: np.ndarray, phasors: list[np.ndarray], taken: list[np.ndarray], word: str) -> np.ndarray:
    """Return the place of a word near its phasor that is clear of all phasors and of the words that are there."""
    half = np.array([0.075 * len(word), 0.11])  # of the word's box, in units of the axes
    angles = np.linspace(0, 2 * np.pi, 48, endpoint=False)
    ring = np.stack([np.cos(angles), np.sin(angles)], axis=-1)
    places = np.concatenate([share * own + radius * ring for share in (1.0, 0.7, 0.4) for radius in (0.24, 0.36, 0.5)])
    places = places[(np.abs(places) + half < _REACH - 0.02).all(axis=-1)]
    lines = [np.linspace(0, 1, 40)[:, None] * phasor for phasor in phasors]
    gap = np.min([_clearance(places, half, line) for line in lines], axis=0)
    for other in taken:
        gap = np.minimum(gap, _clearance(places, half + half, other[None]))
    distance = np.linalg.norm(places[:, None] - own * np.linspace(0.2, 1, 20)[:, None], axis=-1).min(axis=-1)
    for line, phasor in zip(lines, phasors, strict=True):
        if phasor is not own:  # rather on the side away from the others
            distance -= np.minimum(np.linalg.norm(places[:, None] - line, axis=-1).min(axis=-1), 0.4)
    best: np.ndarray = places[np.argmin(np.where(gap > _CLEAR, distance, 10 - gap))]
    return best


def _clearance(places: np.ndarray, half: np.ndarray, points: np.ndarray) -> np.ndarray:
    """Return the gap between boxes around places and points, negative where a point is inside."""
    gap: np.ndarray = (np.abs(places[:, None] - points) - half).max(axis=-1).min(axis=-1)
    return gap
