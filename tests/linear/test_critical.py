"""Critical speeds against what a dense scan finds."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.optimize import brentq

from singletrack import coefficients, load_bicycle

SCAN = np.linspace(0.005, 30.0, 12001)


def largest_real_part(model, speed):
    return float(model.eigenvalues(speed)[0].real.max())


def scanned_changes(model):
    """Speeds at which the largest real part changes sign, bisected."""
    growth = model.eigenvalues(SCAN)[..., :, :].real.max(axis=-1)
    at = np.flatnonzero(np.sign(growth[1:]) != np.sign(growth[:-1]))
    return [brentq(lambda v: largest_real_part(model, v), SCAN[i], SCAN[i + 1], xtol=1e-13, rtol=1e-14) for i in at]


def stability_changes(model):
    ends = [end for low_high in model.critical_speeds().stable_ranges for end in low_high]
    return [end for end in ends if SCAN[0] < end < SCAN[-1]]


def one(models, index):
    return replace(models, **{name: getattr(models, name)[index] for name in ("M", "C1", "K0", "K2")})


def test_stable_ranges_agree_with_a_scan(combination):
    assert stability_changes(combination) == pytest.approx(scanned_changes(combination), rel=1e-9)


@pytest.mark.parametrize("index", range(0, 300, 12))
def test_stable_ranges_of_random_bicycles_agree_with_a_scan(random_models, index):
    model = one(random_models, index)
    assert stability_changes(model) == pytest.approx(scanned_changes(model), rel=1e-9)


def test_batch_agrees_with_single_designs(random_models):
    together = random_models.critical_speeds()
    for index in range(0, 300, 30):
        alone = one(random_models, index).critical_speeds()
        assert together.weave[index] == alone.weave
        assert together.capsize[index] == alone.capsize
        assert together.stable_ranges[index] == alone.stable_ranges


def test_a_root_is_on_the_axis_at_each_critical_speed(random_models):
    critical = random_models.critical_speeds()
    for index in range(300):
        model = one(random_models, index)
        for speed in critical.weave[index]:
            roots = model.eigenvalues(speed)[0]
            crossing = roots[np.argmin(np.abs(roots.real) + 1e3 * (roots.imag == 0))]
            assert abs(crossing.real) < 1e-9 * np.abs(roots).max()
            assert crossing.imag != 0
        for speed in critical.capsize[index]:
            roots = model.eigenvalues(speed)[0]
            assert np.abs(roots).min() < 1e-9 * np.abs(roots).max()


def test_a_very_narrow_range_is_found():
    """The Browser without rider is stable over less than 0.1 m/s; here it is made a hundred times narrower still."""
    browser = load_bicycle("browser")
    ((low, high),) = coefficients(browser).critical_speeds().stable_ranges
    assert 0.05 < high - low < 0.1

    def width(trail):
        ranges = coefficients(browser.replace(trail=trail)).critical_speeds().stable_ranges
        return ranges[0][1] - ranges[0][0] if ranges else -1.0

    wide, none = browser.trail, next(t for t in np.linspace(browser.trail, 0.03, 400) if width(t) < 0)
    while width(wide) > 1e-3:
        middle = (wide + none) / 2
        wide, none = (middle, none) if width(middle) > 0 else (wide, middle)
    model = coefficients(browser.replace(trail=wide))
    ((low, high),) = model.critical_speeds().stable_ranges
    assert 0 < high - low < 1e-3
    assert largest_real_part(model, (low + high) / 2) < 0
    assert largest_real_part(model, low - 1e-3 * (high - low)) > 0
    assert largest_real_part(model, high + 1e-3 * (high - low)) > 0


@given(st.floats(0.5, 3.0))
@settings(max_examples=30, deadline=None)
def test_speeds_scale_with_the_root_of_gravity(factor):
    bicycle = load_bicycle("stratos")
    usual = coefficients(bicycle).critical_speeds()
    other = coefficients(bicycle.replace(gravity=9.81 * factor)).critical_speeds()
    assert other.weave == pytest.approx([speed * factor**0.5 for speed in usual.weave], rel=1e-12)
    assert other.capsize == pytest.approx([speed * factor**0.5 for speed in usual.capsize], rel=1e-12)


def test_json_has_no_infinity():
    """Large spinning wheels: stable at all speeds above one."""
    stable = coefficients(load_bicycle("stratos").replace(front_wheel_inertia_yy=0.18, trail=0.11))
    text = stable.critical_speeds().to_dict()["stable_ranges"]
    assert all(high is None or np.isfinite(high) for _, high in text)
