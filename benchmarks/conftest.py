"""Ratios: what is compared runs alternately in one run, and the table at the end is what README.md shows."""

from __future__ import annotations

import statistics
import time
from typing import TYPE_CHECKING, Any

import pytest

if TYPE_CHECKING:
    from collections.abc import Callable

ROWS: list[tuple[str, str, float, float, float, str]] = []


@pytest.fixture
def compare(benchmark: Any) -> Callable[..., float]:
    """Return a function that measures how many times as long ``theirs`` takes, by pairs of runs, and notes it."""

    def measure(
        ours: Callable[[], Any],
        theirs: Callable[[], Any],
        *,
        names: tuple[str, str],
        target: str = "",
        pairs: int = 7,
        repeat: int = 1,
        clock: Callable[[], float] = time.process_time,
    ) -> float:
        ours()
        theirs()
        times = [(seconds(ours, repeat, clock), seconds(theirs, 1, clock)) for _ in range(pairs)]
        ratio = statistics.median(b / a for a, b in times)
        mine, other = (statistics.median(column) for column in zip(*times, strict=True))
        ROWS.append((*names, mine, other, ratio, target))
        benchmark.extra_info.update(ratio=ratio, target=target, against=names[1])
        benchmark.pedantic(ours, rounds=3)
        return ratio

    return measure


def seconds(work: Callable[[], Any], repeat: int, clock: Callable[[], float]) -> float:
    """Return seconds of the processor (by default: others may be at work on the machine) for one run."""
    start = clock()
    for _ in range(repeat):
        work()
    return (clock() - start) / repeat


def pytest_terminal_summary(terminalreporter: Any) -> None:
    if not ROWS:
        return
    terminalreporter.section("ratios (medians of pairs in this run, processor seconds)")
    terminalreporter.write_line("| singletrack | against | ours | theirs | ratio | target |")
    terminalreporter.write_line("|---|---|---:|---:|---:|---|")
    for ours, theirs, mine, other, ratio, target in ROWS:
        terminalreporter.write_line(
            f"| {ours} | {theirs} | {mine * 1e3:.3g} ms | {other * 1e3:.4g} ms | {ratio:.2f} | {target} |"
        )
