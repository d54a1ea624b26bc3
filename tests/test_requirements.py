"""What is installed is pinned and hashed: every dependency, for every system, without a word of where it comes from."""

from __future__ import annotations

import re
import subprocess
import sys
import tomllib
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
FOLDER = ROOT / "requirements"
PINNED = re.compile(r"^([A-Za-z0-9._-]+)==(\S+)(?: ; (.*?))? ?\\?$")
HASH = re.compile(r"^    --hash=sha256:[0-9a-f]{64}(?: \\)?$")


def normal(name: str) -> str:
    return re.sub(r"[-_.]+", "-", name).lower()


def locked(name: str) -> dict[str, str]:
    """Return the packages of a list with their versions; every line is a pin or a hash, every pin has a hash."""
    found: dict[str, str] = {}
    hashes = 1
    for line in (FOLDER / name).read_text().splitlines():
        if HASH.match(line):
            hashes += 1
            continue
        pin = PINNED.match(line)
        assert pin is not None, line
        assert hashes > 0, f"no hash of the package before {line}"
        found[normal(pin[1])], hashes = pin[2], 0
    assert hashes > 0
    return found


@pytest.mark.parametrize("name", ["run.txt", "dev.txt", "docs.txt", "tools.txt"])
def test_every_package_has_hashes(name: str) -> None:
    assert len(locked(name)) > 20


def test_versions_are_those_of_the_constraints() -> None:
    pins = [line.split("==") for line in (ROOT / "constraints.txt").read_text().splitlines() if "==" in line]
    wanted = {normal(name): version for name, version in pins}
    lists = [locked(name) for name in ("dev.txt", "docs.txt", "run.txt")]
    for name, version in [pin for one in lists for pin in one.items()]:
        assert wanted.get(name, version) == version, f"{name}: run `make lock`"


def test_every_dependency_is_locked() -> None:
    project = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]
    extras = project["optional-dependencies"]

    def names(dependencies: list[str]) -> set[str]:
        found = set()
        for dependency in dependencies:
            name, _, inner = re.match(r"([A-Za-z0-9._-]+)(\[(.*?)\])?", dependency).groups()  # type: ignore[union-attr]
            own = normal(name) == "singletrack"
            found |= set.union(*(names(extras[e.strip()]) for e in inner.split(","))) if own else {normal(name)}
        return found

    assert names(project["dependencies"]) <= set(locked("run.txt")), "run `make lock`"
    assert names([*project["dependencies"], *extras["dev"]]) <= set(locked("dev.txt")), "run `make lock`"
    assert names([*project["dependencies"], *extras["docs"]]) <= set(locked("docs.txt")), "run `make lock`"


def test_build_tools_are_pinned() -> None:
    built = (FOLDER / "build.in").read_text()
    for name in ("run.txt", "dev.txt"):
        for tool in ("hatchling", "editables"):
            assert f"{tool}=={locked(name)[tool]}" in built


def test_wheels_of_every_system_are_there() -> None:
    """A package of compiled code has many files: those of four versions of Python on three systems at least."""
    text = (FOLDER / "run.txt").read_text()
    for name in ("numpy", "scipy"):
        part = re.search(rf"^{name}==.*?\n(?:    --hash.*\n)+", text, re.MULTILINE)
        assert part is not None
        assert part[0].count("--hash") >= 4 * 3


def audit(folder: Path, script: str) -> subprocess.CompletedProcess[str]:
    """Run the audit with a stand-in for the tool that it asks."""
    tool = folder / "pip-audit"
    tool.write_text(f"#!{sys.executable}\n{script}\n")
    tool.chmod(0o755)
    command = [sys.executable, str(FOLDER / "audit.py"), str(tool), "run.txt"]
    return subprocess.run(command, capture_output=True, text=True, check=False)


@pytest.mark.parametrize(
    ("script", "code", "said"),
    [
        ("raise ConnectionError('no route')", 2, "could be reached (ConnectionError: no route)"),
        ('print(\'{"dependencies": [{"name": "a", "skip_reason": "404"}]}\')', 2, "answers from this machine"),
        (
            'print(\'{"dependencies": [{"name": "a", "skip_reason": "404"}, {"name": "b", "vulns": []}]}\')',
            2,
            "not found were a",
        ),
        ("print('{\"dependencies\": []}')", 2, "not found were any packages"),
        (
            'print(\'{"dependencies": [{"name": "b", "version": "1", "vulns": [{"id": "PYSEC-1"}]}]}\')',
            1,
            "run.txt: b 1: PYSEC-1",
        ),
        ('print(\'{"dependencies": [{"name": "b", "version": "1", "vulns": []}]}\')', 0, "nothing is known"),
    ],
)
def test_an_audit_says_what_it_found_or_that_it_could_not_look(
    tmp_path: Path, script: str, code: int, said: str
) -> None:
    done = audit(tmp_path, script)
    assert done.returncode == code
    assert said in done.stdout + done.stderr
    assert (done.stdout + done.stderr).count("\n") == 1
    assert bool(done.stderr) == bool(code)


def test_an_audit_without_its_tool_says_so(tmp_path: Path) -> None:
    done = subprocess.run(
        [sys.executable, str(FOLDER / "audit.py"), str(tmp_path / "none"), "run.txt"],
        capture_output=True,
        text=True,
        check=False,
    )
    assert (done.returncode, done.stderr.count("\n")) == (2, 1)
    assert "cannot be run" in done.stderr
