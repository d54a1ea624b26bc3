"""``singletrack measure``."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from singletrack.analysis.summary import measured_speeds
from singletrack.body.oddities import warn_of_oddities
from singletrack.commands.options import CentreFit
from singletrack.commands.printing import deliver
from singletrack.commands.writing import check_output, text_of
from singletrack.errors import InputError, SingletrackError
from singletrack.files.measured import read_measured
from singletrack.files.source import read_text
from singletrack.library import load_bicycle, shipped
from singletrack.measuring.comparison import compare_measured
from singletrack.present.printing import print_measured
from singletrack.present.tables import critical_speeds_text
from singletrack.present.terminal import Terminal

__all__ = ["run"]


def run(
    file: Annotated[Path, typer.Argument(metavar="FILE", help="Raw measurements.")],
    compare: Annotated[
        str | None, typer.Option(help="A bicycle to compare with, or none; by default the shipped one of that name.")
    ] = None,
    output: Annotated[Path | None, typer.Option(help="Write the bicycle here: .toml, .txt or .yml.")] = None,
    centre_fit: Annotated[CentreFit, typer.Option(help="How centres follow from plumb lines.")] = (
        CentreFit.perpendicular
    ),
) -> None:
    """Turn raw measurements into the 25 parameters with uncertainties, and print them."""
    if output is not None:
        check_output(output)
    if not file.exists():
        raise InputError(f"{file}: there is no such file")
    found = read_measured(read_text(file), str(file), centre_fit)
    name = found.bicycle.name if compare is None and found.bicycle.name in shipped("bicycle") else compare
    other = None if name in {None, "none"} else load_bicycle(str(name))
    warn_of_oddities(found.bicycle)
    console = Terminal()
    if other is None:
        print_measured(console, found.bicycle)
    else:
        agreements = {agreement.name: agreement for agreement in compare_measured(found.bicycle, other)}
        print_measured(console, found.bicycle, other.name, agreements)
    try:
        speeds = measured_speeds(found)
    except SingletrackError as error:
        console.print(f"no uncertainty of the critical speeds: {error}")
    else:
        console.print(critical_speeds_text(speeds.critical, speeds.speed_deviations))
    if output is not None:
        deliver(text_of(found.bicycle, output), output)
