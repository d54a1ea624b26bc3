"""Whole commands as a user runs them, in seconds of the processor, beside what Python takes to load NumPy.

Budgets: the light commands 0.25 s, `singletrack coefficients` 0.35 s, `singletrack reproduce` 10 s. What they import is
tested (tests/commands/test_plain.py). Run with ``make benchmark`` or ``pytest benchmarks/bench_commands.py
--benchmark-enable -n 0``; the table is at the end.
"""

from __future__ import annotations

import resource
import subprocess
import sys
from typing import TYPE_CHECKING, Any

import pytest

if TYPE_CHECKING:
    from pathlib import Path

MODULE = [sys.executable, "-m", "singletrack"]
NUMPY = [sys.executable, "-c", "import numpy"]
COMMANDS = {
    "--version": (["--version"], 0.25),
    "--help": (["--help"], 0.25),
    "list": (["list"], 0.25),
    "template": (["template", "bicycle"], 0.25),
    "schema": (["schema", "bicycle"], 0.25),
    "convert": (["convert", "browser", "out.toml"], 0.25),
    "coefficients": (["coefficients", "browser", "--rider", "rider-a", "--posture", "upright"], 0.35),
    "critical-speeds": (["critical-speeds", "benchmark"], 0.35),
    "reproduce": (["reproduce", "--output", "."], 10.0),
}


def of_children() -> float:
    """Return the processor seconds that ended children of this process have taken."""
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


@pytest.mark.parametrize("name", COMMANDS)
def test_command(compare: Any, name: str, tmp_path: Path) -> None:
    arguments, budget = COMMANDS[name]

    def work(command: list[str]) -> None:
        subprocess.run(command, cwd=tmp_path, check=True, capture_output=True)  # noqa: S603  # our own command

    compare(
        lambda: work([*MODULE, *arguments]),
        lambda: work(NUMPY),
        names=(f"`singletrack {name}`", "`python -c 'import numpy'`"),
        target=f"{budget:g} s",
        pairs=1 if name == "reproduce" else 5,
        clock=of_children,
    )
