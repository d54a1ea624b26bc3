"""``singletrack control``."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from singletrack.commands.model import model_from
from singletrack.commands.model_options import ModelOptions
from singletrack.commands.options import BicycleArgument, JsonOption, SpeedsOption
from singletrack.commands.printing import deliver, print_json, show
from singletrack.control import control_summary
from singletrack.errors import InputError
from singletrack.files.speeds import parse_speeds
from singletrack.output import check_writable
from singletrack.present.control import angles_figure, control_tables
from singletrack.present.style import figure_bytes

__all__ = ["run"]

_FIGURES = (".png", ".svg", ".pdf")


def run(
    bicycle: BicycleArgument,
    options: ModelOptions,
    speeds: SpeedsOption = "0.5:10:20",
    inputs: Annotated[
        list[str] | None,
        typer.Option("--input", metavar="NAME", help="An input, such as 'steer torque'; by default all."),
    ] = None,
    plot: Annotated[Path | None, typer.Option(metavar="FILE", help="Draw the angles here: .png, .svg or .pdf.")] = None,
    json: JsonOption = False,
) -> None:
    """Print where inputs lose modes, how well they reach them, and what riding costs."""
    values = parse_speeds(speeds)
    if plot is not None:
        if plot.suffix.lower() not in _FIGURES:
            raise InputError(f"{plot}: unknown suffix {plot.suffix!r}, must be one of {', '.join(_FIGURES)}")
        check_writable(plot)
    made = model_from(bicycle, options)
    found = control_summary(made.model, values, inputs)
    if json:
        print_json(found.to_dict())
    else:
        show(control_tables(found, made.title))
    if plot is not None:
        deliver(figure_bytes(angles_figure(found, made.title), plot.suffix.lower().removeprefix(".")), plot)
