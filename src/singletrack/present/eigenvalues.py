"""The eigenvalue figure: real and imaginary parts over the forward speed, as in the paper's Figures 4 and 5."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from singletrack.present.labels import Curve, label_curves
from singletrack.present.style import COLOURS, colour_of, new_figure, style
from singletrack.present.words import METRES, SpeedUnit

if TYPE_CHECKING:
    from collections.abc import Sequence

    from matplotlib.axes import Axes
    from matplotlib.figure import Figure
    from matplotlib.text import Annotation

    from singletrack.linear import CriticalSpeeds, Modes

__all__ = ["broken", "draw_eigenvalues", "eigenvalue_figure"]

# Of the words above the axes: how far up they begin and how far apart rows are, in points; how far aside, in pixels.
_ABOVE, _ROW, _ASIDE = 3, 11, 60
_LIFT = 5.0


def eigenvalue_figure(modes: Modes, critical: CriticalSpeeds, title: str, limit: float = 10.0) -> Figure:
    """Return a figure of the eigenvalues of a single design.

    Parameters
    ----------
    modes : Modes
        At ascending speeds.
    critical : CriticalSpeeds
    title : str
    limit : float
        The vertical axis runs from -limit to limit, in 1/s.
    """
    with style():
        figure = new_figure(6.4, 4.6)
        axes = figure.add_subplot()
        axes.set_title(title, loc="left", fontsize=10)
        draw_eigenvalues(axes, modes, critical, limit)
    return figure


def draw_eigenvalues(
    axes: Axes,
    modes: Modes,
    critical: CriticalSpeeds,
    limit: float = 10.0,
    unit: SpeedUnit = METRES,
    beside: Sequence[Curve] = (),
) -> list[str]:
    """Draw the eigenvalues of a single design on axes of any size.

    Parameters
    ----------
    axes : matplotlib Axes
    modes, critical, limit
        As for :func:`eigenvalue_figure`.
    unit : SpeedUnit
        Of the speed in the figure.
    beside : sequence of Curve
        What else is drawn there, which labels keep away from.

    Returns
    -------
    list of str
        Modes in view that no word names, for want of room.
    """
    v = modes.speeds * unit.factor
    ranges = [(low * unit.factor, high * unit.factor) for low, high in critical.stable_ranges]
    axes.set_xlim(float(v[0]), float(v[-1]))
    axes.set_ylim(-limit, limit)
    axes.set_xlabel(f"forward speed v ({unit.name})")
    along = axes.set_ylabel("eigenvalues: Re λ solid, Im λ dashed (1/s)")
    if along.get_window_extent().height > axes.get_window_extent().height:
        axes.set_ylabel("eigenvalues (1/s):\nRe λ solid, Im λ dashed")
    for low, high in ranges:
        axes.axvspan(low, min(high, float(v[-1])), color=COLOURS["stable"], lw=0, zorder=0)
    axes.axhline(0.0, color="black", lw=0.8, zorder=1)
    marked = _mark_speeds(axes, critical, unit)
    curves = _mode_curves(modes, v)
    for curve, dashed in curves:
        axes.plot(curve.x, curve.y, color=curve.colour, ls=(0, (4, 2)) if dashed else "-", zorder=3)
    shown = [(max(low, float(v[0])), min(high, float(v[-1]))) for low, high in ranges]
    least = 0.06 * float(v[-1] - v[0])
    wide = [_stable_label(low, high, limit) for low, high in shown if high - low > least]
    drawn = [*(curve for curve, _ in curves), Curve(v, 0.0 * v, "", "black"), *wide, *beside]
    left_out = label_curves(axes, drawn, marked)
    named = {curve.label.partition(" ")[2] for curve, _ in curves if curve.label and curve.label not in left_out}
    shown = (np.abs(modes.eigenvalues.real) < limit).any(axis=0)
    in_view = [name for name, seen in zip(modes.names, shown, strict=True) if seen]
    return [name for name in dict.fromkeys(in_view) if name not in named]


def _stable_label(low: float, high: float, limit: float) -> Curve:
    """Return the places in the middle of a stable range where the word may stand."""
    heights = np.linspace(-0.95 * limit, 0.95 * limit, 40)
    return Curve(np.full(40, (low + high) / 2), heights, "stable", "#3B7A32", on_points=True)


def _mark_speeds(axes: Axes, critical: CriticalSpeeds, unit: SpeedUnit) -> list[float]:
    """Mark the critical speeds in view with a line and a word above the axes; return them."""
    low, high = axes.get_xlim()
    names = [crossing.mode for crossing in critical.crossings]
    marks = [(crossing.speed * unit.factor, crossing.mode) for crossing in critical.crossings]
    marks = [mark for mark in marks if low < mark[0] < high]
    for speed, name in marks:
        axes.axvline(speed, color=colour_of(name, names), lw=0.9, ls=":", zorder=2)
    texts = [
        axes.annotate(
            f"{name} speed {speed:.2f} {unit.name}",
            (speed, 1.0),
            xycoords=("data", "axes fraction"),
            xytext=(0, _ABOVE),
            textcoords="offset points",
            ha="center",
            va="bottom",
            fontsize=8,
            color=colour_of(name, names),
        )
        for speed, name in marks
    ]
    rows = _arrange(axes, texts)
    if rows:
        _keep_clear(axes, rows)
    return [speed for speed, _ in marks]


def _arrange(axes: Axes, texts: list[Annotation]) -> int:
    """Move words above the axes aside, and into rows, until none covers another; return the number of rows."""
    figure = axes.get_figure(root=True)
    assert figure is not None  # noqa: S101  # drawn axes belong to a figure
    figure.canvas.draw()  # laid out: the axes have their size now
    per_point, across = figure.dpi / 72, axes.get_window_extent()
    ends: list[float] = []  # of what stands in each row, in pixels
    for text in texts:
        box = text.get_window_extent()
        shift = min(0.0, across.x1 - box.x1) + max(0.0, across.x0 - box.x0)
        # A little to the right is better than a row up.
        row = next((row for row, end in enumerate(ends) if box.x0 + max(shift, end - box.x0) <= box.x0 + _ASIDE), -1)
        if row < 0 or box.x1 + max(shift, ends[row] - box.x0) > max(across.x1, box.x1 + shift) + 1:
            row = len(ends)
            ends.append(-np.inf)
        shift = max(shift, ends[row] - box.x0)
        ends[row] = box.x1 + shift + 6 * per_point
        # What is wider than the axes stands above the number at their corner too.
        lift = _LIFT if box.x0 + shift < across.x0 else 0.0
        text.set_position((shift / per_point, _ABOVE + lift + row * _ROW))
    return len(ends)


def _keep_clear(axes: Axes, rows: int) -> None:
    """Hold the place of rows of words above the axes: titles, set before or after, stay above them."""
    above = axes.secondary_xaxis("top")
    above.set_ticks([float(np.mean(axes.get_xlim()))], ["\n".join([" "] * rows)], fontsize=8)
    above.tick_params(length=0, pad=_ABOVE)
    above.spines["top"].set_visible(False)


def broken(roots: np.ndarray, column: int) -> np.ndarray:
    """Return the real part of a mode, NaN where its name passes on from one root to another (see linear.modes).

    Parameters
    ----------
    roots : complex array, shape (k, 2 n)
        At k speeds, in 1/s.
    column : int
        Of the mode.
    """
    real = roots[:, column].real.copy()
    step = np.abs(np.diff(roots[:, column]))
    nearest = np.abs(roots[1:, column, None] - roots[:-1]).min(axis=1)
    real[1:][(step > 5 * nearest + 0.2) & (roots[1:, column].imag == 0) & (roots[:-1, column].imag == 0)] = np.nan
    return real


def _mode_curves(modes: Modes, v: np.ndarray) -> list[tuple[Curve, bool]]:
    """Return the curves of the modes, and whether they are dashed (imaginary parts, where not zero)."""
    roots = modes.eigenvalues
    curves = []
    for column, name in enumerate(modes.names):
        colour = colour_of(name, modes.names)
        real = broken(roots, column)
        imaginary = np.where(roots[:, column].imag > 0, roots[:, column].imag, np.nan)
        second_of_pair = column > 0 and modes.names[column - 1] == name
        twin = column + 1 < len(modes.names) and modes.names[column + 1] == name
        also = broken(roots, column + 1) if twin else None
        curves.append((Curve(v, real, "" if second_of_pair else f"Re {name}", colour, also=also), False))
        if np.isfinite(imaginary).any():
            curves.append((Curve(v, imaginary, "" if second_of_pair else f"Im {name}", colour), True))
    return curves
