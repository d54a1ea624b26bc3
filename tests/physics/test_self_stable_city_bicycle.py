"""A city bicycle self-stable with hands on the bar: found by the closed form, ridden by the other derivation."""

from __future__ import annotations

import numpy as np
import pytest

from singletrack import load_bicycle, load_rider
from singletrack.analysis.aims import LowestWeave
from singletrack.analysis.designs import Design
from singletrack.analysis.problem import Keep, Problem
from singletrack.analysis.search import search
from singletrack.linear import critical_speeds
from singletrack.multibody.bicycle.coefficients import coefficients as by_multibody
from singletrack.public.riding import ride_for

BEFORE = Design.of(load_bicycle("browser"), load_rider("rider-a"), "upright")
BOUNDS = {
    "trail": (0.03, 0.1),
    "steer_axis_tilt": (np.radians(15), np.radians(30)),
    "handlebar_length": (0.1, 0.3),
}
PROBLEM = Problem(BEFORE, LowestWeave(), BOUNDS, (Keep("fork_offset", 0.02), Keep("front_clearance", 0.3)))


@pytest.fixture(scope="module")
def after():
    best = search(PROBLEM, 1)[0]
    assert best.feasible
    return PROBLEM.at(best.x)


def leans(design, speed):
    """Return how a nonlinear ride after a push ends, and the greatest lean in deg in each third of it."""
    found = ride_for(design.bicycle, design.rider, design.options, speed=speed, duration=15.0, push=0.05)
    thirds = np.array_split(np.abs(np.degrees(found.coordinate("lean"))), 3)
    return found, [third.max() for third in thirds]


def test_as_it_is_it_has_no_stable_speed_and_falls():
    assert critical_speeds(BEFORE.model()).stable_ranges == []
    assert not leans(BEFORE, 5.2)[0].whole


def test_what_is_found_rides_on_by_itself(after):
    ((low, high),) = critical_speeds(after.model()).stable_ranges
    assert low < 5.2 < high
    for name, matrix in (("M", after.model().M), ("K0", after.model().K0), ("K2", after.model().K2)):
        other = getattr(by_multibody(after.bicycle, after.rider, "upright"), name)
        np.testing.assert_allclose(other, matrix, atol=1e-9)
    found, sizes = leans(after, 5.2)
    assert found.whole
    assert sizes[2] < 0.1 * sizes[0]
    assert not leans(after, low - 0.5)[0].whole  # below, weave throws it down
    grown = leans(after, high + 0.5)[1]
    assert grown[2] > grown[1]  # above, it capsizes slowly
