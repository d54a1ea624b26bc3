"""K0 and the rider's second-order motion against an exact nonlinear geometry."""

from __future__ import annotations

import mpmath as mp
import numpy as np
import pytest

from physics.exact_geometry import ExactBicycle, ExactRider, vec
from singletrack import coefficients, load_bicycle, load_rider
from singletrack.posture import Options, seat, slaved_bodies

STEP = mp.mpf(10) ** -8  # error of the differences: its square times a number of order one
SEATED = [("stratos", p) for p in ("rigid", "leaned", "upright")] + [("browser", p) for p in ("leaned", "upright")]


def hessian(function):
    """Second derivatives at zero by central differences in 40 digits."""
    h = STEP
    mid = function(mp.mpf(0), mp.mpf(0))
    first = (function(h, mp.mpf(0)) - 2 * mid + function(-h, mp.mpf(0))) / h**2
    second = (function(mp.mpf(0), h) - 2 * mid + function(mp.mpf(0), -h)) / h**2
    mixed = (function(h, h) - function(h, -h) - function(-h, h) + function(-h, -h)) / (4 * h**2)
    return np.array([[first, mixed], [mixed, second]], dtype=float)


@pytest.mark.parametrize("name", ["benchmark", "stratos", "browser"])
def test_k0_of_the_bicycle_is_the_hessian_of_its_height(name):
    bicycle = load_bicycle(name)
    np.testing.assert_allclose(hessian(ExactBicycle(bicycle).height), coefficients(bicycle).K0, rtol=1e-11)


@pytest.mark.parametrize(("name", "posture"), SEATED)
def test_k0_with_a_rider_is_the_hessian_of_the_height(name, posture):
    bicycle, rider = load_bicycle(name), load_rider("rider-a")
    exact = ExactBicycle(bicycle, seat(bicycle, rider, posture))
    np.testing.assert_allclose(hessian(exact.height), coefficients(bicycle, rider, posture).K0, rtol=1e-10)


@pytest.mark.parametrize(
    ("name", "posture", "shoulder"),
    [
        ("stratos", "leaned", "axial"),
        ("stratos", "leaned", None),
        ("browser", "upright", None),
        ("browser", "upright", "abduction"),
    ],
)
def test_motion_of_the_segments_to_second_order(name, posture, shoulder):
    """J, H and w against differences of exactly closed loops."""
    bicycle = load_bicycle(name)
    seated = seat(bicycle, load_rider("rider-a"), Options(posture, shoulder))
    bodies, exact = slaved_bodies(seated, bicycle), ExactRider(bicycle, seated)
    ahead, behind = exact.placed(STEP), exact.placed(-STEP)
    for i, (segment, body) in enumerate(seated.segments.items()):
        at = vec(body.centre)
        plus, minus = ahead[segment](at), behind[segment](at)
        np.testing.assert_allclose(bodies.displacement[0, i], floats((plus - minus) / (2 * STEP)), atol=1e-12)
        np.testing.assert_allclose(bodies.curvature[0, i], floats((plus - 2 * at + minus) / STEP**2), atol=1e-9)
        turn = (ahead[segment].turn - behind[segment].turn) / (2 * STEP)
        np.testing.assert_allclose(bodies.rotation[0, i], floats([turn[2, 1], turn[0, 2], turn[1, 0]]), atol=1e-12)


def floats(values):
    return np.array([float(value) for value in values])
