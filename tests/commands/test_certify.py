"""``singletrack critical-speeds --certify``."""

from __future__ import annotations

import json

import pytest

from singletrack.commands import door
from singletrack.errors import InputError


def run(capsys, *arguments: str) -> str:
    assert door.run(["critical-speeds", *arguments]) == 0
    printed: str = capsys.readouterr().out
    return printed


def test_text_and_json_say_the_same(capsys):
    text = run(capsys, "benchmark", "--certify")
    assert "weave speed     4.29238253634 m/s (gained)" in text
    out = run(capsys, "benchmark", "--certify", "--json")
    found = json.loads(out)
    assert found["status"] == "certified"
    assert [crossing["kind"] for crossing in found["crossings"]] == ["pair", "real"]
    assert found["ranges"][-1]["stop"] is None
    assert len(found["ranges"][0]["eigenvalues"]) == 4
    assert found["parameters"]["trail"]


def test_text_of_a_change_is_exact(capsys):
    out = run(capsys, "benchmark", "--certify", "--json", "--set", "trail=81.1 mm", "--set", "steer_axis_tilt=17.9 deg")
    parameters = json.loads(out)["parameters"]
    assert (parameters["trail"], parameters["steer_axis_tilt"]) == ("81.1 mm", "17.9 deg")


def test_intervals(capsys):
    out = run(capsys, "benchmark", "--certify", "--over", "trail=79 mm:81 mm")
    assert "for every trail from 79 mm to 81 mm, at every speed" in out
    assert "stable" in out


def test_feedback_is_certified_too(capsys):
    feedback = ("--feedback", "steer torque: lean rate=10")
    plain = run(capsys, "benchmark", "--json", *feedback)
    proven = run(capsys, "benchmark", "--json", "--certify", *feedback)
    speed = json.loads(proven)["crossings"][0]["speed"]
    assert speed["lower"] == pytest.approx(json.loads(plain)["weave"][0], rel=1e-9)


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["--over", "trail=1:2"], "there is no --certify"),
        (["--certify", "--over", "trail=55 mm"], "must be FROM:TO"),
        (["--certify", "--over", "trail=57 mm:55 mm"], "from less to more"),
        (["--certify", "--over", "tail=55 mm:57 mm"], "trail"),
        (["--certify", "--engine", "multibody"], "closed form"),
    ],
)
def test_refusals_are_one_message(arguments, message):
    with pytest.raises(InputError, match=message):
        door.run(["critical-speeds", "benchmark", *arguments])


@pytest.mark.parametrize("bounds", ["nan:1", "0.05:inf", "-inf m:0.05"])
def test_bounds_that_are_not_finite_are_refused(bounds):
    with pytest.raises(InputError, match=r"over trail = .* is not finite, must be a finite number"):
        door.run(["critical-speeds", "benchmark", "--certify", "--over", f"trail={bounds}"])
