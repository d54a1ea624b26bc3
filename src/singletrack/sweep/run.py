"""Running a sweep: chunks handed to this process, to others, or to a cluster, recorded as they come back."""

from __future__ import annotations

import errno
from contextlib import closing
from dataclasses import dataclass
from importlib.util import find_spec
from typing import TYPE_CHECKING

import numpy as np

from singletrack.errors import InputError, SingletrackError, install_hint
from singletrack.sweep.chunks import Task
from singletrack.sweep.cluster import do_on_cluster
from singletrack.sweep.processes import available_cores, do_in_processes
from singletrack.sweep.provenance import programs
from singletrack.sweep.store import Store, open_store, partial_of
from singletrack.sweep.work import Chunk, Order, do

if TYPE_CHECKING:
    from collections.abc import Callable, Generator
    from pathlib import Path

    from singletrack.sweep.journal import Entry
    from singletrack.sweep.study import Study

__all__ = ["Summary", "require_extra", "run_sweep"]

_MOST_WORKERS = 1024


@dataclass(frozen=True)
class Summary:
    """What a run has done.

    Attributes
    ----------
    designs : int
        In the whole sweep.
    resumed : int
        Of these, found on disk from an earlier run.
    faulty : int
        Designs with a fault, in the whole sweep.
    damaged : int
        Chunks of an earlier run that were not as they had been written, and were computed again.
    """

    designs: int
    resumed: int
    faulty: int
    damaged: int = 0


def require_extra(scheduler: str | None = None) -> None:
    """Raise InputError if what sweeps, or sweeps with a scheduler, need besides is not installed."""
    for name, who, extra in (("zarr", "sweeps need", "sweep"), ("distributed", "--scheduler needs", "cluster")):
        if find_spec(name) is None and (scheduler is not None or extra == "sweep"):
            raise InputError(f"{who} {name}: {install_hint(extra)}")


def run_sweep(
    study: Study,
    output: Path,
    scheduler: str | None = None,
    workers: int | None = None,
    progress: Callable[[int, int], None] = lambda _done, _resumed: None,
) -> Summary:
    """Compute a study to a Zarr store; take up again what an interrupted run has left.

    Parameters
    ----------
    study : Study
    output : Path
        The store, ``NAME.zarr``. Until it is finished, everything is in ``NAME.zarr.partial``.
    scheduler : str, optional
        Address of a Dask scheduler whose workers see the same file system.
    workers : int, optional
        Processes on this machine, by default one for each core; 1 computes here. Not with ``scheduler``. Processes are
        started afresh: a script that calls this with more than one needs the usual ``if __name__ == "__main__":``.
    progress : callable
        Called with the number of designs on disk, and how many of them were there from the start.

    Raises
    ------
    InputError
        If the output exists, belongs to another study or is being written, there is no room for it, or there is no
        such scheduler.
    SingletrackError
        If workers die, or the scheduler, or the disk is full: what is done is kept.
    """
    require_extra(scheduler)
    if workers is not None and not 1 <= workers <= _MOST_WORKERS:
        raise InputError(f"workers = {workers}, must be a whole number from 1 to {_MOST_WORKERS}")
    try:
        with open_store(study, output) as store:
            try:
                return _fill(store, scheduler, workers, progress)
            except BaseException as error:
                if not isinstance(error, SingletrackError | OSError | MemoryError):
                    error.add_note(_kept(output))  # the command line says it
                raise
    except (OSError, MemoryError) as error:
        raise _stopped(error, output) from None


def _fill(store: Store, scheduler: str | None, workers: int | None, progress: Callable[[int, int], None]) -> Summary:
    count, left = store.layout.designs, list(store.chunks())
    resumed = finished = count - sum(stop - start for start, stop in left)
    progress(finished, resumed)
    with closing(_entries(store, left, scheduler, workers)) as entries:
        for entry in entries:
            store.record(entry)
            finished += min(store.layout.chunk, count - entry.start)
            progress(finished, resumed)
    faulty = sum(
        int(np.any(list(entry.faults.values()), axis=0).sum()) for entry in store.entries.values() if entry.faults
    )
    store.finish()
    return Summary(count, resumed, faulty, store.damaged)


def _entries(store: Store, left: list[tuple[int, int]], scheduler: str | None, workers: int | None) -> Generator[Entry]:
    """Yield the chunks as they are done, in any order, wherever that is."""
    order = Order(Task.of(store.study), store.data.absolute(), store.files, programs())
    work = (Chunk(start, store.study.designs.rows(start, stop)) for start, stop in left)
    if not left:
        return
    if scheduler is not None:
        yield from do_on_cluster(order, work, scheduler)
        return
    workers = min(workers or available_cores(), len(left))
    yield from (do(order, chunk) for chunk in work) if workers == 1 else do_in_processes(order, work, workers)


def _kept(output: Path) -> str:
    return f"what is done is kept in {partial_of(output)}: run the same command again to go on"


def _stopped(error: OSError | MemoryError, output: Path) -> SingletrackError:
    kept = _kept(output)
    if isinstance(error, MemoryError):
        return SingletrackError(f"{output}: there is not enough memory; {kept}")
    if error.errno in {errno.ENOSPC, errno.EDQUOT}:
        return SingletrackError(f"{output}: the disk is full; {kept} when there is room")
    return SingletrackError(f"{output}: {error.filename or 'a file'}: {error.strerror or error}; {kept}")
