"""Reading bicycles and riders from TOML files, shipped or the user's own."""

from __future__ import annotations

import dataclasses
import re
import tomllib
from importlib import resources
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeVar

from singletrack.errors import InputError, SingletrackError, unknown, unknown_name
from singletrack.parameters.bicycle import Bicycle
from singletrack.parameters.record import Record
from singletrack.parameters.rider import Rider
from singletrack.parameters.shapes import segment_shape
from singletrack.parameters.units import parse_quantity

if TYPE_CHECKING:
    from importlib.resources.abc import Traversable

__all__ = ["load_any", "load_bicycle", "load_rider", "override", "parse_record", "read_text", "shipped"]

R = TypeVar("R", bound=Record)

_LARGEST_FILE = 1_000_000
_HEADER = ("kind", "name", "description", "source", "parameters")
_TABLES = {"bicycle": ("extras",), "rider": ("segments",)}


def shipped(kind: str) -> dict[str, Traversable]:
    """Return the files that come with the package, by name.

    Parameters
    ----------
    kind : {"bicycle", "rider"}

    Examples
    --------
    >>> list(shipped("bicycle"))
    ['benchmark', 'browser', 'stratos']
    """
    folder = resources.files("singletrack") / "data" / f"{kind}s"
    files = sorted((file for file in folder.iterdir() if file.name.endswith(".toml")), key=lambda file: file.name)
    return {file.name.removesuffix(".toml"): file for file in files}


def load_bicycle(name_or_path: str | Path) -> Bicycle:
    """Load a bicycle.

    Parameters
    ----------
    name_or_path : str or path
        A shipped name (``benchmark``, ``stratos``, ``browser``) or a file: TOML, a parameter text file or raw
        measurements of BicycleParameters, one of its YAML parameter sets.

    Raises
    ------
    InputError
        If there is no such thing, or the file is not a bicycle; names file, line, parameter, found and allowed.

    Examples
    --------
    >>> load_bicycle("stratos").wheel_base
    1.037
    """
    return _load(Bicycle, name_or_path)


def load_rider(name_or_path: str | Path) -> Rider:
    """Load a rider: a shipped name (``rider-a``), a TOML file, or Yeadon's 95 measurements.

    Errors as in :func:`load_bicycle`. Yeadon's measurements need the optional package ``yeadon``.

    Examples
    --------
    >>> load_rider("rider-a").rider_mass
    72.0
    """
    return _load(Rider, name_or_path)


def load_any(name_or_path: str | Path) -> Bicycle | Rider:
    """Load a bicycle or a rider, whichever it is; errors as in :func:`load_bicycle`.

    >>> load_any("rider-a").kind
    'rider'
    """
    if str(name_or_path) in shipped("rider"):
        return load_rider(name_or_path)
    if str(name_or_path) in shipped("bicycle"):
        return load_bicycle(name_or_path)
    path = Path(name_or_path)
    if not _is_there(path):
        known = [*shipped("bicycle"), *shipped("rider")]
        raise InputError(f"{unknown_name('name', str(name_or_path)[:200], known)}, and there is no such file")
    from singletrack.files.reading import is_rider  # lazy: seldom needed

    return load_rider(path) if is_rider(read_text(path), str(path)) else load_bicycle(path)


def _is_there(path: Path) -> bool:
    try:
        return path.exists()
    except (OSError, ValueError):  # a name too long, or with a NUL
        return False


def _load(cls: type[R], name_or_path: str | Path) -> R:
    known = shipped(cls.kind)
    if isinstance(name_or_path, str) and name_or_path in known:
        return parse_record(cls, known[name_or_path].read_text(encoding="utf-8"), name_or_path)
    path = Path(name_or_path)
    if not _is_there(path):
        raise InputError(f"{unknown_name(cls.kind, str(name_or_path)[:200], known)}, and there is no such file")
    from singletrack.files.reading import read_record  # lazy: seldom needed

    return read_record(cls, read_text(path), str(path))


def read_text(path: Path) -> str:
    """Return the text of a user's file.

    Raises
    ------
    InputError
        If it is a directory, cannot be read, is too large or is not UTF-8 text.
    """
    if path.is_dir():
        raise InputError(f"{path}: is a directory; a file is needed")
    try:
        with path.open("rb") as file:
            content = file.read(_LARGEST_FILE + 1)
    except OSError as error:
        raise InputError(f"{path}: cannot be read ({error.strerror})") from None
    if len(content) > _LARGEST_FILE:
        raise InputError(f"{path}: is larger than {_LARGEST_FILE // 1000} kB; a parameter file is a page of text")
    try:
        return content.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        line = content[: error.start].count(b"\n") + 1
        raise InputError(f"{path}, line {line}: is not UTF-8 text (byte {content[error.start]:#04x})") from None


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
            raise InputError(f"{_place(where, text, name)}: {unknown_name('entry', name, allowed)}{place}")
    if document.get("kind", cls.kind) != cls.kind:
        raise InputError(f"{_place(where, text, 'kind')}: is a {document['kind']!r} file, must be a {cls.kind}")
    if not isinstance(document.get("parameters"), dict):
        raise InputError(f"{where}: has no [parameters]; `singletrack template {cls.kind}` prints a file to fill in")
    for name in ("name", "description", "source"):
        if not isinstance(document.get(name, ""), str):
            raise InputError(f"{_place(where, text, name)}: {name} = {document[name]!r}, must be text")
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
        place = _place(where, text, name)
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
            raise InputError(f"{_place(where, text, table)}: {table} must be a table [{table}]")
        try:
            if table == "segments":
                fields["shapes"] = {name: segment_shape(name, values) for name, values in found.items()}
            else:
                fields[table] = {name: parse_quantity(value, "").value for name, value in found.items()}
        except InputError as error:
            raise InputError(f"{_place(where, text, table)}: {error}") from None
    return fields


def _place(where: str, text: str, name: str) -> str:
    """Return the file with the line on which a name is set."""
    found = re.search(rf"^[^#\n]*?(?<![\w-])[\"']?{re.escape(name)}[\"']?\s*[=\].]", text, re.MULTILINE)
    return where if found is None else f"{where}, line {text.count(chr(10), 0, found.start()) + 1}"


def _place_of_any(where: str, text: str, names: tuple[str, ...]) -> str:
    """Return the file with the line on which the first of the names is set that is set at all."""
    places = (_place(where, text, name) for name in names)
    return next((place for place in places if place != where), where)


def override(record: R, texts: dict[str, str], where: str = "--set") -> R:
    """Return a record with values replaced by texts such as ``"18.5 deg"``, as given on the command line.

    Raises
    ------
    InputError
        If a name is unknown, or a value is not allowed.

    Examples
    --------
    >>> override(load_bicycle("stratos"), {"trail": "60 mm"}).trail
    0.06
    """
    descriptions = record.descriptions()
    record.require_known(dict.fromkeys(name for name in texts if name not in descriptions))
    changes: dict[str, Any] = {}
    deviations = dict(record.standard_deviations)
    for name, text in texts.items():
        try:
            quantity = parse_quantity(text, descriptions[name].unit)
        except InputError as error:
            raise error.at(f"{where} {name}") from None
        changes[name] = quantity.value
        deviations.pop(name, None)
        if quantity.deviation is not None:
            deviations[name] = quantity.deviation
    try:
        return dataclasses.replace(record, **changes, standard_deviations=deviations)
    except SingletrackError as error:
        raise error.at(where) from None
