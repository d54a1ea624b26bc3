"""What inputs do to outputs, over frequency: tables to read, and Bode figures."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from rich.console import Group
from rich.table import Table

from singletrack.present.style import new_figure, style

if TYPE_CHECKING:
    import xarray
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from singletrack.linear import StateSpace

__all__ = ["bode_figure", "seen_tables"]

_SHADES = "viridis"
_MOST_LABELS = 8


def seen_tables(system: StateSpace, amplitudes: xarray.DataArray, title: str) -> Group:
    """Return what inputs do to outputs at once, and the amplitudes at one frequency over speed.

    Parameters
    ----------
    system : StateSpace
        Of a single design at several speeds.
    amplitudes : DataArray
        Per unit of the inputs: speed, frequency (one), output, input.
    title : str
        Above the tables.
    """
    at_once = Table(title=f"{title}: at once, per unit of input (SI)", title_justify="left", title_style="bold")
    at_once.add_column("output")
    for name in system.inputs:
        at_once.add_column(name, justify="right")
    for output, row in zip(system.outputs, system.D[0], strict=True):
        at_once.add_row(output, *(f"{value:.4g}" for value in row))
    frequency = float(amplitudes.frequency[0]) / (2 * np.pi)
    return Group(at_once, *(_over_speed(amplitudes.sel(input=name)[:, 0], name, frequency) for name in system.inputs))


def _over_speed(amplitudes: xarray.DataArray, name: str, frequency: float) -> Table:
    heading = f"amplitude at {frequency:g} Hz, per unit of {name} (SI)"
    table = Table(title=heading, title_justify="left", title_style="bold")
    for column in ("v (m/s)", *amplitudes.output.values):
        table.add_column(str(column), justify="right")
    for speed, row in zip(amplitudes.speed.values, amplitudes.values, strict=True):
        table.add_row(f"{speed:.2f}", *(f"{value:.4g}" for value in row))
    return table


def bode_figure(found: xarray.DataArray, title: str) -> Figure:
    """Return magnitude and phase over frequency, a column for each input, a line for each speed.

    Parameters
    ----------
    found : DataArray
        Complex: speed, frequency (rad/s), output, input.
    title : str
        Of the figure.
    """
    outputs, inputs = found.output.values, found.input.values
    with style():
        from matplotlib import colormaps  # lazy: heavy
        from matplotlib.cm import ScalarMappable
        from matplotlib.colors import Normalize

        figure = new_figure(1.2 + 2.9 * len(inputs), 0.7 + 2.9 * len(outputs))
        figure.suptitle(title, x=0.01, ha="left", fontsize=10)
        axes = figure.subplots(2 * len(outputs), len(inputs), sharex=True, sharey="row", squeeze=False)
        shades = colormaps[_SHADES](np.linspace(0.0, 0.9, len(found.speed)))
        for i, output in enumerate(outputs):
            for j, name in enumerate(inputs):
                _draw(axes[2 * i, j], axes[2 * i + 1, j], found.sel(output=output, input=name), shades)
            axes[2 * i, 0].set_ylabel(f"{output}\nmagnitude (SI)")
            axes[2 * i + 1, 0].set_ylabel("phase (deg)")
        for j, name in enumerate(inputs):
            axes[0, j].set_title(f"per unit of {name}", loc="left", fontsize=9)
            axes[-1, j].set_xlabel("frequency (Hz)")
        if len(found.speed) <= _MOST_LABELS:
            lines, labels = axes[0, 0].get_legend_handles_labels()
            figure.legend(lines, labels, frameon=False, fontsize=8, loc="outside lower center", ncols=4)
        else:
            scale = ScalarMappable(Normalize(float(found.speed.min()), float(found.speed.max())), _SHADES)
            figure.colorbar(scale, ax=axes, label="forward speed v (m/s)")
    return figure


def _draw(magnitude: Axes, phase: Axes, found: xarray.DataArray, shades: np.ndarray) -> None:
    hertz = found.frequency.values / (2 * np.pi)
    for shade, speed in zip(shades, found.speed.values, strict=True):
        values = found.sel(speed=speed).values
        magnitude.loglog(hertz, np.abs(values), color=shade, lw=1.2, label=f"{float(speed):g} m/s")
        phase.semilogx(hertz, np.degrees(np.unwrap(np.angle(values))), color=shade, lw=1.2)
