"""``singletrack new``: a bicycle from a geometry sheet and a kitchen scale."""

from __future__ import annotations

import dataclasses
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from singletrack.analysis.summary import measured_speeds
from singletrack.body.oddities import warn_of_oddities
from singletrack.catalogue import estimate, read_sheet, sheet_template
from singletrack.catalogue.tables import entries
from singletrack.commands.printing import deliver, show
from singletrack.commands.writing import check_output, text_of
from singletrack.errors import InputError, SingletrackError
from singletrack.files.source import read_text
from singletrack.files.toml_keys import place_of_any
from singletrack.files.toml_write import write_toml
from singletrack.measuring.measurement import Measurement
from singletrack.present.tables import critical_speeds_text

if TYPE_CHECKING:
    from singletrack.catalogue import Estimate

__all__ = ["SheetOptions", "run"]

#: One option for each entry of a sheet, as the table of entries tells.
SheetOptions: Any = dataclasses.make_dataclass(
    "SheetOptions",
    [
        (name, Annotated[str | None, typer.Option(help=f"{entry.meaning[0].upper()}{entry.meaning[1:]}.")], None)
        for name, entry in entries().items()
    ],
    frozen=True,
)


def run(
    options: SheetOptions,
    sheet: Annotated[
        Path | None, typer.Argument(metavar="[SHEET]", help="A sheet (TOML); options go before it.")
    ] = None,
    name: Annotated[str | None, typer.Option(help="Of the bicycle.")] = None,
    part: Annotated[
        list[str] | None, typer.Option(metavar="PART=MASS", help='Mass of a part: "saddle=600 g" (repeatable).')
    ] = None,
    with_part: Annotated[list[str] | None, typer.Option("--with", help="A part that is there (repeatable).")] = None,
    without: Annotated[list[str] | None, typer.Option(help="A part that is not there (repeatable).")] = None,
    output: Annotated[
        Path | None, typer.Option("--output", "-o", metavar="FILE", help="Write here: .toml, .txt, .yml.")
    ] = None,
    template: Annotated[bool, typer.Option("--template", help="Print a sheet to fill in.")] = False,
) -> None:
    """Make a bicycle from a geometry sheet and masses, with every derived number explained."""
    if template:
        deliver(sheet_template(), output)
        return
    if output is not None:
        check_output(output)
    typed = {key: value for key, value in dataclasses.asdict(options).items() if value is not None}
    typed |= {"name": name} if name else {}
    typed |= {"parts": dict(map(_part, part))} if part else {}
    typed |= {key: value for key, value in (("with_parts", with_part), ("without_parts", without)) if value}
    if not typed and sheet is None:
        raise InputError("new: needs a SHEET (`singletrack new --template` prints one to fill in) or options")
    made = _estimated(sheet, typed)
    warn_of_oddities(made.bicycle)
    toml = output is None or output.suffix.lower() == ".toml"
    deliver(write_toml(made.bicycle, made.notes) if toml or output is None else text_of(made.bicycle, output), output)
    if output is not None:
        _show_speeds(made)


def _show_speeds(made: Estimate) -> None:
    """Print the critical speeds without rider, with deviations from the covariance."""
    try:
        speeds = measured_speeds(Measurement(made.bicycle, made.names, made.covariance, {}))
    except SingletrackError as error:
        show(f"no uncertainty of the critical speeds: {error}")
    else:
        show(critical_speeds_text(speeds.critical, speeds.speed_deviations))


def _part(text: str) -> tuple[str, str]:
    name, equals, mass = text.partition("=")
    if not equals:
        raise InputError(f'--part: {text!r} is no PART=MASS, as "saddle=600 g"')
    return name.strip(), mass.strip()


def _estimated(sheet: Path | None, typed: dict[str, Any]) -> Estimate:
    """Return the bicycle of a file's entries and of those typed, which win; errors name the file's line."""
    if sheet is None:
        return estimate(**typed)
    text, where = read_text(sheet), str(sheet)
    given = read_sheet(text, where)
    given["name"] = given.get("name") or sheet.stem
    try:
        return estimate(**(given | typed))
    except SingletrackError as error:
        raise error.located(lambda names: place_of_any(where, text, names)) from None
