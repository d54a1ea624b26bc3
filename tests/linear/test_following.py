"""Modes of any number of freedoms: all roots, followed with proof, named by physics, whatever is asked for."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from designs import random_bicycle
from linear.random_models import random_model
from linear.torso import with_torso
from singletrack import InputError, coefficients, load_bicycle, load_rider
from singletrack.arrays import Fault
from singletrack.linear import critical_speeds, eigenvalues, modes
from singletrack.linear.branches import find_branches, in_order, places
from singletrack.linear.modes import _of_any_freedoms
from singletrack.linear.pencil import pencil

CASES = [(2, True), (3, True), (3, False), (4, True), (4, False)]


def assert_permutation(model, speeds):
    named = modes(model, speeds).eigenvalues
    np.testing.assert_array_equal(np.sort_complex(named), np.sort_complex(eigenvalues(model, speeds)))
    return named


@pytest.mark.parametrize(("n", "damped"), CASES)
def test_columns_are_a_permutation_and_do_not_depend_on_the_speeds_asked_for(n, damped):
    model, speeds = random_model(n, 30, seed=50 + n, damped=damped), np.linspace(0.0, 10.0, 101)
    dense = assert_permutation(model, speeds)
    np.testing.assert_array_equal(modes(model, speeds[::20]).eigenvalues, dense[:, ::20])
    np.testing.assert_array_equal(modes(model, 4.0).eigenvalues[:, 0], dense[:, 40])
    np.testing.assert_array_equal(modes(model[7], speeds).eigenvalues, dense[7])
    assert_permutation(model, np.array([0.0, 1e-9, 1e3, 1e5, 2e8]))


@given(st.integers(0, 2**32 - 1), st.integers(3, 4))
@settings(max_examples=10, deadline=None)
def test_any_matrices_give_a_permutation(seed, n):
    assert_permutation(random_model(n, 4, seed), np.linspace(0, 10, 23))


@pytest.mark.parametrize(("n", "damped"), CASES)
def test_each_mode_goes_on_where_it_was(n, damped):
    """Between speeds so near that every root has moved less than a tenth of its distance to others, names stay."""
    model = random_model(n, 8 if n < 4 else 3, seed=5, damped=damped)
    speeds = np.linspace(0.05, 8.0, 4001)
    named = modes(model, speeds).eigenvalues
    before, after = named[:, :-1], named[:, 1:]
    own = np.eye(2 * n, dtype=bool)
    gap = np.where(own, np.inf, np.abs(before[..., :, None] - before[..., None, :])).min(axis=(-2, -1))
    pairs_stay = ((before.imag != 0) == (after.imag != 0)).all(axis=-1)
    nearest = np.abs(after[..., None, :] - before[..., :, None]).min(axis=-2).max(axis=-1)
    calm = (nearest < 0.1 * gap) & pairs_stay
    assert calm.mean() > 0.9
    step = np.abs(after - before).max(axis=-1)
    # Within weave the columns are in order of their imaginary or real parts: compared as sets.
    assert (step[calm] < 0.11 * gap[calm]).all()


@pytest.mark.parametrize("seed", [20071001, 5])
def test_two_freedoms_are_named_as_by_the_exact_meetings(seed):
    """Two ways to follow that have nothing in common, on random bicycles and on riders with meetings of three roots."""
    rng, speeds = np.random.default_rng(seed), np.linspace(0.05, 12.0, 120)
    bicycles = [random_bicycle(load_bicycle(name), rng, 60) for name in ("benchmark", "stratos", "browser")]
    models = [coefficients(bicycle) for bicycle in bicycles]
    models += [coefficients(b, load_rider("rider-a"), posture) for b in bicycles[1:] for posture in ("rigid", "leaned")]
    for model in models:
        exact, general = modes(model, speeds), _of_any_freedoms(model, speeds)
        good = np.isfinite(exact.eigenvalues).all(axis=(1, 2))
        np.testing.assert_allclose(general.eigenvalues[good], exact.eigenvalues[good], rtol=1e-6, atol=1e-6)


def test_shipped_models_are_named_as_by_the_exact_meetings(combination):
    speeds = np.linspace(0.05, 12.0, 500)
    exact, general = modes(combination, speeds), _of_any_freedoms(combination, speeds)
    np.testing.assert_allclose(general.eigenvalues, exact.eigenvalues, rtol=1e-6, atol=1e-6)
    np.testing.assert_array_equal(general.applies, exact.applies)


@pytest.mark.parametrize("seed", [3, 4])
def test_anything_of_two_freedoms_is_named_as_by_the_exact_meetings(seed):
    """Matrices with the zeros that a bicycle's have, else anything: several meetings, two pairs that pass."""
    model = random_model(2, 400, seed, damped=False)
    C1 = model.C1.copy()
    C1[:, 0, 0] = 0.0
    model = replace(model, K2=model.K2 * [0.0, 1.0], C1=C1)
    speeds = np.linspace(0.05, 12.0, 60)
    general, exact = _of_any_freedoms(model, speeds), modes(model, speeds)
    np.testing.assert_allclose(general.eigenvalues, exact.eigenvalues, rtol=1e-6, atol=1e-6)


