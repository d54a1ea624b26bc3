"""``singletrack coefficients``."""

from __future__ import annotations

import json as jsonlib
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from singletrack.commands.model import model_from
from singletrack.commands.model_options import ModelOptions
from singletrack.commands.options import BicycleArgument, JsonOption
from singletrack.commands.printing import deliver, print_json, show
from singletrack.errors import InputError
from singletrack.output import check_writable
from singletrack.present.latex import latex_table
from singletrack.present.model_files import model_csv, model_mat
from singletrack.present.tables import coefficients_table

if TYPE_CHECKING:
    from singletrack.commands.model import Made

__all__ = ["run"]

_FILES = (".mat", ".csv", ".json", ".tex")


def run(
    bicycle: BicycleArgument,
    options: ModelOptions,
    output: Annotated[
        Path | None,
        typer.Option("--output", "-o", metavar="FILE", help="Write here: .mat, .csv, .json or .tex."),
    ] = None,
    json: JsonOption = False,
) -> None:
    """Print the coefficient matrices."""
    if output is not None:
        if output.suffix.lower() not in _FILES:
            raise InputError(f"{output}: unknown suffix {output.suffix!r}, must be one of {', '.join(_FILES)}")
        check_writable(output)
    made = model_from(bicycle, options)
    if output is not None:
        deliver(_content(made, output.suffix.lower()), output)
    elif json:
        print_json(made.model.to_dict())
    else:
        show(coefficients_table(made.model, made.title))


def _content(made: Made, suffix: str) -> str | bytes:
    if suffix == ".mat":
        return model_mat(made.model)
    if suffix == ".csv":
        return model_csv(made.model)
    if suffix == ".tex":
        return latex_table(made.model, made.asked.critical_speeds(), made.title)
    return jsonlib.dumps(made.model.to_dict(), indent=1) + "\n"
