"""A pytest plugin that kills mutants instead of running tests once: everything is imported and collected, and each
mutant is a fork in which the one function that differs gets the mutant's code.

What is decided so is decided in a fraction of a second. A survivor, or a change of what a module does when it is
imported, is left to `cold.py`, which imports everything anew.
"""

from __future__ import annotations

import functools
import gc
import json
import os
import time
from collections import defaultdict
from pathlib import Path
from types import CodeType, FunctionType
from typing import TYPE_CHECKING, Any

import coverage
import hypothesis
from forks import first_failing, forked

if TYPE_CHECKING:
    from collections.abc import Iterator

    import pytest

ROOT = Path.cwd()
#: Hypothesis without a memory, few examples, and no search for a smaller one: a mutant is dead at the first.
EXAMPLES = 15
#: Seconds beyond which no further test is run for a mutant: those that come by are many, and the last tell nothing new.
TOGETHER = float(os.environ.get("BUDGET", "12"))
#: Seconds beyond which a test takes no part.
LONGEST = TOGETHER / 2
PHASES = (hypothesis.Phase.explicit, hypothesis.Phase.generate)


def pytest_runtestloop(session: pytest.Session) -> bool:
    folder = Path(os.environ["MUTANTS"])
    items = {item.nodeid: item for item in session.items}
    for item in session.items:
        _hurry(item)
    lines = tests_of_lines()
    if not (folder / "seconds.json").exists():
        (folder / "seconds.json").write_text(json.dumps(forked(lambda: _times(touched(items, lines)))))
    seconds = json.loads((folder / "seconds.json").read_text())
    left_out = [name for name, value in seconds.items() if value < 0 or value > LONGEST]
    (folder / "left_out.json").write_text(json.dumps(left_out))
    living = _living()
    sound: dict[str, bool] = {}  # tests that pass by themselves, in a fork, where nothing is changed
    gc.freeze()
    known = folder / "warm.jsonl"  # of a run that was interrupted: the last may not be whole
    done = known.read_text().rpartition("\n")[0].splitlines() if known.exists() else []
    with known.open("w") as results:
        results.write("".join(f"{line}\n" for line in done))
        for number, mutant in enumerate(json.loads((folder / "mutants.json").read_text())):
            if number < len(done):
                continue
            chosen = quickest(covering(lines, mutant) - set(left_out), seconds)
            started = time.perf_counter()
            result = _judge(mutant, [items[name] for name in chosen if name in items], living, seconds)
            killer = result.get("killed", "")
            if killer in items and killer not in sound:
                sound[killer] = forked(lambda name=killer: first_failing([items[name]], seconds))["killed"] == ""
            if not sound.get(killer, True):
                left_out.append(killer)
                result |= {"state": "open", "killed": ""}
            result |= {"number": number, "took": time.perf_counter() - started}
            results.write(json.dumps(result) + "\n")
            results.flush()
    return True


def touched(items: dict[str, pytest.Item], lines: dict[str, dict[int, set[str]]]) -> list[pytest.Item]:
    """Return the tests that run any line of the package."""
    touching = {test for by_line in lines.values() for tests in by_line.values() for test in tests}
    return [item for name, item in items.items() if name in touching]


def tests_of_lines() -> dict[str, dict[int, set[str]]]:
    """Return, for each file of the package and line, the tests that run it."""
    found: dict[str, dict[int, set[str]]] = defaultdict(lambda: defaultdict(set))
    for data in os.environ["RECORDS"].split(os.pathsep):
        record = coverage.CoverageData(data)
        record.read()
        for file in record.measured_files():
            name = f"src/{file.rpartition('/src/')[2]}"
            if f"/singletrack/{os.environ['PACKAGE']}/" in name:
                for line, tests in record.contexts_by_lineno(file).items():
                    found[name][line] |= {test.rpartition("|")[0] for test in tests if test}
    return found


def covering(lines: dict[str, dict[int, set[str]]], mutant: dict[str, Any]) -> set[str]:
    """Return the tests that run the changed lines, or else those that run their function, or else their module."""
    by_line = lines.get(mutant["module"], {})
    span = range(mutant["line"], mutant["last"] + 1)
    tests: set[str] = set().union(*(by_line.get(line, set()) for line in span))
    if tests:
        return tests
    _, outer = changed_functions(mutant)
    around = {line for code in outer for _, _, line in code.co_lines() if line}
    return set().union(*(by_line.get(line, set()) for line in around or by_line))


