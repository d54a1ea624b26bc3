"""Critical speeds of any number of freedoms, with springs and dampers: against scans, planted ones, other paths."""

from __future__ import annotations

import json
from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from linear.random_models import random_model
from singletrack import coefficients, load_bicycle, load_rider
from singletrack.arrays import Fault
from singletrack.linear import critical_speeds, eigenvalues
from singletrack.linear.critical import _of_any_freedoms
from singletrack.linear.pencil import pencil
from singletrack.model import LinearModel, concatenate

CASES = [(2, True), (3, True), (3, False), (4, True), (4, False)]


def unstable(model, speeds):
    """Return how many roots grow at speeds (k,), (..., k)."""
    return (eigenvalues(model, speeds).real > 0).sum(axis=-1)


def bisected(model, low, high):
    """Return the speed between two at which the number of growing roots changes."""
    below = unstable(model, low)[0]
    while high - low > 1e-13 * high:
        middle = (low + high) / 2
        if not low < middle < high:
            break
        low, high = (middle, high) if unstable(model, middle)[0] == below else (low, middle)
    return (low + high) / 2


def changes(crossings):
    """Return speeds of crossings and by how much the number of growing roots changes there."""
    change = {"pair": 2, "real": 1}
    sign = {"lost": 1, "gained": -1}
    return np.array([c.speed for c in crossings]), np.array([change[c.kind] * sign[c.direction] for c in crossings])


@pytest.mark.parametrize(("n", "damped"), CASES)
def test_all_crossings_are_those_of_a_dense_scan(n, damped):
    """The number of growing roots at 3000 speeds is what the crossings say; each is where bisection finds it."""
    count = 40 if n < 4 else 15
    model = random_model(n, count, seed=80 + n, damped=damped)
    found = critical_speeds(model)
    scan = np.concatenate([[1e-6, 1e-4], np.geomspace(1e-3, 1e3, 3000)])
    scanned = unstable(model, scan)
    bisections = 0
    for i, crossings in enumerate(found.crossings):
        speeds, change = changes(crossings)
        counted = scanned[i, 0] + ((scan[:, None] > speeds) * change).sum(axis=1)
        np.testing.assert_array_equal(scanned[i], counted)
        interval = np.searchsorted(scan, speeds)
        alone = [k for k in range(len(speeds)) if (interval == interval[k]).sum() == 1]
        for k in alone[:2]:
            low, high = scan[interval[k] - 1], scan[interval[k]]
            assert speeds[k] == pytest.approx(bisected(model[i], low, high), rel=1e-9)
            bisections += 1
    assert bisections > count / 2


@pytest.mark.parametrize(("n", "damped"), CASES)
def test_stable_ranges_are_those_of_a_scan(n, damped):
    model = random_model(n, 60, seed=7, damped=damped)
    # Dampers that make some of these stable somewhere.
    model = replace(model, C0=model.C0 + 4 * np.eye(n) * damped, S0=model.S0 + 60 * np.eye(n))
    scan = np.geomspace(1e-3, 1e3, 2000)
    stable = unstable(model, scan) == 0
    found = critical_speeds(model)
    for i, ranges in enumerate(found.stable_ranges):
        inside = np.zeros(len(scan), dtype=bool)
        for low, high in ranges:
            inside |= (scan > low) & (scan < high)
        np.testing.assert_array_equal(inside, stable[i])
    assert stable.any() or not damped


