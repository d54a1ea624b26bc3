"""A geometry sheet where a command takes a bicycle: the bicycle that it makes, or the design whose entries vary."""

from __future__ import annotations

import importlib
from pathlib import Path
from typing import TYPE_CHECKING, Any

from singletrack.errors import InputError, SingletrackError
from singletrack.files.source import read_text
from singletrack.files.toml_keys import place_of_any
from singletrack.files.toml_text import parse_toml
from singletrack.library import load_bicycle

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from singletrack.analysis.sheet_designs import SheetDesign
    from singletrack.parameters import Bicycle, Rider
    from singletrack.posture import Options

__all__ = ["bicycle_named", "sheet_design", "sheet_entries"]


def sheet_entries(name: str) -> dict[str, Any] | None:
    """Return the entries of a geometry sheet's file, None for anything else.

    Parameters
    ----------
    name : str
        Of a shipped bicycle, or a file.
    """
    path = Path(name)
    if path.suffix.lower() != ".toml" or not path.is_file():
        return None
    text = read_text(path)
    try:
        keys = parse_toml(text, name)
    except InputError:
        return None  # the reader of bicycles says what is wrong
    known = importlib.import_module("singletrack.catalogue.tables").entries()
    own = [key for key in keys if key in known]
    if keys.get("kind") != "sheet" and ("kind" in keys or "parameters" in keys or not own):
        return None
    given: dict[str, Any] = _catalogue().read_sheet(text, name)
    given["name"] = given.get("name") or path.stem
    return given


def bicycle_named(name: str) -> Bicycle:
    """Return a bicycle by a shipped name, from its file, or estimated from its sheet.

    Parameters
    ----------
    name : str

    Raises
    ------
    SingletrackError
        Of a sheet, with its line.
    """
    given = sheet_entries(name)
    if given is None:
        return load_bicycle(name)
    found: Bicycle = _of_sheet(name, lambda: _catalogue().estimate(**given)).bicycle
    return found


def sheet_design(
    name: str, vary: Sequence[str], rider: Rider | None, options: Options, title: str
) -> SheetDesign | None:
    """Return the design that a sheet makes, None if it is no sheet.

    Parameters
    ----------
    name : str
        Of the file.
    vary : sequence of str
        Entries that will vary: where the sheet does not give them, they begin at what is typical.
    rider : Rider, optional
        As he sits on its bicycle.
    options : Options
        How he sits.
    title : str
        For headings.
    """
    given = sheet_entries(name)
    if given is None:
        return None
    theirs = () if rider is None else (*rider.values(), "elbow angle")
    mine = [entry for entry in vary if entry not in theirs and not entry.startswith(("spring at ", "damper at "))]
    found = _of_sheet(name, lambda: _catalogue().expected(mine, **given))
    design: SheetDesign = importlib.import_module("singletrack.analysis.sheet_designs").SheetDesign.of_sheet(
        found, rider, options, title
    )
    return design


def _catalogue() -> Any:
    return importlib.import_module("singletrack.catalogue")  # a door: few bicycles are sheets


def _of_sheet(name: str, make: Callable[[], Any]) -> Any:
    try:
        return make()
    except SingletrackError as error:
        text = read_text(Path(name))
        raise error.located(lambda names: place_of_any(name, text, names)) from None
