"""Riders who lean so that their hands reach."""

from __future__ import annotations

import sys
from math import degrees, pi, radians

import numpy as np
import pytest

from singletrack import InputError, PostureError, coefficients, fit, load_bicycle, load_rider
from singletrack.arrays.steps import complex_steps
from singletrack.body.fit import elbow_angle
from singletrack.commands import app

RIDER = load_rider("rider-a")


@pytest.mark.parametrize("name", ["stratos", "browser"])
def test_a_rider_fitted_to_his_own_elbow_angle_leans_as_before(name):
    bicycle = load_bicycle(name)
    own = RIDER.on(bicycle)
    assert fit(bicycle, RIDER, elbow_angle(bicycle, own)).forward_lean_angle == pytest.approx(own.forward_lean_angle)


@pytest.mark.parametrize(
    "changes", [{"stem_length": 0.25}, {"seat_post_length": 0.25}, {"steer_axis_tilt": 0.33}, {"handlebar_width": 0.6}]
)
@pytest.mark.parametrize("elbow", [1.9, 2.4, pi])
def test_the_elbow_angle_is_the_one_wanted(changes, elbow):
    bicycle = load_bicycle("stratos").replace(**changes)
    found = fit(bicycle, RIDER, elbow)
    if elbow == pi:  # the arms span their whole length, to rounding
        found = found.replace(upper_arm_length=RIDER.upper_arm_length * (1 + 1e-12))
    assert float(elbow_angle(bicycle, found)) == pytest.approx(elbow, abs=1e-5)


def test_it_says_by_how_much_the_hands_cannot_reach():
    bicycle = load_bicycle("stratos")
    with pytest.raises(PostureError, match=r"elbow angle of 168 deg: .* span 0\.6067 m: 0\.\d{4} m too far"):
        fit(bicycle.replace(handlebar_length=-0.8), RIDER, radians(168))
    with pytest.raises(PostureError, match=r"nearest, 89\.9 deg, .* m too near"):
        fit(bicycle.replace(handlebar_length=0.4), RIDER, radians(175))
    with pytest.raises(InputError, match=r"elbow angle: found 4\.0 rad, must be more than 0"):
        fit(bicycle, RIDER, 4.0)
    with pytest.raises(InputError, match="cannot seat a rider without frame geometry"):
        fit(load_bicycle("benchmark"), RIDER)


def test_a_batch_is_fitted_design_by_design():
    bars = np.array([-0.15, -0.09, 0.0, -0.8])
    bicycle = load_bicycle("stratos").replace(handlebar_length=bars)
    model = coefficients(bicycle, RIDER, "leaned", fit=radians(168))
    assert model.valid.tolist() == [True, True, True, False]
    assert "too far" in model.faults[-1].reason((3,))
    for k in range(3):
        single = load_bicycle("stratos").replace(handlebar_length=float(bars[k]))
        rider = fit(single, RIDER, radians(168))
        np.testing.assert_allclose(model.M[k], coefficients(single, rider, "leaned").M, rtol=1e-13)
    assert np.isnan(fit(bicycle, RIDER, radians(168)).forward_lean_angle[3])


def test_the_derivative_of_a_fitted_rider_is_exact():
    """A complex step goes through the fit."""
    bicycle, step = load_bicycle("stratos"), 1e-30

    def fitted(stem):
        return coefficients(bicycle.replace(stem_length=stem), RIDER, "leaned", fit=radians(160))

    with complex_steps():
        moved = fitted(0.19 + 1j * step)
    ends = [fitted(0.19 + h) for h in (1e-5, -1e-5)]
    np.testing.assert_allclose(np.imag(moved.M) / step, (ends[0].M - ends[1].M) / 2e-5, rtol=1e-7, atol=1e-9)


def test_fit_on_the_command_line(monkeypatch, capsys):
    def run(*options):
        seated = ["singletrack", "critical-speeds", "stratos", "--rider", "rider-a", "--posture", "leaned"]
        monkeypatch.setattr(sys, "argv", [*seated, *options])
        with pytest.raises(SystemExit) as stop:
            app.main()
        captured = capsys.readouterr()
        return stop.value.code, captured.out, captured.err

    forward = ("--set", "handlebar_length=-0.15 m")
    assert run(*forward)[0] == 2
    code, out, _ = run(*forward, "--fit")
    assert code == 0
    lean = degrees(
        fit(
            load_bicycle("stratos").replace(handlebar_length=-0.15), RIDER, elbow_angle(load_bicycle("stratos"), RIDER)
        ).forward_lean_angle
    )
    assert f"forward_lean_angle = {lean:.4g} deg to fit" in " ".join(out.split())
    assert "m too far" in run(*forward, "--fit", "--elbow-angle", "20 deg")[2]
    assert "there is no --fit" in run("--elbow-angle", "150 deg")[2]
    assert "--elbow-angle: '3 m'" in run("--fit", "--elbow-angle", "3 m")[2]


@pytest.mark.parametrize("elbow", [float("nan"), "150 deg", True])
def test_what_is_no_angle_is_refused(elbow):
    with pytest.raises(InputError, match="elbow angle: found"):
        fit(load_bicycle("stratos"), RIDER, elbow)
