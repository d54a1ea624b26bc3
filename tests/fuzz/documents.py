"""Files as what they are made of: entries with a name, a value, a deviation, a unit; and how formats write them."""

from __future__ import annotations

import re
from dataclasses import dataclass, replace

__all__ = ["Document", "Entry", "parse", "render"]

_TOML = re.compile(r"^(?P<name>[\w.-]+) = (?P<rest>.*?)(?: # .*)?$")
_QUOTED = re.compile(r'"(?P<value>[-+.\de]+)(?: \+/- (?P<deviation>[-+.\de]+))? ?(?P<unit>[^"]*)"')
_PLAIN = re.compile(r"^\s*(?P<name>\w+)\s*[=:]\s*(?P<value>[^#+]*?)(?:\+/-(?P<deviation>[-+.\de]+))?\s*(?:#.*)?$")


@dataclass(frozen=True)
class Entry:
    """One line: what it says, or the line as it is where it is nothing of the kind."""

    name: str = ""
    value: str = ""
    deviation: str = ""
    unit: str = ""
    raw: str | None = None
    indent: str = ""


@dataclass(frozen=True)
class Document:
    """Entries and the syntax they are written in: toml, equals, colon, columns, or cells of one line."""

    syntax: str
    entries: tuple[Entry, ...]
    ending: str = "\n"
    head: str = ""
    tail: str = ""
    quoted: bool = True

    def with_entries(self, entries) -> Document:
        return replace(self, entries=tuple(entries))


def parse(text: str, syntax: str) -> Document:
    """Return the document that a sound text is."""
    if syntax == "cells":
        return Document(syntax, tuple(Entry("cell", cell) for cell in text.split(":")), ending=":")
    return Document(syntax, tuple(_entry(line, syntax) for line in text.rstrip("\n").split("\n")))


def _entry(line: str, syntax: str) -> Entry:
    if syntax == "columns":
        name, _, value = line.partition(",")
        return Entry(name, value)
    if syntax == "toml":
        found = _TOML.match(line)
        inner = found and _QUOTED.fullmatch(found["rest"])
        if inner:
            return Entry(found["name"], inner["value"], inner["deviation"] or "", inner["unit"])
        return Entry(found["name"], raw=line) if found else Entry(raw=line)
    found = _PLAIN.match(line)
    if not found or not found["value"].strip():
        return Entry(raw=line)
    indent = line[: len(line) - len(line.lstrip())]
    return Entry(found["name"], found["value"].strip(), found["deviation"] or "", indent=indent)


def render(document: Document) -> str:
    """Return the text of a document."""
    lines = [_line(entry, document) if entry.raw is None else entry.raw for entry in document.entries]
    end = "" if document.syntax == "cells" else document.ending
    return document.head + document.ending.join(lines) + end + document.tail


def _line(entry: Entry, document: Document) -> str:
    if document.syntax == "columns":
        return f"{entry.name},{entry.value}"
    if document.syntax == "cells":
        return f"{entry.value}{entry.unit and ' ' + entry.unit}"
    sign = " +/- " if document.syntax == "toml" else "+/-"
    number = entry.value + (f"{sign}{entry.deviation}" if entry.deviation else "")
    if document.syntax == "toml":
        text = f"{number} {entry.unit}".strip()
        return f'{entry.name} = "{text}"' if document.quoted else f"{entry.name} = {text}"
    separator = " = " if document.syntax == "equals" else ": "
    return f"{entry.indent}{entry.name}{separator}{number}{entry.unit and ' ' + entry.unit}"
