"""What the README and the pages of the documentation show is run: programs, commands, files."""

from __future__ import annotations

import json
import os
import re
import tomllib
import webbrowser
from pathlib import Path
from typing import TYPE_CHECKING, Any

import matplotlib as mpl
import matplotlib.pyplot as plt
import pytest

from page_files import provide, run_command
from pages import ROOT, Block, blocks_of, commands_of, page_paths

if TYPE_CHECKING:
    from collections.abc import Iterator

PAGES = page_paths()
#: Languages of blocks that are run or read here; those of the site itself; those that are only shown.
SHOWN = {"text"}
RUN = {"sh", "python", "toml", "json"}


def name_of(path: Path) -> str:
    return path.relative_to(ROOT).as_posix()


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Path]:
    """Return an empty folder to run a page in, with wide terminals and figures that are not shown."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("COLUMNS", "160")
    monkeypatch.setattr(webbrowser, "open", lambda *_: True)
    before = mpl.get_backend()
    plt.switch_backend("agg")
    yield tmp_path
    plt.close("all")
    plt.switch_backend(before)


def run_block(block: Block, names: dict[str, Any], monkeypatch: pytest.MonkeyPatch, capsys: Any) -> None:
    """Run a block, or read it where it is a file."""
    if block.language == "python":
        for name in re.findall(r"\"([\w.-]+\.(?:txt|toml|csv|dat))\"", block.text):
            provide(name)
        exec(compile(block.text, f"line {block.line}", "exec"), names)  # noqa: S102  # our own page
    elif block.language == "toml":
        tomllib.loads(block.text)
    elif block.language == "json":
        json.loads(block.text)
    else:
        for command in commands_of(block):
            if not is_of_the_source(command):
                assert command.startswith("singletrack "), f"line {block.line}: {command}: run it, or say why not"
                run_command(command, monkeypatch, capsys)


def is_of_the_source(command: str) -> bool:
    """Return whether a command is one that continuous integration runs, or an installation: what it names is there."""
    if found := re.fullmatch(r"make ([a-z-]+)", command):
        assert re.search(rf"^{found[1]}:", (ROOT / "Makefile").read_text(encoding="utf-8"), re.MULTILINE), command
    elif found := re.search(r"(?:^|/|\s)(?:pip|python -m pip) install '?\.(?:\[(.*)\])?'?$", command):
        extras = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
        assert set((found[1] or "dev").split(",")) <= set(extras["optional-dependencies"]), command
    return bool(found) or command == "python3 -m venv .venv"


# Those of the README are run by its own test.
@pytest.mark.parametrize("path", PAGES[1:], ids=name_of)
def test_every_block_runs(path: Path, folder: Path, monkeypatch: pytest.MonkeyPatch, capsys: Any) -> None:
    names: dict[str, Any] = {"__name__": "page"}
    for block in blocks_of(path.read_text(encoding="utf-8")):
        if block.language in RUN and not block.reason:
            run_block(block, names, monkeypatch, capsys)
    assert folder == Path.cwd()


@pytest.mark.parametrize("path", PAGES, ids=name_of)
def test_every_block_says_what_it_is(path: Path) -> None:
    blocks = blocks_of(path.read_text(encoding="utf-8"))
    assert [b.line for b in blocks if b.language not in RUN | SHOWN and not b.language.startswith("{")] == []


@pytest.mark.parametrize("path", PAGES, ids=name_of)
def test_links_lead_somewhere(path: Path) -> None:
    """Links to files; Sphinx checks those to pages and headings when the site is built."""
    text = re.sub(r"```.*?```|`[^`\n]*`", "", path.read_text(encoding="utf-8"), flags=re.DOTALL)
    for link in re.findall(r"\]\(([^)#{}\s]+)(?:#[^)]*)?\)", text):
        if "auto_gallery" in link or "generated/" in link or "_static/" in link or "://" in link:
            continue  # written when the site is built
        assert (path.parent / link).exists() or (path.parent / f"{link}.md").exists(), link


def test_a_block_that_is_not_run_has_a_reason() -> None:
    """Of all commands that a reader can copy few are not run: those that need a network, an administrator, or hours."""
    blocks = [block for path in PAGES for block in blocks_of(path.read_text(encoding="utf-8"))]
    left = [block for block in blocks if block.reason]
    assert all(len(block.reason.split()) > 3 for block in left)
    assert len(left) < 0.15 * len([block for block in blocks if block.language in RUN])


def test_blocks_are_found() -> None:
    text = "a\n```sh\nx --a \\\n  b # c\n# d\n```\n<!-- not run: it waits for a person -->\n```python\nf()\n```\n"
    first, second = blocks_of(text)
    assert (first.language, first.line, first.reason) == ("sh", 2, "")
    assert commands_of(first) == ["x --a    b"]
    assert (second.language, second.reason) == ("python", "it waits for a person")


def test_no_block_is_run_where_it_is_shown_only() -> None:
    assert not SHOWN & RUN
    assert os.environ.get("SINGLETRACK_TRACEBACK") is None