@pytest.mark.parametrize("n", [3, 4])
def test_planted_pairs_and_real_roots_are_found(n):
    """Springs and dampers are chosen so that given motions are solutions at given speeds and frequencies."""
    rng = np.random.default_rng(n)
    for _ in range(12):
        model, v, omega = (
            random_model(n, 1, int(rng.integers(1 << 30)))[0],
            rng.uniform(0.5, 9.0),
            rng.uniform(0.5, 9.0),
        )
        a, b = rng.normal(size=(2, n))
        moving = -(omega**2) * model.M + 1j * omega * v * model.C1 + 9.81 * model.K0 + v**2 * model.K2
        wanted = -moving @ (a + 1j * b)
        plane = np.stack([a, b], axis=1)
        forces = np.stack([wanted.real + omega * model.C0 @ b, wanted.imag - omega * model.C0 @ a], axis=1)
        springs = forces @ np.linalg.pinv(plane)
        found = critical_speeds(replace(model, S0=springs)).crossings
        assert min(abs(c.speed - v) / v for c in found if c.kind == "pair") < 1e-10
        held = (9.81 * model.K0 + v**2 * model.K2) @ a
        found = critical_speeds(replace(model, S0=-np.outer(held, a) / (a @ a))).crossings
        assert min(abs(c.speed - v) / v for c in found if c.kind == "real") < 1e-10


def by_general_path(model):
    p, _ = pencil(model)
    return _of_any_freedoms(p, model)


def test_two_freedoms_agree_with_the_quadratics(random_models):
    exact, general = random_models.critical_speeds(), by_general_path(random_models)
    assert general.told.all()
    for name in ("weave_speeds", "capsize_speeds", "ranges"):
        np.testing.assert_allclose(getattr(general, name), getattr(exact, name), rtol=1e-10, err_msg=name)
    np.testing.assert_array_equal(general.weave_directions, exact.weave_directions)
    np.testing.assert_array_equal(general.capsize_directions, exact.capsize_directions)


@pytest.mark.parametrize("width", [1e-2, 1e-4, 1e-5])
@pytest.mark.parametrize("n", [2, 3])
def test_crossings_that_nearly_coincide_are_told_apart(n, width):
    """With more and more damping a pair no longer crosses but only comes near the axis; just before, two crossings."""
    models = random_model(n, 60, seed=21)

    def damped(i, more):
        model = models[i]
        found = critical_speeds(replace(model, C0=model.C0 + more * np.eye(n)))
        assert found.told
        return found

    def pairs(found):
        return np.array([c.speed for c in found.crossings if c.kind == "pair"])

    grid = np.linspace(0.0, 3.0, 13)
    merging = (
        (i, low, high)
        for i in range(60)
        for low, high in pairwise(grid)
        if len(pairs(damped(i, low))) == len(pairs(damped(i, high))) + 2
    )
    i, low, high = next(merging)
    fewer = len(pairs(damped(i, high)))
    for _ in range(60):
        speeds = pairs(damped(i, low))
        gap = np.min(np.diff(speeds) / speeds[:-1])
        if gap < width:
            break
        middle = (low + high) / 2
        low, high = (low, middle) if len(pairs(damped(i, middle))) == fewer else (middle, high)
    assert width / 100 < gap < width
    closest = np.argmin(np.diff(speeds))
    found = [c for c in damped(i, low).crossings if c.kind == "pair"]
    assert {found[closest].direction, found[closest + 1].direction} == {"gained", "lost"}
    between = (speeds[closest] + speeds[closest + 1]) / 2
    model = replace(models[i], C0=models[i].C0 + low * np.eye(n))
    inside, outside = unstable(model, np.array([between, speeds[closest] * (1 - 3 * gap)]))
    if width > 1e-5:  # nearer by, rounding hides on which side the pair is
        assert abs(inside - outside) == 2
    # And on to the damping at which they merge: two or none, never one, and never in doubt.
    for _ in range(40):
        middle = (low + high) / 2
        low, high = (low, middle) if len(pairs(damped(i, middle))) == fewer else (middle, high)
        assert len(pairs(damped(i, middle))) in (fewer, fewer + 2)


def test_directions_of_a_bicycle():
    found = coefficients(load_bicycle("benchmark")).critical_speeds()
    assert [(c.kind, c.mode, c.direction) for c in found.crossings] == [
        ("pair", "weave", "gained"),
        ("real", "capsize", "lost"),
    ]
    assert found.status == "found"
    assert list(found.to_dict()) == ["weave", "capsize", "stable_ranges", "status", "crossings"]


