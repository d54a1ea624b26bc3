"""The store of a sweep while it is being filled: chunk by chunk, with a journal of what is done.

While a sweep runs, everything is in ``NAME.partial``: the store, and a journal that gets a line when all files of a
chunk are synced. What the journal does not list, or what is not as it was written, is computed again. The finished
store, with a list of the checksums of all its files, is moved to its place in one step.
"""

from __future__ import annotations

import json
import os
import shutil
import tempfile
from contextlib import contextmanager, suppress
from dataclasses import dataclass, field
from pathlib import Path  # field of a record
from typing import TYPE_CHECKING, Any

import numpy as np
from filelock import FileLock, Timeout

from singletrack.errors import InputError
from singletrack.sweep import journal
from singletrack.sweep.checksums import CHECKSUMS, checksum_lines, is_intact
from singletrack.sweep.chunks import layout_of
from singletrack.sweep.durable import (
    TEMPORARY,
    check_folder,
    checksum,
    move_folder,
    sync_folder,
    write_files,
)
from singletrack.sweep.journal import Entry
from singletrack.sweep.layout import Layout, encode, metadata
from singletrack.sweep.provenance import differences
from singletrack.sweep.study import Study  # field of a record

if TYPE_CHECKING:
    from collections.abc import Iterator

__all__ = ["JOURNAL", "Store", "in_words", "open_store", "partial_of", "refuse_existing", "tidy"]

#: Names in the folder of an unfinished sweep.
JOURNAL, DATA, LOCK = "journal.jsonl", "data.zarr", "lock"


def partial_of(output: Path) -> Path:
    """Return the folder of the unfinished sweep of an output."""
    return output.parent / f"{output.name}.partial"  # also for ".", which has no name


@dataclass
class Store:
    """A sweep's store while it is being filled; :func:`open_store` makes and locks it.

    Attributes
    ----------
    study : Study
    output : Path
        Where the finished store will be.
    layout : Layout
    entries : dict of int to Entry
        The chunks on disk, by their first design.
    damaged : int
        Chunks that were found on disk, but not as they had been written.
    """

    study: Study
    output: Path
    layout: Layout
    entries: dict[int, Entry] = field(default_factory=dict)
    damaged: int = 0

    @property
    def partial(self) -> Path:
        """Folder of the unfinished sweep."""
        return partial_of(self.output)

    @property
    def data(self) -> Path:
        """The Zarr store inside :attr:`partial`."""
        return self.partial / DATA

    @property
    def journal(self) -> Path:
        """The list of what is done."""
        return self.partial / JOURNAL

    @property
    def files(self) -> dict[str, bytes]:
        """The files that describe the unfinished store, by name."""
        return metadata(self.layout, _attributes(self.study))

    def chunks(self) -> Iterator[tuple[int, int]]:
        """Yield (start, stop) of the chunks that are left to compute."""
        for start in range(0, self.layout.designs, self.layout.chunk):
            if start not in self.entries:
                yield start, min(start + self.layout.chunk, self.layout.designs)

    def resume(self) -> None:
        """Take up what an earlier run has left, or begin."""
        described = self.study.to_dict() | {"chunk": self.layout.chunk}
        found = journal.read_journal(self.journal)
        if found is not None and (changed := differences(found.described, described)):
            raise InputError(
                f"{self.partial}: holds an unfinished sweep of another study (or of this file before it was changed): "
                f"{changed}; remove it, or choose another output"
            )
        if found is None:
            shutil.rmtree(self.data, ignore_errors=True)
            self.journal.unlink(missing_ok=True)
        else:
            for left in self.data.rglob(f"*{TEMPORARY}"):
                left.unlink()
            self.entries = {start: e for start, e in found.entries.items() if self._is_intact(e)}
            self.damaged = len(found.entries) - len(self.entries)
        self.data.mkdir(exist_ok=True)
        files = self.files
        write_files(self.data, files)
        if found is None:
            columns = tuple(column.name for column in self.layout.columns if column.name != "fault")
            sums = {name: checksum(data) for name, data in files.items()}
            journal.write_header(self.journal, self.study.fingerprint, journal.Journal(described, columns, sums))
        for folder in (self.partial, self.output.parent):
            sync_folder(folder)

    def _is_intact(self, entry: Entry) -> bool:
        return all(is_intact(self.data / name, value) for name, value in entry.sums.items())

    def record(self, entry: Entry) -> None:
        """Note that a chunk is on disk: its entry."""
        journal.write_entry(self.journal, entry)
        self.entries[entry.start] = entry

    def finish(self) -> None:
        """Write the faults of all chunks and the checksums, and move the store to its place."""
        entries = [self.entries[start] for start in sorted(self.entries)]
        # In the order of the designs, whatever the order in which the chunks were done.
        kinds = list(dict.fromkeys(kind for entry in entries for kind in entry.faults))
        described = metadata(self.layout, _attributes(self.study) | {"fault_kinds": kinds})
        write_files(self.data, described)
        sums = {name: checksum(data) for name, data in described.items()}
        for entry in entries:
            fault = encode(described, entry.start, {"fault": self._fault_codes(entry, kinds)})
            write_files(self.data, fault)
            sums |= entry.sums | {name: checksum(data) for name, data in fault.items()}
        write_files(self.data, {CHECKSUMS: checksum_lines(sums)})
        move_folder(self.data, self.output)
        _remove(self.partial)

    def _fault_codes(self, entry: Entry, kinds: list[str]) -> np.ndarray:
        codes = np.zeros(min(self.layout.chunk, self.layout.designs - entry.start), dtype=np.int16)
        for kind, bad in entry.faults.items():
            codes[(codes == 0) & bad] = kinds.index(kind) + 1
        return codes


