"""What a file format is: one record for each, in the module that reads and writes it."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from pathlib import Path

from singletrack.files.source import lines_of
from singletrack.parameters.bicycle import Bicycle
from singletrack.parameters.rider import Rider

__all__ = ["Clues", "Format", "clues_of"]

_LONGEST_NAME = 60


@dataclass(frozen=True)
class Clues:
    """What tells one format from another.

    Attributes
    ----------
    suffix : str
        Of the file, in lower case, with its dot.
    values : mapping of str to str
        What follows ``=`` or ``:`` on a line that starts with a name, by name; the first where there are several.
    tables : set of str
        Headings in brackets.
    equals, colons : int
        Lines on which the one or the other sign comes first.
    """

    suffix: str
    values: Mapping[str, str]
    tables: frozenset[str]
    equals: int
    colons: int


def clues_of(text: str, where: str) -> Clues:
    """Return the clues of a text.

    Parameters
    ----------
    text : str
    where : str
        The file's name.

    Examples
    --------
    >>> clues_of("w = 1.02 # m", "a.txt")
    Clues(suffix='.txt', values={'w': '1.02'}, tables=frozenset(), equals=1, colons=0)
    """
    values: dict[str, str] = {}
    tables = set()
    signs = {"=": 0, ":": 0}
    for line in lines_of(text):
        content = line.split("#", 1)[0].strip()
        if content.startswith("["):
            tables.add(content[1 : _LONGEST_NAME + 1].split("]", 1)[0].strip())
        places = {sign: content.find(sign) for sign in signs}
        first = min((place for place in places.values() if place >= 0), default=-1)
        if first < 0:
            continue
        signs[content[first]] += 1
        name = content[:first].rstrip()
        if len(name) <= _LONGEST_NAME and re.fullmatch(r"[A-Za-z]\w*", name):
            values.setdefault(name, content[first + 1 :].strip()[:_LONGEST_NAME])
    return Clues(Path(where).suffix.lower(), values, frozenset(tables), signs["="], signs[":"])


def _none(_: Bicycle | Rider) -> tuple[str, ...]:
    return ()


@dataclass(frozen=True)
class Format:
    """A file format.

    Attributes
    ----------
    name : str
    description : str
        In words that fit after "looks like" and "must be".
    recognises : callable
        Tells from its clues whether a text is in this format; formats are asked in the order of the registry.
    suffixes : tuple of str
        By which it is chosen for writing.
    variant : str
        Which one of several formats with the same suffix.
    read_bicycle, read_rider : callable, optional
        From a text and its file's name, for messages; raise InputError.
    write_bicycle, write_rider : callable, optional
        To a text.
    holds_rider : callable
        Tells from its clues whether a text in this format holds a rider, where it can hold both.
    losses : callable
        What a record has that this format cannot hold, in sentences.
    used_by : str
        The command for what a file holds that is neither a bicycle nor a rider.
    templates : mapping of str to callable
        Texts to fill in, by what they are for.
    """

    name: str
    description: str
    recognises: Callable[[Clues], bool]
    suffixes: tuple[str, ...] = ()
    variant: str = ""
    read_bicycle: Callable[[str, str], Bicycle] | None = None
    read_rider: Callable[[str, str], Rider] | None = None
    write_bicycle: Callable[[Bicycle], str] | None = None
    write_rider: Callable[[Rider], str] | None = None
    holds_rider: Callable[[Clues], bool] | None = None
    losses: Callable[[Bicycle | Rider], tuple[str, ...]] = _none
    used_by: str = ""
    templates: Mapping[str, Callable[[], str]] = field(default_factory=dict)

    def is_for_rider(self, clues: Clues) -> bool:
        """Tell whether a text in this format holds a rider.

        Parameters
        ----------
        clues : Clues
        """
        return self.read_bicycle is None if self.holds_rider is None else self.holds_rider(clues)

    def summary(self) -> str:
        """Return what can be read from and written to files in this format, in words."""
        reads = [kind for kind, read in (("bicycle", self.read_bicycle), ("rider", self.read_rider)) if read]
        writes = [kind for kind in ("bicycle", "rider") if self.can_write(kind)]
        parts = [f"reads {' and '.join(reads)}"] if reads else []
        parts += [f"writes {' and '.join(writes)} ({', '.join(self.suffixes)})"] if writes else []
        return f"{self.description}: {', '.join(parts) or self.used_by}"

    def can_write(self, kind: str) -> bool:
        """Tell whether this format can hold a record.

        Parameters
        ----------
        kind : {"bicycle", "rider"}
        """
        return (self.write_bicycle if kind == "bicycle" else self.write_rider) is not None

    def write(self, record: Bicycle | Rider) -> str | None:
        """Return a record as a text, or None if this format cannot hold its kind.

        Parameters
        ----------
        record : Bicycle or Rider
        """
        if isinstance(record, Bicycle):
            return None if self.write_bicycle is None else self.write_bicycle(record)
        return None if self.write_rider is None else self.write_rider(record)
