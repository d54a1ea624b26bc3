"""``singletrack turn``, as a user runs it."""

from __future__ import annotations

import json
import sys
from typing import Any

import pytest

from singletrack.commands import app as cli


@pytest.fixture
def run(monkeypatch: Any, capsys: Any) -> Any:
    def run(*arguments: str) -> Any:
        monkeypatch.setattr(sys, "argv", ["singletrack", "turn", *arguments])
        with pytest.raises(SystemExit) as stop:
            cli.main()
        captured = capsys.readouterr()
        return stop.value.code, captured.out, captured.err

    return run


def test_a_turn_is_printed_and_drawn(run: Any, tmp_path: Any) -> None:
    figure = tmp_path / "turn.svg"
    rider = ("--rider", "rider-a", "--posture", "leaned")
    code, out, _ = run("stratos", *rider, "--speed", "18 km/h", "--lean", "10 deg", "--plot", str(figure))
    assert code == 0
    assert "steady turn of stratos with rider-a, leaned" in out
    assert "hand torque" in out
    assert "right hand, on the bar" in out
    assert "weave" in out
    assert figure.read_text().startswith("<?xml")


def test_json_has_everything(run: Any) -> None:
    code, out, _ = run("benchmark", "--speed", "6", "--radius", "10", "--json")
    found = json.loads(out)
    assert code == 0
    assert found["radius"] == pytest.approx(10.0)
    assert found["modes"] == ["weave", "weave", "capsize", "castering", "speed"]
    assert len(found["eigenvalues"]) == 5
    assert found["hand_forces"] == {}


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (("benchmark", "--speed", "6"), "--lean and --radius"),
        (("benchmark", "--speed", "6", "--lean", "1", "--radius", "2"), "--lean and --radius"),
        (("benchmark", "--speed", "fast", "--lean", "0.1"), "--speed"),
        (("benchmark", "--speed", "0", "--lean", "0.1"), "a turn needs a speed above zero"),
        (("benchmark", "--speed", "6", "--lean", "85 deg"), "no such turn at 6 m/s"),
        (("benchmark", "--speed", "6", "--lean", "0.1", "--plot", "turn.doc"), "unknown suffix"),
    ],
)
def test_what_cannot_be_is_said(run: Any, arguments: Any, message: str) -> None:
    code, out, err = run(*arguments)
    assert code == 2
    assert out == ""
    assert message in err