def quickest(tests: set[str], seconds: dict[str, float]) -> list[str]:
    """Return tests in the order of what they take, as far as there is time for them."""
    ordered = sorted(tests, key=lambda name: (seconds.get(name, 1.0), name))
    spent = [sum(seconds.get(name, 1.0) for name in ordered[:count]) for count in range(len(ordered))]
    return [name for name, before in zip(ordered, spent, strict=True) if before < TOGETHER]


def changed_functions(mutant: dict[str, Any]) -> tuple[list[tuple[CodeType, CodeType]], list[CodeType]]:
    """Return pairs of the outermost functions that differ, and those before; none if more than functions does."""
    path = str(ROOT / mutant["module"])
    before = compile(Path(path).read_text(), path, "exec")
    after = compile(mutant["source"], path, "exec")
    pairs = list(_differing(before, after))
    if any(old.co_name == "<module>" or not old.co_flags & 0x1 for old, _ in pairs):  # not optimized: a class's body
        return [], []
    return pairs, [old for old, _ in pairs]


def _differing(old: CodeType, new: CodeType) -> Iterator[tuple[CodeType, CodeType]]:
    inner = list(zip(_codes(old), _codes(new), strict=False))
    if _own(old) != _own(new) or len(_codes(old)) != len(_codes(new)):
        yield old, new
    elif old.co_flags & 0x1:  # a function: as a whole, if anything within differs
        if any(True for pair in inner for _ in _differing(*pair)):
            yield old, new
    else:
        for pair in inner:
            yield from _differing(*pair)


def _codes(code: CodeType) -> list[CodeType]:
    return [constant for constant in code.co_consts if isinstance(constant, CodeType)]


def _own(code: CodeType) -> tuple[object, ...]:
    constants = [(type(c), repr(c)) for c in code.co_consts if not isinstance(c, CodeType)]
    return code.co_code, constants, code.co_names, code.co_varnames, code.co_freevars, code.co_cellvars, code.co_flags


def _living() -> dict[tuple[str, int, str], list[FunctionType]]:
    found = defaultdict(list)
    for thing in gc.get_objects():
        if type(thing) is FunctionType and thing.__code__.co_filename.startswith(str(ROOT / "src")):
            code = thing.__code__
            found[code.co_filename, code.co_firstlineno, code.co_qualname].append(thing)
    return found


def _judge(mutant, items, living, seconds) -> dict[str, Any]:
    try:
        pairs, _ = changed_functions(mutant)
    except (SyntaxError, ValueError):
        return {"state": "no program"}
    if mutant["source"] is None or not mutant["changed"]:
        return {"state": "no change"}
    functions = [living.get((old.co_filename, old.co_firstlineno, old.co_qualname), []) for old, _ in pairs]
    if not pairs or not all(functions):
        same = not pairs and _same(mutant)
        return {"state": "no change" if same else "imported"}
    if any(
        f.__code__.co_freevars != new.co_freevars for fs, (_, new) in zip(functions, pairs, strict=True) for f in fs
    ):
        return {"state": "imported"}
    if not items:
        return {"state": "unseen"}

    def work() -> dict[str, Any]:
        for copies, (_, new) in zip(functions, pairs, strict=True):
            for function in copies:
                function.__code__ = new
        _forget()
        return first_failing(items, seconds)

    result = forked(work)
    return {"state": "killed" if "::" in result["killed"] else "open", **result}


def _same(mutant: dict[str, Any]) -> bool:
    path = str(ROOT / mutant["module"])
    before, after = compile(Path(path).read_text(), path, "exec"), compile(mutant["source"], path, "exec")
    return not any(True for _ in _differing(before, after))


def _forget() -> None:
    """Empty what functions of ours remember from before."""
    for thing in gc.get_objects():
        if isinstance(thing, functools._lru_cache_wrapper) and thing.__module__.startswith("singletrack"):
            thing.cache_clear()


def _hurry(item: pytest.Item) -> None:
    test = getattr(item, "obj", None)
    used = getattr(test, "_hypothesis_internal_use_settings", None)
    if used is not None:
        few = min(EXAMPLES, used.max_examples)
        test._hypothesis_internal_use_settings = hypothesis.settings(
            used, max_examples=few, phases=PHASES, database=None, derandomize=True
        )


def _times(items: list[pytest.Item]) -> dict[str, float]:
    """Return the processor time of each test, the quickest of its own; -1 if it fails as things are."""
    from _pytest.runner import runtestprotocol

    found = {}
    for number, item in enumerate(items):
        started = time.process_time()
        following = items[number + 1] if number + 1 < len(items) else None
        failed = any(report.failed for report in runtestprotocol(item, log=False, nextitem=following))
        found[item.nodeid] = -1.0 if failed else time.process_time() - started
    return found
