"""Free joints in batches and on JAX, and what springs may be."""

from __future__ import annotations

import numpy as np
import pytest

from mechanisms import random_mechanism
from singletrack import InputError, closed_form, coefficients, load_bicycle, load_rider
from singletrack.posture import Options, load_posture, mechanism_of

BICYCLE = load_bicycle("browser")
RIDER = load_rider("rider-a").on(BICYCLE)
NAMES = ("M", "C0", "C1", "S0", "K0", "K2")


def batch(seed=5, count=4):
    rng = np.random.default_rng(seed)
    bicycle = BICYCLE.replace(trail=BICYCLE.trail * rng.uniform(0.9, 1.1, count))
    return bicycle, RIDER.replace(
        rider_mass=72.0 * rng.uniform(0.9, 1.1, count), torso_length=0.48 * rng.uniform(0.99, 1.01, count)
    )


@pytest.mark.parametrize(
    "options",
    [
        Options("upright", torso_lean=True, springs={"torso lean": np.array([100.0, 200.0, 0.0, 50.0]), "steer": 2.0}),
        Options("leaned", torso_lean=True, dampers={"torso twist": 3.0}),
        Options("moore-2012", torso_lean=True),
        Options("upright", springs={"hands": 2000.0}),
        Options(random_mechanism(3)),
        Options(random_mechanism(6)),
    ],
    ids=lambda options: options.title,
)
def test_a_batch_is_its_designs_one_by_one(options):
    bicycle, rider = batch()
    together = closed_form.coefficients(bicycle, rider, options)
    for k in range(4):
        alone_bicycle = bicycle.replace(trail=float(bicycle.trail[k]))
        alone = rider.replace(rider_mass=float(rider.rider_mass[k]), torso_length=float(rider.torso_length[k]))
        laws = {name: float(np.broadcast_to(value, 4)[k]) for name, value in options.springs.items()}
        one = Options(options.posture, options.shoulder, options.arms, options.torso_lean, laws, options.dampers)
        single = closed_form.coefficients(alone_bicycle, alone, one)
        for name in NAMES:
            found, expected = np.broadcast_to(getattr(together, name), (4, *single.M.shape))[k], getattr(single, name)
            np.testing.assert_allclose(found, expected, rtol=1e-10, atol=1e-11 * max(1.0, np.abs(expected).max()))


def test_jax_gives_the_same_with_free_joints_and_its_derivative():
    jax = pytest.importorskip("jax")
    before = jax.config.jax_enable_x64
    jax.config.update("jax_enable_x64", val=True)
    try:
        options = Options("upright", torso_lean=True, springs={"torso lean": 100.0})

        def inertia(trail):
            return closed_form.coefficients(BICYCLE.replace(trail=trail), RIDER, options).M

        expected = closed_form.coefficients(BICYCLE, RIDER, options)
        np.testing.assert_allclose(jax.jit(inertia)(BICYCLE.trail), expected.M, rtol=1e-12)
        slope = jax.jacfwd(inertia)(BICYCLE.trail)
        ends = [np.asarray(inertia(BICYCLE.trail + h)) for h in (1e-5, -1e-5)]
        np.testing.assert_allclose(slope, (ends[0] - ends[1]) / 2e-5, rtol=1e-6, atol=1e-8)
    finally:
        jax.config.update("jax_enable_x64", val=before)


@pytest.mark.parametrize(
    ("options", "words"),
    [
        ({"springs": {"torso lean": 100.0}}, "unknown joint of a spring 'torso lean'"),
        ({"springs": {"steer": -1.0}}, "spring at steer: found -1.0 N m/rad"),
        ({"dampers": {"steer": float("nan")}}, "damper at steer: found nan"),
        ({"springs": {"steer": "stiff"}}, "spring at steer: found 'stiff', must be a number"),
    ],
)
def test_laws_that_cannot_be(options, words):
    with pytest.raises(InputError, match=words):
        coefficients(BICYCLE, RIDER, "upright", **options)


def test_what_needs_a_rider():
    model = coefficients(BICYCLE, springs={"steer": 3.0}, dampers={"steer": 0.5})
    assert (model.S0[1, 1], model.C0[1, 1]) == (3.0, 0.5)
    for options, words in (
        ({"torso_lean": True}, "torso lean needs a rider"),
        ({"springs": {"hands": 3.0}}, "a spring or damper at hands needs a rider"),
        ({"fit": 2.5}, "fit needs a rider"),
    ):
        with pytest.raises(InputError, match=words):
            coefficients(BICYCLE, **options)


def test_torso_lean_twice_is_refused_and_a_file_says_its_own_arms():
    leaning = mechanism_of(Options("upright", torso_lean=True))
    assert leaning.freedoms == ("torso lean",)
    with pytest.raises(InputError, match="has a joint torso lean already"):
        mechanism_of(Options(leaning, torso_lean=True))
    with pytest.raises(InputError, match="is a mechanism; its file says"):
        mechanism_of(Options(load_posture("upright"), shoulder="axial"))


def test_torso_lean_carries_all_but_the_legs():
    for posture in ("rigid", "upright", "leaned", "moore-2012"):
        mechanism = mechanism_of(Options(posture, torso_lean=True))
        for segment, joint in mechanism.segments.items():
            assert (joint == "frame") == ("leg" in segment)
        roots = {joint.name for joint in mechanism.joints if joint.parent == "frame"}
        assert roots == {"torso lean"}
