"""``singletrack convert``."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from singletrack.body.oddities import warn_of_oddities
from singletrack.commands.options import Parameterization
from singletrack.commands.printing import deliver, show
from singletrack.commands.writing import check_output, losses_of, text_of
from singletrack.errors import InputError
from singletrack.files.rigid_rider import read_rigid_rider
from singletrack.files.source import read_text
from singletrack.library.load import load_any
from singletrack.parameters import Bicycle, Rider
from singletrack.parameters.bodies import with_rigid_rider

__all__ = ["run"]


def run(
    source: Annotated[str, typer.Argument(metavar="IN", help="A shipped name or a file in any format.")],
    output: Annotated[Path, typer.Argument(metavar="OUT", help="Its suffix says how: .toml, .txt, .yml.")],
    parameterization: Annotated[Parameterization, typer.Option(help="Symbols of a .yml parameter set.")] = (
        Parameterization.benchmark
    ),
    configuration: Annotated[Path | None, typer.Option(help="Posture file of a rider by 95 measurements.")] = None,
    rigid_rider: Annotated[Path | None, typer.Option(help="Rigid rider to lump into the rear frame.")] = None,
) -> None:
    """Read a bicycle or a rider in any format and write it in the format of the output's suffix."""
    check_output(output)
    if output.exists() and Path(source).exists() and output.samefile(source):
        raise InputError(f"{output}: is the file to read, must be another one")
    record = load_any(source, configuration)
    if rigid_rider is not None:
        record = _with_rigid_rider(record, rigid_rider)
    text = text_of(record, output, parameterization)
    warn_of_oddities(record)
    deliver(text, output)
    for loss in losses_of(record, output, parameterization):
        show(f"note: {loss}")


def _with_rigid_rider(record: Bicycle | Rider, path: Path) -> Bicycle:
    if not isinstance(record, Bicycle):
        raise InputError(f"{record.name}: is a rider, must be a bicycle to put the rigid rider {path} on")
    return with_rigid_rider(record, read_rigid_rider(read_text(path), str(path)))