@pytest.mark.parametrize("n", [2, 3, 4])
def test_roots_stay_in_their_discs(n):
    """What the proof says: at any speed of an interval each disc holds as many roots as at any other."""
    p, _ = pencil(random_model(n, 15, seed=n))
    b = find_branches(p)
    rng = np.random.default_rng(n)
    for _ in range(4):
        v = b.low + (b.high - b.low) * rng.uniform(size=len(b.low))
        roots = np.sort_complex(np.linalg.eigvals(p.rows(b.design).state(v[:, None]))[:, 0])
        found = places(b, roots, v)
        t = (v - (b.low + b.high) / 2)[:, None]
        centre = b.centre[:, 0] + t * b.centre[:, 1] + t * t * b.centre[:, 2]
        assert (np.abs(found - centre) <= b.radius + 1e-9 * (1 + np.abs(found))).all()
    # The intervals of a design cover all speeds once.
    for design in range(len(p)):
        own = np.sort(b.low[b.design == design])
        np.testing.assert_array_equal(np.append(own[1:], b.high.max()), np.sort(b.high[b.design == design]))


def test_the_order_that_lasts_is_a_permutation():
    rng = np.random.default_rng(1)
    roots = np.sort_complex(np.linalg.eigvals(rng.normal(size=(200, 6, 6))).astype(complex))
    np.testing.assert_array_equal(np.sort_complex(in_order(roots)), roots)


SPEEDS = np.array([0.5, 2.0, 5.0, 8.0])


def test_a_stiff_torso_is_a_mode_of_its_own_and_leaves_the_bicycle_s_names():
    """With a spring that hardly gives, weave, capsize and castering are those of the rigid rider."""
    bicycle = load_bicycle("stratos")
    stiff = with_torso(bicycle, spring=1e7, damper=2e3)
    rigid = replace(
        coefficients(bicycle), **{name: np.asarray(getattr(stiff, name))[:2, :2] for name in ("M", "C1", "K0", "K2")}
    )
    found, wanted = modes(stiff, SPEEDS), modes(rigid, SPEEDS)
    assert found.names == ("weave", "weave", "capsize", "castering", "torso lean", "torso lean")
    np.testing.assert_allclose(found.eigenvalues[:, :4], wanted.eigenvalues, rtol=1e-3)
    np.testing.assert_array_equal(found.applies[:, :4], wanted.applies)
    assert found.applies[:, 4:].all()
    assert (np.abs(found.eigenvalues[:, 4].imag) > 1000).all()


def test_a_torso_that_falls_over_has_two_real_roots():
    found = modes(with_torso(load_bicycle("stratos")), [5.0, 8.0, 20.0])
    torso = found.eigenvalues[:, 4:]
    assert (torso.imag == 0).all()
    assert (torso[:, 0].real < 0).all()
    assert (torso[:, 1].real > 0).all()
    assert found.applies.all()


def test_an_overdamped_torso_has_two_real_roots_and_leaves_capsize_its_name():
    model = with_torso(load_bicycle("stratos"), spring=500.0, damper=400.0)
    found = modes(model, [6.0, 8.0, 10.0])
    assert (found.eigenvalues[:, 4:].imag == 0).all()
    assert found.applies[:, :4].all()
    (capsize,) = (c.speed for c in critical_speeds(model).crossings if c.mode == "capsize")
    assert abs(modes(model, capsize).eigenvalues[0, 2]) < 1e-9


