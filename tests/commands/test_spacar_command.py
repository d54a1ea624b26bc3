"""``singletrack spacar``: the state at the end, small motions, statics; bad files end with code 2 and one message."""

from __future__ import annotations

import json
import subprocess
import sys

import numpy as np
import pytest

PENDULUM = """
PLHINGE 1 10 2
PLBEAM 2 1 2 3 4
X 3 0 -1
FIX 1
FIX 10
DYNE 1 1
MASS 3 2
GRAVITY 0 -9.81
E 1 1 0.001
TIMESTEP 4 0.4
INPUTS 1 1 1
OUTE 1 1 1
"""


def run(*arguments):
    command = [sys.executable, "-m", "singletrack", "spacar", *map(str, arguments)]
    return subprocess.run(command, capture_output=True, text=True, check=False)


@pytest.fixture
def file(tmp_path):
    path = tmp_path / "pendulum.dat"
    path.write_text(PENDULUM)
    return path


def test_json(file):
    done = run(file, "--json")
    assert done.returncode == 0
    assert done.stderr == ""
    data = json.loads(done.stdout)
    rate = np.sqrt(9.81)
    assert data["time"] == 0.4
    assert data["e"]["1"][0] == pytest.approx(0.001 * np.cos(rate * 0.4), rel=1e-5)
    assert data["ed"]["1"][0] == pytest.approx(-0.001 * rate * np.sin(rate * 0.4), rel=1e-5)
    assert data["edd"]["1"][0] == pytest.approx(-9.81 * np.sin(data["e"]["1"][0]), rel=1e-9)
    assert np.array(data["x"]["3"]) == pytest.approx([np.sin(data["e"]["1"][0]), -np.cos(data["e"]["1"][0])], rel=1e-9)
    linear = data["linear"]
    assert linear["M"][0][0] == pytest.approx(2.0, rel=1e-12)
    assert linear["K"][0][0] == pytest.approx(2 * 9.81, rel=1e-5)
    assert sorted(abs(im) for _, im in linear["eigenvalues"]) == pytest.approx([rate, rate], rel=1e-5)
    assert (linear["inputs"], linear["outputs"]) == (["1: e 1 1"], ["1: e 1 1"])


def test_history(file, tmp_path):
    assert run(file, "--history", tmp_path / "motion.csv").returncode == 0
    lines = (tmp_path / "motion.csv").read_text().splitlines()
    assert len(lines) == 1 + 5
    last = dict(zip(lines[0].split(","), map(float, lines[-1].split(",")), strict=True))
    assert last["time"] == 0.4
    assert last["e 1 1"] == pytest.approx(0.001 * np.cos(np.sqrt(9.81) * 0.4), rel=1e-5)
    assert run(file, "--history", tmp_path).returncode == 2


def test_text_and_listing(file):
    done = run(file)
    assert done.returncode == 0
    assert "dynamic: e 1 1" in done.stdout
    assert "eigenvalues of small motions in e 1 1" in done.stdout
    assert "at 0.4 s" not in run(file, "--listing").stdout


def test_statics(tmp_path):
    path = tmp_path / "column.dat"
    path.write_text("PLBEAMNL 1 1 2 3 4\nX 3 2 0\nFIX 1\nFIX 2\nDYNE 1 2 3\nESTIFF 1 0 3\nEMASS 1 1\nFORCE 3 -1 0\n")
    data = json.loads(run(path, "--equilibrium", "--buckling", "--json").stdout)
    assert data["buckling"]["factors"][0] == pytest.approx(np.pi**2 * 3 / 16, rel=0.01)
    assert len(data["frequencies"]) == 2
    assert "factors of the loads" in run(path, "--buckling").stdout


def test_bad_files_end_with_code_2_and_one_message(tmp_path):
    path = tmp_path / "bad.dat"
    path.write_text("PLBEAM 1 1 2 3 4\nX 3 1 0\nSURFACE 1\n")
    done = run(path)
    assert (done.returncode, done.stdout) == (2, "")
    assert done.stderr.startswith("singletrack: ")
    assert "bad.dat, line 3: SURFACE: the ground is a plane" in done.stderr
    assert "Traceback" not in done.stderr
    assert run(tmp_path / "none.dat").returncode == 2
