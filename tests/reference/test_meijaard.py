"""The benchmark bicycle of Meijaard et al. (2007), to all published digits."""

from __future__ import annotations

from math import pi

import numpy as np
import pytest

from singletrack import coefficients, load_bicycle


@pytest.fixture(scope="module")
def model():
    return coefficients(load_bicycle("benchmark"))


def test_shipped_parameters_are_the_published_ones(meijaard):
    published, bicycle = meijaard["parameters"], load_bicycle("benchmark")
    assert bicycle.steer_axis_tilt == pytest.approx(pi / 10, rel=1e-15)
    for name in ("wheel_base", "trail", "gravity"):
        assert getattr(bicycle, name) == published[name]
    for body in ("rear_wheel", "rear_frame", "front_frame", "front_wheel"):
        for key, value in published[body].items():
            name = f"inertia_{key[1:]}" if key.startswith("I") else key
            assert getattr(bicycle, f"{body}_{name}") == value


@pytest.mark.parametrize("name", ["M", "C1", "K0", "K2"])
def test_matrices(model, meijaard, name):
    np.testing.assert_allclose(getattr(model, name), meijaard[name], rtol=1e-12, atol=0)


@pytest.mark.parametrize("speed", range(11))
def test_eigenvalues(model, meijaard, speed):
    published = np.array([complex(*root) for root in meijaard["eigenvalues"][str(speed)]])
    computed = model.eigenvalues(float(speed))[0]
    assert np.max(np.abs(computed - published) / np.abs(published)) < 1e-12


def test_critical_speeds(model, meijaard):
    critical = model.critical_speeds()
    # Published with 13 digits.
    assert critical.weave == [pytest.approx(meijaard["weave_speed"], rel=1e-12)]
    assert critical.capsize == [pytest.approx(meijaard["capsize_speed"], rel=1e-12)]
    assert critical.stable_ranges == [(critical.weave[0], critical.capsize[0])]
