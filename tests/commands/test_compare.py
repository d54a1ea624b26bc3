"""``singletrack compare``."""

from __future__ import annotations

import json

import pytest

from singletrack.commands.door import run
from singletrack.errors import InputError


def test_tables_and_figure(capsys, tmp_path):
    assert run(["compare", "stratos", "browser", "--rider", "rider-a", "--speeds", "4, 6"]) == 0
    printed = capsys.readouterr().out
    for word in ("parameters that differ", "weave speed", "damping ratio of weave at 6 m/s", "Cossalter", "stable"):
        assert word in printed
    file = tmp_path / "both.pdf"
    assert run(["compare", "stratos", "browser", "benchmark", "-o", str(file)]) == 0
    assert file.read_bytes().startswith(b"%PDF")


def test_json(capsys):
    assert run(["compare", "stratos", "browser", "--json"]) == 0
    found = json.loads(capsys.readouterr().out)
    assert found["designs"] == ["stratos", "browser"]
    assert {"name", "unit", "values", "source"} <= set(found["measures"][0])


def test_one_is_refused():
    with pytest.raises(InputError, match="must be two or more"):
        run(["compare", "stratos"])
