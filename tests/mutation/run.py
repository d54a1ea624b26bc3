"""Mutation testing: change the code in one place, run the tests that should notice, and list who survives.

Run by `make mutants` with the tools' Python: `run.py --python PYTHON --sample N PACKAGE...`. Works on copies of the
sources, made by cosmic-ray's operators, N of them drawn with a fixed seed for each package (0: all). Writes a table to
`.mutants/PACKAGE.txt`: survivors with their changes, and the score.
"""

from __future__ import annotations

import argparse
import random
import re
import shutil
import subprocess
import sys
from pathlib import Path

from cosmic_ray.work_db import WorkDB, use_db
from cosmic_ray.work_item import TestOutcome, WorkerOutcome, WorkItem, WorkResult

ROOT = Path(__file__).parents[2]
#: The tests that should notice, quick ones first; all that a package has besides is in its own folder.
TESTS = {
    "body": "tests/body src/singletrack/body tests/closed_form tests/posture",
    "posture": "tests/posture src/singletrack/posture tests/body tests/closed_form tests/physics",
    "linear": "tests/linear src/singletrack/linear",
    "multibody": "tests/multibody",
    "analysis": "tests/analysis src/singletrack/analysis",
}
#: Not counted: changes that make no difference to what a program computes (types, decorators), and operators on bits,
#: which real numbers do not have, so that any test that comes by kills them.
LEFT_OUT = re.compile(
    r"core/(ReplaceBinaryOperator_BitOr_|RemoveDecorator|ExceptionReplacer|.*_(Bit(Or|And|Xor)|[LR]Shift)$)"
)
CONFIG = """
[cosmic-ray]
module-path = "src/singletrack/{package}"
timeout = {timeout}
excluded-modules = []
test-command = "{python} -m pytest -x -q -n 0 --no-header {tests}"

[cosmic-ray.distributor]
name = "local"
"""


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--python", default=str(ROOT / ".venv" / "bin" / "python"))
    parser.add_argument("--sample", type=int, default=0)
    parser.add_argument("--timeout", type=float, default=120.0)
    parser.add_argument("--module", default="", help="only files whose path has this in it")
    parser.add_argument("packages", nargs="+", choices=sorted(TESTS))
    options = parser.parse_args()
    for package in options.packages:
        judge(package, options)


def judge(package: str, options: argparse.Namespace) -> None:
    folder = ROOT / ".mutants" / package
    shutil.rmtree(folder, ignore_errors=True)
    for name in ("src", "tests", "docs", "benchmarks"):
        shutil.copytree(ROOT / name, folder / name, ignore=shutil.ignore_patterns("__pycache__", ".mutants"))
    for name in ("pyproject.toml", "README.md", "CHANGELOG.md", "constraints.txt"):
        shutil.copy(ROOT / name, folder / name)
    settings = {"package": package, "tests": TESTS[package], "timeout": options.timeout, "python": options.python}
    (folder / "config.toml").write_text(CONFIG.format(**settings))
    environment = {"PYTHONPATH": "src", "PATH": "/usr/bin:/bin", "OMP_NUM_THREADS": "1", "PYTHONDONTWRITEBYTECODE": "1"}

    def tool(*arguments: str) -> None:
        command = [sys.executable, "-m", "cosmic_ray.cli", *arguments]
        subprocess.run(command, check=True, cwd=folder, env=environment, stdout=subprocess.DEVNULL)

    tool("baseline", "config.toml")
    tool("init", "config.toml", "session.sqlite")
    with use_db(str(folder / "session.sqlite"), WorkDB.Mode.open) as database:
        total = draw(database, options.sample, options.module)
    tool("exec", "config.toml", "session.sqlite")
    with use_db(str(folder / "session.sqlite"), WorkDB.Mode.open) as database:
        text = table(database, package, total)
    (ROOT / ".mutants" / f"{package}.txt").write_text(text)
    sys.stdout.write(text.splitlines()[0] + "\n")


def draw(database: WorkDB, sample: int, module: str) -> int:
    """Mark as skipped all mutants but a sample of those that count; return how many these are."""
    items = [item for item in database.work_items if counts(item, module)]
    places = sorted(items, key=key)
    drawn = places if not sample or sample >= len(places) else random.Random(20261124).sample(places, sample)
    kept = {item.job_id for item in drawn}
    for item in list(database.work_items):
        if item.job_id not in kept:
            database.set_result(item.job_id, WorkResult(WorkerOutcome.SKIPPED))
    return len(items)


def key(item: WorkItem) -> tuple[str, tuple[int, int], str, int]:
    mutation = item.mutations[0]
    return str(mutation.module_path), mutation.start_pos, mutation.operator_name, mutation.occurrence


def counts(item: WorkItem, module: str) -> bool:
    mutation = item.mutations[0]
    return not LEFT_OUT.match(mutation.operator_name) and module in str(mutation.module_path)


def table(database: WorkDB, package: str, total: int) -> str:
    """Return the score, and the survivors with their changes."""
    killed, survivors = 0, []
    items = {item.job_id: item for item in database.work_items}
    for job, result in database.results:
        if result.worker_outcome == WorkerOutcome.SKIPPED:
            continue
        if result.test_outcome == TestOutcome.SURVIVED:
            survivors.append((items[job], result.diff or ""))
        else:
            killed += 1
    run = killed + len(survivors)
    score = f"{killed} killed, {len(survivors)} survived ({killed / max(run, 1):.1%})"
    lines = [f"{package}: {run} of {total} mutants run, {score}"]
    for item, diff in sorted(survivors, key=lambda pair: str(pair[0].mutations[0])):
        mutation = item.mutations[0]
        changed = [line for line in diff.splitlines() if line[:1] in "+-" and line[:3] not in {"+++", "---"}]
        lines += ["", f"{mutation.module_path}:{mutation.start_pos[0]} {mutation.operator_name}", *changed]
    return "\n".join(lines) + "\n"


if __name__ == "__main__":
    main()