@contextmanager
def open_store(study: Study, output: Path) -> Iterator[Store]:
    """Make or take up the unfinished store of a study, locked, with everything found out that would stop it later.

    Raises
    ------
    InputError
        If the output exists or cannot be written, there is no room for it, or what is there belongs to another study
        or sweep.
    """
    partial = partial_of(output)
    refuse_existing(output)
    try:
        _refuse_links(output, partial)
        partial.mkdir(parents=True, exist_ok=True)
        check_folder(partial)
        with tempfile.TemporaryFile(dir=output.parent):
            pass
    except OSError as error:
        raise InputError(f"{partial}: cannot be written ({error.strerror}); must be in a folder that can be") from None
    lock = FileLock(partial / LOCK)
    try:
        lock.acquire(timeout=0)
    except Timeout:
        raise InputError(f"{partial}: another sweep is writing here; wait for it or choose another output") from None
    try:
        refuse_existing(output)  # finished while we came here
        store = Store(study, output, layout_of(study))
        _refuse_too_large(store)
        store.resume()
        yield store
    finally:
        if not (partial / JOURNAL).exists():  # nothing was begun, or all is done
            _remove(partial)
        lock.release()
        if os.name == "nt" and not (partial / JOURNAL).exists():  # where a lock that is held cannot be removed
            _remove_lock(partial)


def _remove_lock(partial: Path) -> None:
    with suppress(OSError):
        (partial / LOCK).unlink()
        partial.rmdir()


def tidy(output: Path) -> None:
    """Remove what a finished sweep has left beside its output, having been killed at the very end."""
    partial = partial_of(output)
    if (partial / JOURNAL).exists() and not (partial / DATA).exists():
        with suppress(Timeout), FileLock(partial / LOCK, timeout=0):
            _remove(partial)


def _remove(partial: Path) -> None:
    """Remove the folder of an unfinished sweep, but nothing that is not ours."""
    shutil.rmtree(partial / DATA, ignore_errors=True)
    for path in (*partial.glob(f"*{TEMPORARY}"), partial / JOURNAL, partial / LOCK):
        with suppress(OSError):
            path.unlink(missing_ok=True)
    with suppress(OSError):
        partial.rmdir()


def refuse_existing(output: Path) -> None:
    """Raise InputError if there is something at the place of an output, were it a link to nowhere."""
    if output.is_symlink():
        raise InputError(f"{output}: is a symbolic link; must be a name that does not exist yet")
    if os.path.lexists(output):
        raise InputError(f"{output}: exists already; remove it or choose another output")


def _refuse_links(output: Path, partial: Path) -> None:
    if partial.is_symlink() or (os.path.lexists(partial) and not partial.is_dir()):
        raise InputError(f"{partial}: is not a folder; {output.name} is collected there: remove it")


def _refuse_too_large(store: Store) -> None:
    there = sum(file.stat().st_size for file in store.partial.rglob("*") if file.is_file())
    needed, free = store.layout.size - there, shutil.disk_usage(store.partial).free
    if needed > free:
        raise InputError(
            f"{store.output}: {store.layout.designs:,} designs need {in_words(needed)}, and there are {in_words(free)} "
            "free; must be on a larger disk, or keep less, or have fewer speeds or designs"
        )


def in_words(size: float) -> str:
    """Return a size in bytes with a fitting unit.

    >>> in_words(999), in_words(12_345_678), in_words(3e15)
    ('999 bytes', '12.3 MB', '3000 TB')
    """
    for unit, value in (("TB", 1e12), ("GB", 1e9), ("MB", 1e6), ("kB", 1e3)):
        if size >= value:
            return f"{size / value:.3g} {unit}" if size < 1e15 else f"{size / value:.0f} {unit}"
    return f"{size:.0f} bytes"


def _attributes(study: Study) -> dict[str, Any]:
    """Return the attributes of the store: where its numbers come from."""
    described = study.to_dict()
    described.pop("speeds")
    return {
        "name": study.name,
        "description": study.description,
        "study": json.dumps(described),
        "fingerprint": study.fingerprint,
        "singletrack": described["programs"]["singletrack"],
        "numpy": np.__version__,
        "coordinates": " ".join(v.name for v in study.designs.variations),
    }
