"""Whole commands as a user runs them: import, one model, the whole paper.

Budgets on two cores: `import singletrack` 0.3 s of CPU, `singletrack coefficients` 1 s, `singletrack reproduce` 10 s.
Run with ``make benchmark`` or ``pytest benchmarks --benchmark-enable``.
"""

from __future__ import annotations

import resource
import subprocess
import sys
from typing import TYPE_CHECKING

import pytest

if TYPE_CHECKING:
    from pathlib import Path

MODULE = [sys.executable, "-m", "singletrack"]
COMMANDS = {
    "import": ([sys.executable, "-c", "import singletrack"], 0.3),
    "coefficients": ([*MODULE, "coefficients", "stratos", "--rider", "rider-a", "--posture", "leaned"], 1.0),
    "reproduce": ([*MODULE, "reproduce", "--output", "."], 10.0),
}


@pytest.mark.parametrize("name", COMMANDS)
def test_command(benchmark: object, name: str, tmp_path: Path) -> None:
    command, budget = COMMANDS[name]

    def work() -> None:
        subprocess.run(command, cwd=tmp_path, check=True, capture_output=True)  # noqa: S603  # our own command

    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    benchmark.pedantic(work, rounds=3, warmup_rounds=1)  # type: ignore[attr-defined]
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    used = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    benchmark.extra_info.update(budget_s=budget, cpu_s_per_run=used / 4)  # type: ignore[attr-defined]
