"""The pages of one line for each command and of the first programs: what they show runs."""

from __future__ import annotations

import re
import shlex
import sys
from pathlib import Path
from typing import Any

import pytest

from singletrack.commands import app as cli
from singletrack.commands.door import COMMANDS as DOOR

PAGES = Path(__file__).parents[2] / "docs" / "howto"
LINES = [
    line.partition(" #")[0].strip()
    for block in re.findall(r"```sh\n(.*?)```", (PAGES / "commands.md").read_text(encoding="utf-8"), re.DOTALL)
    for line in block.splitlines()
]


@pytest.mark.parametrize(
    "command", [line for line in LINES if not re.search(r"MEASUREMENTS|STUDY|RECORD|FILE\.dat", line)]
)
def test_commands(command, monkeypatch, capsys, tmp_path):
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(sys, "argv", shlex.split(command.partition(">")[0]))
    with pytest.raises(SystemExit) as stop:
        cli.main()
    assert stop.value.code == 0
    assert capsys.readouterr().out


def test_no_command_is_missing():
    beside = {"reproduce", "period", "schema"}  # in the README; with measuring; for editors
    assert {shlex.split(line)[1] for line in LINES} == set(DOOR) - beside


def test_python():
    path = PAGES / "python.md"
    block = "\n".join(re.findall(r"```python\n(.*?)```", path.read_text(encoding="utf-8"), re.DOTALL))
    names: dict[str, Any] = {}
    exec(compile(block, str(path), "exec"), names)  # noqa: S102  # our own page
    assert names["trails"].M.shape == (1000, 2, 2)
    assert names["motion"].sizes["time"] == 501
