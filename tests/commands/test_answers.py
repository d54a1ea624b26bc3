"""What commands print and draw is what the library answers: identify, control, design, in text, JSON and figures."""

from __future__ import annotations

import json
import re
import xml.etree.ElementTree as ET
from typing import TYPE_CHECKING

import numpy as np
import pytest

from singletrack import InputError, coefficients, load_bicycle, load_rider
from singletrack.body.fit import elbow_angle
from singletrack.commands.door import run
from singletrack.library.measured import load_measured_modes

if TYPE_CHECKING:
    from pathlib import Path

VARY = ["--vary", "trail=20mm:120mm", "--vary", "steer_axis_tilt=12deg:25deg"]


@pytest.fixture
def records(tmp_path: Path) -> list[str]:
    """Two records of one oscillation, -0.5 +- 4i 1/s, under a name, with a little noise."""
    t = np.linspace(0, 6, 601)
    files = []
    for seed in (1, 2):
        w = np.exp(-0.5 * t) * np.cos(4 * t) + 1e-3 * np.random.default_rng(seed).normal(size=t.size)
        path = tmp_path / f"rates{seed}.csv"
        path.write_text("time,w\n\n" + "".join(f"{a:.3f},{b:.6f}\n" for a, b in zip(t, w, strict=True)))
        files.append(str(path))
    return files


def test_identified_records_are_told_alone_together_and_beside_the_model(
    records: list[str], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    figure = tmp_path / "points.svg"
    options = ["--column", "w", "--bicycle", "benchmark", "--speed", "5", "--plot", str(figure)]
    assert run(["identify", *records, *options]) == 0
    told = capsys.readouterr().out
    pairs = re.findall(r"(-?\d\.\d+) ± \S+, (\d\.\d+) ±", told)
    assert len(pairs) == 3
    for pair in pairs:
        np.testing.assert_allclose([float(number) for number in pair], [-0.5, 4.0], atol=5e-3)
    weave = coefficients(load_bicycle("benchmark")).eigenvalues(5.0)[0, 2]
    assert f"model: {weave.real:.4f}, {weave.imag:.4f} 1/s" in told
    ET.fromstring(figure.read_bytes())  # noqa: S314  # our own file
    assert run(["identify", *records, "--column", "w", "--json"]) == 0
    found = json.loads(capsys.readouterr().out)
    np.testing.assert_allclose(found["eigenvalue"], [-0.5, 4.0], atol=5e-3)
    assert [one["file"] for one in found["runs"]] == records


@pytest.fixture
def published(tmp_path: Path) -> Path:
    """The shipped measured set as a file: what was measured is what the model gives, but for one run."""
    bicycle, measured = load_bicycle("kooijman-2008"), load_measured_modes("kooijman-2008")
    values = {name: float(value) for name, value in bicycle.values().items() if value is not None}
    values["steer_axis_tilt_deg"] = float(np.degrees(values.pop("steer_axis_tilt")))
    parts = (measured.lowest_speeds, measured.highest_speeds, measured.eigenvalues.real, measured.eigenvalues.imag)
    path = tmp_path / "set.json"
    path.write_text(json.dumps({"bicycle": values, "measured_weave": {"rows": np.transpose(parts).tolist()}}))
    return path


def test_a_published_set_is_compared_with_its_own_model(
    published: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    figure = tmp_path / "set.svg"
    assert run(["identify", str(published), "--plot", str(figure)]) == 0
    told = capsys.readouterr().out
    assert "26 runs, weave measured and computed" in told
    assert figure.stat().st_size > 5000
    assert run(["identify", str(published), "--json"]) == 0
    found = json.loads(capsys.readouterr().out)
    assert found["rms"] == pytest.approx(float(re.search(r"rms difference (\S+)", told)[1]), abs=5e-4)  # type: ignore[index]
    parts = np.array(found["measured"]) - np.array(found["computed"])
    assert found["rms"] == pytest.approx(np.sqrt(np.mean(np.sum(parts**2, axis=-1))), rel=0.5)
    with pytest.raises(InputError, match="a published set is compared alone"):
        run(["identify", str(published), str(published)])


@pytest.mark.parametrize(
    ("changed", "words"),
    [
        ("{", "is not valid JSON"),
        ("[]", "must have a 'bicycle'"),
        ('{"bicycle": {"trail": true}}', "bicycle trail = 'True', must be a finite number"),
        ('{"bicycle": {"trail": 1}}', "measured_weave must have rows"),
        ('{"bicycle": {}, "measured_weave": {"rows": [[1, 2], [3]]}}', "measured_weave must have rows"),
        ('{"bicycle": {}, "measured_weave": {"rows": [[1, 2, 3, NaN]]}}', "measured_weave must have rows"),
    ],
)
def test_what_is_no_published_set(changed: str, words: str, tmp_path: Path) -> None:
    path = tmp_path / "set.json"
    path.write_text(changed)
    with pytest.raises(InputError, match=rf"set\.json: .*{words}"):
        run(["identify", str(path)])


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("time,w\n", "has no rows under its names"),
        ("time,w\n0\n", "line 2: w is '', must be a finite number"),
        ("time,w\n0,৪\n", "line 2: w is '৪', must be a finite number"),
        ("time,v\n0,1\n", "line 1: unknown column 'w'"),
    ],
)
def test_what_is_no_record(text: str, words: str, tmp_path: Path) -> None:
    path = tmp_path / "rates.csv"
    path.write_text(text)
    with pytest.raises(InputError, match=words):
        run(["identify", str(path), "--column", "w"])
    with pytest.raises(InputError, match="there is no such file"):
        run(["identify", str(path.with_name("none.csv")), "--column", "w"])


