"""Mutation testing: change the code in one place, run the tests that come by there, and list who survives.

Run by `make mutants` with the tools' Python:
`run.py --python PYTHON [--sample N] [--seed S] [--module PART] [--again] PACKAGE...`. Works on a copy of the sources in
`.mutants/PACKAGE`:

1. mutants of the package, N of them drawn by the seed (0: all), made by cosmic-ray's operators (`mutants.py`);
2. which tests run which lines, recorded once by coverage's contexts, for as long as sources and tests stay the same
   (or read from `--coverage FILE...`, as of a whole run with `--cov-context=test`);
3. mutants within functions, in forks of a process that has everything imported and collected (`warm.py`);
4. what survived or changes what is done on import, in forks that import everything anew (`cold.py`).

Writes a table to `.mutants/PACKAGE.txt`: the score, and the survivors with their changes. With `--again` the last
table's survivors alone are run again.
"""

from __future__ import annotations

import argparse
import hashlib
import json
import os
import shutil
import subprocess
import sys
from pathlib import Path
from typing import Any

from mutants import Place, drawn, mutant, places

ROOT = Path(__file__).parents[2]
HERE = Path(__file__).parent
#: The tests that should notice; of them, those that come by the changed line are run.
TESTS = {
    "body": "tests/body src/singletrack/body tests/closed_form tests/posture tests/physics tests/public",
    "posture": "tests/posture src/singletrack/posture tests/body tests/closed_form tests/physics tests/public",
    "linear": "tests/linear src/singletrack/linear tests/physics tests/public tests/closed_form tests/present",
    "multibody": "tests/multibody src/singletrack/multibody tests/physics tests/public",
    "analysis": "tests/analysis src/singletrack/analysis tests/public",
}
QUIET = ("-n", "0", "-q", "-m", "not slow")
COPIED = ("src", "tests", "docs", "benchmarks", "requirements", "web/src")
FILES = ("pyproject.toml", "README.md", "CHANGELOG.md", "constraints.txt", "Makefile")


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--python", default=str(ROOT / ".venv" / "bin" / "python"))
    parser.add_argument("--sample", type=int, default=0)
    parser.add_argument("--seed", type=int, default=20261124)
    parser.add_argument("--module", default="", help="only files whose path has this in it")
    parser.add_argument("--coverage", nargs="*", default=[], help="records with contexts that were made before")
    parser.add_argument("--again", action="store_true", help="only the survivors of the last run")
    parser.add_argument("--warm", action="store_true", help="leave open what needs everything imported anew")
    parser.add_argument("packages", nargs="+", choices=sorted(TESTS))
    options = parser.parse_args()
    for package in options.packages:
        sys.stdout.write(judge(package, options).splitlines()[0] + "\n")
        sys.stdout.flush()


def judge(package: str, options: argparse.Namespace) -> str:
    """Run a package's mutants; return the table, which is written too."""
    folder, output = ROOT / ".mutants" / package, ROOT / ".mutants" / f"{package}.txt"
    folder.mkdir(parents=True, exist_ok=True)
    copy = folder / "copy"
    shutil.rmtree(copy, ignore_errors=True)
    for name in COPIED:
        shutil.copytree(
            ROOT / name, copy / name, ignore=shutil.ignore_patterns("__pycache__"), copy_function=shutil.copy2
        )
    for name in FILES:
        shutil.copy2(ROOT / name, copy / name)
    every = places(copy, package, options.module)
    if options.again:
        wanted = [Place(**place) for place in json.loads((folder / "survivors.json").read_text())]
    else:
        wanted = drawn(every, options.sample, options.seed)
    described = json.dumps([mutant(copy, place) for place in wanted])
    known = folder / "mutants.json"
    if not known.exists() or known.read_text() != described:  # else an interrupted run of the same goes on
        for name in ("warm.jsonl", "cold.jsonl"):
            (folder / name).unlink(missing_ok=True)
    known.write_text(described)
    shutil.rmtree(folder / "numba", ignore_errors=True)
    python = Python(options.python, copy, folder)
    if options.coverage:
        python.environment["RECORDS"] = os.pathsep.join(str(Path(name).resolve()) for name in options.coverage)
    else:
        record(python, package, folder)
    python("-m", "pytest", *QUIET, "-s", "-p", "warm", *TESTS[package].split())
    if not options.warm:
        python(str(HERE / "cold.py"), str(folder))
    text = table(package, folder, len(every), options.seed)
    output.write_text(text)
    known.unlink()  # done: the same again starts anew
    return text


