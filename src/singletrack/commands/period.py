"""``singletrack period``."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from singletrack.commands.figures import check_figure, deliver_figure
from singletrack.commands.printing import show
from singletrack.errors import InputError
from singletrack.files.signals import read_signal
from singletrack.files.source import read_text
from singletrack.measuring.oscillation import fit_oscillation
from singletrack.present.oscillation import oscillation_figure

__all__ = ["run"]


def run(
    file: Annotated[Path, typer.Argument(metavar="FILE", help="Two columns: time in s, signal.")],
    plot: Annotated[Path | None, typer.Option(help="Draw signal and fit here: .png, .svg or .pdf.")] = None,
) -> None:
    """Fit a decaying oscillation to a recorded signal and print its period with its standard deviation."""
    if plot is not None:
        check_figure(plot)
    if not file.exists():
        raise InputError(f"{file}: there is no such file")
    fit = fit_oscillation(*read_signal(read_text(file), str(file)), str(file))
    show(f"period: {fit.period:.9g} ± {fit.period_deviation:.2g} s")
    show(f"without damping: {fit.natural_period:.9g} s")
    show(f"decay: {fit.decay:.4g} ± {fit.decay_deviation:.2g} 1/s")
    show(f"for the measurements' file: {fit.natural_period!r}+/-{fit.period_deviation!r}")
    if plot is not None:
        figure = oscillation_figure(fit, file.stem)
        deliver_figure(figure, plot)
