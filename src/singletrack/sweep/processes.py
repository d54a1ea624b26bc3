"""Chunks done by a pool of processes on this machine: pipes between parent and children, nothing that listens."""

from __future__ import annotations

import multiprocessing
import os
import signal
import threading
from concurrent.futures import FIRST_COMPLETED, Future, ProcessPoolExecutor, wait
from concurrent.futures.process import BrokenProcessPool
from contextlib import contextmanager
from typing import TYPE_CHECKING

from singletrack.arrays import single_thread
from singletrack.errors import SingletrackError
from singletrack.sweep.work import Chunk, Order, do

if TYPE_CHECKING:
    from collections.abc import Iterator

    from singletrack.sweep.journal import Entry

__all__ = ["available_cores", "do_in_processes"]

#: Chunks given out for each process: one that it works on, one that waits.
_AHEAD = 2
#: Times that a chunk may be lost with the process that had it, before the chunk is blamed.
_MOST_LOST = 3


def available_cores() -> int:
    """Return the number of cores that this process may use."""
    if hasattr(os, "sched_getaffinity"):
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1


def do_in_processes(order: Order, work: Iterator[Chunk], workers: int) -> Iterator[Entry]:
    """Yield the chunks as they are done, in any order; a process that dies is replaced.

    Parameters
    ----------
    order : Order
    work : iterator of Chunk
        What is to be done.
    workers : int
        Processes.

    Raises
    ------
    SingletrackError
        If the processes with a chunk die each time.
    """
    again: list[Chunk] = []
    lost: dict[int, int] = {}
    while True:
        with _pool(order, workers) as pool:
            waiting: dict[Future[Entry], Chunk] = {}
            try:
                yield from _through(pool, again, work, waiting, _AHEAD * workers)
            except BrokenProcessPool:
                again += waiting.values()
                for chunk in waiting.values():
                    lost[chunk.start] = lost.get(chunk.start, 0) + 1
            else:
                return
        if max(lost.values(), default=0) > _MOST_LOST:
            raise SingletrackError(
                f"the processes that were given some designs died {_MOST_LOST + 1} times; is there enough memory for "
                f"{workers} of them? (In a script, run_sweep belongs under `if __name__ == '__main__':`.) What is on "
                "disk is kept: run the sweep again to go on"
            )


def _through(
    pool: ProcessPoolExecutor, again: list[Chunk], work: Iterator[Chunk], waiting: dict[Future[Entry], Chunk], room: int
) -> Iterator[Entry]:
    """Yield chunks as they are done; keep in ``waiting`` those that are not."""
    while True:
        while len(waiting) < room:
            if not again and (chunk := next(work, None)) is not None:
                again.append(chunk)
            if not again:
                break
            with _interrupts_held():
                future = pool.submit(_do_here, again[-1])  # should the pool be broken, the chunk stays in `again`
            waiting[future] = again.pop()
        if not waiting:
            return
        for future in wait(waiting, return_when=FIRST_COMPLETED).done:
            entry = future.result()
            del waiting[future]
            yield entry


@contextmanager
def _pool(order: Order, workers: int) -> Iterator[ProcessPoolExecutor]:
    """Yield a pool of fresh processes; whatever happens, none of them is left."""
    pool = ProcessPoolExecutor(
        workers, mp_context=multiprocessing.get_context("spawn"), initializer=_begin, initargs=(order,)
    )
    try:
        yield pool
    finally:
        processes = list((getattr(pool, "_processes", None) or {}).values())
        pool.shutdown(wait=False, cancel_futures=True)
        for process in processes:
            process.terminate()  # what they were writing is not in the journal
        for process in processes:
            process.join()


@contextmanager
def _interrupts_held() -> Iterator[None]:
    """Hold back Ctrl-C: a process that is started now will not get it, and this one does so afterwards."""
    if not hasattr(signal, "pthread_sigmask"):
        yield
        return
    before = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)


class _Here:
    """What this process was started with."""

    order: Order


def _begin(order: Order) -> None:
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # the parent decides
    _Here.order = order
    threading.Thread(target=_end_with_parent, daemon=True).start()


def _end_with_parent() -> None:
    parent = multiprocessing.parent_process()
    if parent is not None:
        parent.join()
        os._exit(1)


def _do_here(chunk: Chunk) -> Entry:
    with single_thread():  # each core has a process already
        return do(_Here.order, chunk)