def test_a_torso_that_has_met_capsize_leaves_castering_its_name():
    """Rider A's torso with 128 N m/rad and 50 N m s/rad: one root alone, one in a pair with capsize."""
    model = coefficients(
        load_bicycle("stratos"),
        load_rider("rider-a"),
        "leaned",
        torso_lean=True,
        springs={"torso lean": 128.0},
        dampers={"torso lean": 50.0},
    )
    found = modes(model, [2.0, 5.0, 10.0])
    assert found.applies[:, 3:5].all()
    assert (found.eigenvalues[:, 4].real < found.eigenvalues[:, 3].real).all()
    np.testing.assert_array_equal(found.eigenvalues[1:, 5], found.eigenvalues[1:, 2].conj())
    assert not found.applies[1:, [2, 5]].any()


@pytest.mark.parametrize(("spring", "damper"), [(100.0, 10.0), (110.0, 20.0), (128.0, 50.0)])
def test_a_torso_that_has_met_capsize_leaves_weave_whole(spring, damper):
    """Weave is the pair that grows with the speed, capsize is slow, whatever the torso does with it when riding."""
    model = coefficients(
        load_bicycle("stratos-2012"),
        load_rider("rider-a").replace(torso_width=0.40),
        "leaned",
        torso_lean=True,
        springs={"torso lean": spring},
        dampers={"torso lean": damper},
    )
    roots = modes(model, [8.0, 10.0, 30.0, 60.0]).eigenvalues
    np.testing.assert_array_equal(roots[:, 0], roots[:, 1].conj())
    assert (np.abs(roots[:, 0].imag) > 1).all()
    grown = np.abs(roots[3] / roots[2])
    np.testing.assert_allclose(grown[:2], 2, rtol=0.15)
    assert (np.abs(roots[2:, 2]) < 1).all()


@pytest.mark.parametrize(("bicycle", "posture"), [("browser", "upright"), ("stratos", "leaned"), ("stratos", "rigid")])
@pytest.mark.parametrize("damper", [20.0, 50.0])
def test_castering_grows_past_a_damped_torso_and_never_falls(bicycle, posture, damper):
    """Rider A's torso with a damper: its decaying root hardly moves, castering passes it as a pair in between."""
    model = coefficients(
        load_bicycle(bicycle), load_rider("rider-a"), posture, torso_lean=True, dampers={"torso lean": damper}
    )
    found = modes(model, [5.0, 60.0, 120.0])
    castering, torso = found.eigenvalues[:, 3], found.eigenvalues[:, 4:]
    assert (castering.real < 0).all()
    # As physics has it at high speed: castering as fast as the speed is high, the torso's roots bounded, one falls.
    assert castering[2].real / castering[1].real == pytest.approx(2.0, rel=0.05)
    assert torso[2].real.max() > 1.0
    assert torso[2].real.min() == pytest.approx(torso[1].real.min(), rel=0.4)
    # At riding speed the torso's decaying root is that of its damper, faster than castering, or in a pair with it.
    assert torso[0].real.min() <= castering[0].real + 1e-9


def test_crossings_and_modes_have_the_same_names():
    for spring, damper in ((500.0, 30.0), (1e5, 100.0), (2000.0, 100.0)):
        model = with_torso(load_bicycle("stratos"), spring, damper)
        for crossing in critical_speeds(model).crossings:
            found = modes(model, crossing.speed)
            on_axis = np.argmin(np.abs(found.eigenvalues[0].real))
            assert found.names[on_axis] == crossing.mode


def test_a_third_freedom_on_its_own_does_not_disturb():
    """Beside a bicycle and coupled to nothing: its roots pass through the bicycle's, and every name stays."""
    bicycle = coefficients(load_bicycle("benchmark"))
    parts = {name: np.pad(np.asarray(getattr(bicycle, name)), ((0, 1), (0, 1))) for name in ("M", "C1", "K0", "K2")}
    last = np.diag([0.0, 0.0, 1.0])
    parts["M"] = parts["M"] + last
    model = replace(
        bicycle,
        **parts,
        C0=1.0 * last,
        S0=9.0 * last,
        B=None,
        coordinates=("lean", "steer", "torso lean"),
    )
    speeds = np.linspace(0.3, 10, 60)
    found = modes(model, speeds)
    np.testing.assert_allclose(found.eigenvalues[:, 4], -0.5 + 1j * np.sqrt(8.75), rtol=1e-9)
    np.testing.assert_allclose(found.eigenvalues[:, :4], modes(bicycle, speeds).eigenvalues, rtol=1e-6, atol=1e-9)


