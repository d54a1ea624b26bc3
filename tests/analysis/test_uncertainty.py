"""Uncertainty carried through: linear and sampled, where they agree and where they must not."""

import numpy as np
import pytest

from singletrack import InputError, coefficients, load_bicycle, load_rider
from singletrack.analysis.uncertainty import eigenvalue_uncertainty, linear_uncertainty, sample_designs
from singletrack.closed_form import coefficients as linear_model
from singletrack.files.measured import read_measured
from singletrack.files.source import read_text
from singletrack.linear import modes
from singletrack.posture import Options

# About what a tape measure and a scale give.
DEVIATIONS = {
    **dict.fromkeys(("wheel_base", "trail"), 0.002),
    **dict.fromkeys(("rear_frame_x", "rear_frame_z", "front_frame_x", "front_frame_z"), 0.003),
    **dict.fromkeys(("rear_frame_mass", "front_frame_mass", "rear_wheel_mass", "front_wheel_mass"), 0.02),
    "steer_axis_tilt": 0.0035,
    "front_wheel_inertia_yy": 0.001,
    "rear_wheel_inertia_yy": 0.001,
}


def measured_like(name="stratos", **changes):
    return load_bicycle(name).replace(standard_deviations=DEVIATIONS, **changes)


def test_linear_and_sampled_weave_speed_of_the_measured_stratos_agree(shared_data):
    path = shared_data / "bicycles" / "StratosMeasured.txt"
    found = read_measured(read_text(path), str(path))
    for covariance in (None, (found.names, found.covariance)):
        linear = linear_uncertainty(found.bicycle, covariance=covariance).critical_speeds()
        sampled = sample_designs(found.bicycle, covariance=covariance, samples=4000).critical_speeds()
        np.testing.assert_allclose(linear.weave_deviation, sampled.weave_deviation, rtol=0.05)
        np.testing.assert_allclose(linear.capsize_deviation, sampled.capsize_deviation, rtol=0.05)


@pytest.mark.parametrize(("name", "posture"), [("stratos", "rigid"), ("stratos", "leaned"), ("browser", "upright")])
def test_linear_and_sampled_deviations_agree_with_a_rider(name, posture):
    bike, person = measured_like(name), load_rider("rider-a").replace(standard_deviations={"rider_mass": 0.5})
    if name == "stratos":
        # Arms stretched to 99.5 % do not reach in a seventh of the designs, which the sample then lacks: longer arms.
        person = person.replace(upper_arm_length=0.30)
    linear = linear_uncertainty(bike, person, posture)
    sampled = sample_designs(bike, person, posture, samples=4000)
    for matrix, deviation in linear.matrices().items():
        drawn = np.asarray(getattr(sampled.model, matrix)).std(axis=0)
        np.testing.assert_allclose(drawn, deviation, rtol=0.06, atol=1e-9 + 0.002 * deviation.max())
    speeds = np.array([2.0, 5.0, 8.0])
    one, other = linear.eigenvalues(speeds), sampled.eigenvalues(speeds)
    use = one.linear
    assert use.sum() >= 8
    np.testing.assert_allclose(one.real_deviation[use], other.real_deviation[use], rtol=0.08, atol=1e-4)
    np.testing.assert_allclose(one.imaginary_deviation[use], other.imaginary_deviation[use], rtol=0.08, atol=1e-4)


def test_one_uncertain_parameter_gives_slope_times_deviation():
    bicycle = load_bicycle("stratos")
    speeds = [coefficients(bicycle.replace(trail=0.0563 + h)).critical_speeds().weave[0] for h in (1e-5, -1e-5)]
    slope = (speeds[0] - speeds[1]) / 2e-5
    found = linear_uncertainty(bicycle.replace(standard_deviations={"trail": 0.0016})).critical_speeds()
    assert found.weave_deviation[0] == pytest.approx(abs(slope) * 0.0016, rel=1e-6)


def test_correlation_matters():
    # Two masses that must sum to what the scale shows: their errors cancel in the total.
    bicycle = measured_like()
    names = ("rear_frame_mass", "rear_wheel_mass")
    alone = load_bicycle("stratos").replace(standard_deviations=dict.fromkeys(names, 0.02))
    opposite = (names, 0.02**2 * np.array([[1.0, -1.0], [-1.0, 1.0]]))
    free, bound = linear_uncertainty(alone), linear_uncertainty(alone, covariance=opposite)
    sampled = sample_designs(alone, covariance=opposite, samples=4000)
    assert bound.matrices()["K0"][0, 0] < free.matrices()["K0"][0, 0]
    np.testing.assert_allclose(np.asarray(sampled.model.K0)[:, 0, 0].std(), bound.matrices()["K0"][0, 0], rtol=0.05)
    # Parameters outside the covariance keep their own standard deviations.
    more = linear_uncertainty(bicycle, covariance=opposite)
    assert set(more.derivatives.names) == set(DEVIATIONS)