def test_directions_are_those_of_the_eigenvalues(random_models):
    """A little above each crossing more roots grow than a little below, or fewer, as the direction says."""
    upright = coefficients(load_bicycle("browser"), load_rider("rider-a"), "upright")
    for model in (upright, *(random_models[i] for i in range(0, 300, 30))):
        for c in critical_speeds(model).crossings:
            below, above = unstable(model, np.array([c.speed * (1 - 1e-6), c.speed * (1 + 1e-6)]))
            assert above - below == {"pair": 2, "real": 1}[c.kind] * {"lost": 1, "gained": -1}[c.direction]


@pytest.mark.parametrize("factor", [1e-40, 1e40, 1e-130, 1e130])
def test_masses_of_any_size_have_the_same_speeds(factor):
    """Every term is proportional to mass: speeds, ranges, eigenvalues and status stay."""
    for model in (coefficients(load_bicycle("benchmark")), random_model(3, 5, 1), random_model(2, 5, 1)):
        heavy = replace(model, **{name: getattr(model, name) * factor for name in ("M", "C0", "C1", "S0", "K0", "K2")})
        usual, other = critical_speeds(model), critical_speeds(heavy)
        np.testing.assert_allclose(other.weave_speeds, usual.weave_speeds, rtol=1e-10)
        np.testing.assert_allclose(other.capsize_speeds, usual.capsize_speeds, rtol=1e-10)
        np.testing.assert_allclose(other.ranges, usual.ranges, rtol=1e-10)
        assert other.status == usual.status
        np.testing.assert_allclose(eigenvalues(heavy, 3.0), eigenvalues(model, 3.0), rtol=1e-8)


@pytest.mark.parametrize("factor", [1e-30, 1e30])
@pytest.mark.parametrize("n", [2, 3])
def test_units_of_time_and_length_do_not_matter(n, factor):
    """Time in other units: v C1 and C0 scale once, stiffness twice; speeds once."""
    model = random_model(n, 10, 3, damped=n == 3)
    fast = replace(model, gravity=model.gravity * factor**2, C0=model.C0 * factor, S0=model.S0 * factor**2)
    usual, other = critical_speeds(model), critical_speeds(fast)
    np.testing.assert_allclose(other.weave_speeds, usual.weave_speeds * factor, rtol=1e-9)
    np.testing.assert_allclose(other.capsize_speeds, usual.capsize_speeds * factor, rtol=1e-9)
    assert other.status == usual.status


@pytest.mark.parametrize("n", [2, 3])
def test_faulty_designs_have_no_speeds(n):
    model = random_model(n, 4, 2, damped=n == 3)
    K0 = model.K0.copy()
    K0[2, 0, 0] = np.nan
    faulty = replace(model, K0=K0, faults=(Fault(np.array([False, True, False, False]), "wrong"),))
    found, sound = critical_speeds(faulty), critical_speeds(model)
    assert found.told.tolist() == [True, False, False, True]
    for i in (1, 2):
        assert found.status[i] == "could not tell"
        assert found.weave[i] == found.capsize[i] == found.stable_ranges[i] == []
        assert np.isnan(found.weave_speeds[i]).all()
        assert np.isnan(found.ranges[i]).all()
    for i in (0, 3):
        assert found.crossings[i] == sound.crossings[i]
    assert np.isnan(eigenvalues(faulty, 2.0)[[1, 2]]).all()


