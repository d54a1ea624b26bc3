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

_LEAN, _STEER = COLOURS["weave"], COLOURS["capsize"]


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
        grid = figure.subplots(len(rows), 3, squeeze=False)
        for axes_row, (name, modes) in zip(grid, rows, strict=True):
            for axes, column in zip(axes_row, (0, 2, 3), strict=True):
                _draw_phasors(axes, modes, speed_index, column)
            axes_row[0].set_ylabel(f"{name}\nIm", fontsize=8)
        for axes in grid[-1]:
            axes.set_xlabel("Re", fontsize=8)
    return figure


def _draw_phasors(axes: Axes, modes: Modes, index: int, column: int) -> None:
    from matplotlib.patches import Circle  # lazy: heavy

    axes.set_aspect("equal")
    axes.set_xlim(-1.25, 1.25)
    axes.set_ylim(-1.25, 1.25)
    axes.set_xticks([-1, 0, 1])
    axes.set_yticks([-1, 0, 1])
    axes.tick_params(labelsize=7)
    axes.add_patch(Circle((0, 0), 1.0, fill=False, ec="#CCCCCC", lw=0.6))
    axes.axhline(0, color="#CCCCCC", lw=0.6, zorder=0)
    axes.axvline(0, color="#CCCCCC", lw=0.6, zorder=0)
    roots = modes.eigenvalues[index]
    motion = modes.eigenmotions[index, column]
    motion = motion / np.abs(motion).max()
    applies = bool(modes.applies[index, column])
    text = format_root(roots[0], roots[1]) if column == 0 else format_root(roots[column])
    name = modes.names[column] if applies else f"({modes.names[column]})"
    axes.set_title(f"{name}: {text} 1/s", fontsize=8)
    above = 1.0 if abs(motion[1].imag) < 0.25 else 0.0
    for phasor, colour, word, width in ((motion[0], _LEAN, "lean", 3.2), (motion[1], _STEER, "steer", 1.6)):
        axes.annotate(
            "",
            (phasor.real, phasor.imag),
            (0, 0),
            arrowprops={"arrowstyle": "-|>", "color": colour, "lw": width, "shrinkA": 0, "shrinkB": 0},
        )
        at = _beside(phasor, 0.22 if word == "lean" else -0.22 * (above or 1.0))
        axes.text(at.real, at.imag, word, color=colour, fontsize=8, ha="center", va="center")


def _beside(phasor: complex, distance: float) -> complex:
    """Return a place beside the outer half of a phasor, at least far enough out to be clear of the other's foot."""
    length = max(abs(phasor), 1e-9)
    along = phasor / length
    return along * max(0.62 * length, 0.42) + 1j * along * distance
