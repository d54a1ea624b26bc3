"""``singletrack control``."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import numpy as np
import typer

from singletrack.commands.figures import check_figure, deliver_figure
from singletrack.commands.model import Made, model_from
from singletrack.commands.model_options import ModelOptions
from singletrack.commands.options import BicycleArgument, JsonOption, SpeedsOption
from singletrack.commands.printing import print_json, show
from singletrack.control import ControlSummary, control_summary, frequency_response, save_mat
from singletrack.errors import InputError
from singletrack.files.speeds import parse_speeds
from singletrack.linear import StateSpace
from singletrack.output import check_writable
from singletrack.present.bode import bode_figure, seen_tables
from singletrack.present.control import angles_figure, control_tables, locus_figure

if TYPE_CHECKING:
    from collections.abc import Callable

    from matplotlib.figure import Figure

__all__ = ["run"]

#: Speeds of a root locus, so many that its dots join.
_LOCUS = 600
#: Frequencies of a Bode figure, rad/s, and how many outputs it takes.
_BODE = 2 * np.pi * np.logspace(-2, 1.5, 400)
_MOST_OUTPUTS = 6


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
    outputs: Annotated[
        list[str] | None,
        typer.Option(
            "--output",
            metavar="NAME",
            help="See what inputs do to it: 'lean acceleration', 'right elbow', 'right hand force y', ...",
        ),
    ] = None,
    bode: Annotated[
        Path | None, typer.Option(metavar="FILE", help="Draw the outputs over frequency here: .png, .svg or .pdf.")
    ] = None,
    mat: Annotated[Path | None, typer.Option(metavar="FILE", help="Write A, B, C, D here, for Matlab.")] = None,
    json: JsonOption = False,
) -> None:
    """Print where inputs lose modes, how well they reach them, and what riding costs."""
    values, wanted = parse_speeds(speeds), outputs or []
    _check_files((plot, locus, bode), mat)
    if bode is not None and len(wanted) > _MOST_OUTPUTS:
        raise InputError(f"--bode: draws at most {_MOST_OUTPUTS} outputs, found {len(wanted)}")
    made = model_from(bicycle, options)
    system = made.asked.state_space(values, outputs)
    found = control_summary(made.model, values, inputs)
    if json:
        print_json(found.to_dict() | (system.to_dict() if wanted else {}))
    else:
        _tell(made, found, system if wanted else None)
    draws: list[tuple[Path | None, Callable[[], Figure]]] = [
        (plot, lambda: angles_figure(found, made.title)),
        (locus, lambda: _locus(made, values)),
        (bode, lambda: _bode(made, values, outputs)),
    ]
    for path, draw in draws:
        if path is not None:
            deliver_figure(draw(), path, quiet=json)
    if mat is not None:
        save_mat(system, mat)
        if not json:
            show(f"wrote {mat}")


def _tell(made: Made, found: ControlSummary, system: StateSpace | None) -> None:
    show(control_tables(found, made.title))
    if system is not None:
        show(seen_tables(system, abs(frequency_response(system, [2 * np.pi])), made.title))


def _check_files(figures: tuple[Path | None, ...], mat: Path | None) -> None:
    for file in figures:
        if file is not None:
            check_figure(file)
    if mat is not None:
        check_writable(mat)


def _locus(made: Made, speeds: np.ndarray) -> Figure:
    dense = np.linspace(speeds.min(), speeds.max(), _LOCUS)
    return locus_figure(dense, made.asked.modes(dense).eigenvalues, made.title)


def _bode(made: Made, speeds: np.ndarray, outputs: list[str] | None) -> Figure:
    """Return the figure of outputs over frequency; without outputs asked for, of the coordinates."""
    system = made.asked.state_space(speeds, outputs or list(made.model.coordinates))
    return bode_figure(frequency_response(system, _BODE), made.title)
