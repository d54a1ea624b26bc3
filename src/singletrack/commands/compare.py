"""``singletrack compare``."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import numpy as np
import typer

from singletrack.analysis.compare import compare
from singletrack.commands.figures import (
    BicyclesArgument,
    TitleOption,
    WidthOption,
    check_figure,
    deliver_figure,
    millimetres,
)
from singletrack.commands.model_options import ModelOptions
from singletrack.commands.options import JsonOption
from singletrack.commands.printing import print_json, show
from singletrack.commands.sensitivity import design_from
from singletrack.errors import InputError
from singletrack.files.speeds import parse_speeds
from singletrack.linear import critical_speeds, modes
from singletrack.present.comparing import measure_rows
from singletrack.present.plotting import Drawn, overlay_figure
from singletrack.present.tables import rows_table
from singletrack.present.words import range_text

if TYPE_CHECKING:
    from collections.abc import Sequence

    from singletrack.analysis.compare import Comparison
    from singletrack.analysis.designs import Design

__all__ = ["run"]


def run(
    bicycles: BicyclesArgument,
    options: ModelOptions,
    speeds: Annotated[
        str, typer.Option("--speeds", metavar="SPEEDS", help="Of modes and measures: one, a list or a range.")
    ] = "5",
    output: Annotated[
        Path | None, typer.Option("--output", "-o", metavar="FILE", help="Overlay figure: .pdf, .png or .svg.")
    ] = None,
    width: WidthOption = "84 mm",
    title: TitleOption = "",
    json: JsonOption = False,
) -> None:
    """Put bicycles side by side."""
    if len(bicycles) < 2:
        raise InputError("compare: found one bicycle, must be two or more")
    if output is not None:
        check_figure(output)
    wide, at = millimetres(width), parse_speeds(speeds)
    designs = [design_from(bicycle, options) for bicycle in bicycles]
    found = compare(designs, at)
    if output is not None:
        _draw(designs, output, wide, title)
    if json:
        print_json(found.to_dict())
    elif output is None:
        _print(found)


def _print(found: Comparison) -> None:
    difference = [f"{title} − {found.titles[0]}" for title in found.titles[1:]]
    if found.parameters:
        show(rows_table("parameters that differ", ("", *found.titles, *difference), measure_rows(found.parameters)))
    else:
        show("no parameter differs")
    show(rows_table("what follows", ("", *found.titles, *difference), measure_rows(found.measures)))
    for title, critical in zip(found.titles, found.critical, strict=True):
        ranges = "; ".join(range_text(low, high) for low, high in critical.stable_ranges)
        show(f"{title}: stable {ranges or 'never'}")
    for source in dict.fromkeys(f"{m.name.split(' at ')[0]}: {m.source}" for m in found.measures if m.source):
        show(source)


def _draw(designs: Sequence[Design], output: Path, width: float, title: str) -> None:
    fine, drawn = np.linspace(0.0, 10.0, 401), []
    for design in designs:
        model = design.model()
        drawn.append(Drawn(design.title, modes(model, fine), critical_speeds(model)))
    deliver_figure(overlay_figure(drawn, width, title), output)
