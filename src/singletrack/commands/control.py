"""``singletrack control``."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import numpy as np
import typer

from singletrack.commands.figures import check_figure, deliver_figure
from singletrack.commands.model import model_from
from singletrack.commands.model_options import ModelOptions
from singletrack.commands.options import BicycleArgument, JsonOption, SpeedsOption
from singletrack.commands.printing import print_json, show
from singletrack.control import control_summary
from singletrack.files.speeds import parse_speeds
from singletrack.present.control import angles_figure, control_tables, locus_figure

__all__ = ["run"]

#: Speeds of a root locus, so many that its dots join.
_LOCUS = 600


def run(
    bicycle: BicycleArgument,
    options: ModelOptions,
    speeds: SpeedsOption = "0.5:10:20",
    inputs: Annotated[
        list[str] | None,
        typer.Option("--input", metavar="NAME", help="An input, such as 'steer torque'; by default all."),
    ] = None,
    plot: Annotated[Path | None, typer.Option(metavar="FILE", help="Draw the angles here: .png, .svg or .pdf.")] = None,
    locus: Annotated[
        Path | None, typer.Option(metavar="FILE", help="Draw the eigenvalues' way over speed here: .png, .svg or .pdf.")
    ] = None,
    json: JsonOption = False,
) -> None:
    """Print where inputs lose modes, how well they reach them, and what riding costs."""
    values = parse_speeds(speeds)
    for file in (plot, locus):
        if file is not None:
            check_figure(file)
    made = model_from(bicycle, options)
    found = control_summary(made.model, values, inputs)
    if json:
        print_json(found.to_dict())
    else:
        show(control_tables(found, made.title))
    if plot is not None:
        deliver_figure(angles_figure(found, made.title), plot)
    if locus is not None:
        dense = np.linspace(values.min(), values.max(), _LOCUS)
        figure = locus_figure(dense, made.model.modes(dense).eigenvalues, made.title)
        deliver_figure(figure, locus)
