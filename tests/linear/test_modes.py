"""Modes: nothing lost, nothing doubled, names that depend on bicycle and speed alone."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from designs import random_bicycle
from singletrack import CoefficientMatrices, InputError, coefficients, load_bicycle, load_rider
from singletrack.linear.characteristic import characteristic_polynomial
from singletrack.linear.meetings import find_meetings, meeting_speeds
from singletrack.linear.root_order import arrange

COUNTS = (5, 11, 101, 1001)


def assert_permutation(model, speeds):
    named = model.modes(speeds).eigenvalues
    np.testing.assert_array_equal(np.sort_complex(named), np.sort_complex(model.eigenvalues(speeds)))


def assert_names_do_not_depend_on_the_number_of_speeds(model):
    dense = model.modes(np.linspace(0, 10, 1001)).eigenvalues
    for count, step in ((11, 100), (101, 10)):
        np.testing.assert_array_equal(model.modes(np.linspace(0, 10, 1001)[::step]).eigenvalues, dense[..., ::step, :])
        assert count == dense[..., ::step, :].shape[-2]


def meetings_of(model):
    p = characteristic_polynomial(model)
    parts = (np.reshape(a, (-1, a.shape[-1])) for a in (p.a4, p.a3, p.a2, p.a1, p.a0))
    return find_meetings(type(p)(*parts)).speeds


def assert_continuous(model, last=10.0, count=4001):
    """Each speed's roots continue those of the speed before; a name passes on only where roots meet."""
    speeds = np.linspace(0.0, last, count)[1:]
    roots = model.modes(speeds).eigenvalues.reshape(-1, count - 1, 4)
    before, after = roots[:, :-1], roots[:, 1:]
    nearest = np.abs(after[..., None, :] - before[..., :, None]).min(axis=-1)
    jumps = (np.abs(after - before) > 5 * nearest + 0.2).any(axis=-1)
    meetings = meetings_of(model)[:, None, :]
    step = speeds[1] - speeds[0]
    met = ((meetings >= speeds[:-1, None] - step) & (meetings <= speeds[1:, None] + step)).any(axis=-1)
    assert not (jumps & ~met).any()
    return jumps


@pytest.mark.parametrize("count", COUNTS)
def test_columns_are_a_permutation(combination, count):
    assert_permutation(combination, np.linspace(0, 10, count))


@pytest.mark.parametrize("count", COUNTS)
def test_columns_of_random_bicycles_are_a_permutation(random_models, count):
    part = slice(None) if count < 1001 else slice(None, None, 10)
    some = replace(random_models, **{name: getattr(random_models, name)[part] for name in ("M", "C1", "K0", "K2")})
    assert_permutation(some, np.linspace(0, 10, count))


def test_names_do_not_depend_on_the_number_of_speeds(combination):
    assert_names_do_not_depend_on_the_number_of_speeds(combination)


def test_names_of_random_bicycles_do_not_depend_on_the_number_of_speeds(random_models):
    assert_names_do_not_depend_on_the_number_of_speeds(random_models)


def test_a_speed_has_the_same_names_alone_and_in_company(random_models):
    speeds = np.random.default_rng(5).uniform(0, 10, 7)
    together = random_models.modes(speeds).eigenvalues
    for i, speed in enumerate(speeds):
        np.testing.assert_array_equal(random_models.modes(speed).eigenvalues[:, 0], together[:, i])


def test_modes_are_continuous(combination):
    assert not assert_continuous(combination).any()


def test_modes_of_random_bicycles_are_continuous(random_models):
    assert_continuous(random_models, count=1501)


def test_through_meeting_and_splitting_nothing_is_lost(combination):
    """Speeds within rounding of every meeting, where real and paired roots can hardly be told apart."""
    meetings = meeting_speeds(characteristic_polynomial(combination))
    if len(meetings) == 0:
        pytest.skip("roots of this combination never meet")
    near = meetings[:, None] * (1 + np.array([-1e-9, -1e-13, -1e-15, 0, 1e-15, 1e-13, 1e-9]))
    assert_permutation(combination, np.sort(near.ravel()))


def test_meetings_are_double_roots(combination):
    for speed in meeting_speeds(characteristic_polynomial(combination)):
        roots = combination.eigenvalues(speed)[0]
        gaps = np.abs(roots[:, None] - roots)[np.triu_indices(4, 1)]
        assert gaps.min() < 1e-5 * np.abs(roots).max()  # a double root has half the digits


def test_a_pair_that_meets_and_splits_keeps_its_order():
    """The Stratos alone: capsize and castering are a pair from 0.46 to 2.31 m/s, castering the faster one outside."""
    modes = coefficients(load_bicycle("stratos")).modes([0.2, 1.0, 3.0])
    capsize, castering = modes.eigenvalues[:, 2], modes.eigenvalues[:, 3]
    assert castering[0].real < capsize[0].real
    assert castering[1] == np.conj(capsize[1])
    assert castering[2].real < capsize[2].real
    assert modes.applies[:, 3].tolist() == [False, False, True]


@pytest.mark.parametrize("speed", [4.0, 6.0, 8.0])
def test_names_are_those_of_the_paper(speed):
    modes = coefficients(load_bicycle("stratos"), load_rider("rider-a")).modes(speed)
    weave, conjugate, capsize, castering = modes.eigenvalues[0]
    assert weave.imag > 0
    assert conjugate == np.conj(weave)
    assert capsize.imag == castering.imag == 0
    assert castering.real < -10 < capsize.real
    assert modes.applies.all()
    assert abs(modes.eigenmotions[0, 3, 1]) > 10  # castering is steer


