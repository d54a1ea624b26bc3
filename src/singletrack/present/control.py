"""Controllability and effort, for reading and as figures."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from rich.console import Group
from rich.table import Table

from singletrack.present.style import COLOURS, new_figure, style

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from singletrack.control import ControlSummary, Effort

__all__ = ["angles_figure", "control_tables", "effort_figure"]


def control_tables(found: ControlSummary, title: str) -> Group:
    """Return what the inputs of a model can do, for reading.

    Parameters
    ----------
    found : ControlSummary
        What was computed.
    title : str
        Above the first table.
    """
    lost = Table(title=f"{title}: where an input loses a mode", title_justify="left", title_style="bold")
    for heading in ("input", "speed (m/s)", "eigenvalue (1/s)", "mode"):
        lost.add_column(heading, justify="right" if "(" in heading else "left")
    for one in found.uncontrollable:
        imaginary = f" {one.eigenvalue.imag:+.4f}i" if one.eigenvalue.imag else ""
        lost.add_row(one.input, f"{one.speed:.4f}", f"{one.eigenvalue.real:.4f}{imaginary}", one.mode)
    parts = [lost if found.uncontrollable else f"{title}: no input loses a mode at any speed above zero"]
    parts.extend(_one_input(found, name) for name in found.inputs)
    parts.append(
        "angles in deg between mode and input: 90 is out of reach; least energy and largest torque after a push to "
        "0.1 rad/s of lean"
    )
    return Group(*parts)


def _one_input(found: ControlSummary, name: str) -> Table:
    table = Table(title=f"by {name}", title_justify="left", title_style="bold")
    for heading in ("v (m/s)", *found.modes, "least energy (N²m²s)", "largest torque (N m)"):
        table.add_column(heading, justify="right")
    effort, angles = found.efforts[name], np.degrees(found.angles[name])
    for k, speed in enumerate(found.speeds):
        energy, torque = effort.least_energy[k], effort.largest_torque[k]
        row = [f"{speed:.2f}", *(f"{angle:.1f}" for angle in angles[k])]
        table.add_row(*row, *("cannot" if not np.isfinite(x) else f"{x:.3g}" for x in (energy, torque)))
    return table


def angles_figure(found: ControlSummary, title: str) -> Figure:
    """Return modal controllability over speed, axes for each input, as in figures 7 and 8 of the journal paper.

    Parameters
    ----------
    found : ControlSummary
        What was computed.
    title : str
        Of the figure.
    """
    with style():
        figure = new_figure(3.4 * len(found.inputs), 3.2)
        figure.suptitle(title, x=0.01, ha="left", fontsize=10)
        all_axes = figure.subplots(1, len(found.inputs), sharey=True, squeeze=False)[0]
        for axes, name in zip(all_axes, found.inputs, strict=True):
            _draw_angles(axes, found, name)
        all_axes[0].set_ylabel("angle of mode and input (deg)")
        all_axes[-1].legend(frameon=False, fontsize=7.5, loc="upper left", bbox_to_anchor=(1.0, 1.0))
    return figure


def _draw_angles(axes: Axes, found: ControlSummary, name: str) -> None:
    axes.set_title(name, loc="left", fontsize=9)
    axes.set_xlabel("forward speed v (m/s)")
    axes.set_xlim(float(found.speeds[0]), float(found.speeds[-1]))
    least = min(float(np.degrees(angles).min()) for angles in found.angles.values())
    axes.set_ylim(10 * np.floor(least / 10), 92)
    axes.axhline(90, color="black", lw=0.8, ls=":")
    seen: dict[str, int] = {}
    for column, mode in enumerate(found.modes):
        seen[mode] = seen.get(mode, 0) + 1
        several = found.modes.count(mode) > 1
        label = f"{mode} {seen[mode]}" if several else mode
        line = ("-", "--", ":")[min(seen[mode] - 1, 2)]
        axes.plot(
            found.speeds, np.degrees(found.angles[name][:, column]), line, color=_colour(mode), lw=1.3, label=label
        )


def _colour(mode: str) -> str:
    return COLOURS.get(mode, COLOURS["front"])


def effort_figure(efforts: dict[str, Effort], title: str) -> Figure:
    """Return least energy and largest torque over speed, one curve for each label, where the input can do it.

    Parameters
    ----------
    efforts : dict
        What was computed, by label.
    title : str
        Of the figure.
    """
    with style():
        figure = new_figure(7.0, 3.2)
        figure.suptitle(title, x=0.01, ha="left", fontsize=10)
        energy, torque = figure.subplots(1, 2)
        for k, (label, found) in enumerate(efforts.items()):
            colour, line = list(COLOURS.values())[k % 3], ("-", "--", ":")[k // 3 % 3]
            for axes, values in ((energy, found.least_energy), (torque, found.largest_torque)):
                shown = np.where(np.isfinite(values) & (values > 0), values, np.nan)
                axes.semilogy(found.speeds, shown, color=colour, ls=line, lw=1.4, label=label)
        energy.set_ylabel("least energy after a push (N² m² s)")
        torque.set_ylabel("largest torque after a push (N m)")
        for axes in (energy, torque):
            axes.set_xlabel("forward speed v (m/s)")
        torque.legend(frameon=False, fontsize=7.5, loc="upper left", bbox_to_anchor=(1.0, 1.0))
    return figure
