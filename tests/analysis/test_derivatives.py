"""Derivatives by a complex step against closed forms, differences and one another."""

import numpy as np
import pytest

from singletrack import InputError, coefficients, linear, load_bicycle, load_rider
from singletrack.analysis.derivatives import derivatives
from singletrack.posture import Options

CASES = [
    ("benchmark", None, "rigid", None),
    ("stratos", "rider-a", "rigid", None),
    ("stratos", "rider-a", "leaned", None),
    ("stratos", "rider-a", "leaned", "axial"),
    ("browser", "rider-a", "upright", None),
]


def case(bicycle, rider, posture, shoulder):
    bike = load_bicycle(bicycle)
    return bike, None if rider is None else load_rider(rider).on(bike), posture, shoulder


def changed(bike, person, name, value):
    if name in bike.values():
        return bike.replace(**{name: value}), person
    return bike, person.replace(**{name: value})


@pytest.mark.parametrize("which", CASES, ids=str)
def test_every_parameter_against_differences(which):
    bike, person, posture, shoulder = case(*which)
    values = {**bike.values(), **({} if person is None else person.values())}
    slopes = derivatives(bike, person, Options(posture, shoulder), list(values))
    for i, (name, value) in enumerate(values.items()):
        step = 1e-6 * max(abs(value), 0.01)
        ends = [coefficients(*changed(bike, person, name, value + h), posture, shoulder) for h in (step, -step)]
        for matrix, derivative in slopes.matrices.items():
            numeric = (getattr(ends[0], matrix) - getattr(ends[1], matrix)) / (2 * step)
            scale = 1e-6 * (1 + np.abs(getattr(ends[0], matrix)).max() / max(abs(value), 0.01))
            np.testing.assert_allclose(derivative[i], numeric, atol=scale, err_msg=f"{matrix} by {name}")


@pytest.mark.parametrize("which", CASES, ids=str)
def test_eigenvalues_and_critical_speeds_against_differences(which):
    bike, person, posture, shoulder = case(*which)
    names = ["trail", "steer_axis_tilt", "front_frame_mass", "gravity", "rear_wheel_inertia_yy"]
    slopes = derivatives(bike, person, Options(posture, shoulder), names)
    speeds = np.array([0.7, 3.3, 7.1])
    roots = linear.eigenvalues(slopes.model, speeds)
    found = slopes.eigenvalues(speeds[:, None], roots)
    for i, name in enumerate(names):
        value = getattr(bike, name)
        step = 1e-5 * value
        ends = [coefficients(*changed(bike, person, name, value + h), posture, shoulder) for h in (step, -step)]
        numeric = (ends[0].eigenvalues(speeds) - ends[1].eigenvalues(speeds)) / (2 * step)
        np.testing.assert_allclose(found[..., i], numeric, rtol=1e-4, atol=1e-4 * np.abs(numeric).max())
        for kind in ("weave", "capsize"):
            critical = [np.asarray(getattr(end.critical_speeds(), kind)) for end in ends]
            expected = (critical[0] - critical[1]) / (2 * step)
            own = slopes.critical_speeds(getattr(linear.critical_speeds(slopes.model), kind), kind)[:, i]
            np.testing.assert_allclose(own, expected, rtol=1e-4, atol=1e-6)


def test_gravity_and_speed_scale_as_they_must():
    # Froude: eigenvalues grow with sqrt(g) when the speed does; so v d/dv + 2 g d/dg of s is s.
    slopes = derivatives(load_bicycle("benchmark"), names=["gravity"])
    speeds = np.array([1.0, 4.5, 8.0])[:, None]
    roots = linear.modes(slopes.model, speeds[:, 0]).eigenvalues
    total = speeds * slopes.eigenvalues_by_speed(speeds, roots) + 2 * 9.81 * slopes.eigenvalues(speeds, roots)[..., 0]
    np.testing.assert_allclose(total, roots, rtol=1e-9)


def test_unknown_parameters_are_refused():
    with pytest.raises(InputError, match="trial"):
        derivatives(load_bicycle("benchmark"), names=["trial"])
