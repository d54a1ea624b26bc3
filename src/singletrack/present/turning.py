"""Steady turns for reading, and how stability goes over the lean angle as a figure."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from singletrack.present.style import COLOURS, new_figure, style
from singletrack.present.tables import format_root

if TYPE_CHECKING:
    from collections.abc import Sequence

    from matplotlib.figure import Figure

    from singletrack.arrays import Array

__all__ = ["turn_figure", "turn_text"]


def turn_text(
    quantities: Sequence[tuple[str, float, str]],
    forces: Sequence[tuple[str, Array]],
    roots: Sequence[tuple[str, complex]],
) -> str:
    """Return a turn for reading.

    Parameters
    ----------
    quantities
        What, value, unit, in the order of the lines.
    forces
        Whose, and its components, shape (3,), N.
    roots
        Names of the modes and their eigenvalues, 1/s, each a scalar.
    """
    lines = [f"{what + ':':<22}{value + 0.0:10.4g} {unit}".rstrip() for what, value, unit in quantities]
    lines += [
        f"{whose + ':':<22}" + " ".join(f"{round(float(part), 1) + 0.0:9.1f}" for part in force) + " N"
        for whose, force in forces
    ]
    lines.append("eigenvalues in 1/s:")
    lines += [f"  {name:<20}{format_root(value)}" for name, value in roots]
    return "\n".join(lines)


def turn_figure(lean: Array, names: Sequence[str], roots: Array, title: str, end: str) -> Figure:
    """Return a figure of the eigenvalues over the lean angle.

    Parameters
    ----------
    lean : array, shape (k,)
        In deg.
    names : sequence of str
        The n modes; one colour each.
    roots : complex array, shape (k, n)
        In 1/s.
    title, end : str
        What it is, and why the turns end.
    """
    with style():
        figure = new_figure(6.4, 4.2)
        axes = figure.add_subplot()
        axes.set_title(f"{title}\nends: {end}", loc="left", fontsize=10)
        axes.axhline(0.0, color="black", lw=0.8)
        for name in dict.fromkeys(names):
            columns = [i for i, other in enumerate(names) if other == name]
            colour = COLOURS.get(name, COLOURS["frame"])
            for place, i in enumerate(columns):
                axes.plot(lean, roots[:, i].real, color=colour, label=name if place == 0 else None)
                frequency = np.where(roots[:, i].imag > 0.0, roots[:, i].imag, np.nan)
                axes.plot(lean, frequency, color=colour, ls=(0, (4, 2)))
        axes.set_ylim(*_limits(roots))
        axes.set_xlabel("lean (deg)")
        axes.set_ylabel("eigenvalues: Re λ solid, Im λ dashed (1/s)")
        axes.legend(frameon=False, fontsize=8)
    return figure


def _limits(roots: Array) -> tuple[float, float]:
    """Return limits in which the slow modes can be seen; the fastest decay may leave them."""
    low, high = np.percentile(roots.real, 15), np.percentile(roots.imag, 95)
    return min(-2.0, float(low)) - 1.0, max(2.0, float(high)) + 1.0
