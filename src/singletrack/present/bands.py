"""Bands of uncertainty around the eigenvalues, on a figure that exists."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from singletrack.present.style import COLOURS, colour_of
from singletrack.present.words import METRES, SpeedUnit

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from singletrack.analysis.uncertainty import EigenvalueUncertainty

__all__ = ["add_bands"]


def add_bands(
    ax: Any,
    result: EigenvalueUncertainty,
    *,
    parts: Sequence[str] = ("real", "imaginary"),
    colours: Mapping[str, Any] | None = None,
    alpha: float = 0.25,
    unit: SpeedUnit = METRES,
) -> list[Any]:
    """Draw the central 95 % of the eigenvalues as bands over the speed.

    Parameters
    ----------
    ax : matplotlib Axes
        With the speed across and the real or imaginary parts in 1/s up; its limits are left as they are.
    result : EigenvalueUncertainty
    parts : sequence of {"real", "imaginary"}
        Imaginary parts are drawn where the design oscillates, the positive ones only.
    colours : mapping of "weave", "capsize", "castering" to a colour, optional
    alpha : float
        Opacity.
    unit : SpeedUnit
        Of the speed across.

    Returns
    -------
    list of matplotlib artists

    Examples
    --------
    >>> from dataclasses import replace
    >>> import matplotlib.figure, numpy as np
    >>> from singletrack import load_bicycle
    >>> from singletrack.analysis.uncertainty import eigenvalue_uncertainty
    >>> bicycle = replace(load_bicycle("stratos"), standard_deviations={"trail": 0.0016})
    >>> ax = matplotlib.figure.Figure().subplots()
    >>> len(add_bands(ax, eigenvalue_uncertainty(bicycle, speeds=np.linspace(5, 10, 11))))
    4
    """
    names = result.names
    palette = {**{mode: colour_of(mode, names) for mode in names}, **COLOURS, **(colours or {})}
    drawn, speeds = [], result.speeds * unit.factor
    limits = ax.get_xlim(), ax.get_ylim(), ax.get_autoscale_on()
    for column, mode in enumerate(names):
        twin = column > 0 and names[column - 1] == mode
        style = {"color": palette[mode], "alpha": alpha, "linewidth": 0}
        oscillates = result.eigenvalues[:, column].imag != 0
        if "real" in parts:
            # The two roots of an oscillation share their real part: one band, not one on top of another.
            where = ~oscillates if twin else np.ones_like(oscillates)
            if where.any():
                drawn.append(ax.fill_between(speeds, *result.real_interval[:, :, column], where=where, **style))
        upper = result.eigenvalues[:, column].imag > 0
        if "imaginary" in parts and upper.any():
            low, high = result.imaginary_interval[:, :, column]
            drawn.append(ax.fill_between(speeds, low, high, where=upper, **style))
    if not limits[2]:
        ax.set_xlim(limits[0])
        ax.set_ylim(limits[1])
    return drawn