def test_control_is_drawn_and_printed(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    angles, locus = tmp_path / "angles.svg", tmp_path / "locus.svg"
    options = ["--speeds", "4:8:3", "--input", "steer torque", "--plot", str(angles), "--locus", str(locus)]
    assert run(["control", "benchmark", *options]) == 0
    assert "steer torque" in capsys.readouterr().out
    for file in (angles, locus):
        ET.fromstring(file.read_bytes())  # noqa: S314  # our own file


def test_a_front_is_a_table_of_designs(capsys: pytest.CaptureFixture[str]) -> None:
    aims = ["--aim", "widest=10", "--aim", "effort=4", "--points", "3", "--starts", "1"]
    assert run(["design", "benchmark", *VARY, *aims]) == 0
    told = capsys.readouterr().out
    assert "first aim" in told
    assert "trail (mm)" in told
    with pytest.raises(InputError, match="must be one or two"):
        run(["design", "benchmark", *VARY, *aims, "--aim", "weave"])
    with pytest.raises(InputError, match="is for one aim"):
        run(["design", "benchmark", *VARY, *aims, "-o", "found.toml"])


def test_the_matrices_of_another_are_an_aim(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    wanted = tmp_path / "wanted.json"
    bicycle = load_bicycle("benchmark").replace(trail=0.06)
    wanted.write_text(json.dumps(coefficients(bicycle).to_dict()))
    options = ["--aim", f"matrices={wanted}", "--vary", "trail=20mm:120mm", "--starts", "1", "--json"]
    assert run(["design", "benchmark", *options]) == 0
    assert json.loads(capsys.readouterr().out)["parameters"]["trail"] == pytest.approx(0.06, abs=1e-4)


def test_a_rider_may_be_kept_at_his_elbows(capsys: pytest.CaptureFixture[str]) -> None:
    options = ["--rider", "rider-a", "--posture", "leaned", "--fit", "--aim", "weave", "--starts", "1"]
    vary, keep = ["--vary", "stem_length=0.18:0.2"], ["--keep", "front_clearance=:0.5"]
    assert run(["design", "stratos", *options, *vary, *keep]) == 0
    told = capsys.readouterr().out
    before = np.degrees(float(load_rider("rider-a").on(load_bicycle("stratos")).forward_lean_angle))
    assert f"forward_lean_angle {before:.2f} deg before" in told
    assert float(elbow_angle(load_bicycle("stratos"), load_rider("rider-a").on(load_bicycle("stratos")))) < np.pi


@pytest.mark.parametrize("aim", ["", "stable", "stable=1", "widest=x", "weave=3", "nothing", "effort=1 kg"])
def test_what_is_no_aim(aim: str) -> None:
    with pytest.raises(InputError, match="--aim"):
        run(["design", "benchmark", *VARY, "--aim", aim])


@pytest.mark.parametrize("keep", ["trail", "trail=1", "trail=:", "trail=1:2:3", "trail=a:b"])
def test_what_keeps_nothing(keep: str) -> None:
    with pytest.raises(InputError, match="--keep"):
        run(["design", "benchmark", *VARY, "--aim", "weave", "--keep", keep])
