"""Options of how a rider sits and is sprung, on the command line."""

from __future__ import annotations

import json
import sys

import numpy as np
import pytest

from singletrack import coefficients, load_bicycle, load_rider
from singletrack.commands import app as cli


@pytest.fixture
def run(monkeypatch, capsys):
    """Run the command line in this process; return exit code, standard output, standard error."""

    def run(*arguments):
        monkeypatch.setattr(sys, "argv", ["singletrack", *arguments])
        with pytest.raises(SystemExit) as stop:
            cli.main()
        captured = capsys.readouterr()
        return stop.value.code, captured.out, captured.err

    return run


LEAN_LAWS = ["--spring", "torso lean=100 N*m/rad", "--damper", "torso lean=10 N*m*s/rad"]


def test_torso_lean_with_spring_and_damper_from_the_command_line(run):
    seated = ("stratos", "--rider", "rider-a", "--posture", "leaned", "--torso-lean")
    code, out, err = run("coefficients", *seated, *LEAN_LAWS, "--json")
    assert (code, err) == (0, "")
    found = json.loads(out)
    assert found["coordinates"] == ["lean", "steer", "torso lean"]
    assert found["inputs"] == ["lean torque", "steer torque", "torso torque"]
    assert (found["S0"][2][2], found["C0"][2][2]) == (100.0, 10.0)
    model = coefficients(load_bicycle("stratos"), load_rider("rider-a"), "leaned", torso_lean=True)
    assert found["M"] == np.asarray(model.M).tolist()


@pytest.mark.parametrize(
    ("options", "words"),
    [
        (["--posture", "uprit"], "unknown posture 'uprit'; did you mean upright"),
        (["--posture", "leaned", "--arms", "bend"], "unknown arms 'bend'; did you mean bent"),
        (["--arms", "bent"], "only the posture leaned has straight or bent arms"),
        (["--posture", "upright", "--spring", "elbow=3"], "did you mean left elbow"),
        (["--posture", "upright", "--spring", "steer=3 kg"], "--spring steer: '3 kg' has a unit that is not one of"),
        (["--posture", "upright", "--spring", "steer=-3"], "spring at steer: found -3.0 N m/rad"),
        (["--posture", "upright", "--damper", "steer"], "--damper 'steer': found no value"),
        (["--posture", "leaned", "--arms", "straight", "--shoulder", "axial"], "cannot follow the handlebar"),
    ],
)
def test_model_options_that_cannot_be(run, options, words):
    code, out, err = run("coefficients", "stratos", "--rider", "rider-a", *options)
    assert (code, out) == (2, "")
    assert words in err
