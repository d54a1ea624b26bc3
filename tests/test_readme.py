"""What the README says runs."""

from __future__ import annotations

import re
import webbrowser
from pathlib import Path
from typing import Any

import pytest
from PIL import Image, ImageSequence

from page_files import run_command
from singletrack.reproduce.cases import paper_cases
from singletrack.reproduce.measured import measured_case
from singletrack.reproduce.statements import check_statements

README = Path(__file__).parents[1] / "README.md"
COMMANDS = [
    line.partition("#")[0].strip()
    for block in re.findall(r"```sh\n(.*?)```", README.read_text(), re.DOTALL)
    for line in block.splitlines()
    if line.startswith("singletrack ")
]


@pytest.mark.parametrize("command", COMMANDS)
def test_commands(command, monkeypatch, capsys, tmp_path):
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(webbrowser, "open", lambda *_: True)
    run_command(command, monkeypatch, capsys)


def test_python(monkeypatch, tmp_path):
    monkeypatch.chdir(tmp_path)
    block = "\n".join(re.findall(r"```python\n(.*?)```", README.read_text(), re.DOTALL))
    names: dict[str, Any] = {}
    exec(compile(block, str(README), "exec"), names)  # noqa: S102  # our own README
    assert names["model"].M.shape == (2, 2)
    assert (tmp_path / "stratos.png").stat().st_size > 10_000


def test_it_fits_a_screen():
    assert len(README.read_text().splitlines()) <= 65


def test_the_picture_moves():
    file = README.parent / "docs" / "figures" / "weave.gif"
    with Image.open(file) as picture:
        frames = sum(1 for _ in ImageSequence.Iterator(picture))
    assert frames > 20
    assert file.stat().st_size < 500_000


def test_verdicts():
    statements = check_statements(paper_cases(), measured_case())
    for paper, words in {
        "founding": "({} of {} hold, {} in part;",
        "journal": "{} of {}, {} in part, in its journal",
    }.items():
        own = [one for one in statements if one.paper == paper]
        holds, partly = (sum(one.verdict == verdict for one in own) for verdict in ("holds", "holds in part"))
        assert words.format(holds, len(own), partly) in " ".join(README.read_text().split())


def test_links():
    for link in re.findall(r"\]\(([^)]*)\)", README.read_text()):
        assert (README.parent / link).exists(), link