def test_where_roots_meet_the_sample_takes_over():
    bicycle = measured_like()
    fine = linear_uncertainty(bicycle).eigenvalues(np.linspace(0.1, 3.0, 5801))
    meeting = fine.speeds[np.argmax(fine.real_deviation.max(axis=-1))]
    speeds = np.sort(np.append(np.linspace(0.0, 3.0, 31), meeting))
    joined = eigenvalue_uncertainty(bicycle, speeds=speeds, samples=500)
    straight = linear_uncertainty(bicycle).eigenvalues(speeds)
    assert 0 < (~joined.linear).sum() < joined.linear.size / 3
    # At the meeting the linear deviation grows without bound; the joined one stays below the spread of the roots.
    assert straight.real_deviation.max() > 3 * joined.real_deviation.max()
    assert np.isfinite(joined.real_interval).all()
    assert (joined.real_interval[0] <= joined.real_interval[1]).all()
    np.testing.assert_array_equal(joined.real_deviation[joined.linear], straight.real_deviation[joined.linear])


def test_the_central_95_percent_hold_95_percent():
    bicycle = measured_like()
    linear = linear_uncertainty(bicycle).eigenvalues([6.0])
    fresh = modes(sample_designs(bicycle, samples=4000, seed=11).model, [6.0]).eigenvalues[:, 0]
    low, high = linear.real_interval[:, 0]
    inside = ((fresh.real > low) & (fresh.real < high)).mean(axis=0)
    np.testing.assert_allclose(inside, 0.95, atol=0.015)


def test_the_same_seed_draws_the_same_designs():
    bicycle = measured_like()
    first, same, other = (np.asarray(sample_designs(bicycle, samples=50, seed=s).model.M) for s in (3, 3, 4))
    np.testing.assert_array_equal(first, same)
    assert not np.array_equal(first, other)


def test_designs_that_cannot_exist_are_left_out():
    # The tensor's entry (x, z) may not exceed what keeps the frame's moments positive.
    bicycle = load_bicycle("stratos").replace(standard_deviations={"front_frame_inertia_xz": 0.06})
    drawn = sample_designs(bicycle, samples=500)
    assert 50 < drawn.model.shape[0] < 500 == drawn.drawn
    with pytest.raises(InputError, match="standard deviations are too large"):
        sample_designs(bicycle.replace(standard_deviations={"front_frame_inertia_xz": 10.0}), samples=500)


@pytest.mark.parametrize(
    ("deviations", "says"),
    [
        ({}, "no parameter has a standard deviation"),
        ({"trail": 0.0}, "no parameter has a standard deviation"),
        ({"trail": -1.0}, "must be finite and zero or more"),
        ({"trail": float("nan")}, "must be finite and zero or more"),
    ],
)
def test_deviations_that_make_no_sense_are_refused(deviations, says):
    with pytest.raises(InputError, match=says):
        linear_uncertainty(load_bicycle("stratos").replace(standard_deviations=deviations))


def test_other_refusals():
    bicycle = measured_like()
    with pytest.raises(InputError, match="single design"):
        linear_uncertainty(bicycle.replace(trail=np.array([0.05, 0.06])))
    with pytest.raises(InputError, match="samples = 3"):
        sample_designs(bicycle, samples=3)
    with pytest.raises(InputError, match="covariance has shape"):
        linear_uncertainty(bicycle, covariance=(("trail",), np.eye(2)))


def test_designs_in_which_the_rider_does_not_reach_are_left_out_of_the_sample():
    # Arms stretched to 99.5 % of their length: some bars within the standard deviations are out of reach.
    bicycle, rider = measured_like(), load_rider("rider-a")
    drawn = sample_designs(bicycle, rider, "rigid", samples=400)
    assert 200 < drawn.model.shape[0] < 400
    found = eigenvalue_uncertainty(bicycle, rider, speeds=np.linspace(0, 8, 17), samples=400)
    assert np.isfinite(found.real_deviation).all()


@pytest.mark.parametrize(
    "options",
    [
        Options("upright", dampers={"steer": 3.0}),
        Options("upright", torso_lean=True, springs={"torso lean": 50.0}),
    ],
)
def test_a_sample_keeps_all_freedoms_springs_and_dampers(options):
    """Against the same designs made one by one, from the same draws: only the trail is uncertain."""
    bicycle, rider = load_bicycle("browser").replace(standard_deviations={"trail": 0.002}), load_rider("rider-a")
    found = sample_designs(bicycle, rider, options, samples=12, seed=3)
    draws = np.random.default_rng(3).standard_normal((12, 1))[:, 0]
    each = [linear_model(bicycle.replace(trail=bicycle.trail + 0.002 * d), rider, options) for d in draws]
    assert found.model.coordinates == each[0].coordinates
    for name in ("M", "C0", "C1", "K0", "S0", "K2"):
        own = np.asarray(getattr(found.model, name))
        for k, one in enumerate(each):
            np.testing.assert_allclose(own[k], getattr(one, name), rtol=1e-9, atol=1e-9)
    assert (np.abs(np.asarray(found.model.C0)).max() > 0) == bool(options.dampers)
    spread = eigenvalue_uncertainty(bicycle, rider, options, speeds=[1.0, 5.0], samples=30)
    assert spread.names == modes(found.nominal, [1.0]).names
