"""Judge the mutants that `warm.py` left open: the changed module is written, and a fork that has only the libraries in
memory imports everything anew and runs the tests as they are, quickest first.

Run in a copy of the sources by `run.py`, with the Python of the tests: `cold.py FOLDER TEST...`.
"""

from __future__ import annotations

import importlib
import json
import os
import shutil
import sys
import time
import warnings
from pathlib import Path
from typing import Any

import pytest
from forks import first_failing, forked, limit
from warm import covering, quickest, tests_of_lines

LIBRARIES = (
    "casadi control hypothesis jinja2 matplotlib.figure mpmath numpy pint pydantic rich.console scipy.integrate "
    "scipy.interpolate scipy.linalg scipy.optimize scipy.signal scipy.sparse scipy.stats sympy typer xarray yaml"
)
#: Seconds that importing and collecting may take.
START = 20.0


class Chosen:
    """Of the tests that are found, run the chosen ones in their order, until one fails."""

    def __init__(self, names: list[str], seconds: dict[str, float]) -> None:
        self.names, self.seconds = names, seconds
        self.result: dict[str, Any] = {"killed": "collection"}

    def pytest_runtestloop(self, session: pytest.Session) -> bool:
        if session.testsfailed:
            return True
        items = {item.nodeid: item for item in session.items}
        self.result = first_failing([items[name] for name in self.names if name in items], self.seconds)
        return True


def main(folder: Path, arguments: list[str]) -> None:
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        for name in LIBRARIES.split():
            importlib.import_module(name)
    lines = tests_of_lines()
    seconds = json.loads((folder / "seconds.json").read_text())
    left_out = set(json.loads((folder / "left_out.json").read_text()))
    mutants = json.loads((folder / "mutants.json").read_text())
    sound: dict[str, bool] = {}  # tests that pass by themselves where nothing is changed
    left = [json.loads(line) for line in (folder / "warm.jsonl").read_text().splitlines()]
    known = folder / "cold.jsonl"
    done = known.read_text().rpartition("\n")[0].splitlines() if known.exists() else []
    with known.open("w") as results:
        results.write("".join(f"{line}\n" for line in done))
        for one in [one for one in left if one["state"] in {"open", "imported", "unseen"}][len(done) :]:
            mutant = mutants[one["number"]]
            names = quickest(covering(lines, mutant) - left_out, seconds)
            started = time.perf_counter()
            result = judge(mutant, names, seconds, arguments)
            killer = result["killed"]
            if killer and killer != "time" and killer not in sound:
                unchanged = mutant | {"source": Path(mutant["module"]).read_text()}
                sound[killer] = not judge(unchanged, [killer] if "::" in killer else names[:1], seconds, arguments)[
                    "killed"
                ]
            if not sound.get(killer, True):
                result["state"] = "error"
            results.write(json.dumps({**result, "number": one["number"], "took": time.perf_counter() - started}) + "\n")
            results.flush()


def judge(mutant: dict[str, Any], names: list[str], seconds: dict[str, float], arguments: list[str]) -> dict[str, Any]:
    path = Path(mutant["module"])
    before = path.read_bytes()
    for compiled in (path.parent / "__pycache__").glob(f"{path.stem}.*"):
        compiled.unlink()
    if "quartic" in mutant["module"]:  # compiled code of the same file's other contents
        shutil.rmtree(os.environ["NUMBA_CACHE_DIR"], ignore_errors=True)
    files = sorted({name.partition("::")[0] for name in names})

    def work() -> dict[str, Any]:
        limit(START)
        chosen = Chosen(names, {name: 3 * value for name, value in seconds.items()})  # with all examples
        quiet = ["-n", "0", "-q", "-s", "-W", "ignore::pytest.PytestAssertRewriteWarning"]
        code = pytest.main([*quiet, *arguments, *files], plugins=[chosen])
        return chosen.result | {"code": int(code)}

    path.write_text(mutant["source"])
    try:
        result = forked(work)
    finally:
        path.write_bytes(before)
    if "error" in result:
        return {"state": "error", **result}
    return {"state": "killed" if result["killed"] else "survived", **result}


if __name__ == "__main__":
    sys.dont_write_bytecode = True
    sys.path.insert(0, str(Path.cwd() / "src"))
    main(Path(sys.argv[1]), sys.argv[2:])