def test_two_further_freedoms_have_their_own_names():
    model = random_model(4, 1, 3)[0]
    heavy = np.diag([1.0, 1.0, 0.0, 0.0])
    apart = replace(
        model,
        M=np.eye(4) + 0.01 * model.M,
        C0=np.diag([1.0, 1.0, 0.4, 0.6]),
        S0=np.diag([0.0, 0.0, 400.0, 2500.0]),
        **{name: heavy @ getattr(model, name) @ heavy for name in ("C1", "K0", "K2")},
    )
    found = modes(apart, [1.0, 3.0])
    assert found.names[4:] == ("torso lean", "torso lean", "head lean", "head lean")
    assert found.applies[:, 4:].all()
    frequency = np.abs(found.eigenvalues[:, 4:].imag)
    assert (frequency[:, :2] < 30).all()
    assert (frequency[:, 2:] > 30).all()


def test_roots_that_coincide_at_every_speed_come_to_an_end():
    """Two further freedoms alike in everything: nothing tells their roots apart, and still none is lost."""
    bicycle = coefficients(load_bicycle("benchmark"))
    parts = {name: np.pad(np.asarray(getattr(bicycle, name)), ((0, 2), (0, 2))) for name in ("M", "C1", "K0", "K2")}
    last = np.diag([0.0, 0.0, 1.0, 1.0])
    names = ("lean", "steer", "torso lean", "head lean")
    model = replace(bicycle, **(parts | {"M": parts["M"] + last}), C0=last, S0=9 * last, B=None, coordinates=names)
    p, _ = pencil(model)
    assert len(find_branches(p).design) < 2000
    assert_permutation(model, np.linspace(0.0, 10.0, 11))


def test_labels_of_more_freedoms():
    data = modes(random_model(3, 2, 1), [1.0, 2.0]).to_xarray()
    assert data["mode"].values.tolist() == [
        "weave +",
        "weave -",
        "capsize",
        "castering",
        "torso lean +",
        "torso lean -",
    ]
    assert data["eigenmotions"].sizes == {"design_0": 2, "speed": 2, "mode": 6, "coordinate": 3}
    written = modes(random_model(3, 1, 1)[0], [1.0]).to_dict()
    assert written["modes"][-1] == "torso lean"
    assert np.shape(written["eigenvalues"]) == (1, 6, 2)


@pytest.mark.parametrize("n", [2, 3])
def test_no_speeds_negative_ones_and_faults(n):
    model = random_model(n, 3, 1, damped=n == 3)
    assert modes(model, []).eigenvalues.shape == (3, 0, 2 * n)
    assert modes(model, []).eigenmotions.shape == (3, 0, 2 * n, n)
    assert modes(model, []).applies.shape == (3, 0, 2 * n)
    with pytest.raises(InputError, match="zero or more"):
        modes(model, [1.0, -1.0])
    with pytest.raises(InputError, match="speed of light"):
        modes(model, 1e200)
    faulty = replace(model, faults=(Fault(np.array([False, True, False]), "wrong"),))
    found = modes(faulty, [1.0, 2.0])
    assert np.isnan(found.eigenvalues[1]).all()
    assert not found.applies[1].any()
    np.testing.assert_array_equal(found.eigenvalues[[0, 2]], modes(model, [1.0, 2.0]).eigenvalues[[0, 2]])


def test_weave_is_one_pair_at_speed_where_a_sprung_torso_has_met_capsize():
    sprung = {"springs": {"torso lean": 100.0}, "dampers": {"torso lean": 10.0}, "torso_lean": True}
    model = coefficients(load_bicycle("stratos-2012"), load_rider("rider-a"), posture="leaned", **sprung)
    found = modes(model, [5.0, 8.0, 10.0, 20.0])
    weave = found.eigenvalues[:, :2]
    np.testing.assert_array_equal(weave[:, 0], weave[:, 1].conj())
    assert (np.abs(weave[:, 0].imag) == np.abs(found.eigenvalues.imag).max(axis=1)).all()
