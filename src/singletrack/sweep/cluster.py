"""Chunks done by the workers of a Dask scheduler that the user has named, on machines that share the file system.

Whoever reaches a Dask scheduler can have its workers run any code: docs/howto/sweep.md says how to prevent it (TLS).
A chunk that is lost, with its worker or with the connection, is given out again; one that takes too long is computed
here. Doing a chunk twice does no harm: its files are the same to the last bit, and are moved to their place whole.
"""

from __future__ import annotations

import importlib
import logging
import time
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any

from singletrack.errors import InputError, SingletrackError
from singletrack.sweep.work import Chunk, Order, do

if TYPE_CHECKING:
    from collections.abc import Iterator

    from singletrack.sweep.journal import Entry

__all__ = ["do_on_cluster"]

#: Chunks given out for each thread of the workers.
_AHEAD = 2
#: Seconds after which a connection or a scheduler without workers is given up.
_PATIENCE = 30.0
#: Seconds without any result after which this process does one of the missing chunks itself.
_QUIET = 20.0
_TLS = (
    "for tls:// set DASK_DISTRIBUTED__COMM__TLS__CA_FILE, DASK_DISTRIBUTED__COMM__TLS__CLIENT__CERT and "
    "DASK_DISTRIBUTED__COMM__TLS__CLIENT__KEY (docs/howto/sweep.md)"
)


def _distributed() -> Any:
    return importlib.import_module("distributed")  # lazy: optional, heavy, untyped


def do_on_cluster(order: Order, work: Iterator[Chunk], address: str) -> Iterator[Entry]:
    """Yield the chunks as they are done, in any order.

    Parameters
    ----------
    order : Order
    work : iterator of Chunk
        What is to be done.
    address : str
        Of the scheduler, ``tls://HOST:PORT`` or ``tcp://HOST:PORT``.

    Raises
    ------
    InputError
        If there is no such scheduler, it cannot be reached with TLS, or has no workers.
    SingletrackError
        If the scheduler is lost, or the workers with a chunk die each time.
    """
    with _client(address) as client:
        room = _AHEAD * _threads(client, address)
        waiting: dict[Any, Chunk] = {}
        lost: list[Chunk] = []
        while True:
            while len(waiting) < room:
                chunk = lost.pop() if lost else next(work, None)
                if chunk is None:
                    break
                waiting[client.submit(do, order, chunk, pure=False)] = chunk
            if not waiting:
                return
            done = _done(client, list(waiting))
            if not done:  # one of the missing chunks, here; should it come back after all, nobody waits for it
                future = next(iter(waiting))
                chunk = waiting.pop(future)
                future.cancel()
                yield do(order, chunk)
            for future in done:
                chunk = waiting.pop(future)
                entry = _entry(future)
                if entry is None:
                    lost.append(chunk)
                    _await_connection(client, address)
                else:
                    yield entry


def _done(client: Any, futures: list[Any]) -> list[Any]:
    """Return the futures that are done or lost, none after a time without any."""
    until = time.monotonic() + _QUIET
    while time.monotonic() < until:
        done = [future for future in futures if future.status != "pending"]
        if done or client.status != "running":
            return done or futures[:1]
        time.sleep(0.01)
    return []


def _entry(future: Any) -> Entry | None:
    """Return what a worker has done, or None if that is lost."""
    distributed = _distributed()
    if future.status in {"cancelled", "lost", "pending"}:
        return None
    try:
        entry: Entry = future.result(timeout=_PATIENCE)
    except distributed.KilledWorker as error:
        raise SingletrackError(
            f"the workers that were given some designs died each time ({error}); is there enough memory? What is on "
            "disk is kept: run the sweep again to go on"
        ) from None
    except (SingletrackError, MemoryError):
        raise
    except (distributed.CancelledError, distributed.TimeoutError, OSError) as error:
        if isinstance(error, OSError) and error.errno is not None and error.filename is not None:
            raise  # of the disk, not of the network
        return None
    return entry


def _await_connection(client: Any, address: str) -> None:
    until = time.monotonic() + _PATIENCE
    while client.status not in {"running", "closed"} and time.monotonic() < until:
        time.sleep(0.1)
    if client.status != "running":
        raise SingletrackError(
            f"--scheduler {address}: is lost; what is on disk is kept: run the same command again to go on"
        )


def _threads(client: Any, address: str) -> int:
    """Return the number of threads of all workers, once there is a worker."""
    until = time.monotonic() + _PATIENCE
    while not (threads := int(sum(client.nthreads().values()))):
        if time.monotonic() > until:
            raise InputError(f"--scheduler {address}: has no workers; start some with `dask worker {address}`")
        time.sleep(0.1)
    return threads


@contextmanager
def _client(address: str) -> Iterator[Any]:
    with _silence():
        try:
            client = _distributed().Client(address, timeout="10s")
        except (OSError, ValueError, TypeError, RuntimeError) as error:
            first = (str(error) or repr(error)).splitlines()[0]
            raise _no_scheduler(address, first) from None
        try:
            yield client
        finally:
            client.close(timeout=2)


@contextmanager
def _silence() -> Iterator[None]:
    """Keep the tracebacks that Dask logs of lost connections from the terminal: what is to be said is raised."""
    _distributed()  # which sets up its loggers
    loggers = [logging.getLogger(name) for name in ("asyncio", "tornado", "tornado.application", "distributed")]
    loggers += [
        logging.getLogger(name) for name in list(logging.root.manager.loggerDict) if name[:12] == "distributed."
    ]
    before = [logger.level for logger in loggers]
    for logger in loggers:
        logger.setLevel(logging.CRITICAL + 1)
    try:
        yield
    finally:
        for logger, level in zip(loggers, before, strict=True):
            logger.setLevel(level)


def _no_scheduler(address: str, reason: str) -> InputError:
    return InputError(
        f"--scheduler {address}: no Dask scheduler answers ({reason}); must be an address such as "
        f"tls://192.168.0.5:8786; {_TLS}"
    )
