"""A small study with many chunks, faulty designs and answers of every kind, shared by the tests of sweeps."""

from __future__ import annotations

import os
import random
from contextlib import contextmanager
from typing import TYPE_CHECKING

from singletrack.sweep import chunks, load_study, run_sweep

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path

    from singletrack.sweep import Study

#: Trails negative to large (weave and capsize speeds come and go), arms too short to reach.
SMALL = """
name = "small"
bicycle = "browser"
rider = "rider-a"
posture = "upright"
speeds = [2, 5]
keep = ["matrices", "eigenvalues", "critical_speeds", "stable_ranges"]
[vary]
trail = { from = "-200 mm", to = "200 mm", count = 5 }
upper_arm_length = ["20 cm", "22 cm", "29 cm", "30 cm"]
"""
SOME = 8
CHUNK = 7  # designs, of 20: three chunks, the last one not full


def small_study(folder: Path, text: str = SMALL) -> Study:
    path = folder / "study.toml"
    path.write_text(text)
    return load_study(path)


@contextmanager
def chunks_of(designs: int) -> Iterator[None]:
    """Let chunks be small, so that a small study has several."""
    before, chunks._DESIGNS = chunks._DESIGNS, designs
    try:
        yield
    finally:
        chunks._DESIGNS = before


class Stop(Exception):  # noqa: N818
    """Stands for an interrupt."""


def interrupted(study: Study, output: Path, after: int) -> None:
    """Run a sweep until so many designs are done."""

    def progress(done: int, _resumed: int) -> None:
        if done >= after:
            raise Stop

    try:
        run_sweep(study, output, workers=1, progress=progress)
    except Stop:
        return
    raise AssertionError("was finished before it was interrupted")


def in_turn(count: int, seed: str) -> list[int]:
    """Return the numbers of what is to fail: all of them in `make kill`, otherwise the ends and a few between."""
    if os.environ.get("SINGLETRACK_EXHAUSTIVE") or count <= SOME:
        return list(range(count))
    return sorted({0, count - 1, *random.Random(seed).sample(range(count), SOME)})


def files_of(store: Path) -> dict[str, bytes]:
    """Return every file of a folder, by name."""
    return {path.relative_to(store).as_posix(): path.read_bytes() for path in store.rglob("*") if path.is_file()}
