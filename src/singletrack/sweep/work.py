"""What a worker does, wherever it is: compute one chunk, bring it to the disk, and say what is there."""

from __future__ import annotations

import socket
from dataclasses import dataclass
from pathlib import Path  # field of a record
from typing import Any

import numpy as np

from singletrack.errors import InputError
from singletrack.sweep.chunks import Task, compute_chunk  # field of a record
from singletrack.sweep.durable import checksum, write_files
from singletrack.sweep.journal import Entry
from singletrack.sweep.layout import encode
from singletrack.sweep.provenance import programs

__all__ = ["Chunk", "Order", "do"]


@dataclass(frozen=True, eq=False)
class Order:
    """What is the same for all chunks of a sweep: the task, where its results go, and which programs compute it."""

    task: Task
    data: Path
    files: dict[str, bytes]
    programs: dict[str, str]


@dataclass(frozen=True, eq=False)
class Chunk:
    """Some designs: the number of the first, and the values (k, parameters) of all."""

    start: int
    rows: np.ndarray


def do(order: Order, chunk: Chunk) -> Entry:
    """Compute a chunk as an order says and write it; when this returns, it is on the disk.

    Raises
    ------
    InputError
        If this machine has other versions of the programs, or does not see the store.
    OSError
        If a file cannot be written.
    """
    _refuse_stranger(order)
    arrays, faults = compute_chunk(order.task, chunk.rows)
    arrays |= {name: np.ascontiguousarray(chunk.rows[:, i]) for i, name in enumerate(order.task.names)}
    files: dict[str, Any] = encode(order.files, chunk.start, arrays)
    write_files(order.data, files)
    return Entry(chunk.start, {name: checksum(data) for name, data in files.items()}, faults)


def _refuse_stranger(order: Order) -> None:
    here = programs()
    for name, wanted in order.programs.items():
        if here[name] != wanted:
            raise InputError(
                f"the worker on {socket.gethostname()} has {name} {here[name]}, must have {wanted}, as where the sweep "
                "was started: results could differ"
            )
    if not (order.data / ".zgroup").exists():
        raise InputError(
            f"the worker on {socket.gethostname()} does not see {order.data}; all machines must share its file system"
        )
