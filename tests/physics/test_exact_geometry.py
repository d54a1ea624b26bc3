"""K0 and the rider's second-order motion against an exact nonlinear geometry."""

from __future__ import annotations

import mpmath as mp
import numpy as np
import pytest

from mechanisms import random_mechanism
from physics.exact_geometry import ExactBicycle, ExactRider, vec
from singletrack import closed_form, coefficients, load_bicycle, load_rider
from singletrack.posture import Options, seat, slaved_bodies

STEP = mp.mpf(10) ** -8  # error of the differences: its square times a number of order one
SEATED = [("stratos", p) for p in ("rigid", "leaned", "upright")] + [("browser", p) for p in ("leaned", "upright")]


def hessian(function, count=2):
    """Second derivatives at zero by central differences in 40 digits."""
    h = STEP

    def at(*steps):
        values = [mp.mpf(0)] * count
        for i, step in steps:
            values[i] += step
        return function(*values)

    mid = at()
    found = np.empty((count, count))
    for i in range(count):
        found[i, i] = (at((i, h)) - 2 * mid + at((i, -h))) / h**2
        for j in range(i):
            mixed = at((i, h), (j, h)) - at((i, h), (j, -h)) - at((i, -h), (j, h)) + at((i, -h), (j, -h))
            found[i, j] = found[j, i] = mixed / (4 * h**2)
    return found


def energy_matrix(exact, count):
    """The matrix of twice the kinetic energy, by polarisation."""
    units = np.eye(count)
    own = [exact.twice_kinetic_energy(unit) for unit in units]
    found = np.diag([float(value) for value in own])
    for i in range(count):
        for j in range(i):
            both = exact.twice_kinetic_energy(units[i] + units[j])
            found[i, j] = found[j, i] = float((both - own[i] - own[j]) / 2)
    return found


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


LEANING = [
    ("stratos", Options("leaned", torso_lean=True)),
    ("stratos", Options("rigid", torso_lean=True)),
    ("browser", Options("upright", torso_lean=True)),
]


@pytest.mark.parametrize(("name", "options"), LEANING, ids=lambda value: getattr(value, "title", value))
def test_k0_and_m_with_torso_lean(name, options):
    check_against_exact_geometry(load_bicycle(name), options)


@pytest.mark.parametrize("seed", range(8))
def test_k0_and_m_of_random_mechanisms(seed):
    """K0 is the Hessian of the height of exactly closed loops, M that of the kinetic energy at zero speed."""
    check_against_exact_geometry(load_bicycle("stratos"), Options(random_mechanism(seed)))


def check_against_exact_geometry(bicycle, options):
    rider = load_rider("rider-a")
    model = closed_form.coefficients(bicycle, rider, options)
    exact, count = ExactBicycle(bicycle, seat(bicycle, rider, options)), model.freedoms
    for found, expected in ((model.K0, hessian(exact.height, count)), (model.M, energy_matrix(exact, count))):
        np.testing.assert_allclose(found, expected, rtol=0.0, atol=1e-10 * np.abs(expected).max())


def floats(values):
    return np.array([float(value) for value in values])
