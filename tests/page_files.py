"""Commands of the pages run, with the files that a reader of the pages would have."""

from __future__ import annotations

import runpy
import shlex
import shutil
import sys
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest

from singletrack.commands import app as cli

if TYPE_CHECKING:
    from collections.abc import Callable

__all__ = ["FILES", "provide", "run_command"]

HERE = Path(__file__).parent
DATA = HERE.parent / "src" / "singletrack" / "data"
MECHANISMS = runpy.run_path(str(HERE / "multibody" / "spacar" / "conftest.py"), run_name="mechanisms")
IMAGINED = runpy.run_path(str(HERE / "files" / "mutations.py"), run_name="imagined")

STUDY = """
name = "small"
bicycle = "browser"
rider = "rider-a"
posture = "upright"
speeds = [2, 5]
keep = ["eigenvalues", "critical_speeds", "stable_ranges"]
[vary]
trail = ["50 mm", "60 mm"]
rider_mass = ["65 kg", "72 kg"]
"""

SHEET = """
kind = "sheet"
head_angle = "69 deg"
fork_offset = "50 mm"
wheel_size = "37-622"
wheel_base = "1.10 m"

[[loads]]
name = "battery"
on = "rear frame"
mass = "2.5 kg"
x = "0.1 m"
z = "-0.7 m"
"""

COLUMN = """
PLBEAM 1 1 2 3 4
PLBEAM 2 3 4 5 6
X 3 0.5 0
X 5 1.0 0
FIX 1
FIX 2
DYNE 1 2 3
DYNE 2 2 3
EMASS 1 1.0
EMASS 2 1.0
ESTIFF 1 0 1.0
ESTIFF 2 0 1.0
FORCE 5 -1 0
END
"""


def _record() -> str:
    """Return a recorded lean rate that decays, with noise."""
    time = np.arange(0.0, 3.0, 0.01)
    noise = np.random.default_rng(1).normal(0.0, 0.01, time.shape)
    rate = np.exp(-0.5 * time) * np.sin(3.0 * time) + noise
    return "time,gyro_x\n" + "".join(f"{t:.2f},{y:.5f}\n" for t, y in zip(time, rate, strict=True))


def _crank() -> str:
    """Return the manual's slider-crank, for the first tenth of a second."""
    return str(MECHANISMS["SLIDER_CRANK"]).replace("TIMESTEP 100 5.0", "TIMESTEP 4 0.1")


def _posture() -> str:
    return (DATA / "postures" / "upright-axial.toml").read_text(encoding="utf-8")


#: The content of a file, or another file that is copied.
FILES: dict[str, Callable[[], str | Path]] = {
    "mine.toml": lambda: DATA / "bicycles" / "stratos.toml",
    "bicycle.toml": lambda: DATA / "bicycles" / "stratos.toml",
    "me.toml": lambda: DATA / "riders" / "rider-a.toml",
    "my-posture.toml": _posture,
    "sheet.toml": lambda: SHEET,
    "STUDY.toml": lambda: STUDY,
    "study.toml": lambda: STUDY,
    "MyBikeMeasured.txt": IMAGINED["raw_measurements"],
    "MEASUREMENTS": IMAGINED["raw_measurements"],
    "RECORD...": _record,
    "swing.csv": IMAGINED["signal"],
    "run-1.csv": _record,
    "run-2.csv": _record,
    "kooijman2008.json": lambda: HERE / "reference" / "kooijman2008.json",
    "crank.dat": _crank,
    "bicycle.dat": lambda: MECHANISMS["ROBOT"],
    "FILE.dat": _crank,
    "column.dat": lambda: COLUMN,
}


def run_command(command: str, monkeypatch: pytest.MonkeyPatch, capsys: Any) -> None:
    """Run a command as a shell would, its output into the file that it names."""
    command, _, target = (part.strip() for part in command.partition(" > "))
    for name in shlex.split(command):
        provide(name.rpartition("=")[2])
    monkeypatch.setattr(sys, "argv", shlex.split(command))
    with pytest.raises(SystemExit) as stop:
        cli.main()
    said = capsys.readouterr()
    assert stop.value.code == 0, f"{command}: {said.err}"
    assert said.out or said.err, command
    if target:
        Path(target).write_text(said.out, encoding="utf-8")


def provide(name: str) -> None:
    """Put a reader's own file that a page names where it is looked for."""
    if name in FILES and not Path(name).exists():
        made = FILES[name]()
        if isinstance(made, Path):
            shutil.copy(made, name)
        else:
            Path(name).write_text(made, encoding="utf-8")
