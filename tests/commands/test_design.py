"""``singletrack design``: finds, resumes, writes, and says what is wrong."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest

from singletrack import load_bicycle
from singletrack.analysis.derivatives import derivatives_of
from singletrack.analysis.designs import Design
from singletrack.analysis.effort_aim import LeastEffort
from singletrack.commands.door import run
from singletrack.control import effort
from singletrack.errors import InputError

VARY = ["--vary", "trail=20mm:120mm", "--vary", "steer_axis_tilt=12deg:25deg"]


def test_finds_and_says_what_binds(capsys, tmp_path):
    file = tmp_path / "found.toml"
    assert run(["design", "browser", "--aim", "widest", *VARY, "--starts", "2", "-o", str(file)]) == 0
    printed = capsys.readouterr().out
    assert "what holds it back" in printed
    assert "searches end there" in printed
    found = load_bicycle(str(file))
    assert 0.02 <= found.trail <= 0.12
    assert found.name == "browser"  # the rider is known by it


def test_an_interrupted_search_goes_on(capsys, tmp_path):
    state = tmp_path / "state.json"
    arguments = ["design", "benchmark", "--aim", "weave", *VARY, "--seed", "3", "--state", str(state), "--json"]
    assert run([*arguments, "--starts", "3"]) == 0
    whole = json.loads(capsys.readouterr().out)
    data = json.loads(state.read_text())
    assert len(data["found"]) == 3
    state.write_text(json.dumps(data | {"found": data["found"][:2]}))  # as if it had been interrupted
    assert run([*arguments, "--starts", "3"]) == 0
    assert json.loads(capsys.readouterr().out) == whole
    with pytest.raises(InputError, match="is of another problem"):
        run([*arguments[:-1], "--vary", "wheel_base=1:1.1"])
    state.write_text("nothing")
    with pytest.raises(InputError, match="is no state of a search"):
        run(arguments)


def test_the_front_of_two_aims(capsys):
    arguments = ["--aim", "widest", "--aim", "effort=4", "--points", "4", "--starts", "1", "--json"]
    assert run(["design", "benchmark", *VARY, *arguments]) == 0
    front = json.loads(capsys.readouterr().out)
    values = np.array(front["values"])
    assert len(values) >= 3
    assert (np.diff(values[:, 0]) > 0).all()
    assert (np.diff(values[:, 1]) < 0).all()


def test_an_interrupted_front_goes_on(capsys, tmp_path):
    state = tmp_path / "front.json"
    aims = ["--aim", "widest", "--aim", "effort=4", "--points", "4", "--starts", "2", "--state", str(state), "--json"]
    assert run(["design", "benchmark", *VARY, *aims]) == 0
    whole = json.loads(capsys.readouterr().out)
    data = json.loads(state.read_text())
    assert len(data["found"]) == 2 * 2 + 2 * 2  # both ends, and from both neighbours at two points between
    for kept in (1, 5, 8):
        state.write_text(json.dumps(data | {"found": data["found"][:kept]}))
        assert run(["design", "benchmark", *VARY, *aims]) == 0
        assert json.loads(capsys.readouterr().out) == whole
        assert len(json.loads(state.read_text())["found"]) == 8


def test_the_cost_of_control_and_its_gradient():
    design = Design.of(load_bicycle("benchmark"))
    names = ("trail", "gravity", "front_frame_mass")
    aim = LeastEffort((3.0, 5.0))
    values, rows = aim(derivatives_of(design, names))
    assert values[0] == pytest.approx(effort(design.model(), [3.0, 5.0]).cost.mean(), rel=1e-9)
    for i, name in enumerate(names):
        own, h = float(design.values()[name]), 1e-5
        ends = [aim(derivatives_of(design.changed({name: own + d}), names))[0][0] for d in (h, -h)]
        assert rows[0, i] == pytest.approx((ends[0] - ends[1]) / (2 * h), rel=1e-5)


def test_matrices_as_an_aim(capsys, tmp_path):
    wanted = load_bicycle("benchmark").replace(trail=0.05)
    file = tmp_path / "wanted.json"
    file.write_text(json.dumps(Design.of(wanted).model().to_dict()))
    arguments = ["--aim", f"matrices={file}", "--vary", "trail=20mm:120mm", "--starts", "1", "--json"]
    assert run(["design", "benchmark", *arguments]) == 0
    assert json.loads(capsys.readouterr().out)["parameters"]["trail"] == pytest.approx(0.05, rel=1e-5)


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (["--aim", "fast", *VARY], "--aim 'fast': must be stable="),
        (["--aim", "stable=3", *VARY], "must be stable="),
        (["--aim", "widest", "--vary", "trail=1"], "must be NAME=LOW:HIGH"),
        (["--aim", "widest", "--vary", "trial=1:2"], "unknown parameter 'trial'"),
        (["--aim", "widest", *VARY, "--keep", "width=1:"], "unknown quantity 'width'"),
        (["--aim", "widest", *VARY, "--keep", "reach=0.3:"], "needs frame geometry"),
        (["--aim", "widest", "--aim", "weave", "--aim", "widest", *VARY], "must be one or two"),
    ],
    ids=lambda a: " ".join(a) if isinstance(a, list) else "",
)
def test_what_is_wrong_is_said(arguments, words):
    with pytest.raises(InputError) as caught:
        run(["design", "benchmark", *arguments])
    assert words in str(caught.value)


SHEET = """
kind = "sheet"
head_angle = "69 deg"
fork_offset = "50 mm"
wheel_size = "37-622"
wheel_base = "1.10 m"
"""


@pytest.fixture
def sheet(tmp_path):
    file = tmp_path / "mine.toml"
    file.write_text(SHEET)
    return str(file)


def test_a_sheet_is_searched_by_its_own_entries(capsys, sheet, tmp_path):
    found = tmp_path / "found.toml"
    arguments = ["--aim", "widest", "--vary", "head_angle=66deg:72deg", "--vary", "stem_length=40mm:130mm"]
    kept = ["--keep", "front_clearance=300mm:", "--starts", "2", "-o", str(found)]
    assert run(["design", sheet, *arguments, *kept]) == 0
    printed = capsys.readouterr().out
    assert "head_angle" in printed
    assert "mine: minus the widest stable range" in printed
    bicycle = load_bicycle(str(found))
    assert np.radians(18) - 1e-9 <= bicycle.steer_axis_tilt <= np.radians(24) + 1e-9
    assert bicycle.rear_frame_inertia_xx > 0.1


def test_a_sheet_stands_for_its_bicycle(capsys, sheet):
    assert run(["critical-speeds", sheet, "--json"]) == 0
    one = json.loads(capsys.readouterr().out)
    assert run(["new", sheet]) == 0
    bicycle = Path(sheet).with_name("made.toml")
    bicycle.write_text(capsys.readouterr().out)
    assert run(["critical-speeds", str(bicycle), "--json"]) == 0
    assert json.loads(capsys.readouterr().out) == one
    assert run(["sensitivity", sheet, "--json"]) == 0
    assert "fork_offset" in json.loads(capsys.readouterr().out)["parameters"]


@pytest.mark.parametrize(
    ("text", "arguments", "words"),
    [
        (SHEET, ["--vary", "trail=20mm:80mm"], "trail: cannot vary, it follows"),
        (SHEET, ["--vary", "head_angle=60deg:75deg", "--set", "trail=0.05"], "change the sheet"),
        (SHEET, ["--vary", "wheel_size=1:2"], "wheel_size: cannot vary, it is no number"),
        (SHEET + 'trail = "20 mm"\n', ["--vary", "head_angle=60deg:75deg"], "trail contradicts itself"),
        (SHEET + 'fork_ofset = "1 mm"\n', ["--vary", "head_angle=60deg:75deg"], "line 7: unknown entry 'fork_ofset'"),
    ],
)
def test_what_is_wrong_with_a_sheet_is_said(tmp_path, text, arguments, words):
    file = tmp_path / "sheet.toml"
    file.write_text(text)
    with pytest.raises(InputError) as caught:
        run(["design", str(file), "--aim", "widest", *arguments])
    assert words in str(caught.value)
