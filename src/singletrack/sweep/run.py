"""Running a sweep: stretches handed to this process or to Dask workers, recorded as they come back."""

from __future__ import annotations

import importlib
import os
from contextlib import contextmanager
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from singletrack.errors import InputError, SingletrackError
from singletrack.sweep.chunks import Task, compute_chunk
from singletrack.sweep.store import Store, write_chunk

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator
    from pathlib import Path

    from singletrack.sweep.study import Study

__all__ = ["Summary", "require_extra", "run_sweep"]

#: Stretches given out for each worker: one that it works on, one that waits.
_AHEAD = 2


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
        Designs of this run with a fault.
    """

    designs: int
    resumed: int
    faulty: int


def require_extra() -> None:
    """Raise InputError if what sweeps need besides is not installed."""
    try:
        import distributed  # noqa: F401
        import zarr  # noqa: F401
    except ImportError as error:
        raise InputError(f"sweeps need {error.name}: pip install 'singletrack[sweep]'") from None


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
        Processes on this machine, by default one for each core; 1 computes here. Not with ``scheduler``.
    progress : callable
        Called with the number of designs on disk, and how many of them were there from the start.

    Raises
    ------
    InputError
        If the output exists, belongs to another study or is being written, or there is no such scheduler.
    """
    require_extra()
    if output.exists():
        raise InputError(f"{output}: exists already; remove it or choose another output")
    with Store(study, output) as store:
        count = study.designs.count
        left = sum(stop - start for start, stop in store.pieces())
        resumed, finished, faulty = count - left, count - left, 0
        progress(finished, resumed)
        with _executor(scheduler, workers, pieces=len(list(store.pieces()))) as execute:
            task = Task.of(study)
            pieces = ((task, store.data, start, study.designs.rows(start, stop)) for start, stop in store.pieces())
            for start, size, faults in execute(pieces):
                store.record(start, faults)
                finished += size
                faulty += int(np.any(list(faults.values()), axis=0).sum()) if faults else 0
                progress(finished, resumed)
        store.finish()
    return Summary(count, resumed, faulty)


_Piece = tuple[Task, "Path", int, "np.ndarray"]
_Done = tuple[int, int, "dict[str, np.ndarray]"]


def _do(piece: _Piece) -> _Done:
    task, data, start, rows = piece
    arrays, faults = compute_chunk(task, rows)
    write_chunk(data, start, {**arrays, **{name: rows[:, i] for i, name in enumerate(task.names)}})
    return start, len(rows), faults


@contextmanager
def _executor(
    scheduler: str | None, workers: int | None, pieces: int
) -> Iterator[Callable[[Iterator[_Piece]], Iterator[_Done]]]:
    """Yield a function that does pieces, in any order, a few at a time."""
    workers = min(workers or len(os.sched_getaffinity(0)), max(pieces, 1))
    if scheduler is None and workers == 1:
        yield lambda work: map(_do, work)
        return
    distributed = _distributed()
    with _client(scheduler, workers) as client:

        def execute(work: Iterator[_Piece]) -> Iterator[_Done]:
            room = _AHEAD * max(1, sum(client.nthreads().values()))
            waiting = distributed.as_completed(
                [client.submit(_do, piece, pure=False) for _, piece in zip(range(room), work, strict=False)]
            )
            for future in waiting:
                result = _result(future)
                following = next(work, None)
                if following is not None:
                    waiting.add(client.submit(_do, following, pure=False))
                yield result

        yield execute


def _distributed() -> Any:
    return importlib.import_module("distributed")  # lazy: optional, heavy, untyped


def _result(future: Any) -> _Done:
    try:
        done: _Done = future.result()
    except _distributed().KilledWorker as error:
        raise SingletrackError(
            f"the workers that were given one stretch of the sweep died each time ({error}); is there enough memory? "
            "What is on disk is kept: run the sweep again to go on"
        ) from None
    return done


@contextmanager
def _client(scheduler: str | None, workers: int) -> Iterator[Any]:
    distributed = _distributed()
    if scheduler is not None:
        try:
            client = distributed.Client(scheduler, timeout="10s")
        except (OSError, ValueError) as error:
            raise InputError(
                f"--scheduler {scheduler}: no Dask scheduler answers ({error}); must be an address such as "
                "tcp://192.168.0.5:8786"
            ) from None
        with client:
            yield client
        return
    with (
        distributed.LocalCluster(n_workers=workers, threads_per_worker=1, dashboard_address=":0") as cluster,
        distributed.Client(cluster) as client,
    ):
        yield client
