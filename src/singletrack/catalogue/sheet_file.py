"""Sheets as TOML files: one to fill in, and one read."""

from __future__ import annotations

import textwrap
from typing import TYPE_CHECKING, Any

from singletrack.catalogue.tables import components, entries
from singletrack.errors import InputError, unknown
from singletrack.files.toml_keys import place_of
from singletrack.files.toml_text import parse_toml
from singletrack.files.toml_write import unit_text

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

__all__ = ["read_sheet", "sheet_template"]

_OWN = ("kind", "name", "parts", "loads", "with_parts", "without_parts")
#: What entries other than numbers and text must be: in words, and a test.
_FORMS: dict[str, tuple[str, Callable[[Any], bool]]] = {
    "parts": ("a table", lambda value: isinstance(value, dict)),
    "loads": ("tables [[loads]]", lambda value: _is_list_of(value, dict)),
    "with_parts": ("a list of names", lambda value: _is_list_of(value, str)),
    "without_parts": ("a list of names", lambda value: _is_list_of(value, str)),
}
_GROUPS = {
    "geometry": "Geometry: needed are head angle, fork offset or trail, wheels, and wheel base (or front centre, or\n"
    "# stack and reach); the rest is typical where it is not given.",
    "masses": "Masses: what the scale said, as far as it did.",
}


def read_sheet(text: str, where: str) -> dict[str, Any]:
    """Return a sheet's entries by name, as :func:`~singletrack.catalogue.bicycle` takes them.

    Parameters
    ----------
    text : str
        TOML.
    where : str
        The file's name, for messages.

    Raises
    ------
    InputError
        If it is no sheet: names the file, the line and the entry.

    Examples
    --------
    >>> read_sheet('head_angle = "72 deg"', "mine.toml")
    {'head_angle': '72 deg'}
    """
    document = parse_toml(text, where)
    kind = document.pop("kind", "sheet")
    if kind != "sheet":
        raise InputError(
            f"{place_of(where, text, 'kind')}: is a {kind} file, must be a sheet (singletrack new --template)"
        )
    for name, found in document.items():
        if name not in entries() and name not in _OWN:
            raise unknown("entry", name, [*entries(), *_OWN], place_of(where, text, name))
        form, fits = _FORMS.get(name, ("a number or text", lambda value: isinstance(value, str | int | float)))
        if not fits(found):
            raise InputError(f"{place_of(where, text, name)}: {name} must be {form}", parameters=[name])
    return document


def _is_list_of(value: object, kind: type) -> bool:
    return isinstance(value, list) and all(isinstance(each, kind) for each in value)


def sheet_template() -> str:
    """Return a sheet to fill in, as TOML.

    >>> sheet_template().splitlines()[0]
    '# A geometry sheet for `singletrack new`. Take the # off what you know, replace the ?. Bare numbers are SI;'
    """
    return "\n".join(_lines()) + "\n"


def _lines() -> Iterator[str]:
    yield "# A geometry sheet for `singletrack new`. Take the # off what you know, replace the ?. Bare numbers are SI;"
    yield '# text may have a unit and a standard deviation: "45 mm", "72 +/- 0.5 deg". The rest is estimated.'
    yield from ('kind = "sheet"', 'name = ""')
    group = ""
    for name, entry in entries().items():
        if entry.group != group:
            group = entry.group
            yield from ("", f"# {_GROUPS[group]}")
        unit = {"m": "mm", "": ""}.get(entry.unit, unit_text(entry.unit))
        yield f'# {name} = "? {unit}"'.replace('? "', '?"') + f" # {entry.meaning}"
    optional = sorted({part.kind or part.name for part in components() if part.probability < 1})
    yield from ("", "# What is there, or not, of:")
    yield from textwrap.wrap(", ".join(optional), 110, initial_indent="# ", subsequent_indent="# ")
    yield from ('# with_parts = ["carrier"]', '# without_parts = ["ring lock"]')
    yield from ("", "# What was weighed by itself: any component, or frame, fork, front hub, rear hub.", "# [parts]")
    yield '# saddle = "600 g"'
    yield from (
        "",
        "# What is mounted: motor, battery, luggage; x ahead of the rear contact, z down (heights are negative).",
    )
    yield from ("# [[loads]]", '# name = "battery"', '# mass = "2.8 kg"', '# x = "-50 mm"', '# z = "-750 +/- 20 mm"')
    yield '# on = "rear frame" # or "front frame"; length, width, height: of the box it fills'