def test_never_and_could_not_tell_are_different():
    stiff = replace(random_model(3, 1, 1)[0], C0=50 * np.eye(3), S0=1e4 * np.eye(3), C1=np.zeros((3, 3)), K2=np.eye(3))
    assert critical_speeds(stiff).status == "none"
    assert critical_speeds(stiff).stable_ranges == [(0.0, np.inf)]
    # A third freedom on its own, which swings without a damper at any speed: on the axis everywhere.
    bicycle = coefficients(load_bicycle("benchmark"))

    def beside(matrix, last):
        return np.block([[np.asarray(matrix), np.zeros((2, 1))], [np.zeros((1, 2)), np.array([[last]])]])

    swinging = LinearModel(
        beside(bicycle.M, 1.0),
        beside(bicycle.C1, 0.0),
        beside(bicycle.K0, 0.0),
        beside(bicycle.K2, 0.0),
        bicycle.gravity,
        S0=beside(np.zeros((2, 2)), 5.0),
        coordinates=("lean", "steer", "torso lean"),
        inputs=("lean torque",),
    )
    found = critical_speeds(swinging)
    assert found.status == "could not tell"
    assert found.weave == []
    damped = critical_speeds(replace(swinging, C0=beside(np.zeros((2, 2)), 0.1)))
    assert damped.weave == pytest.approx(bicycle.critical_speeds().weave, rel=1e-10)
    assert damped.capsize == pytest.approx(bicycle.critical_speeds().capsize, rel=1e-10)
    assert [c.mode for c in damped.crossings] == ["weave", "capsize"]


def test_json_has_no_infinity_and_says_so_by_null():
    """A stable range without end: None in the dictionary, null in the text."""
    endless = replace(
        random_model(2, 1, 1)[0], C0=50 * np.eye(2), S0=1e4 * np.eye(2), C1=np.zeros((2, 2)), K2=np.eye(2)
    )
    assert critical_speeds(endless).stable_ranges == [(0.0, np.inf)]
    written = json.loads(json.dumps(critical_speeds(endless).to_dict(), allow_nan=False))
    assert written["stable_ranges"] == [[0.0, None]]
    batch = concatenate([endless, endless])
    assert critical_speeds(batch).to_dict()["stable_ranges"] == [[[0.0, None]], [[0.0, None]]]


@pytest.mark.parametrize("n", [2, 3])
def test_a_design_alone_is_as_in_company(n):
    model = random_model(n, 30, 11)
    together = critical_speeds(model)
    assert together.weave_speeds.shape == together.weave_modes.shape == together.weave_directions.shape
    for i in range(0, 30, 7):
        alone = critical_speeds(model[i])
        assert alone.weave == pytest.approx(together.weave[i], rel=1e-12)
        assert [c[1:] for c in alone.crossings] == [c[1:] for c in together.crossings[i]]
        assert alone.status == together.status[i]


def test_shapes_of_a_batch_of_two_axes():
    model = random_model(3, 6, 4)
    grid = replace(model, **{a: getattr(model, a).reshape(2, 3, 3, 3) for a in ("M", "C0", "C1", "S0", "K0", "K2")})
    found = critical_speeds(grid)
    assert found.told.shape == (2, 3)
    assert found.weave_speeds.shape[:2] == (2, 3)
    assert found.weave_speeds.shape[-1] >= 4
    assert found.ranges.shape[-2:] == (found.ranges.shape[-2], 2)
    assert found.crossings[1][2] == critical_speeds(model).crossings[5]
    assert critical_speeds(model[:0]).weave_speeds.shape == (0, 4)  # two pairs may meet the axis twice, in any batch


@given(st.integers(0, 2**32 - 1), st.integers(2, 4))
@settings(max_examples=30, deadline=None)
def test_a_root_is_on_the_axis_at_every_crossing(seed, n):
    model = random_model(n, 3, seed)
    found = critical_speeds(model)
    assert found.told.all()
    for i, crossings in enumerate(found.crossings):
        for c in crossings:
            roots = eigenvalues(model[i], c.speed)[0]
            axis = np.abs(roots.real) if c.kind == "pair" else np.abs(roots)
            on = np.argmin(axis)
            assert axis[on] < 1e-7 * max(1.0, np.abs(roots).max())
            assert (np.abs(roots[on].imag) > 1e-6) == (c.kind == "pair")
