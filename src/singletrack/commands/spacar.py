"""``singletrack spacar``."""

from __future__ import annotations

import warnings
from enum import StrEnum
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from singletrack.commands.options import JsonOption
from singletrack.commands.printing import print_json, show
from singletrack.errors import OddityWarning
from singletrack.multibody.spacar import read
from singletrack.multibody.spacar.report import columns, report, statics
from singletrack.output import check_writable, write_whole
from singletrack.present.spacar import motion_text, statics_text
from singletrack.present.tables import write_csv

if TYPE_CHECKING:
    from singletrack.multibody.spacar import Spacar

__all__ = ["run"]


class _Mass(StrEnum):
    consistent = "consistent"
    lumped = "lumped"


def run(
    file: Annotated[Path, typer.Argument(metavar="FILE.dat", help="A file of SPACAR, of Delft or Twente.")],
    listing: Annotated[bool, typer.Option("--listing", help="Only say what was understood of the file.")] = False,
    equilibrium: Annotated[
        bool, typer.Option("--equilibrium", help="Equilibrium under the constant loads, with natural frequencies.")
    ] = False,
    buckling: Annotated[
        bool, typer.Option("--buckling", help="Factors of the loads (FORCE) at which the drawing buckles.")
    ] = False,
    history: Annotated[
        Path | None, typer.Option("--history", metavar="FILE.csv", help="Write the whole motion here, a row a step.")
    ] = None,
    mass: Annotated[_Mass, typer.Option(help="How beams and trusses carry their mass.")] = _Mass.consistent,
    json: JsonOption = False,
) -> None:
    """Run a file: the state at the end of its motion, and small motions about that."""
    if history is not None:
        check_writable(history)
    model = read(file, mass.value)
    for remark in model.description.remarks:
        warnings.warn(remark, OddityWarning, stacklevel=2)
    if listing:
        show(model.listing())
    elif equilibrium or buckling:
        _statics(model, equilibrium, buckling, json)
    else:
        _motion(model, history, json=json)


def _statics(model: Spacar, equilibrium: bool, buckling: bool, json: bool) -> None:
    data = statics(model, equilibrium=equilibrium, buckling=buckling)
    if json:
        print_json(data)
    else:
        show(statics_text(data))


def _motion(model: Spacar, history: Path | None, *, json: bool) -> None:
    motions = model.run()
    if history is not None:
        write_whole(history, write_csv(*columns(model, motions)))
    motion = motions[-1]
    data: dict[str, Any] = report(model, motion, model.linearise(motion))
    if json:
        print_json(data)
    else:
        show(model.listing())
        show(motion_text(data))
