"""JSON schemas of our own files, for editors that complete and check TOML."""

from __future__ import annotations

from typing import TypeAlias

from singletrack.errors import InputError, unknown_name
from singletrack.files.toml_write import unit_text
from singletrack.parameters.bicycle import Bicycle
from singletrack.parameters.record import ALLOWED, Parameter, Record
from singletrack.parameters.rider import Rider
from singletrack.parameters.shapes import SEGMENTS

__all__ = ["schema"]

#: As the standard library writes it: texts, numbers, lists and mappings again.
Schema: TypeAlias = dict[str, object]

_NUMBER = r"[+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?"
# Units by the SI unit they convert to, as editors should offer them; the reader knows more.
_UNITS = {
    "": "",
    "m": r"(?:m|cm|mm|dm|km|in|ft|inch|foot|metre|meter)",
    "kg": r"(?:kg|g|lb|lbs)",
    "rad": r"(?:rad|deg|degrees|°)",
}


def schema(kind: str) -> Schema:
    """Return the JSON schema (draft 2020-12) of a bicycle's or a rider's TOML file.

    Parameters
    ----------
    kind : {"bicycle", "rider"}

    Examples
    --------
    >>> schema("bicycle")["properties"]["parameters"]["properties"]["trail"]["description"]
    'front contact behind the steer axis at the ground [m], a finite number'
    """
    kinds: dict[str, type[Record]] = {"bicycle": Bicycle, "rider": Rider}
    if kind not in kinds:
        raise InputError(unknown_name("kind", kind, kinds))
    descriptions = kinds[kind].descriptions()
    properties = {name: _quantity(p, several=name == "forward_lean_angle") for name, p in descriptions.items()}
    text = {"type": "string"}
    tables = {"segments": _segments()} if kind == "rider" else {"extras": _numbers()}
    return {
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "title": f"singletrack {kind}",
        "type": "object",
        "required": ["parameters"],
        "additionalProperties": False,
        "properties": {
            "kind": {"const": kind},
            **dict.fromkeys(("name", "description", "source"), text),
            "parameters": {
                "type": "object",
                "required": [name for name, p in descriptions.items() if not p.optional],
                "additionalProperties": False,
                "properties": properties,
            },
            **tables,
        },
    }


def _quantity(p: Parameter, *, several: bool) -> Schema:
    """Return the schema of a quantity, or of one for each bicycle."""
    unit = _UNITS.get(p.unit, r"[A-Za-z°].*")
    tail = rf"(?:\s*{unit})?" if unit else ""
    number: Schema = {"type": "number"}
    if p.allowed in {"positive", "fraction"}:
        number["exclusiveMinimum"] = 0
    if p.allowed == "not negative":
        number["minimum"] = 0
    if p.allowed == "above ground":
        number["exclusiveMaximum"] = 0
    if p.allowed == "fraction":
        number["exclusiveMaximum"] = 1
    bracket = f" [{unit_text(p.unit)}]" if p.unit else ""
    kinds: list[Schema] = [number, {"type": "string", "pattern": _pattern(tail)}]
    if several:
        kinds.append({"type": "object", "additionalProperties": {"anyOf": list(kinds)}})
    return {"description": f"{p.meaning}{bracket}, {ALLOWED[p.allowed][0]}", "anyOf": kinds}


def _pattern(tail: str) -> str:
    return rf"^\s*{_NUMBER}\s*(?:(?:\+/-|±)\s*{_NUMBER})?{tail}\s*$"


def _numbers() -> Schema:
    uncertain = {"type": "string", "pattern": _pattern("")}
    return {"type": "object", "additionalProperties": {"anyOf": [{"type": "number"}, uncertain]}}


def _segments() -> Schema:
    parts = ("centre", "gyration_along", "gyration_sideways", "gyration_across")
    shape = {
        "type": "object",
        "required": list(parts),
        "additionalProperties": False,
        "properties": {part: {"type": "number"} for part in parts},
    }
    return {"type": "object", "additionalProperties": False, "properties": dict.fromkeys(SEGMENTS, shape)}
