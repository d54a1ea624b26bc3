"""Measured eigenvalues on computed curves, as in Figure 7 of Kooijman, Schwab and Meijaard (2008)."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from singletrack.present.eigenvalues import draw_eigenvalues
from singletrack.present.labels import Curve
from singletrack.present.style import new_figure, style

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from singletrack.library.measured import MeasuredModes
    from singletrack.linear import CriticalSpeeds, Modes

__all__ = ["measured_figure"]


#: Points of a bar that labels keep away from.
_ALONG = 5


def measured_figure(modes: Modes, critical: CriticalSpeeds, runs: MeasuredModes, title: str) -> Figure:
    """Return a figure of computed eigenvalues with one bar a run, as wide as the range of its speeds.

    Parameters
    ----------
    modes : Modes
        Of a single design, at ascending speeds.
    critical : CriticalSpeeds
    runs : MeasuredModes
    title : str
    """
    with style():
        figure = new_figure(6.4, 4.6)
        axes = figure.add_subplot()
        axes.set_title(title, loc="left", fontsize=10)
        middle = (runs.lowest_speeds + runs.highest_speeds) / 2
        reach = np.stack([middle - runs.lowest_speeds, runs.highest_speeds - middle])
        marks = [(runs.eigenvalues.real, "o", "measured Re weave"), (runs.eigenvalues.imag, "D", "measured Im weave")]
        for values, marker, label in marks:
            axes.errorbar(
                *(middle, values), xerr=reach, fmt=marker, ms=2.6, lw=0.7, color="#222222", label=label, zorder=4
            )
        along = np.linspace(runs.lowest_speeds, runs.highest_speeds, _ALONG)
        bars = [
            Curve(along.ravel(), np.broadcast_to(values, along.shape).ravel(), "", "#222222") for values, *_ in marks
        ]
        draw_eigenvalues(axes, modes, critical, beside=bars)
        axes.legend(loc="upper left", frameon=False, fontsize=8)
    return figure
