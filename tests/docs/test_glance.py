"""The pages of one line for each command and of the first programs, whose blocks `tests/test_pages.py` runs."""

from __future__ import annotations

import re
import shlex
from pathlib import Path
from typing import Any

from singletrack.commands.door import COMMANDS as DOOR

PAGES = Path(__file__).parents[2] / "docs" / "howto"
LINES = [
    line.partition(" #")[0].strip()
    for block in re.findall(r"```sh\n(.*?)```", (PAGES / "commands.md").read_text(encoding="utf-8"), re.DOTALL)
    for line in block.splitlines()
]


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
