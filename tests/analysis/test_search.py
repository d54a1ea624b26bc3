"""Designs by aim: problems whose answer is known, gradients, and certificates of the optimum."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from singletrack import InputError, load_bicycle, load_rider
from singletrack.analysis.aims import LowestWeave, StableBetween, TargetMatrices, WidestRange
from singletrack.analysis.derivatives import derivatives_of
from singletrack.analysis.designs import Design
from singletrack.analysis.problem import Found, Keep, Problem
from singletrack.analysis.quantities import QUANTITIES, quantities_with_gradients, quantity
from singletrack.analysis.search import search
from singletrack.linear import critical_speeds, eigenvalues

BENCHMARK = Design.of(load_bicycle("benchmark"))
BOUNDS = {"trail": (0.02, 0.12), "steer_axis_tilt": (0.2, 0.4), "front_frame_mass": (2.0, 6.0)}


def test_a_design_is_found_again_from_its_matrices():
    wanted = {"trail": 0.055, "steer_axis_tilt": 0.28, "front_frame_mass": 3.1}
    problem = Problem(BENCHMARK, TargetMatrices(BENCHMARK.changed(wanted).model()), BOUNDS)
    for found in search(problem, 3):
        own = problem.at(found.x).values()
        assert {name: float(own[name]) for name in wanted} == pytest.approx(wanted, rel=1e-5)
        assert found.binding == ()


def test_what_binds_is_said():
    # Least lean-lean inertia by the masses alone: the least mass is the answer, and its bound is what binds.
    class Inertia:
        name = "M lean, lean"

        def __call__(self, slopes):
            return np.array([slopes.model.M[0, 0]]), slopes.matrices["M"][:, 0, 0][None]

    problem = Problem(BENCHMARK, Inertia(), {"front_frame_mass": (2.0, 6.0), "rear_frame_mass": (70.0, 90.0)})
    best = search(problem, 2)[0]
    np.testing.assert_allclose(best.x, 0.0, atol=1e-12)
    assert best.binding == ("front_frame_mass at its least", "rear_frame_mass at its least")
    assert best.stationary < 1e-9


def test_constraints_hold_and_bind():
    browser = Design.of(load_bicycle("browser"))
    bounds = {"trail": (0.02, 0.2), "steer_axis_tilt": (0.2, 0.6)}
    problem = Problem(browser, LowestWeave(), bounds, (Keep("fork_offset", 0.045, 0.06), Keep("reach", -1.0, 2.0)))
    best = search(problem, 2)[0]
    offset = float(quantity(problem.at(best.x), "fork_offset"))
    assert 0.045 - 1e-7 <= offset <= 0.06 + 1e-7
    assert best.feasible
    low, high = critical_speeds(problem.at(best.x).model()).stable_ranges[0]
    assert best.value == pytest.approx(max(low, 2 * low + 1.0 - high), abs=1e-9)


@pytest.mark.parametrize("aim", [StableBetween(4.5, 5.5), WidestRange(), LowestWeave()], ids=lambda a: a.name)
def test_gradients_of_aims_against_differences(aim):
    names = ("trail", "steer_axis_tilt", "front_frame_mass")
    for design in (BENCHMARK, BENCHMARK.changed({"trail": -0.05})):  # stable somewhere, and nowhere
        values, rows = aim(derivatives_of(design, names))
        for i, name in enumerate(names):
            h = 1e-6
            ends = [
                aim(derivatives_of(design.changed({name: float(design.values()[name]) + d}), names))[0] for d in (h, -h)
            ]
            numeric = (ends[0] - ends[1]) / (2 * h)
            np.testing.assert_allclose(rows[:, i], numeric, rtol=1e-4, atol=1e-3)
    assert values.shape == (len(rows),)


def test_stable_between_is_stable_between():
    problem = Problem(BENCHMARK, StableBetween(4.5, 6.0), {**BOUNDS, "front_wheel_inertia_yy": (0.2, 0.35)})
    best = search(problem, 1)[0]
    assert best.value < 0
    model = problem.at(best.x).model()
    assert any(low < 4.5 and high > 6.0 for low, high in critical_speeds(model).stable_ranges)
    assert eigenvalues(model, np.linspace(4.5, 6.0, 200)).real.max() < 0


def test_all_starts_agree_and_known_ones_are_not_searched_again():
    problem = Problem(BENCHMARK, WidestRange(), BOUNDS)
    told: list[Any] = []
    whole = search(problem, 3, seed=1, tell=told.append)
    assert len(told) == 3
    assert max(f.value for f in whole) - min(f.value for f in whole) < 1e-6
    again: list[Any] = []
    rest = search(problem, 3, seed=1, known=told[:2], tell=again.append)
    assert len(again) == 1
    np.testing.assert_array_equal(rest[0].x, whole[0].x)


def test_a_rider_who_does_not_reach_is_no_design():
    stratos = Design.of(load_bicycle("stratos"), load_rider("rider-a"), "leaned")
    problem = Problem(stratos, WidestRange(), {"handlebar_length": (-0.3, 0.3)})
    best = search(problem, 2)[0]
    assert best.feasible
    assert problem.at(best.x).model().valid


def test_quantities_are_right_and_differentiable():
    browser = Design.of(load_bicycle("browser"))
    b = browser.bicycle
    x_crank = np.sqrt(b.chain_stay_length**2 - (b.rear_wheel_radius - b.bottom_bracket_height) ** 2)
    front = np.hypot(b.wheel_base - x_crank, b.front_wheel_radius - b.bottom_bracket_height) - b.front_wheel_radius
    assert float(quantity(browser, "front_clearance")) == pytest.approx(front, rel=1e-12)
    names = ("trail", "wheel_base", "chain_stay_length", "handlebar_length", "steer_axis_tilt")
    values, rows = quantities_with_gradients(browser, tuple(QUANTITIES), names)
    for i, name in enumerate(names):
        h = 1e-6
        moved = browser.changed({name: float(browser.values()[name]) + h})
        after, _ = quantities_with_gradients(moved, tuple(QUANTITIES), ())
        np.testing.assert_allclose((after - values) / h, rows[:, i], atol=1e-4)


@pytest.mark.parametrize(
    ("bounds", "words"),
    [({}, "no parameter may change"), ({"trail": (0.1, 0.0)}, "from less to more"), ({"trial": (0, 1)}, "trial")],
)
def test_problems_that_are_none(bounds, words):
    with pytest.raises(InputError, match=words):
        Problem(BENCHMARK, WidestRange(), bounds)


def test_what_is_found_is_written():
    assert Found(np.array([0.5]), 1.0, feasible=True).to_dict()["x"] == [0.5]


def test_front_clearance_is_that_of_three_circles():
    browser = load_bicycle("browser")
    height = browser.bottom_bracket_height
    crank = (browser.chain_stay_length**2 - (browser.rear_wheel_radius - height) ** 2) ** 0.5
    expected = np.hypot(browser.wheel_base - crank, browser.front_wheel_radius - height) - browser.front_wheel_radius
    assert float(quantity(Design.of(browser), "front_clearance")) == pytest.approx(float(expected), rel=1e-12)