def test_castering_does_not_apply_to_the_slow_upright_rider():
    modes = coefficients(load_bicycle("browser"), load_rider("rider-a"), "upright").modes([1.0, 8.0])
    assert modes.applies[:, 3].tolist() == [False, True]


@pytest.fixture(scope="module")
def random_riders():
    """Rider A on 150 random bicycles, rigid and leaned; some of them have meetings of three roots."""
    rng = np.random.default_rng(1899)
    bicycles = [random_bicycle(load_bicycle(name), rng, 75) for name in ("stratos", "browser")]
    parts = [coefficients(b, load_rider("rider-a"), p) for b in bicycles for p in ("rigid", "leaned")]
    good = [np.isfinite(part.M).all(axis=(1, 2)) for part in parts]
    matrices = (
        np.concatenate([getattr(part, name)[mask] for part, mask in zip(parts, good, strict=True)])
        for name in ("M", "C1", "K0", "K2")
    )
    return CoefficientMatrices(*matrices, np.array(9.81))


def test_names_of_random_riders(random_riders):
    assert_permutation(random_riders, np.linspace(0, 10, 101))
    assert_names_do_not_depend_on_the_number_of_speeds(random_riders)
    jumps = assert_continuous(random_riders, count=1501)
    assert jumps.any()  # some names do pass on: that is what the next test is about


def test_weave_is_the_oscillation(random_riders):
    """Where there is one pair, of a bicycle whose pair at high speed is weave, it is weave or has nothing of weave."""
    for model in (random_riders, coefficients(load_bicycle("stratos"), load_rider("rider-a"), "leaned", "axial")):
        roots = model.modes(np.linspace(0, 10, 501)).eigenvalues.reshape(-1, 4)
        one_pair = (roots.imag != 0).sum(axis=-1) == 2
        of_weave = (roots[one_pair][:, :2].imag != 0).sum(axis=-1)
        assert set(of_weave.tolist()) <= {0, 2}


@pytest.mark.parametrize("factor", [1 - 1e-5, 1 + 1e-5, 1.001])
def test_names_bear_small_changes(factor):
    """Three roots of this rider meet at almost one speed; the names at other speeds must not depend on which two."""
    stratos, speeds = load_bicycle("stratos"), [0.7, 3.3, 4.5, 6.0]
    one, other = (
        coefficients(stratos.replace(trail=stratos.trail * f), load_rider("rider-a"), "leaned", "axial").modes(speeds)
        for f in (1.0, factor)
    )
    np.testing.assert_allclose(other.eigenvalues, one.eigenvalues, atol=0.05)


def test_order_and_repetition_of_speeds_are_kept():
    model = coefficients(load_bicycle("browser"))
    modes = model.modes([5.0, 1.0, 5.0])
    np.testing.assert_array_equal(modes.eigenvalues[0], modes.eigenvalues[2])
    np.testing.assert_array_equal(modes.speeds, [5.0, 1.0, 5.0])


@pytest.mark.parametrize("speeds", [[-1.0], [np.nan], "fast", [[1.0]], [True]])
def test_speeds_that_are_none(speeds):
    with pytest.raises(InputError, match="speeds"):
        coefficients(load_bicycle("stratos")).modes(speeds)


def test_labelled_modes():
    data = coefficients(load_bicycle("stratos")).modes([2.0, 4.0]).to_xarray()
    assert data["eigenvalues"].sel(mode="capsize").dims == ("speed",)
    assert data["eigenvalues"].attrs["units"] == "1/s"


@given(
    st.lists(st.complex_numbers(max_magnitude=1e3, allow_nan=False, allow_infinity=False), min_size=2, max_size=2),
    st.lists(st.floats(-1e3, 1e3), min_size=4, max_size=4),
    st.sampled_from([0, 2, 4]),
    st.booleans(),
)
@settings(max_examples=300, deadline=None)
def test_the_order_holds_all_roots(pairs, reals, count, descending):
    for roots in (
        [pairs[0], pairs[0].conjugate(), pairs[1], pairs[1].conjugate()],
        [pairs[0], pairs[0].conjugate(), *reals[:2]],
        reals,
    ):
        given_roots = np.array(roots, dtype=complex)
        ordered = arrange(given_roots, np.array(count), np.array(descending))
        np.testing.assert_array_equal(np.sort_complex(ordered), np.sort_complex(given_roots))


@given(st.integers(0, 2**32 - 1))
@settings(max_examples=25, deadline=None)
def test_any_matrices_give_a_permutation(seed):
    """Also matrices that no bicycle has."""
    rng = np.random.default_rng(seed)
    root = rng.normal(size=(40, 2, 2))
    K2 = rng.normal(size=(40, 2, 2)) * np.array([0.0, 1.0])
    symmetric = rng.normal(size=(40, 2, 2))
    model = CoefficientMatrices(
        root @ np.swapaxes(root, 1, 2) + 0.1 * np.eye(2),
        rng.normal(size=(40, 2, 2)),
        symmetric + np.swapaxes(symmetric, 1, 2),
        K2,
        np.array(9.81),
    )
    assert_permutation(model, np.linspace(0, 10, 23))
