"""What the options of a model say and do, as a user meets them."""

from __future__ import annotations

import json
import subprocess
import sys

import numpy as np
import pytest

from singletrack import coefficients, load_bicycle, load_rider
from singletrack.commands import app, door
from singletrack.library import shipped
from singletrack.posture import ARMS, POSTURES, SHOULDERS

MODEL_COMMANDS = ["coefficients", "eigenvalues", "critical-speeds", "show"]


@pytest.fixture
def run(monkeypatch, capsys):
    """Run the command line in this process; return exit code, standard output, standard error."""
    monkeypatch.setenv("COLUMNS", "200")

    def run(*arguments):
        monkeypatch.setattr(sys, "argv", ["singletrack", *arguments])
        with pytest.raises(SystemExit) as stop:
            app.main()
        captured = capsys.readouterr()
        return stop.value.code, captured.out, captured.err

    return run


@pytest.mark.parametrize("command", MODEL_COMMANDS)
def test_every_command_that_makes_a_model_has_the_same_options(command, run):
    _, printed, _ = run(command, "--help")
    for option in ("rider", "posture", "shoulder", "arms", "torso-lean", "spring", "damper", "engine", "set"):
        assert f"--{option}" in printed
    for name in (*POSTURES, *SHOULDERS, *ARMS):
        assert name in printed


@pytest.mark.parametrize("command", MODEL_COMMANDS)
def test_headings_list_what_was_changed(command, run):
    code, printed, _ = run(command, "stratos", "--set", "trail=60 mm", "--set", "gravity=9.8")
    assert code == 0
    assert "trail = 60 mm, gravity = 9.8" in printed


@pytest.mark.parametrize("command", MODEL_COMMANDS)
def test_a_name_that_is_set_twice_is_refused_by_name(command, run):
    code, out, err = run(command, "stratos", "--set", "trail=0.06", "--set", " trail = 0.05 ")
    assert (code, out) == (2, "")
    assert err == "singletrack: --set trail: is given twice, as '0.06' and as '0.05'\n"


def test_arms_torso_springs_and_dampers(run):
    seat = ["--rider", "rider-a", "--posture", "leaned", "--arms", "bent", "--torso-lean"]
    sprung = ["--spring", "torso lean=100 N*m/rad", "--spring", "steer=1 N*m/deg", "--damper", "torso lean=10"]
    _, out, _ = run("coefficients", "stratos", *seat, *sprung, "--json")
    found = json.loads(out)
    springs = {"torso lean": 100.0, "steer": np.rad2deg(1.0)}
    model = coefficients(
        *(load_bicycle("stratos"), load_rider("rider-a"), "leaned"),
        arms="bent", torso_lean=True, springs=springs, dampers={"torso lean": 10.0},
    )  # fmt: skip
    assert tuple(found["coordinates"]) == model.coordinates == ("lean", "steer", "torso lean")
    for name in ("M", "C0", "C1", "S0", "K0", "K2", "B"):
        np.testing.assert_array_equal(found[name], getattr(model, name))
    _, out, _ = run("coefficients", "stratos", *seat, *sprung)
    assert "leaned, arms bent, torso lean, spring at torso lean" in out
    assert "S0 springs" in out


def test_a_mechanism_from_a_file(run, tmp_path):
    path = tmp_path / "mine.toml"
    path.write_text(shipped("posture")["upright-axial"].read_text(encoding="utf-8"), encoding="utf-8")
    outputs = [
        run("coefficients", "browser", "--rider", "rider-a", "--posture", posture, "--json")
        for posture in ("upright", str(path))
    ]
    assert outputs[0] == outputs[1]


@pytest.mark.parametrize(
    ("options", "says"),
    [
        (["--spring", "steer"], "--spring 'steer': found no value"),
        (["--spring", "steer=1 kg"], "--spring steer: '1 kg'"),
        (["--damper", "steer=1", "--damper", "steer=2"], "--damper steer: is given twice"),
        (["--spring", "torso lean=-1"], "spring at torso lean"),
        (["--arms", "crossed"], "unknown arms 'crossed'"),
        (["--spring", "knee=1"], "knee"),
        (["--posture", "sitting"], "sitting"),
        (["--posture", "rigid", "--arms", "bent"], "arms"),
    ],
)
def test_wrong_options_are_one_sentence(options, says, run):
    code, out, err = run("coefficients", "stratos", "--rider", "rider-a", "--posture", "leaned", *options)
    assert (code, out) == (2, "")
    assert err.count("\n") == 1
    assert says in err


@pytest.mark.parametrize("command", MODEL_COMMANDS)
def test_what_is_set_without_effect_is_said(command, run):
    code, _, err = run(command, "stratos", "--set", "stem_length=0.3")
    assert code == 0
    assert err.startswith("singletrack: warning: --set stem_length: changes no equation without a --rider")
    code, _, err = run(command, "stratos", "--set", "stem_length=0.3", "--rider", "rider-a")
    assert (code, err) == (0, "")


@pytest.mark.parametrize("command", MODEL_COMMANDS)
def test_what_looks_odd_is_said_by_every_command_that_computes(command, run):
    code, out, err = run(command, "stratos", "--set", "wheel_base=13.7")
    assert code == 0
    assert err.count("\n") == 1
    assert "singletrack: warning: stratos: wheel_base = 13.7 m is outside what is usual" in err
    assert "warning" not in out


def test_an_oddity_is_said_once(run):
    _, _, err = run("coefficients", "stratos", "--rider", "rider-a", "--set", "trail=-0.01")
    assert err.count("trail = -0.01") == 1


def test_files_that_look_odd_are_said_by_the_file_commands(run, tmp_path):
    odd, copy = tmp_path / "odd.toml", tmp_path / "copy.toml"
    run("convert", "stratos", str(odd))
    odd.write_text(odd.read_text(encoding="utf-8").replace('"0.0563 m"', '"-0.05 m"'), encoding="utf-8")
    code, _, err = run("convert", str(odd), str(copy))
    assert code == 0
    assert "singletrack: warning: stratos: trail = -0.05 m is negative" in err
    assert "singletrack: warning: stratos: trail = -0.05 m is negative" in run("show", str(odd))[2]


def test_show_says_the_same_as_the_commands_for_one_thing_each(run):
    """One formatter: critical speeds and ranges, open ones too, read alike everywhere."""
    for change in ("trail=0.2", "trail=0.0563"):
        _, shown, _ = run("show", "stratos", "--set", change)
        _, alone, _ = run("critical-speeds", "stratos", "--set", change)
        for line in alone.splitlines()[1:]:
            assert line in shown
        assert "inf" not in shown


def test_the_door_returns_what_the_command_raises(monkeypatch):
    with pytest.raises(ValueError, match="stratoss"):
        door.run(["coefficients", "stratoss"])


def test_warnings_are_left_as_they_were():
    code = (
        "import warnings, sys\nbefore = warnings.showwarning, list(warnings.filters)\n"
        "from singletrack.commands.app import main\nsys.argv = ['singletrack', 'list']\n"
        "try: main()\nexcept SystemExit: pass\n"
        "assert warnings.showwarning is before[0]"
    )
    assert subprocess.run([sys.executable, "-c", code], capture_output=True, check=False).returncode == 0
