"""Freedoms, springs and dampers of riders: the two derivations against each other, limits, energy."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from mechanisms import random_mechanism
from singletrack import closed_form, load_bicycle, load_rider, multibody
from singletrack.multibody import ride, simulate
from singletrack.posture import Options

NAMES = ("M", "C0", "C1", "S0", "K0", "K2", "B")
RIDER = load_rider("rider-a")
SEATS = [
    Options("rigid"),
    Options("upright"),
    Options("upright", "abduction"),
    Options("leaned"),
    Options("leaned", arms="bent"),
    Options("leaned", "axial"),
    Options("moore-2012"),
    Options("one-hand"),
]
SPRINGS, DAMPERS = {"torso lean": 100.0, "steer": 3.0}, {"torso lean": 10.0, "steer": 0.5}


def assert_same(bicycle, rider, options, tolerance=1e-10):
    one, other = (make.coefficients(bicycle, rider, options) for make in (closed_form, multibody))
    assert (one.coordinates, one.inputs) == (other.coordinates, other.inputs)
    for name in NAMES:
        expected, found = np.asarray(getattr(one, name)), np.asarray(getattr(other, name))
        size = max(np.abs(expected).max(), 1e-3)
        np.testing.assert_allclose(found, expected, rtol=0.0, atol=tolerance * size, err_msg=name)
    return one


@pytest.mark.parametrize("name", ["stratos", "browser"])
@pytest.mark.parametrize("options", SEATS, ids=lambda options: options.title)
def test_engines_agree_with_torso_lean_springs_and_dampers(name, options):
    assert_same(load_bicycle(name), RIDER, options)
    leaning = replace(options, torso_lean=True, springs=SPRINGS, dampers=DAMPERS)
    model = assert_same(load_bicycle(name), RIDER, leaning)
    assert model.coordinates == ("lean", "steer", "torso lean")
    assert model.inputs == ("lean torque", "steer torque", "torso torque")
    assert (model.S0[2, 2], model.C0[2, 2]) == (100.0, 10.0)


@pytest.mark.parametrize(
    "options",
    [
        Options("upright", springs={"hands": 2000.0, "right elbow": 20.0}, dampers={"hands": 30.0}),
        Options("upright", springs={"left hand": 500.0}),
        Options("leaned", torso_lean=True, springs={"hands": 3000.0, "torso pitch": 500.0}),
        Options("leaned", springs={"torso twist": 20.0, "left shoulder flexion": 5.0}, dampers={"torso twist": 3.0}),
    ],
    ids=lambda options: options.title,
)
def test_engines_agree_on_soft_hands_and_sprung_joints(options):
    assert_same(load_bicycle("browser"), RIDER, options)


@settings(max_examples=50, deadline=None, derandomize=True)
@given(seed=st.integers(0, 10_000))
def test_engines_agree_on_random_mechanisms(seed):
    """Random trees of hinges and sliders, loops to the bar, the frame and each other, freedoms, springs, dampers."""
    assert_same(load_bicycle("stratos"), RIDER, Options(random_mechanism(seed)))


@pytest.mark.parametrize("posture", ["rigid", "leaned", "upright"])
def test_stiff_torso_lean_approaches_the_rigid_torso_as_one_over_its_stiffness(posture):
    """The slow roots of the sprung torso against those of the rigid one: ten times as stiff, ten times as near."""
    bicycle, speed = load_bicycle("stratos"), 5.0
    rigid = state_roots(closed_form.coefficients(bicycle, RIDER, posture), speed)
    off = []
    for stiffness in (1e5, 1e6, 1e7):
        options = Options(posture, torso_lean=True, springs={"torso lean": stiffness})
        found = state_roots(closed_form.coefficients(bicycle, RIDER, options), speed)
        off.append(max(np.abs(found - root).min() for root in rigid))
    assert off[0] / off[1] == pytest.approx(10.0, rel=0.05)
    assert off[1] / off[2] == pytest.approx(10.0, rel=0.05)


def state_roots(model, speed):
    n = model.freedoms
    lower = -np.linalg.solve(model.M, np.hstack([model.stiffness(speed), model.damping(speed)]))
    return np.linalg.eigvals(np.vstack([np.hstack([np.zeros((n, n)), np.eye(n)]), lower]))


@pytest.mark.parametrize(("name", "posture"), [("browser", "upright"), ("stratos", "leaned")])
def test_energy_is_kept_with_torso_lean_and_decreases_with_a_damper(name, posture):
    bicycle, times = load_bicycle(name), np.linspace(0.0, 0.8, 17)

    def energy(**laws):
        model = multibody.bicycle_model(bicycle, RIDER, Options(posture, torso_lean=True, **laws))
        start = ride(model, 6.0, {"lean": 0.05, "torso lean": -0.1}, {"lean": -0.1, "torso lean": 0.3})
        return simulate(start, times, rtol=1e-10, atol=1e-11).energy.to_numpy()

    kept = energy(springs={"torso lean": 400.0})
    np.testing.assert_allclose(kept, kept[0], rtol=1e-8)
    damped = energy(springs={"torso lean": 400.0}, dampers={"torso lean": 10.0})
    assert (np.diff(damped) < 0).all()


def test_a_free_pitch_is_in_balance_at_rest():
    """The nonlinear model stays at rest, however heavy the torso that the free hinge carries."""
    model = multibody.bicycle_model(
        load_bicycle("stratos"), RIDER, Options("leaned", springs={"hands": 3000.0, "torso pitch": 800.0})
    )
    at_rest = multibody.assemble(model)
    assert np.abs(multibody.accelerations(at_rest).a).max() < 1e-9
    assert abs(model.system.parameters["torso pitch balance"]) > 50.0
