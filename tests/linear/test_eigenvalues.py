"""Eigenvalues, eigenmotions and state space."""

from __future__ import annotations

import mpmath as mp
import numpy as np
import pytest

from singletrack import coefficients, load_bicycle
from singletrack.linear.eigenvalues import eigenmotions

SPEEDS = np.array([0.0, 0.3, 1.0, 2.5, 4.2, 6.0, 9.0, 10.0])


def exact_roots(model, speed):
    """Roots of the characteristic polynomial in 50 digits, straight from the determinant."""
    with mp.workdps(50):
        entry = [
            [
                [
                    mp.mpf(float(model.M[i, j])),
                    mp.mpf(speed) * mp.mpf(float(model.C1[i, j])),
                    mp.mpf(float(model.gravity)) * mp.mpf(float(model.K0[i, j]))
                    + mp.mpf(speed) ** 2 * mp.mpf(float(model.K2[i, j])),
                ]
                for j in range(2)
            ]
            for i in range(2)
        ]

        def product(a, b):
            result = [mp.mpf(0)] * 5
            for i, x in enumerate(a):
                for j, y in enumerate(b):
                    result[i + j] += x * y
            return result

        quartic = [
            x - y for x, y in zip(product(entry[0][0], entry[1][1]), product(entry[0][1], entry[1][0]), strict=True)
        ]
        return np.array([complex(root) for root in mp.polyroots(quartic, maxsteps=500, extraprec=300)])


@pytest.mark.parametrize("speed", SPEEDS)
def test_against_50_digits(combination, speed):
    exact, computed = exact_roots(combination, float(speed)), combination.eigenvalues(speed)[0]
    error = np.abs(exact[:, None] - computed).min(axis=0)
    # As small as the conditioning of each root allows: a few roundings of the matrices' entries.
    gap = np.abs(computed[:, None] - computed)
    np.fill_diagonal(gap, np.inf)
    closeness = np.abs(computed).max() / np.minimum(gap.min(axis=1), np.abs(computed).max())
    assert (error < 2e-14 * np.abs(computed).max() * closeness).all()


def test_motion_solves_the_pencil(combination):
    roots = combination.eigenvalues(SPEEDS)
    motion = eigenmotions(combination, SPEEDS, roots)
    for i, speed in enumerate(SPEEDS):
        for s, q in zip(roots[i], motion[i], strict=True):
            terms = [combination.M * s**2, combination.damping(speed) * s, combination.stiffness(speed)]
            size = sum(np.abs(term) for term in terms) @ np.abs(q)
            assert (np.abs(sum(terms) @ q) <= 1e-12 * size.max()).all()
            assert q[0] in (0, 1)


def test_time_reversal(combination):
    """Riding backwards in time: roots at -v are the negatives of those at v."""
    forward, backward = combination.eigenvalues(SPEEDS), combination.eigenvalues(-SPEEDS)
    np.testing.assert_allclose(np.sort_complex(-backward), forward, rtol=1e-9, atol=1e-9)


def test_roots_at_rest_come_in_opposite_pairs(combination):
    roots = combination.eigenvalues(0.0)[0]
    np.testing.assert_allclose(np.sort_complex(-roots), np.sort_complex(roots), atol=1e-12)


def test_pairs_are_exact_conjugates(random_models):
    roots = random_models.eigenvalues(np.linspace(0, 10, 31))
    np.testing.assert_array_equal(np.sort_complex(np.conj(roots)), np.sort_complex(roots))


def test_state_space_has_the_same_eigenvalues(combination):
    for speed in (0.5, 5.0):
        system = combination.state_space(speed)
        np.testing.assert_allclose(
            np.sort_complex(np.linalg.eigvals(system.A)), combination.eigenvalues(speed)[0], rtol=1e-9, atol=1e-9
        )
        np.testing.assert_allclose(combination.M @ system.B[2:], np.eye(2), atol=1e-12)


def test_state_space_goes_to_python_control():
    system = coefficients(load_bicycle("benchmark")).state_space(5.0).to_control()
    assert system.input_labels == ["lean torque", "steer torque"]
    assert system.state_labels == ["lean", "steer", "lean rate", "steer rate"]


def test_shapes_of_a_batch():
    trail, mass = np.linspace(0.02, 0.1, 3)[:, None], np.linspace(5, 9, 2)
    model = coefficients(load_bicycle("stratos").replace(trail=trail, rear_frame_mass=mass))
    assert model.shape == (3, 2)
    assert model.eigenvalues([1.0, 2.0, 3.0, 4.0, 5.0]).shape == (3, 2, 5, 4)
    assert model.modes([1.0, 2.0]).eigenmotions.shape == (3, 2, 2, 4, 2)
    assert model.state_space(3.0).A.shape == (3, 2, 4, 4)
    assert model.to_xarray()["M"].dims == ("design_0", "design_1", "equation", "coordinate")
