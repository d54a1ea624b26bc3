"""Round tyres: the closed form against the nonlinear engine, by hand, through files, and what they do to capsize."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from singletrack import InputError, closed_form, coefficients, load_bicycle, load_rider, multibody

CASES = [("benchmark", None, "rigid"), ("stratos", "rider-a", "leaned"), ("browser", "rider-a", "upright")]


@pytest.mark.parametrize(("name", "rider", "posture"), CASES)
@pytest.mark.parametrize(
    "tyres",
    [{"rear_tyre_radius": 0.025}, {"front_tyre_radius": 0.03}, {"rear_tyre_radius": 0.02, "front_tyre_radius": 0.04}],
)
def test_both_derivations_agree(name: str, rider: Any, posture: str, tyres: Any) -> None:
    bicycle, rider = load_bicycle(name).replace(**tyres), rider and load_rider(rider)
    one, other = (maker.coefficients(bicycle, rider, posture) for maker in (closed_form, multibody))
    for matrix in ("M", "C1", "K0", "K2"):
        np.testing.assert_allclose(getattr(one, matrix), getattr(other, matrix), atol=1e-10, err_msg=matrix)
    knife = closed_form.coefficients(load_bicycle(name), rider, posture)
    np.testing.assert_array_equal(one.K2, knife.K2)
    assert np.all(np.linalg.eigvalsh(one.K0 - knife.K0) > -1e-12)  # a round tyre only ever lifts


def test_with_a_soft_frame_and_fork_too() -> None:
    soft = {
        "frame_torsion_stiffness": 5e3,
        "frame_hinge_x": 0.9,
        "frame_hinge_z": -0.6,
        "fork_bending_stiffness": 8e3,
        "fork_hinge_x": 1.0,
        "fork_hinge_z": -0.5,
    }
    bicycle = load_bicycle("benchmark").replace(rear_tyre_radius=0.02, front_tyre_radius=0.03, **soft)
    one, other = (maker.coefficients(bicycle) for maker in (closed_form, multibody))
    assert one.freedoms == other.freedoms == 4
    for matrix in ("M", "C1", "K0", "K2"):
        np.testing.assert_allclose(getattr(one, matrix), getattr(other, matrix), atol=1e-9, err_msg=matrix)


def test_the_load_on_a_wheel_is_lifted() -> None:
    bicycle = load_bicycle("benchmark")
    knife, tyre = (coefficients(b) for b in (bicycle, bicycle.replace(rear_tyre_radius=0.03)))
    bodies = {"rear_wheel": 0.0, "rear_frame": 0.3, "front_frame": 0.9, "front_wheel": 1.02}
    masses = {"rear_wheel": 2.0, "rear_frame": 85.0, "front_frame": 4.0, "front_wheel": 3.0}
    rear_load = sum(masses[name] * (1.0 - x / 1.02) for name, x in bodies.items())
    np.testing.assert_allclose(tyre.K0 - knife.K0, [[0.03 * rear_load, 0.0], [0.0, 0.0]], atol=1e-12)


def test_batches_and_the_shift_of_the_capsize_speed() -> None:
    bicycle = load_bicycle("benchmark")
    radii = np.linspace(0.0, 0.04, 5)
    models = coefficients(bicycle.replace(rear_tyre_radius=radii, front_tyre_radius=radii))
    assert models.shape == (5,)
    np.testing.assert_array_equal(models[0].K0, coefficients(bicycle).K0)
    single = coefficients(bicycle.replace(rear_tyre_radius=0.02, front_tyre_radius=0.02))
    np.testing.assert_allclose(models[2].K0, single.K0, rtol=1e-14)
    capsize = [models[i].critical_speeds().capsize[0] for i in range(3)]
    assert np.all(np.diff(capsize) < 0.0)  # rounder tyres capsize sooner


def test_a_tyre_rounder_than_its_wheel_is_refused() -> None:
    with pytest.raises(InputError, match=r"front_tyre_radius = 0.4 m .* must not exceed front_wheel_radius = 0.35 m"):
        load_bicycle("benchmark").replace(front_tyre_radius=0.4)
    with pytest.raises(InputError, match="rear_tyre_radius"):
        load_bicycle("benchmark").replace(rear_tyre_radius=-0.01)
