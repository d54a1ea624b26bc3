"""The two-mass skate of Kooijman et al. (2011), Science 332:339: point masses, no wheels to speak of."""

import numpy as np
import pytest

from singletrack import InputError, coefficients, load_bicycle, multibody


@pytest.fixture
def skate(shared_data):
    return load_bicycle(shared_data / "bicycles" / "TmsBenchmark.txt")


def test_matrices_are_those_of_two_point_masses(skate):
    # Both positions and their rates by hand: zero trail, so that the frame yaws by steer and speed alone.
    tilt, base = float(skate.steer_axis_tilt), float(skate.wheel_base)
    sin, cos = np.sin(tilt), np.cos(tilt)
    rear, front = (10.0, 1.2, -0.4), (1.0, 1.02, -0.2)
    ahead = (front[1] - base) * cos - front[2] * sin
    model = coefficients(skate)
    M = [
        [sum(m * z**2 for m, _, z in (rear, front)), -front[0] * ahead * front[2]],
        [-front[0] * ahead * front[2], front[0] * ahead**2],
    ]
    K0 = np.array([[rear[0] * rear[2] + front[0] * front[2], -front[0] * ahead]] * 2)
    K0[1] = [-front[0] * ahead, -front[0] * ahead * sin]
    C1 = [
        [0.0, -cos / base * sum(m * x * z for m, x, z in (rear, front))],
        [0.0, cos / base * front[0] * ahead * front[1]],
    ]
    K2 = [[0.0, -cos / base * sum(m * z for m, _, z in (rear, front))], [0.0, cos / base * front[0] * ahead]]
    for found, expected in zip(model.matrices, (M, C1, K0, K2), strict=True):
        np.testing.assert_allclose(found, expected, atol=1e-12)
    assert np.linalg.eigvalsh(model.M).min() > 0


def test_it_is_stable_beyond_2_8_metres_a_second_as_published(skate):
    (weave,) = coefficients(skate).critical_speeds().weave
    assert weave == pytest.approx(2.8, abs=0.05)
    assert coefficients(skate).critical_speeds().stable_ranges == [(weave, np.inf)]


def test_it_is_what_small_light_wheels_tend_to(skate):
    def with_wheels(size):
        parts = {"radius": size, "mass": size, "inertia_xx": size**3, "inertia_yy": size**3}
        return skate.replace(
            **{f"{end}_wheel_{part}": value for end in ("rear", "front") for part, value in parts.items()}
        )

    (limit,) = coefficients(skate).critical_speeds().weave
    errors = [abs(coefficients(with_wheels(size)).critical_speeds().weave[0] - limit) for size in (1e-3, 1e-4, 1e-5)]
    assert errors[2] < 1e-4 < errors[0]
    assert np.all(np.diff(errors) < 0)


def test_the_engine_says_that_it_rolls_wheels(skate):
    with pytest.raises(InputError, match="rear_wheel_radius = 0 m, must be greater than zero: the multibody engine"):
        multibody.coefficients(skate)
