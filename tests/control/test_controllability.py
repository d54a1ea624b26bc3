"""Losses of controllability: planted ones are found and no others, printed ones come out, 50 digits agree."""

from __future__ import annotations

import json
from pathlib import Path

import mpmath
import numpy as np
import pytest

from singletrack import InputError, coefficients, load_bicycle, load_rider
from singletrack.control import distance_to_uncontrollability, modal_controllability, uncontrollable_speeds
from singletrack.control.controllability import state_polynomial
from singletrack.model import LinearModel

PRINTED = Path(__file__).parents[3] / "shared" / "reference" / "passive2012.json"
CASES = [("hybrid_leaned", "stratos-2012", "leaned"), ("city_upright", "browser-2012", "upright")]


def lean_model(bicycle, posture, width=0.40):
    rider = load_rider("rider-a").replace(torso_width=width) if width else load_rider("rider-a")
    return coefficients(load_bicycle(bicycle), rider, posture, torso_lean=True)


@pytest.mark.parametrize(("key", "bicycle", "posture"), CASES)
@pytest.mark.parametrize(("column", "name"), [("steer_torque", "steer torque"), ("lean_torque", "torso torque")])
def test_tables_1_and_2_of_the_journal_paper(key, bicycle, posture, column, name):
    if not PRINTED.exists():
        pytest.skip("../shared with the printed tables is not here")
    printed = json.loads(PRINTED.read_text())["uncontrollable"][key][column]
    found = uncontrollable_speeds(lean_model(bicycle, posture), [name])
    assert len(found) == len(printed)
    for loss, (speed, root, _, _) in zip(found, printed, strict=True):
        assert loss.speed == pytest.approx(speed, rel=0.03, abs=0.005 if speed < 0.1 else 0)
        assert loss.eigenvalue == pytest.approx(root, rel=0.03)


def random_model(n, seed):
    """A random model with symmetric mass and gravity matrices and one input."""
    random = np.random.default_rng(seed)
    half = random.standard_normal((n, n))
    names = ("lean", "steer", *(f"joint {k}" for k in range(n - 2)))
    K0 = random.standard_normal((n, n))
    return LinearModel(
        half @ half.T + n * np.eye(n),
        random.standard_normal((n, n)),
        (K0 + K0.T) / 2,
        random.standard_normal((n, n)),
        1.0,
        coordinates=names,
        inputs=("torque",),
        B=random.standard_normal((n, 1)),
    )


def planted(n, seed):
    """Plant a loss: change K2 so that a row w with w b = 0 annihilates the pencil at a speed and a root."""
    import dataclasses

    model = random_model(n, seed)
    random = np.random.default_rng(seed + 1000)
    speed, root = random.uniform(0.5, 3.0), random.uniform(-3.0, 3.0)
    w = np.linalg.svd(np.asarray(model.B).T)[2][-1]  # w b = 0
    rest = w @ (model.M * root**2 + speed * model.C1 * root + model.K0 + speed**2 * model.K2)
    return dataclasses.replace(model, K2=model.K2 - np.outer(w, rest) / speed**2), speed, root


@pytest.mark.parametrize("n", [2, 3, 4])
@pytest.mark.parametrize("seed", range(6))
def test_planted_losses_are_found_and_no_others(n, seed):
    model, speed, root = planted(n, seed)
    found = uncontrollable_speeds(model)
    assert min(abs(loss.speed - speed) / speed for loss in found) < 1e-9
    assert any(abs(loss.eigenvalue - root) < 1e-8 * (1 + abs(root)) for loss in found)
    A, B = state_polynomial(model)
    for loss in found:  # Popov, Belevitch and Hautus: the rank falls there, and is full beside
        ranks = []
        for v in (loss.speed, loss.speed * 1.001):
            pencil = np.column_stack([A[0] + v * A[1] + v * v * A[2] - loss.eigenvalue * np.eye(2 * n), B])
            ranks.append(np.linalg.svd(pencil, compute_uv=False)[-1])
        assert ranks[0] < 1e-9 < ranks[1]


@pytest.mark.parametrize(("model", "name"), [("benchmark", "steer torque"), ("stratos-2012", "steer torque")])
def test_losses_are_the_sign_changes_of_the_determinant_in_50_digits(model, name):
    """Of the controllability matrix, over a fine grid of speeds: as many, and at the same places."""
    if model == "benchmark":
        made, top = coefficients(load_bicycle(model)), 8.0
    else:
        made, top = lean_model(model, "leaned"), 6.0
    A, B = state_polynomial(made)
    column = mpmath.matrix(B[:, made.inputs.index(name)].tolist())
    parts = [mpmath.matrix(part.tolist()) for part in A]

    def determinant(v):
        with mpmath.workdps(50):
            matrix = parts[0] + v * parts[1] + v * v * parts[2]
            columns, now = [], column
            for _ in range(len(column)):
                columns.append(now)
                now = matrix * now
            return mpmath.sign(mpmath.det(mpmath.matrix([[c[i] for c in columns] for i in range(len(column))])))

    grid = np.concatenate([np.linspace(0.002, 0.05, 25), np.linspace(0.06, top, 120)])
    signs = [determinant(float(v)) for v in grid]
    changes = [(a, b) for a, b, s, t in zip(grid, grid[1:], signs, signs[1:], strict=False) if s != t]
    speeds = [loss.speed for loss in uncontrollable_speeds(made, [name]) if 0.002 < loss.speed < top]
    assert len(speeds) == len(changes)
    for speed, (low, high) in zip(speeds, changes, strict=True):
        assert low <= speed <= high


def test_angles_are_right_where_a_mode_is_lost():
    model = lean_model("stratos-2012", "leaned")
    for loss in uncontrollable_speeds(model):
        angles = np.degrees(modal_controllability(model, [loss.speed])[loss.input][0])
        assert angles.max() == pytest.approx(90.0, abs=1e-4)
        assert distance_to_uncontrollability(model.state_space(loss.speed), loss.input) < 1e-6


def test_the_statements_of_the_journal_paper_on_springs():
    """Spring and damper at the hinge move the loss of the unstable mode by steer to a much lower speed."""
    soft = lean_model("stratos-2012", "leaned")
    rider = load_rider("rider-a").replace(torso_width=0.40)
    hinge = {"springs": {"torso lean": 100.0}, "dampers": {"torso lean": 10.0}}
    sprung = coefficients(load_bicycle("stratos-2012"), rider, "leaned", torso_lean=True, **hinge)
    before, after = (
        [loss for loss in uncontrollable_speeds(m, ["steer torque"]) if loss.eigenvalue.real > 0]
        for m in (soft, sprung)
    )
    assert before[0].speed > 1.5
    assert after[0].speed < 0.5 * before[0].speed
    by_torso = [[loss.speed for loss in uncontrollable_speeds(m, ["torso torque"])] for m in (soft, sprung)]
    np.testing.assert_allclose(by_torso[0], by_torso[1], rtol=1e-6)  # the spring acts where the torque does


def test_wrong_questions_are_refused():
    model = coefficients(load_bicycle("benchmark"))
    with pytest.raises(InputError, match="unknown input 'torso'"):
        uncontrollable_speeds(model, ["torso"])
    batch = coefficients(load_bicycle("benchmark").replace(trail=np.array([0.05, 0.06])))
    with pytest.raises(InputError, match="single design"):
        uncontrollable_speeds(batch)
