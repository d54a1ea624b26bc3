"""What the README says runs."""

from __future__ import annotations

import re
import shlex
import sys
from pathlib import Path

import pytest

from singletrack.commands import app as cli
from singletrack.reproduce.cases import paper_cases
from singletrack.reproduce.claims import check_claims

README = Path(__file__).parents[1] / "README.md"
COMMANDS = [
    line.partition("#")[0].strip()
    for block in re.findall(r"```sh\n(.*?)```", README.read_text(), re.DOTALL)
    for line in block.splitlines()
    if line.startswith("singletrack ") and not re.search(r"MEASUREMENTS|STUDY", line)  # the user's own files
]


@pytest.mark.parametrize("command", COMMANDS)
def test_commands(command, monkeypatch, capsys, tmp_path):
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(sys, "argv", shlex.split(command.partition(">")[0]))
    with pytest.raises(SystemExit) as stop:
        cli.main()
    assert stop.value.code == 0
    assert capsys.readouterr().out


def test_python():
    block = "\n".join(re.findall(r"```python\n(.*?)```", README.read_text(), re.DOTALL))
    names: dict[str, object] = {}
    exec(compile(block, str(README), "exec"), names)  # noqa: S102  # our own README
    assert names["trails"].M.shape == (1000, 2, 2)
    assert names["motion"].sizes["time"] == 501


def test_verdicts():
    claims = check_claims(paper_cases())
    holds, partly = (sum(claim.verdict == verdict for claim in claims) for verdict in ("holds", "holds in part"))
    assert f"({holds} of {len(claims)} hold, {partly} in part;" in README.read_text()


def test_links():
    for link in re.findall(r"\]\(([^)]*)\)", README.read_text()):
        assert (README.parent / link).exists(), link
