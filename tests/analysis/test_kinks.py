"""Descent along kinks: critical damping, valleys with known ends, cliffs, and bicycles against a fine grid."""

from __future__ import annotations

import numpy as np
import pytest

from singletrack import load_bicycle
from singletrack.analysis.aims import StableBetween
from singletrack.analysis.designs import Design
from singletrack.analysis.kinks import descended
from singletrack.analysis.problem import Problem
from singletrack.analysis.search import search
from singletrack.linear import eigenvalues


def growth(x):
    """Of s^2 + c s + k with c = 6 x0, k = 4 x1: the largest real part of a root, and its gradient."""
    c, k = 6 * x[0], 4 * x[1]
    root = np.sqrt(complex(c * c / 4 - k))
    value = -c / 2 + root.real
    if root.real == 0:
        return value, np.array([-3.0, 0.0])
    return value, np.array([6 * (-0.5 + c / 4 / root.real), -4 / 2 / root.real])


@pytest.mark.parametrize("start", [(0.1, 0.2), (0.95, 0.1), (0.5, 0.9), (0.99, 0.99)])
def test_critical_damping_is_found_where_the_roots_meet(start):
    """Of k at most 4 the fastest decay is 2 /s: c = 4, a double root, with a kink that no gradient is finite at."""
    end = descended(growth, np.array(start))
    assert growth(end)[0] == pytest.approx(-2.0, abs=0.02)


def test_a_valley_between_two_slopes_is_followed_to_its_end():
    def valley(x):
        steep = 10 * abs(x[0] - x[1])
        side = np.sign(x[0] - x[1])
        return steep + (x[0] - 0.8) ** 2, np.array([10 * side + 2 * (x[0] - 0.8), -10 * side])

    np.testing.assert_allclose(descended(valley, np.array([0.1, 0.5])), 0.8, atol=1e-3)


def test_along_a_cliff_beyond_which_there_is_nothing():
    def cliff(x):
        if x[0] + 0.3 * x[1] > 0.7:
            return np.inf, np.zeros(2)
        return -4 * x[0] + x[1], np.array([-4.0, 1.0])

    np.testing.assert_allclose(descended(cliff, np.array([0.2, 0.9])), [0.7, 0.0], atol=2e-3)


def test_nothing_gets_worse_and_smooth_ends_stay():
    def bowl(x):
        return float(((x - 0.4) ** 2).sum()), 2 * (x - 0.4)

    np.testing.assert_allclose(descended(bowl, np.array([0.9, 0.1, 0.5])), 0.4, atol=1e-4)
    corner = descended(lambda x: (x.sum(), np.ones(len(x))), np.array([0.5, 0.7]))
    np.testing.assert_array_equal(corner, [0.0, 0.0])


@pytest.mark.parametrize(
    ("low", "high", "bounds"),
    [
        (3.0, 6.0, {"trail": (0.02, 0.2), "steer_axis_tilt": (0.1, 0.6)}),
        # Beyond some spin inertia no wheel can be: the best design is at that edge, where no gradient tells of it.
        (2.0, 5.0, {"trail": (0.0, 0.2), "front_wheel_inertia_yy": (0.1, 0.6)}),
    ],
)
def test_searches_end_no_worse_than_a_fine_grid(low, high, bounds):
    design = Design.of(load_bicycle("benchmark"))
    axis = np.linspace(0, 1, 81)
    x = np.stack(np.meshgrid(axis, axis, indexing="ij"), -1).reshape(-1, 2)
    least, most = np.array(list(bounds.values())).T
    values = least + x * (most - least)
    model = design.changed({name: values[:, i] for i, name in enumerate(bounds)}).model()
    best = np.nanmin(eigenvalues(model, np.linspace(low, high, 25)).real.max(axis=(-1, -2)))
    found = search(Problem(design, StableBetween(low, high), bounds), 3)
    for one in found:
        assert one.feasible
        assert one.value <= best + 1e-3