class Python:
    """The Python of the tests, run in the copy, with the copy's sources and one thread."""

    def __init__(self, python: str, copy: Path, folder: Path) -> None:
        self.python, self.copy = python, copy
        kept = {name: os.environ[name] for name in ("PATH", "HOME") if name in os.environ}
        threads = dict.fromkeys(("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS"), "1")
        names = {"MUTANTS": str(folder), "PACKAGE": folder.name, "RECORDS": str(folder / "coverage")}
        if "BUDGET" in os.environ:
            names["BUDGET"] = os.environ["BUDGET"]
        paths = {"PYTHONPATH": f"{copy / 'src'}{os.pathsep}{HERE}"}
        self.environment = {**kept, **threads, **paths, **names, "NUMBA_CACHE_DIR": str(folder / "numba")}

    def __call__(self, *arguments: str) -> None:
        done = subprocess.run(
            [self.python, *arguments], cwd=self.copy, env=self.environment, capture_output=True, text=True, check=False
        )
        if done.returncode not in {0, 1, 5}:  # of pytest: passed, some failed, none run
            sys.exit(f"{' '.join(arguments)}\n{done.stdout[-3000:]}\n{done.stderr[-3000:]}")


def record(python: Python, package: str, folder: Path) -> None:
    """Record which tests run which lines of a package, unless that is known for these sources and tests."""
    mark = hashlib.sha256()
    for path in sorted((*(python.copy / "src").rglob("*.*"), *(python.copy / "tests").rglob("*.py"))):
        if path.is_file() and path.suffix != ".pyc" and "mutation" not in path.parts:
            mark.update(str(path).encode() + path.read_bytes())
    known = folder / "coverage.mark"
    if known.exists() and (folder / "coverage").exists() and known.read_text() == mark.hexdigest():
        return
    python.environment["COVERAGE_FILE"] = str(folder / "coverage")
    for name in ("coverage", "seconds.json"):
        (folder / name).unlink(missing_ok=True)
    settings = folder / "coverage.toml"
    source = python.copy / "src" / "singletrack" / package
    settings.write_text(f'[tool.coverage.run]\nsource = ["{source}"]\n')
    measure = ("--cov", f"--cov-config={settings}", "--cov-context=test", "--cov-report=")
    python("-m", "pytest", *QUIET, *measure, *TESTS[package].split())
    known.write_text(mark.hexdigest())


def table(package: str, folder: Path, total: int, seed: int) -> str:
    """Return the score, and the survivors with their changes."""
    mutants = json.loads((folder / "mutants.json").read_text())
    states: dict[int, dict[str, Any]] = {}
    for name in ("warm.jsonl", "cold.jsonl"):
        if not (folder / name).exists():
            continue
        for line in (folder / name).read_text().splitlines():
            one = json.loads(line)
            one["took"] += states.get(one["number"], {"took": 0.0})["took"]
            states[one["number"]] = one
    counted = {number: one for number, one in states.items() if one["state"] not in {"no program", "no change"}}
    alive = [number for number, one in sorted(counted.items()) if one["state"] != "killed"]
    timed = sum(one.get("killed") == "time" for one in counted.values())
    dead, took = len(counted) - len(alive), sum(one["took"] for one in states.values())
    killed = f"{dead} killed ({timed} by the clock), {len(alive)} survived ({dead / max(len(counted), 1):.1%})"
    each = f"{took / max(len(states), 1):.2f} s each"
    lines = [f"{package}: {len(counted)} of {total} mutants run (seed {seed}), {killed}; {each}"]
    for number in alive:
        one = mutants[number]
        lines += ["", f"{one['module']}:{one['line']} {one['operator']} {states[number]['state']}", *one["changed"]]
    names = Place.__dataclass_fields__
    survivors = [{name: mutants[number][name] for name in names} for number in alive]
    (folder / "survivors.json").write_text(json.dumps(survivors))
    return "\n".join(lines) + "\n"


if __name__ == "__main__":
    main()
