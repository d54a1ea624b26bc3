"""``singletrack convert``."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from singletrack.commands.model import warn_of_oddities
from singletrack.commands.options import Parameterization
from singletrack.commands.printing import deliver, show
from singletrack.commands.writing import check_output, is_parameter_set, text_of
from singletrack.errors import InputError
from singletrack.files.source import read_text
from singletrack.files.text import read_rigid_rider
from singletrack.files.yeadon import read_configuration, read_yeadon
from singletrack.library.load import load_any
from singletrack.parameters import Bicycle, Rider
from singletrack.parameters.bodies import with_rigid_rider
from singletrack.parameters.symbols import MODEL_SYMBOLS, NAMES

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
    record = _load(source, configuration)
    if rigid_rider is not None:
        record = _with_rigid_rider(record, rigid_rider)
    text = text_of(record, output, parameterization)
    warn_of_oddities(record)
    deliver(text, output)
    if isinstance(record, Bicycle) and is_parameter_set(output):
        _note_losses(record)


def _load(source: str, configuration: Path | None) -> Bicycle | Rider:
    """Load whichever of a bicycle and a rider it is; a rider by Yeadon's measurements with a configuration."""
    if configuration is None:
        return load_any(source)
    lean = read_configuration(read_text(configuration), str(configuration))
    return read_yeadon(read_text(Path(source)), source, lean)


def _with_rigid_rider(record: Bicycle | Rider, path: Path) -> Bicycle:
    if not isinstance(record, Bicycle):
        raise InputError(f"{record.name}: is a rider, must be a bicycle to put the rigid rider {path} on")
    return with_rigid_rider(record, read_rigid_rider(read_text(path), str(path)))


def _note_losses(record: Bicycle) -> None:
    """Say what a parameter set does not hold."""
    held = [NAMES[symbol] for symbol in MODEL_SYMBOLS]
    lost = [name for name in record.values() if name not in held]
    if record.standard_deviations:
        show("note: a parameter set holds no standard deviations; they stand in its comments")
    if lost:
        show(f"note: a parameter set holds no {', '.join(lost)}")
