"""The figure of a fitted oscillation: signal, fit and what is left."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from singletrack.present.style import COLOURS, new_figure, style

if TYPE_CHECKING:
    from singletrack.measuring.oscillation import Oscillation

__all__ = ["oscillation_figure"]


def oscillation_figure(fit: Oscillation, title: str = "") -> Any:
    """Return a matplotlib Figure with the signal, the fitted oscillation and the residuals.

    Parameters
    ----------
    fit : Oscillation
        What was fitted, with the signal.
    title : str
        Of the figure; none if empty.

    Examples
    --------
    >>> import numpy as np
    >>> from singletrack.measuring.oscillation import fit_oscillation
    >>> t = np.linspace(0, 10, 500)
    >>> len(oscillation_figure(fit_oscillation(t, np.exp(-0.1 * t) * np.cos(4 * t) + 1e-3 * np.sin(50 * t))).axes)
    2
    """
    with style():
        return _drawn(fit, title)


def _drawn(fit: Oscillation, title: str) -> Any:
    figure = new_figure(8.0, 5.0)
    top, bottom = figure.subplots(2, 1, sharex=True, height_ratios=[3, 1])
    fine = np.linspace(fit.time[0], fit.time[-1], 20 * len(fit.time) if len(fit.time) < 500 else 2 * len(fit.time))
    top.plot(fit.time, fit.signal, ".", markersize=2, color="0.5", label="signal")
    top.plot(fine, fit.at(fine), color=COLOURS["weave"], linewidth=1, label="fit")
    top.set_ylabel("signal")
    top.legend(loc="upper right")
    top.set_title(f"{title + ': ' if title else ''}period {fit.period:.6g} s ± {fit.period_deviation:.1g} s")
    bottom.plot(fit.time, fit.signal - fit.at(fit.time), ".", markersize=2, color="0.3")
    bottom.set_xlabel("time in s")
    bottom.set_ylabel("left over")
    return figure
