"""Our own TOML files, read: a bicycle or a rider, with units and standard deviations."""

from __future__ import annotations

import re
import tomllib
from pathlib import Path
from typing import Any, TypeVar

from singletrack.errors import InputError, SingletrackError, unknown, unknown_name
from singletrack.files.source import place_of
from singletrack.parameters.record import Record
from singletrack.parameters.rider import Rider
from singletrack.parameters.shapes import segment_shape
from singletrack.parameters.units import parse_quantity

__all__ = ["parse_record"]

R = TypeVar("R", bound=Record)

_HEADER = ("kind", "name", "description", "source", "parameters")
_TABLES = {"bicycle": ("extras",), "rider": ("segments",)}


def parse_record(cls: type[R], text: str, where: str) -> R:
    """Return the record that a TOML text describes.

    Parameters
    ----------
    cls : type
        :class:`Bicycle` or :class:`Rider`.
    text : str
        The file's text.
    where : str
        Name of the file, for messages.

    Raises
    ------
    InputError
        Names the file, the line, the parameter, what was found and what is allowed.
    """
    try:
        document = tomllib.loads(text)
    except tomllib.TOMLDecodeError as error:
        raise InputError(f"{where}: is not valid TOML: {error}") from None
    except RecursionError:
        raise InputError(f"{where}: is not valid TOML: nested too deeply") from None
    except ValueError:  # Python's limit on the digits of whole numbers
        longest = max(re.finditer(r"\d+", text), key=lambda found: len(found[0]))
        line = text.count("\n", 0, longest.start()) + 1
        raise InputError(f"{where}, line {line}: found a number of {len(longest[0])} digits, must be shorter") from None
    header = _checked_header(cls, document, where, text)
    fields, deviations = _quantities(cls, header.pop("parameters"), where, text)
    fields |= _tables(cls, document, where, text)
    missing = [name for name, p in cls.descriptions().items() if not p.optional and name not in fields]
    if missing:
        raise InputError(f"{where}: [parameters] lacks {', '.join(missing)}")
    try:
        return cls(**fields, **header, standard_deviations=deviations)
    except SingletrackError as error:
        raise error.located(lambda names: _place_of_any(where, text, names)) from None


def _checked_header(cls: type[R], document: dict[str, Any], where: str, text: str) -> dict[str, Any]:
    if not document:
        raise InputError(f"{where}: is empty; `singletrack template {cls.kind}` prints a file to fill in")
    allowed = (*_HEADER, *_TABLES.get(cls.kind, ()))
    for name in document:
        if name not in allowed:
            place = "; parameters go under [parameters]" if name in cls.descriptions() else ""
            raise InputError(f"{place_of(where, text, name)}: {unknown_name('entry', name, allowed)}{place}")
    if document.get("kind", cls.kind) != cls.kind:
        raise InputError(f"{place_of(where, text, 'kind')}: is a {document['kind']!r} file, must be a {cls.kind}")
    if not isinstance(document.get("parameters"), dict):
        raise InputError(f"{where}: has no [parameters]; `singletrack template {cls.kind}` prints a file to fill in")
    for name in ("name", "description", "source"):
        if not isinstance(document.get(name, ""), str):
            raise InputError(f"{place_of(where, text, name)}: {name} = {document[name]!r}, must be text")
    return {
        "name": document.get("name", Path(where).stem),
        "source": document.get("source", ""),
        "description": document.get("description", ""),
        "parameters": document["parameters"],
    }


def _quantities(
    cls: type[R], parameters: dict[str, Any], where: str, text: str
) -> tuple[dict[str, Any], dict[str, float]]:
    fields: dict[str, Any] = {}
    deviations: dict[str, float] = {}
    descriptions = cls.descriptions()
    for name, found in parameters.items():
        place = place_of(where, text, name)
        if name not in descriptions:
            raise unknown(f"{cls.kind} parameter", name, descriptions, place)
        try:
            if cls is Rider and name == "forward_lean_angle" and isinstance(found, dict):
                angles = {bicycle: parse_quantity(angle, "rad") for bicycle, angle in found.items()}
                fields["forward_lean_angles"] = {bicycle: angle.value for bicycle, angle in angles.items()}
                deviations |= {
                    f"forward_lean_angle on {bicycle}": angle.deviation
                    for bicycle, angle in angles.items()
                    if angle.deviation is not None
                }
                continue
            quantity = parse_quantity(found, descriptions[name].unit)
        except InputError as error:
            raise error.of(name).at(place) from None
        fields[name] = quantity.value
        if quantity.deviation is not None:
            deviations[name] = quantity.deviation
    return fields, deviations


def _tables(cls: type[R], document: dict[str, Any], where: str, text: str) -> dict[str, Any]:
    """Return what the tables besides [parameters] hold: a rider's segment shapes, numbers kept from other formats."""
    fields: dict[str, Any] = {}
    for table in _TABLES.get(cls.kind, ()):
        found = document.get(table, {})
        if not isinstance(found, dict):
            raise InputError(f"{place_of(where, text, table)}: {table} must be a table [{table}]")
        try:
            if table == "segments":
                fields["shapes"] = {name: segment_shape(name, values) for name, values in found.items()}
            else:
                fields[table] = {name: parse_quantity(value, "").value for name, value in found.items()}
        except InputError as error:
            raise error.at(place_of(where, text, table)) from None
    return fields


def _place_of_any(where: str, text: str, names: tuple[str, ...]) -> str:
    """Return the file with the line on which the first of the names is set that is set at all."""
    places = (place_of(where, text, name) for name in names)
    return next((place for place in places if place != where), where)
