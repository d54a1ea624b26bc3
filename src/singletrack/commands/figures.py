"""What commands that draw share: their options, and the file whose name decides the format."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from singletrack.commands.printing import deliver
from singletrack.errors import InputError
from singletrack.files.speeds import parse_range
from singletrack.output import check_writable
from singletrack.parameters.steps import step_of
from singletrack.parameters.units import parse_quantity
from singletrack.present.style import figure_bytes

if TYPE_CHECKING:
    import numpy as np
    from matplotlib.figure import Figure

    from singletrack.analysis.designs import Design

__all__ = [
    "BicyclesArgument",
    "FigureOption",
    "TitleOption",
    "WidthOption",
    "axis_label",
    "check_figure",
    "deliver_figure",
    "millimetres",
    "parse_over",
]

_FIGURES = (".pdf", ".png", ".svg")
_DOTS = 600  # per inch: what journals ask of line drawings
_WIDTHS = (40.0, 400.0)

BicyclesArgument = Annotated[list[str], typer.Argument(metavar="BICYCLE...", help="Shipped names or files.")]
FigureOption = Annotated[
    Path, typer.Option("--output", "-o", metavar="FILE", help="Draw here: .pdf, .png or .svg decides the format.")
]
WidthOption = Annotated[
    str, typer.Option("--width", metavar="LENGTH", help='Of the figure, e.g. "84 mm" (one column) or "174 mm".')
]
TitleOption = Annotated[str, typer.Option("--title", metavar="TEXT", help="Above the figure; by default none.")]


def check_figure(output: Path) -> None:
    """Make sure, before anything is computed, that a figure can be written.

    Parameters
    ----------
    output : path

    Raises
    ------
    InputError
        If its suffix names no format, or it cannot be written.
    """
    if output.suffix.lower() not in _FIGURES:
        raise InputError(f"{output}: unknown suffix {output.suffix!r}, must be one of {', '.join(_FIGURES)}")
    check_writable(output)


def deliver_figure(figure: Figure, output: Path, *, quiet: bool = False) -> None:
    """Write a figure whole, in the format of the file's suffix, and say so.

    Parameters
    ----------
    figure : matplotlib Figure
    output : path
    quiet : bool
        Say nothing: JSON is printed.
    """
    deliver(figure_bytes(figure, output.suffix.lower().removeprefix("."), _DOTS), output, quiet=quiet)


def millimetres(text: str, option: str = "--width") -> float:
    """Return a width in mm.

    Parameters
    ----------
    text : str
        A length in m, or with a unit.
    option : str
        What it was given for, for messages.

    Raises
    ------
    InputError
        If it is no length, or no width of a figure.
    """
    try:
        width = 1e3 * parse_quantity(text, "m").value
    except InputError as error:
        raise error.at(option) from None
    if not _WIDTHS[0] <= width <= _WIDTHS[1]:
        raise InputError(f'{option} {text!r}: must be between {_WIDTHS[0]:g} and {_WIDTHS[1]:g} mm, e.g. "84 mm"')
    return width


def parse_over(design: Design, text: str, option: str = "--over") -> tuple[str, np.ndarray]:
    """Return the parameter and its values (m,), SI, that PARAMETER=START:STOP:COUNT says.

    Parameters
    ----------
    design : Design
        Whose parameter it is.
    text : str
        Each number may have a unit: ``trail=40mm:80mm:9``.
    option : str
        What it was given for, for messages.

    Raises
    ------
    InputError
        If the text is nothing of the kind, or there is no such parameter.
    """
    name, sign, range_text = (part.strip() for part in text.partition("="))
    if not sign:
        raise InputError(f"{option} {text!r}: must be PARAMETER=START:STOP:COUNT, e.g. {option} trail=40mm:80mm:9")
    try:
        return name, parse_range(range_text, design.unit(name))
    except InputError as error:
        raise error.at(option) from None


def axis_label(design: Design, name: str) -> tuple[str, float]:
    """Return the label of a parameter's axis, with its unit, and the factor from SI to that unit.

    Parameters
    ----------
    design : Design
    name : str
    """
    step = step_of(design.unit(name))
    return f"{name.replace('_', ' ')} ({step.unit})", step.factor
