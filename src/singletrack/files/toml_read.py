"""Our own TOML files, read."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple, TypeVar

from singletrack.errors import InputError, SingletrackError, shown, unknown_name
from singletrack.files.toml_keys import place_of, place_of_any
from singletrack.files.toml_text import WrittenFloat, parse_toml
from singletrack.parameters.hints import unknown_parameter
from singletrack.parameters.record import Record
from singletrack.parameters.rider import Rider
from singletrack.parameters.shapes import SegmentShape, segment_shape
from singletrack.parameters.units import parse_quantity

if TYPE_CHECKING:
    from collections.abc import Mapping

__all__ = ["parse_record"]

R = TypeVar("R", bound=Record)

_TEXTS = ("name", "description", "source")
_HEADER = ("kind", *_TEXTS, "parameters")
_TABLES = {"bicycle": ("extras",), "rider": ("segments",)}


class _File(NamedTuple):
    """What messages need: the file's name and its text."""

    where: str
    text: str

    def place(self, name: str) -> str:
        return place_of(self.where, self.text, name)


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
    file = _File(where, text)
    document = parse_toml(text, where, WrittenFloat)
    parameters = _checked_header(cls, document, file)
    fields, deviations, written = _quantities(cls, parameters, file)
    extras, uncertain = _extras(cls, document, file)
    shapes = {"shapes": _shapes(document, file)} if cls is Rider else {"extras": extras}
    texts = {name: document.get(name, "") for name in _TEXTS} | {"name": document.get("name", Path(where).stem)}
    missing = [name for name, p in cls.descriptions().items() if not p.optional and name not in fields]
    if missing:
        raise InputError(f"{where}: [parameters] lacks {', '.join(missing)}", parameters=missing)
    try:
        return cls(**fields, **shapes, **texts, standard_deviations=deviations | uncertain, written=written)  # type: ignore[arg-type]  # checked above
    except SingletrackError as error:
        raise error.located(lambda names: place_of_any(where, text, names)) from None


def _checked_header(cls: type[R], document: Mapping[str, object], file: _File) -> Mapping[str, object]:
    """Return the parameters of a document of which the rest was checked."""
    if not document:
        raise InputError(f"{file.where}: is empty; `singletrack template {cls.kind}` prints a file to fill in")
    allowed = (*_HEADER, *_TABLES.get(cls.kind, ()))
    for name in document:
        if name not in allowed:
            place = "; parameters go under [parameters]" if name in cls.descriptions() else ""
            raise InputError(f"{file.place(name)}: {unknown_name('entry', name, allowed)}{place}")
    if document.get("kind", cls.kind) != cls.kind:
        found = shown(document["kind"])
        raise InputError(f"{file.place('kind')}: is a {found} file, must be a {cls.kind}")
    parameters = document.get("parameters")
    if not isinstance(parameters, dict):
        raise InputError(
            f"{file.where}: has no [parameters]; `singletrack template {cls.kind}` prints a file to fill in"
        )
    for name in _TEXTS:
        if not isinstance(document.get(name, ""), str):
            raise InputError(f"{file.place(name)}: {name} = {shown(document[name])}, must be text")
    return parameters


def _quantities(
    cls: type[R], parameters: Mapping[str, object], file: _File
) -> tuple[dict[str, object], dict[str, float], dict[str, str]]:
    """Return values by parameter, standard deviations where given, and how the values were written."""
    fields: dict[str, object] = {}
    written: dict[str, str] = {}
    deviations: dict[str, float] = {}
    descriptions = cls.descriptions()
    for name, found in parameters.items():
        if name not in descriptions:
            raise unknown_parameter(cls.kind, name, descriptions).at(file.place(name))
        several = cls is Rider and name == "forward_lean_angle" and isinstance(found, dict)
        values = found if isinstance(found, dict) and several else {"": found}
        angles = {}
        for bicycle, value in values.items():
            try:
                quantity = parse_quantity(value, descriptions[name].unit)
            except InputError as error:
                raise error.of(name).at(file.place(name)) from None
            angles[bicycle] = quantity.value
            key = f"{name} on {bicycle}" if several else name
            written[key] = getattr(value, "text", str(value))
            if quantity.deviation is not None:
                deviations[key] = quantity.deviation
        if several:
            fields["forward_lean_angles"] = angles
        else:
            fields[name] = angles[""]
    return fields, deviations, written


def _table(name: str, document: Mapping[str, object], file: _File) -> Mapping[str, object]:
    found = document.get(name, {})
    if not isinstance(found, dict):
        raise InputError(f"{file.place(name)}: {name} must be a table [{name}]")
    return found


def _shapes(document: Mapping[str, object], file: _File) -> dict[str, SegmentShape]:
    try:
        return {name: segment_shape(name, values) for name, values in _table("segments", document, file).items()}
    except InputError as error:
        raise error.at(file.place("segments")) from None


def _extras(cls: type[R], document: Mapping[str, object], file: _File) -> tuple[dict[str, float], dict[str, float]]:
    """Return the numbers kept from other formats, and standard deviations where given."""
    values, deviations = {}, {}
    for name, found in (_table("extras", document, file) if cls.kind == "bicycle" else {}).items():
        try:
            quantity = parse_quantity(found, "")
        except InputError as error:
            raise error.of(name).at(file.place(name)) from None
        values[name] = quantity.value
        if quantity.deviation is not None:
            deviations[name] = quantity.deviation
    return values, deviations
