"""Eigenvalues over the speed: one bicycle with its modes in colour, or several over one another."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from singletrack.present.bands import add_bands
from singletrack.present.eigenvalues import broken, draw_eigenvalues
from singletrack.present.style import LINES, colour_of, new_figure, style
from singletrack.present.words import METRES, SpeedUnit

if TYPE_CHECKING:
    from collections.abc import Sequence

    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from singletrack.analysis.uncertainty import EigenvalueUncertainty
    from singletrack.linear import CriticalSpeeds, Modes

__all__ = ["MILLIMETRES", "Drawn", "overlay_figure", "single_figure"]

#: Inches per mm.
MILLIMETRES = 1 / 25.4
#: Designs told apart by colour and dashes; more share a scale of colours.
_MOST_DASHED = len(LINES)


@dataclass(frozen=True, eq=False)
class Drawn:
    """What is drawn of one design.

    Attributes
    ----------
    label : str
        In the legend.
    modes : Modes
        At ascending speeds (k,).
    critical : CriticalSpeeds
    uncertainty : EigenvalueUncertainty, optional
        At speeds of its own.
    """

    label: str
    modes: Modes
    critical: CriticalSpeeds
    uncertainty: EigenvalueUncertainty | None = None


def single_figure(
    drawn: Drawn, width: float = 84.0, title: str = "", unit: SpeedUnit = METRES, limit: float = 10.0
) -> Figure:
    """Return the eigenvalues of one design, modes in colour, real parts solid and imaginary parts dashed.

    Parameters
    ----------
    drawn : Drawn
    width : float
        In mm.
    title : str
        Empty for none.
    unit : SpeedUnit
    limit : float
        The vertical axis runs from -limit to limit, in 1/s.
    """
    with style():
        figure = new_figure(width * MILLIMETRES, max(0.72 * width, 62.0) * MILLIMETRES)
        axes = figure.add_subplot()
        set_title(axes, title)
        wordless = draw_eigenvalues(axes, drawn.modes, drawn.critical, limit, unit)
        if wordless:
            names = drawn.modes.names
            add_legend(figure, wordless, [{"color": colour_of(name, names), "lw": 1.6} for name in wordless], width)
        if drawn.uncertainty is not None:
            add_bands(axes, drawn.uncertainty, unit=unit)
    return figure


def overlay_figure(
    designs: Sequence[Drawn],
    width: float = 84.0,
    title: str = "",
    unit: SpeedUnit = METRES,
    limit: float = 10.0,
    scale: tuple[str, Sequence[float]] | None = None,
) -> Figure:
    """Return real parts of the eigenvalues of several designs over the speed, and imaginary parts below.

    Parameters
    ----------
    designs : sequence of Drawn
        All at the same speeds.
    width : float
        In mm.
    title : str
        Empty for none.
    unit : SpeedUnit
    limit : float
        Real parts are shown from -limit to limit, imaginary parts to limit, in 1/s.
    scale : (label, values), optional
        Of a family: its parameter, with its unit, and the value of each design; then colours follow the values.
    """
    with style():
        figure = new_figure(width * MILLIMETRES, 1.25 * width * MILLIMETRES)
        real, imaginary = figure.subplots(2, 1, sharex=True, gridspec_kw={"height_ratios": [1.5, 1.0]})
        set_title(real, title)
        lines = _lines(designs, scale)
        real.axhline(0.0, color="black", lw=0.6, zorder=1)
        for design, look in zip(designs, lines, strict=True):
            _draw(real, imaginary, design, look, unit)
        speeds = designs[0].modes.speeds * unit.factor
        real.set(xlim=(speeds[0], speeds[-1]), ylim=(-limit, limit), ylabel="Re λ (1/s)")
        imaginary.set(ylim=(0, limit), ylabel="Im λ (1/s)", xlabel=f"forward speed v ({unit.name})")
        if scale is not None and len(designs) > _MOST_DASHED:
            add_scale(figure, [real, imaginary], *scale)
        else:
            add_legend(figure, [design.label for design in designs], lines, width)
    return figure


def set_title(axes: Axes, title: str) -> None:
    """Write a title above axes, in as many lines as it takes; nothing if it is empty.

    Parameters
    ----------
    axes : matplotlib Axes
    title : str
    """
    if title:
        axes.set_title(title, loc="left", fontsize=9, wrap=True)


def _lines(designs: Sequence[Drawn], scale: tuple[str, Sequence[float]] | None) -> list[dict[str, Any]]:
    if len(designs) <= _MOST_DASHED:
        return [{"color": colour, "ls": dashes, "lw": 1.3} for colour, dashes in LINES[: len(designs)]]
    values = np.asarray(scale[1] if scale else range(len(designs)), dtype=float)
    return [{"color": colour, "ls": "-", "lw": 1.1} for colour in scale_colours(values)]


def scale_colours(values: np.ndarray) -> Any:
    """Return colours (m, 4) of values (m,): from dark to light in grey too, and never too light to be seen.

    Parameters
    ----------
    values : array, shape (m,)
    """
    from matplotlib import colormaps  # lazy: heavy

    spread = float(np.ptp(values)) or 1.0
    return colormaps["cividis"](0.85 * (values - values.min()) / spread)


def add_scale(figure: Figure, axes: Any, label: str, values: Sequence[float]) -> None:
    """Draw a scale of colours for the values of a family beside axes.

    Parameters
    ----------
    figure : matplotlib Figure
    axes : Axes or list of Axes
    label : str
        The parameter and its unit.
    values : sequence of float
    """
    from matplotlib.cm import ScalarMappable  # lazy: heavy
    from matplotlib.colors import BoundaryNorm, ListedColormap

    numbers = np.sort(np.asarray(values, dtype=float))
    middle = (numbers[1:] + numbers[:-1]) / 2
    bounds = [2 * numbers[0] - middle[0], *middle, 2 * numbers[-1] - middle[-1]]
    mappable = ScalarMappable(BoundaryNorm(bounds, len(numbers)), ListedColormap(scale_colours(numbers)))
    every = max(1, -(-len(numbers) // 9))
    bar = figure.colorbar(mappable, ax=axes, label=label, spacing="proportional", aspect=40, ticks=numbers[::every])
    bar.ax.minorticks_off()
    bar.ax.set_yticklabels([f"{number:.4g}" for number in numbers[::every]])


def add_legend(figure: Figure, labels: Sequence[str], lines: Sequence[dict[str, Any]], width: float) -> None:
    """Write a legend above everything, in as few rows as the width allows.

    Parameters
    ----------
    figure : matplotlib Figure
    labels : sequence of str
    lines : sequence of dict
        How each line is drawn.
    width : float
        Of the figure, in mm.
    """
    from matplotlib.lines import Line2D  # lazy: heavy

    handles = [Line2D([], [], **look) for look in lines]
    longest = 1.6 * max(map(len, labels)) + 14  # mm: letters of 8 points, and the line before them
    columns = int(np.clip(width // longest, 1, len(labels)))
    figure.legend(handles, labels, loc="outside upper left", ncols=columns, frameon=False, fontsize=8, handlelength=3)


def _draw(real: Axes, imaginary: Axes, design: Drawn, look: dict[str, Any], unit: SpeedUnit) -> None:
    v, roots = design.modes.speeds * unit.factor, design.modes.eigenvalues
    for column in range(roots.shape[-1]):
        # The lower root of a pair lies on the upper one: drawn twice, dashes would fill each other's gaps.
        real.plot(v, np.where(roots[:, column].imag < 0, np.nan, broken(roots, column)), **look)
        upper = np.where(roots[:, column].imag > 0, roots[:, column].imag, np.nan)
        if np.isfinite(upper).any():
            imaginary.plot(v, upper, **look)
    if design.uncertainty is not None:
        colours = dict.fromkeys(design.modes.names, look["color"])
        add_bands(real, design.uncertainty, parts=["real"], colours=colours, unit=unit)
        add_bands(imaginary, design.uncertainty, parts=["imaginary"], colours=colours, unit=unit)
