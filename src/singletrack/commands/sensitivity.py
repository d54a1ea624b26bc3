"""``singletrack sensitivity``."""

from __future__ import annotations

from enum import StrEnum
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from singletrack.analysis.designs import Design
from singletrack.analysis.sensitivity import CHANGES, KINDS, Sensitivity, sensitivity
from singletrack.analysis.sobol import design_results, sobol_indices
from singletrack.commands.figures import TitleOption, check_figure, deliver_figure, millimetres
from singletrack.commands.model import model_from
from singletrack.commands.model_options import EngineName, ModelOptions
from singletrack.commands.options import BicycleArgument, JsonOption
from singletrack.commands.printing import print_json, show
from singletrack.commands.sheets import sheet_design
from singletrack.errors import InputError
from singletrack.files.speeds import parse_speeds
from singletrack.parameters.units import parse_quantity
from singletrack.present.tables import rows_table
from singletrack.present.tornado import sensitivity_rows, sobol_rows, tornado_figure

if TYPE_CHECKING:
    from collections.abc import Sequence

__all__ = ["design_from", "parse_bounds", "run"]

Kind = StrEnum("Kind", {kind.replace(" ", "_"): kind.replace(" ", "-") for kind in KINDS})  # type: ignore[misc]
Change = StrEnum("Change", {change: change for change in CHANGES})  # type: ignore[misc]


def run(
    bicycle: BicycleArgument,
    options: ModelOptions,
    of: Annotated[
        list[Kind] | None, typer.Option("--of", help="What is asked about, by default critical-speeds; repeatable.")
    ] = None,
    speeds: Annotated[str, typer.Option("--speeds", metavar="SPEEDS", help="Of eigenvalues, m/s or with unit.")] = "5",
    by: Annotated[
        Change, typer.Option("--by", help="Rank by a change one can make, by standard deviation, or by 1 %.")
    ] = Change.step,  # type: ignore[attr-defined]
    parameters: Annotated[
        list[str] | None, typer.Option("--parameter", metavar="NAME", help="Only these; repeatable.")
    ] = None,
    top: Annotated[int, typer.Option("--top", min=1, max=200, help="Parameters shown.")] = 12,
    sobol: Annotated[bool, typer.Option("--sobol", help="Global: Sobol's indices over --range or deviations.")] = False,
    ranges: Annotated[
        list[str] | None, typer.Option("--range", metavar="NAME=LOW:HIGH", help="For --sobol; repeatable.")
    ] = None,
    samples: Annotated[int, typer.Option("--samples", help="For --sobol: a power of two.")] = 1024,
    seed: Annotated[int, typer.Option("--seed", min=0, help="For --sobol.")] = 0,
    output: Annotated[
        Path | None, typer.Option("--output", "-o", metavar="FILE", help="Tornado figure: .pdf, .png or .svg.")
    ] = None,
    result: Annotated[str | None, typer.Option("--result", metavar="NAME", help="Only this result.")] = None,
    width: Annotated[str, typer.Option("--width", metavar="LENGTH", help="Of the figure.")] = "120 mm",
    title: TitleOption = "",
    json: JsonOption = False,
) -> None:
    """Rank parameters by what they do."""
    if output is not None:
        check_figure(output)
    wide = millimetres(width)
    design = design_from(
        bicycle, options, [*(parameters or []), *(text.partition("=")[0].strip() for text in ranges or [])]
    )
    if sobol:
        if output is not None:
            raise InputError("--sobol: has no tornado figure; leave -o away")
        _sobol(design, ranges, samples, seed, float(parse_speeds(speeds)[0]), json=json)
        return
    kinds = [kind.value.replace("-", " ") for kind in of or ()] or list(KINDS[:1])
    at = parse_speeds(speeds) if "eigenvalues" in kinds else ()
    found = sensitivity(design, kinds, at, parameters or (), by.value)
    if not found.results:
        raise InputError(f"{design.title}: has no critical speed; ask --of eigenvalues, at --speeds")
    if output is not None:
        deliver_figure(tornado_figure(found, result or found.results[0], top, wide, title), output)
    if json:
        print_json(found.to_dict())
    elif output is None:
        _print(found, [result] if result else found.results, design.title, top)


