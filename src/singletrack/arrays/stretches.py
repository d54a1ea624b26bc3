"""Long batches in stretches: short enough for the processor's cache, spread over threads, with bounded memory.

What is computed in a stretch must not depend on the other designs in it: then neither the stretches nor the threads
change a bit. Threads are as many as this process may use cores; ``SINGLETRACK_THREADS`` or, without it,
``OMP_NUM_THREADS`` in the environment says how many at most.
"""

from __future__ import annotations

import os
from concurrent.futures import ThreadPoolExecutor
from contextlib import contextmanager
from contextvars import ContextVar, copy_context
from functools import lru_cache
from itertools import pairwise
from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

__all__ = ["in_stretches", "part_of", "single_thread", "stretches", "threads"]

#: Set within a thread of ours, which starts no more of them, and where a caller has threads or processes of its own.
_ALONE: ContextVar[bool] = ContextVar("alone", default=False)


def threads() -> int:
    """Return how many threads may work at a time."""
    if _ALONE.get():
        return 1
    cores = len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1
    wanted = os.environ.get("SINGLETRACK_THREADS", os.environ.get("OMP_NUM_THREADS", ""))
    return min(cores, max(1, int(wanted))) if wanted.isdecimal() else cores


@contextmanager
def single_thread() -> Iterator[None]:
    """Let what is computed within the block keep to its own thread.

    Examples
    --------
    >>> with single_thread():
    ...     threads()
    1
    """
    before = _ALONE.set(True)
    try:
        yield
    finally:
        _ALONE.reset(before)


def stretches(count: int, length: int) -> list[slice]:
    """Return slices of nearly equal length that make up a range, none of them of one entry beside others.

    A single entry would be added up in another order by NumPy.

    Parameters
    ----------
    count : int
        Entries in all.
    length : int
        Entries of a slice, at most (but two).

    Examples
    --------
    >>> [(s.start, s.stop) for s in stretches(10, 4)]
    [(0, 3), (3, 6), (6, 10)]
    """
    if count <= length:
        return [slice(0, count)]
    pieces = max(1, min(-(-count // max(length, 2)), count // 2))
    edges = [count * k // pieces for k in range(pieces + 1)]
    return [slice(low, high) for low, high in pairwise(edges)]


def in_stretches(work: Callable[[slice], None], count: int, length: int) -> None:
    """Call a function for each stretch of a range, from several threads where there are several stretches.

    Parameters
    ----------
    work : callable
        Takes the slice; what it finds it writes to its own place.
    count, length : int
        As for :func:`stretches`.

    Raises
    ------
    Exception
        What the function raised for the first stretch that it failed for.
    """
    if count <= length:
        work(slice(0, count))
        return
    pieces = stretches(count, length)
    if len(pieces) < 2 or threads() < 2:
        for piece in pieces:
            work(piece)
        return

    def alone(piece: slice) -> None:
        with single_thread():
            work(piece)

    pool = _pool(os.getpid(), threads())
    # Each in a copy of our context: what the caller has set (errors of floating point, complex steps) holds there.
    for done in [pool.submit(copy_context().run, alone, piece) for piece in pieces]:
        done.result()


@lru_cache(maxsize=1)
def _pool(_process: int, workers: int) -> ThreadPoolExecutor:
    """Return the threads of this process (a forked one has none yet), which keep their memory from call to call."""
    return ThreadPoolExecutor(workers, thread_name_prefix="singletrack")


def part_of(value: Any, which: slice | np.ndarray, shape: tuple[int, ...]) -> Any:
    """Return some designs' values, on one axis, of an array that broadcasts to a batch; anything else as it is.

    Parameters
    ----------
    value : array, shape (...)
        Or anything that is no array with axes.
    which : slice or array of int
        Indices of designs, as numbered along one axis.
    shape : tuple of int
        Of the batch.

    Examples
    --------
    >>> part_of(np.array([[1.0], [2.0]]), slice(2, 5), (2, 3)).tolist()
    [1.0, 2.0, 2.0]
    """
    if not isinstance(value, np.ndarray) or not value.ndim:
        return value
    if value.shape == shape:
        return value.reshape(-1)[which] if value.flags.c_contiguous else value.flat[which]
    return np.broadcast_to(value, shape).flat[which]
