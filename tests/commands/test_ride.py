"""``singletrack ride``, as a user runs it."""

from __future__ import annotations

import csv
import io
import json
import sys
from typing import Any

import numpy as np
import pytest
import xarray as xr
from PIL import Image

from singletrack.commands import app as cli


@pytest.fixture
def run(monkeypatch: Any, capsys: Any) -> Any:
    def run(*arguments: str) -> Any:
        monkeypatch.setattr(sys, "argv", ["singletrack", "ride", *arguments])
        with pytest.raises(SystemExit) as stop:
            cli.main()
        captured = capsys.readouterr()
        return stop.value.code, captured.out, captured.err

    return run


def test_a_fall_is_said_drawn_animated_and_written(run: Any, tmp_path: Any) -> None:
    data, figure, movie = (tmp_path / name for name in ("run.nc", "run.svg", "run.gif"))
    rider = ("--rider", "rider-a", "--posture", "upright")
    files = ("-o", str(data), "--plot", str(figure), "--animate", str(movie))
    code, out, _ = run("browser", *rider, "--speed", "4", "--push", "0.3", "--for", "3", *files)
    assert code == 0
    assert "fell to the right" in out
    with xr.open_dataset(data, engine="scipy") as found:
        assert found.attrs["end"].startswith("fell to the right")
        assert float(found.time[-1]) == pytest.approx(float(found.attrs["end_time"]))
        assert float(found.q.sel(coordinate="lean")[-1]) > np.radians(45.0)
        duration = float(found.time[-1])
    assert figure.read_text().startswith("<?xml")
    with Image.open(movie) as image:
        assert image.n_frames == pytest.approx(20 * duration, abs=1.5)


def test_csv_and_json_hold_the_same_ride(run: Any, tmp_path: Any) -> None:
    table = tmp_path / "run.csv"
    code, out, _ = run("benchmark", "--speed", "4.6", "--push", "0.5 rad/s", "--for", "2", "-o", str(table), "--json")
    assert code == 0
    found = json.loads(out[out.index("{") :])
    assert found["whole"]
    assert found["end_time"] == 2.0
    rows = list(csv.DictReader(io.StringIO(table.read_text())))
    assert max(abs(float(row["lean"])) for row in rows) == pytest.approx(found["greatest_lean"], rel=1e-12)
    assert float(rows[0]["lean rate"]) == 0.5
    assert float(rows[-1]["time"]) == 2.0


def test_a_torque_from_a_file_is_felt(run: Any, tmp_path: Any) -> None:
    torque = tmp_path / "torque.txt"
    torque.write_text("time, torque\n0, 0\n0.5, 1\n1, 0\n")
    code, out, _ = run("benchmark", "--speed", "5", "--torque", str(torque), "--for", "1", "--json")
    pushed = json.loads(out)
    assert code == 0
    assert pushed["greatest_lean"] > 0.01
    _, out, _ = run("benchmark", "--speed", "5", "--for", "1", "--json")
    assert json.loads(out)["greatest_lean"] == pytest.approx(0.0, abs=1e-9)


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (("--speed", "5", "--for", "0"), "duration: 0.0 s"),
        (("--speed", "5", "-o", "run.doc"), "unknown suffix '.doc'"),
        (("--speed", "5", "--animate", "run.png"), "unknown suffix '.png'"),
        (("--speed", "quick"), "--speed"),
        (("--speed", "5", "--torque", "nowhere.txt"), "nowhere.txt"),
    ],
)
def test_what_cannot_be_is_said(run: Any, arguments: Any, message: str) -> None:
    code, out, err = run("benchmark", *arguments)
    assert code == 2
    assert out == ""
    assert message in err


def test_progress_is_drawn_on_terminals_only(run: Any) -> None:
    code, _, said = run("stratos", "--speed", "6", "--for", "0.1")
    assert (code, said) == (0, "")
