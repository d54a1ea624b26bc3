"""Kill a sweep with SIGKILL at random instants until it is finished, and compare every byte with an undisturbed one.

Run by test_kills.py as a program of its own, which forks before Zarr has any thread:
``kill_loop.py STUDY FOLDER KILLS WORKERS``. Prints what it has seen as JSON.
"""

from __future__ import annotations

import json
import os
import random
import shutil
import signal
import sys
import time
from pathlib import Path
from typing import Any

sys.path.insert(0, str(Path(__file__).parents[1]))
from singletrack.sweep import load_study, run_sweep
from singletrack.sweep.journal import read_journal
from sweep_helpers import CHUNK, chunks_of, files_of


def start(study: Any, output: Path, workers: int) -> int:
    """Run a sweep in a fork, a process group of its own; return its number."""
    pid = os.fork()
    if pid == 0:
        os.setpgid(0, 0)
        code = 1
        try:
            run_sweep(study, output, workers=workers)
            code = 0
        finally:
            os._exit(code)
    return pid


def main(study_file: Path, folder: Path, kills: int, workers: int) -> dict[str, int]:
    study, random_numbers = load_study(study_file), random.Random(20261124)
    began = time.monotonic()
    assert os.waitstatus_to_exitcode(os.waitpid(start(study, folder / "right.zarr", workers), 0)[1]) == 0
    duration = time.monotonic() - began
    right = files_of(folder / "right.zarr")
    seen = {"kills": 0, "finished": 0, "chunks kept": 0, "killed too late": 0}
    output, partial = folder / "killed.zarr", folder / "killed.zarr.partial"
    while seen["kills"] < kills:
        pid = start(study, output, workers)
        time.sleep(random_numbers.uniform(0, duration))
        # Only the parent of the pool: its workers have to end by themselves.
        os.kill(pid, signal.SIGKILL)
        code = os.waitstatus_to_exitcode(os.waitpid(pid, 0)[1])
        assert code in {0, -signal.SIGKILL}, code
        seen["kills"] += code != 0
        if output.exists():  # whole, or not at all
            assert files_of(output) == right
            seen["finished" if code == 0 else "killed too late"] += 1
            shutil.rmtree(output)
            shutil.rmtree(partial, ignore_errors=True)
            continue
        seen["chunks kept"] += compare(partial, right)
    assert os.waitstatus_to_exitcode(os.waitpid(start(study, output, workers), 0)[1]) == 0
    assert files_of(output) == right
    assert not partial.exists()
    return seen


def compare(partial: Path, right: dict[str, bytes]) -> int:
    """Compare all files that the journal says are on the disk; return the number of its chunks."""
    found = read_journal(partial / "journal.jsonl") if partial.exists() else None
    if found is None:
        return 0
    for entry in found.entries.values():
        for name in entry.sums:
            assert (partial / "data.zarr" / name).read_bytes() == right[name], name
    return len(found.entries)


if __name__ == "__main__":
    with chunks_of(CHUNK):
        told = main(Path(sys.argv[1]), Path(sys.argv[2]), int(sys.argv[3]), int(sys.argv[4]))
    print(json.dumps(told))  # noqa: T201