def design_from(bicycle: str, options: ModelOptions, vary: Sequence[str] | None = None) -> Design:
    """Return the design that a command's arguments ask for, after warning of what looks odd.

    Parameters
    ----------
    bicycle : str
        A shipped name or a file.
    options : ModelOptions
    vary : sequence of str, optional
        What will vary: of a geometry sheet its entries, and the bicycle follows. None: the bicycle's parameters vary.

    Raises
    ------
    InputError
        As :func:`model_from`, or if another derivation than the closed form is asked for.
    """
    if options.engine is EngineName.multibody:
        raise InputError("--engine: this command takes the closed form, which has exact derivatives; leave it away")
    made = model_from(bicycle, options)
    of_sheet = None if vary is None else sheet_design(bicycle, vary, made.rider, options.sitting, made.title)
    if of_sheet is not None:
        if options.settings:
            raise InputError("--set: with a geometry sheet, change the sheet (`singletrack new` makes its bicycle)")
        return of_sheet
    return Design.of(made.bicycle, made.rider, options.sitting, made.title)


def parse_bounds(design: Design, texts: Sequence[str], option: str) -> dict[str, tuple[float, float]]:
    """Return the least and the greatest value of parameters, SI, from NAME=LOW:HIGH.

    Parameters
    ----------
    design : Design
        Whose parameters they are.
    texts : sequence of str
    option : str
        For messages.

    Raises
    ------
    InputError
        If a text is nothing of the kind, or there is no such parameter.
    """
    found: dict[str, tuple[float, float]] = {}
    for text in texts:
        name, sign, both = (part.strip() for part in text.partition("="))
        ends = both.split(":")
        if not sign or len(ends) != 2:
            raise InputError(f"{option} {text!r}: must be NAME=LOW:HIGH, e.g. {option} trail=40mm:80mm")
        try:
            low, high = (parse_quantity(end.strip(), design.unit(name)).value for end in ends)
        except InputError as error:
            raise error.at(option) from None
        if name in found or not low < high:
            raise InputError(f"{option} {text!r}: must be given once, with LOW below HIGH")
        found[name] = (low, high)
    return found


def _print(found: Sensitivity, results: Sequence[str], title: str, top: int) -> None:
    headings = ("parameter", "derivative", "change", "less", "more")
    for result in results:
        value = f"{result} {found.values[found.row(result)]:.4g} {found.result_units[found.row(result)]}"
        show(rows_table(f"{title}: {value}", headings, sensitivity_rows(found, result, top)))


def _sobol(design: Design, ranges: Sequence[str] | None, samples: int, seed: int, speed: float, *, json: bool) -> None:
    bounds = parse_bounds(design, ranges or [], "--range")
    if not bounds:
        bounds = _of_deviations(design)
    names = tuple(bounds)
    found = sobol_indices(design_results(design, names, speed), bounds, samples, seed, normal=not ranges)
    if json:
        print_json(found.to_dict())
        return
    for r, result in enumerate(found.results):
        heading = (
            f"{design.title}: {result} {found.mean[r]:.4g} ± {found.deviation[r]:.2g}, {found.evaluations} designs"
        )
        show(rows_table(heading, ("parameter", "alone", "with interactions"), sobol_rows(found, result)))


def _of_deviations(design: Design) -> dict[str, tuple[float, float]]:
    """Return means and standard deviations of the parameters that have one."""
    values = design.values()
    found = {name: (float(values[name]), sd) for name, sd in design.deviations().items() if name in values and sd > 0}
    if not found:
        raise InputError("--sobol: no parameter has a standard deviation; give --range NAME=LOW:HIGH")
    return found
