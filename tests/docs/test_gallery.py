"""The gallery: every script stands on what is there, says which command does the same, and no command is missing.

The scripts are executed when the site is built; here nothing is computed.
"""

from __future__ import annotations

import ast
import importlib
import re
import shlex
from pathlib import Path
from typing import Any

import pytest

from singletrack.commands.door import COMMANDS, command

GALLERY = Path(__file__).parents[2] / "docs" / "gallery"
SCRIPTS = sorted(GALLERY.glob("plot_*.py"))
#: What the gallery owes: each subject is the name of a script.
SUBJECTS = {
    "figure_4b", "my_bicycle", "pendulums", "own_posture", "torso_lean", "controllability", "effort", "sensitivity",
    "trail_and_head_angle", "city_bicycle", "steady_turn", "fall", "four_bar", "soft_fork", "a_million_designs",
    "geometry_sheet", "compare", "measured_weave", "certificates",
}  # fmt: skip


def commands_of(script: Path) -> list[str]:
    """Return the command lines that a script quotes, those that go on joined."""
    blocks = re.findall(
        r"^# \.\. code-block:: sh\n#\n((?:#    .*\n?)+)", script.read_text(encoding="utf-8"), re.MULTILINE
    )
    text = "\n".join(line[5:] for block in blocks for line in block.splitlines())
    return text.replace("\\\n", " ").splitlines()


def test_every_subject_has_a_script():
    names = [re.sub(r"plot_\d\d_", "", script.stem) for script in SCRIPTS]
    assert len(names) == len(set(names))
    assert set(names) >= SUBJECTS


@pytest.mark.parametrize("script", SCRIPTS, ids=lambda script: script.stem)
def test_names_of_the_package_exist(script):
    tree = ast.parse(script.read_text(encoding="utf-8"))
    asked = [
        (node.module, alias.name) for node in ast.walk(tree) if isinstance(node, ast.ImportFrom) for alias in node.names
    ]
    ours = [(module, name) for module, name in asked if str(module).startswith("singletrack")]
    assert ours
    for module, name in ours:
        assert not any(part.startswith("_") for part in (*str(module).split("."), name)), f"{name} is private"
        assert hasattr(importlib.import_module(str(module)), name), f"{module} has no {name}"


@pytest.mark.parametrize("script", SCRIPTS, ids=lambda script: script.stem)
def test_a_script_is_a_page(script):
    text = script.read_text(encoding="utf-8")
    title, line, empty, *_ = str(ast.get_docstring(ast.parse(text))).splitlines()
    assert len(title) <= len(line), "the line under the title is as long as the title"
    assert (set(line), empty) == ({"="}, "")
    assert re.search(r"^# What is seen\n# -+$", text, re.MULTILINE)
    assert "figure" in text
    assert "shared" not in text, "a script reads what comes with the package or lies beside it"
    for file in re.findall(r"[\"'</]([\w-]+\.toml)[\"'>]", text):
        assert file in re.findall(r"[\w-]+\.toml", "\n".join(commands_of(script))) or (GALLERY / file).is_file(), file


@pytest.mark.parametrize("script", SCRIPTS, ids=lambda script: script.stem)
def test_commands_are_commands(script):
    lines = commands_of(script)
    for line in lines:
        program, name, *arguments = shlex.split(line.partition(" > ")[0])
        assert program == "singletrack"
        parsed: Any = command(name).make_context(name, arguments)  # which refuses options that are none
        assert parsed.command.name == name
    assert lines or "four_bar" in script.stem, "the engine alone has no command"


def test_no_command_is_missing():
    quoted = {shlex.split(line)[1] for script in SCRIPTS for line in commands_of(script)}
    assert set(COMMANDS) == quoted
