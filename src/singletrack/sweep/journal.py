"""The journal of an unfinished sweep: which study it is, and which chunks are on the disk, with their checksums.

Every line is a JSON object that carries its own checksum. A line that does not hold (cut short by a kill, damaged,
written by something else) counts as not written: its chunk is computed again. Only the first line cannot be spared: it
says which study the numbers belong to.
"""

from __future__ import annotations

import base64
import hashlib
import json
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np

from singletrack.errors import InputError
from singletrack.sweep.durable import append_line

if TYPE_CHECKING:
    from pathlib import Path

__all__ = ["FORMAT", "Entry", "Journal", "read_journal", "write_entry", "write_header"]

#: Of the journal and the store; the first one had no checksums.
FORMAT = 2


@dataclass(frozen=True, eq=False)
class Entry:
    """One chunk on disk.

    Attributes
    ----------
    start : int
        Its first design.
    sums : dict of str to str
        SHA-256 of its files, by name: one of each array.
    faults : dict of str to bool array, shape (k,)
        Which of its designs have which kind of fault.
    """

    start: int
    sums: dict[str, str]
    faults: dict[str, np.ndarray] = field(default_factory=dict)


@dataclass(frozen=True)
class Journal:
    """What a journal says.

    Attributes
    ----------
    described : dict
        All that decides the numbers of the study, and their places.
    columns : tuple of str
        The arrays that each chunk has a file of.
    files : dict of str to str
        SHA-256 of the files that describe the store, by name.
    entries : dict of int to Entry
        The chunks that are on disk, by start.
    """

    described: dict[str, Any]
    columns: tuple[str, ...]
    files: dict[str, str]
    entries: dict[int, Entry] = field(default_factory=dict)


def write_header(path: Path, fingerprint: str, journal: Journal) -> None:
    """Begin a journal at a path: the fingerprint of the study, and all of the journal but its entries."""
    header = {"described": journal.described, "columns": list(journal.columns), "files": journal.files}
    append_line(path, _signed({"study": fingerprint, "format": FORMAT, **header}))


def write_entry(path: Path, entry: Entry) -> None:
    """Note in the journal at a path that a chunk is on disk: its entry."""
    packed = {kind: base64.b64encode(np.packbits(bad).tobytes()).decode() for kind, bad in entry.faults.items()}
    append_line(path, _signed({"start": entry.start, "sums": entry.sums, "faults": packed}))


def read_journal(path: Path) -> Journal | None:
    """Return what the journal at a path says, or None if there is none, or only the beginning of its first line.

    Raises
    ------
    InputError
        If its first line does not say whose it is.
    """
    try:
        content = path.read_bytes()
    except FileNotFoundError:
        return None
    lines = content.split(b"\n")
    found = [_checked(line) for line in lines]
    header = next((line for line in found if line is not None), None)
    if header is None and not any(line.strip() for line in lines[:-1]) and lines[-1].startswith(b'{"study"'):
        return None  # killed while it wrote the first line
    if header is None and not content.strip():
        return None
    if header is None or "described" not in header or header.get("format") != FORMAT:
        raise InputError(
            f"{path}: does not say which study it belongs to (damaged, or written by another version of singletrack); "
            f"what is in {path.parent} cannot be trusted: remove that folder, or choose another output"
        )
    journal = Journal(header["described"], tuple(header["columns"]), header["files"])
    for line in found:
        if line is not None and (entry := _entry(line, journal)) is not None:
            journal.entries[entry.start] = entry
    return journal


def _signed(line: dict[str, Any]) -> str:
    return json.dumps({**line, "check": _check(line)})


def _check(line: dict[str, Any]) -> str:
    return hashlib.sha256(json.dumps(line, sort_keys=True).encode()).hexdigest()[:16]


def _checked(text: bytes) -> dict[str, Any] | None:
    """Return what a line says, if it is what was written."""
    try:
        line = json.loads(text.decode("utf-8"))
    except (ValueError, RecursionError):
        return None
    if not isinstance(line, dict):
        return None
    check = line.pop("check", None)
    return line if check == _check(line) else None


def _entry(line: dict[str, Any], journal: Journal) -> Entry | None:
    if "start" not in line:
        return None
    start, sums = line["start"], line["sums"]
    length = min(journal.described["chunk"], journal.described["designs"]["count"] - start)
    faults = {
        kind: np.unpackbits(np.frombuffer(base64.b64decode(packed), dtype=np.uint8), count=length).astype(bool)
        for kind, packed in line["faults"].items()
    }
    return Entry(start, sums, faults)
