"""Commands from an installation that cannot be written to, for a user without a home folder: they work, and say no more
than elsewhere."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest

from installations import read_only_installation, run

pytestmark = pytest.mark.skipif(os.name == "nt", reason="needs the permissions of a POSIX system")

#: What each prints, and what it writes.
PRINTED = (
    "coefficients stratos --rider rider-a --posture leaned --json",
    "critical-speeds benchmark",
    "control benchmark --speeds 5 --json",
)
WRITTEN = {
    "plot benchmark --speeds 0:10:5": "figure.svg",
    "page benchmark": "page.html",
    "ride benchmark --speed 5 --for 0.1": "ride.csv",
}


def test_every_kind_of_output_from_a_read_only_installation_without_a_home(tmp_path: Path) -> None:
    here = tmp_path / "here"
    here.mkdir()
    usual = [sys.executable, "-m", "singletrack"]
    environment = os.environ | {"PYTHONPATH": str(Path(__file__).parents[2] / "src")}
    wanted = ""
    for line in PRINTED:
        done = subprocess.run([*usual, *line.split()], capture_output=True, text=True, check=True, env=environment)
        wanted += done.stdout
    script = [f"singletrack {line}" for line in PRINTED]
    script += [f"singletrack {line} -o {name} >> said.txt" for line, name in WRITTEN.items()]
    script += ["singletrack convert benchmark bicycle.toml >> said.txt"]
    with read_only_installation(tmp_path) as command:
        done = run(command, " && ".join(script), tmp_path)
    assert done.returncode == 0, done.stderr
    assert done.stderr == ""
    assert done.stdout == wanted
    for name in (*WRITTEN.values(), "bicycle.toml"):
        assert (tmp_path / "work" / name).stat().st_size > 100
