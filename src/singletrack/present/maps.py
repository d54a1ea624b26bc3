"""Figures with a parameter along an axis: eigenvalues over it, and the map of speed and parameter."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from singletrack.present.labels import Curve, label_curves
from singletrack.present.plotting import MILLIMETRES, set_title
from singletrack.present.style import COLOURS, colour_of, new_figure, style
from singletrack.present.words import METRES, SpeedUnit

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from singletrack.analysis.family import StabilityMap
    from singletrack.linear import Modes

__all__ = ["map_figure", "parameter_figure"]


def parameter_figure(
    values: np.ndarray, modes: Modes, label: str, width: float = 84.0, title: str = "", limit: float = 10.0
) -> Figure:
    """Return the eigenvalues at one speed over a parameter.

    Parameters
    ----------
    values : array, shape (m,)
        Of the parameter, as the axis shows them, in the units of its label.
    modes : Modes
        Of the m designs at one speed; eigenvalues of shape (m, 1, 2 n).
    label : str
        The parameter and its unit.
    width : float
        In mm.
    title : str
        Empty for none.
    limit : float
        The vertical axis runs from -limit to limit, in 1/s.
    """
    with style():
        figure = new_figure(width * MILLIMETRES, max(0.72 * width, 62.0) * MILLIMETRES)
        axes = figure.add_subplot()
        set_title(axes, title)
        axes.set(xlim=(values.min(), values.max()), ylim=(-limit, limit), xlabel=label)
        axes.set_ylabel("Re λ solid, Im λ dashed (1/s)")
        axes.axhline(0.0, color="black", lw=0.8, zorder=1)
        roots, curves = modes.eigenvalues[:, 0, :], []
        for column, name in enumerate(modes.names):
            colour = colour_of(name, modes.names)
            twin = column > 0 and modes.names[column - 1] == name
            upper = np.where(roots[:, column].imag > 0, roots[:, column].imag, np.nan)
            axes.plot(values, roots[:, column].real, color=colour)
            axes.plot(values, upper, color=colour, ls=(0, (4, 2)))
            curves.append(Curve(values, roots[:, column].real, "" if twin else f"Re {name}", colour))
            curves.append(Curve(values, upper, "" if twin else f"Im {name}", colour))
        label_curves(axes, [*curves, Curve(values, 0.0 * values, "", "black")], [])
    return figure


def map_figure(
    found: StabilityMap,
    factor: float,
    label: str,
    top: float,
    width: float = 84.0,
    title: str = "",
    unit: SpeedUnit = METRES,
) -> Figure:
    """Return the map of speed and parameter: where all modes are stable, and the critical speeds.

    Parameters
    ----------
    found : StabilityMap
    factor : float
        What its values are multiplied with for the axis: units of the label in one of SI.
    label : str
        The parameter and its unit.
    top : float
        The highest speed shown, in m/s.
    width : float
        In mm.
    title : str
        Empty for none.
    unit : SpeedUnit
    """
    values, critical, names = found.values * factor, found.critical, []
    with style():
        figure = new_figure(width * MILLIMETRES, max(0.72 * width, 62.0) * MILLIMETRES)
        axes = figure.add_subplot()
        set_title(axes, title)
        axes.set(xlim=(0.0, top * unit.factor), ylim=(values.min(), values.max()))
        axes.set(xlabel=f"forward speed v ({unit.name})", ylabel=label)
        ranges = np.minimum(critical.ranges, 2 * top) * unit.factor
        stable = _shade(axes, values, ranges, min(top, 2 * top) * unit.factor)
        curves = []
        for kind, speeds, modes in (
            ("weave", critical.weave_speeds, critical.weave_modes),
            ("capsize", critical.capsize_speeds, critical.capsize_modes),
        ):
            dashes = "-" if kind == "weave" else (0, (5, 1.5))
            pieces = _branches(speeds * unit.factor, values, modes)
            for x, y, mode in pieces:
                names.append(mode)
                colour = colour_of(mode, names)
                axes.plot(x, y, color=colour, ls=dashes)
                shown = np.where(x <= top * unit.factor, x, np.nan)
                longest = max((other for *other, name in pieces if name == mode), key=lambda one: len(one[0]))
                word = f"{mode} speed" if longest[0] is x else ""
                curves.append(Curve(shown, y, word, colour))
        label_curves(axes, [*curves, *stable], [])
    return figure


def _branches(speeds: np.ndarray, values: np.ndarray, modes: np.ndarray) -> list[tuple[np.ndarray, np.ndarray, str]]:
    """Return critical speeds (m, k) as curves (x, y, mode), in pieces with the same number of speeds.

    Where two speeds meet and cease to exist, their curves are joined: the fold is one curve.
    """
    curves: list[tuple[np.ndarray, np.ndarray, str]] = []
    count = np.isfinite(speeds).sum(axis=-1)
    breaks = np.flatnonzero(count[1:] != count[:-1]) + 1
    for rows in np.split(np.arange(len(values)), breaks):
        n = count[rows[0]]
        ends = [row for row in (rows[0], rows[-1]) if n >= 2 and len(rows) > 1]
        joined = [row for row in ends if 0 < row < len(values) - 1]
        for k in range(n):
            x, y = speeds[rows, k], values[rows]
            for row in joined:
                other = (k ^ 1) if (k ^ 1) < n else k
                meets = abs(speeds[row, k] - speeds[row, other]) < 0.02 * speeds[row, k] and other > k
                if meets:
                    middle = (speeds[row, k] + speeds[row, other]) / 2
                    at_end = row == rows[-1]
                    x = np.append(x, middle) if at_end else np.insert(x, 0, middle)
                    y = np.append(y, values[row]) if at_end else np.insert(y, 0, values[row])
            curves.append((x, y, str(modes[rows[0], k])))
    return curves


def _shade(axes: Axes, values: np.ndarray, ranges: np.ndarray, top: float) -> list[Curve]:
    """Shade the stable ranges (m, k, 2); return where the word may stand."""
    places = []
    for k in range(ranges.shape[1]):
        low, high = ranges[:, k, 0], ranges[:, k, 1]
        axes.fill_betweenx(values, low, high, where=np.isfinite(low), color=COLOURS["stable"], lw=0, zorder=0)
        shown = np.minimum(high, top)
        wide = np.isfinite(low) & (shown - low > 0.15 * top)
        places.append(np.stack([np.where(wide, (low + shown) / 2, np.nan), values]))
    x, y = np.concatenate(places, axis=1)
    if not np.isfinite(x).any():
        return []
    return [Curve(x, y, "stable", "#3B7A32", on_points=True)]
