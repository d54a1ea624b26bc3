"""Records: frozen, validated, any shape."""

from __future__ import annotations

import dataclasses

import numpy as np
import pytest

from singletrack import Bicycle, InputError, Rider, coefficients, load_bicycle, load_rider
from singletrack.parameters.rider import MASS_FRACTIONS

STRATOS, RIDER = load_bicycle("stratos"), load_rider("rider-a")
POSITIVE = [n for n, p in Bicycle.descriptions().items() if p.allowed == "positive"]
NOT_NEGATIVE = [n for n, p in Bicycle.descriptions().items() if p.allowed == "not negative"]
ANGLES = [(record, n) for record in (STRATOS, RIDER) for n, p in record.descriptions().items() if p.allowed == "angle"]


@pytest.mark.parametrize("name", POSITIVE)
@pytest.mark.parametrize("value", [0.0, -1.0, float("nan"), float("inf")])
def test_lengths_masses_and_moments_are_positive(name, value):
    with pytest.raises(InputError, match=f"stratos: .*{name} = "):
        STRATOS.replace(**{name: value})


@pytest.mark.parametrize("name", NOT_NEGATIVE)
@pytest.mark.parametrize("value", [-1e-3, float("nan"), float("inf")])
def test_wheels_and_moments_are_zero_or_more(name, value):
    with pytest.raises(InputError, match=f"stratos: .*{name} = .*, must be zero or more"):
        STRATOS.replace(**{name: value})


@pytest.mark.parametrize("degrees", [-90.0, 90.0, 16.9 * 180 / np.pi])
def test_the_steer_axis_leans_less_than_90_degrees(degrees):
    with pytest.raises(InputError, match=r"steer_axis_tilt = .* must be between -90 and 90 deg"):
        STRATOS.replace(steer_axis_tilt=np.radians(degrees))


@pytest.mark.parametrize(
    ("changes", "says"),
    [
        ({"rear_wheel_radius": 0.0}, "spin infinitely fast, must be greater than zero unless rear_wheel_inertia_yy"),
        ({"front_wheel_mass": 0.0}, "front_wheel_mass = 0 kg .* unless the wheel has no inertia"),
    ],
)
def test_a_wheel_without_radius_or_mass_has_no_inertia(changes, says):
    with pytest.raises(InputError, match=says):
        STRATOS.replace(**changes)


def test_a_front_assembly_that_moves_no_mass_is_refused():
    wheel = {f"front_wheel_{part}": 0.0 for part in ("mass", "radius", "inertia_xx", "inertia_yy")}
    frame = {f"front_frame_inertia_{axes}": 0.0 for axes in ("xx", "yy", "zz", "xz")}
    on_the_axis = {"trail": 0.0, "steer_axis_tilt": 0.0, "front_frame_x": float(STRATOS.wheel_base)}
    bicycle = STRATOS.replace(**wheel, **frame, **on_the_axis)
    with pytest.raises(InputError, match="stratos: the mass matrix is not positive definite"):
        coefficients(bicycle)
    # A little off the axis, the equations stand; in a batch the others go on.
    both = coefficients(bicycle.replace(front_frame_x=float(STRATOS.wheel_base) + np.array([0.0, 0.01])))
    assert both.valid.tolist() == [False, True]


@pytest.mark.parametrize("name", ["trail", "rear_frame_x", "handlebar_length", "front_frame_inertia_xz"])
def test_signed_parameters_are_finite(name):
    for value in (float("nan"), float("-inf")):
        with pytest.raises(InputError, match=f"{name} = .* must be a finite number"):
            STRATOS.replace(**{name: value})


@pytest.mark.parametrize(("record", "name"), ANGLES, ids=lambda value: value if isinstance(value, str) else "")
@pytest.mark.parametrize("value", [0.0, -0.3, np.pi / 2, 16.9, 82.9])
def test_angles_are_between_0_and_90_degrees(record, name, value):
    with pytest.raises(InputError, match=f"{name} = .* must be between 0 and 90 deg"):
        record.replace(**{name: value})


@pytest.mark.parametrize("value", ["0.05", None, True, [1, "a"], {}])
def test_values_are_numbers(value):
    with pytest.raises(InputError, match="trail"):
        STRATOS.replace(trail=value)


@pytest.mark.parametrize(
    ("changes", "body"),
    [
        ({"rear_frame_inertia_yy": 3.0}, "rear_frame"),
        ({"rear_frame_inertia_xz": 0.5}, "rear_frame"),
        ({"front_frame_inertia_xx": 0.5}, "front_frame"),
        ({"front_wheel_inertia_yy": 0.3}, "front_wheel"),
        ({"rear_wheel_inertia_xx": 0.02}, "rear_wheel"),
    ],
)
def test_inertias_that_no_body_has(changes, body):
    with pytest.raises(InputError, match=f"{body}_inertia .* is no body's"):
        STRATOS.replace(**changes)


def test_all_faults_are_told_at_once():
    with pytest.raises(InputError) as error:
        STRATOS.replace(trail=np.nan, wheel_base=-1.0)
    assert "trail" in str(error.value)
    assert "wheel_base" in str(error.value)


def test_centre_of_mass_below_the_ground():
    with pytest.raises(InputError, match="z points down"):
        STRATOS.replace(rear_frame_z=0.4825)


def test_torso_without_width_or_thickness():
    with pytest.raises(InputError, match="leaves no torso"):
        RIDER.replace(shoulder_to_shoulder=0.09)
    with pytest.raises(InputError, match="does not go around"):
        RIDER.replace(chest_circumference=0.6)


def test_unknown_names_offer_the_nearest():
    with pytest.raises(InputError, match="did you mean wheel_base"):
        STRATOS.replace(wheelbase=1.0)


def test_records_are_frozen_and_replace_copies():
    with pytest.raises(dataclasses.FrozenInstanceError):
        STRATOS.trail = 0.1
    assert STRATOS.replace(trail=0.1).trail == 0.1
    assert STRATOS.trail == 0.0563


def test_rider_a_is_all_there():
    assert sum(getattr(RIDER, name) * count for name, count in MASS_FRACTIONS.items()) == pytest.approx(1.0, abs=1e-15)


def test_stadium_has_the_chest_circumference():
    width, thickness = RIDER.torso_section
    assert 2 * (width - thickness) + np.pi * thickness == pytest.approx(RIDER.chest_circumference)


def test_lean_angle_belongs_to_rider_on_bicycle():
    assert np.degrees(RIDER.on(load_bicycle("browser")).forward_lean_angle) == pytest.approx(82.9)
    assert RIDER.replace(forward_lean_angle=1.0).on(STRATOS).forward_lean_angle == 1.0
    with pytest.raises(InputError, match="forward_lean_angle on bicycle 'benchmark' is not known"):
        RIDER.on(load_bicycle("benchmark"))


def test_a_bad_design_in_a_batch_is_flagged_in_place():
    batch = STRATOS.replace(trail=np.array([0.05, np.nan, 0.06]), wheel_base=np.array([1.0, 1.0, -1.0]))
    model = coefficients(batch)
    assert model.valid.tolist() == [True, False, False]
    reasons = [fault.reason((1,)) for fault in model.faults if fault.bad[1]]
    assert reasons == ["trail = nan m, must be a finite number"]
    good = coefficients(STRATOS.replace(trail=0.05, wheel_base=1.0))
    np.testing.assert_array_equal(model.M[0], good.M)


def test_batch_is_the_same_as_one_by_one():
    lengths = np.array([0.25, 0.27, 0.28])
    for posture in ("rigid", "leaned", "upright"):
        together = coefficients(load_bicycle("browser"), RIDER.replace(upper_arm_length=lengths), posture)
        for i, length in enumerate(lengths):
            alone = coefficients(load_bicycle("browser"), RIDER.replace(upper_arm_length=float(length)), posture)
            for name in ("M", "C1", "K0", "K2"):
                np.testing.assert_allclose(getattr(together, name)[i], getattr(alone, name), rtol=1e-12, atol=1e-13)


def test_unreachable_grip_in_a_batch():
    rider = RIDER.replace(upper_arm_length=np.array([0.28, 0.1]))
    model = coefficients(STRATOS, rider, "upright")
    assert model.valid.tolist() == [True, False]
    (fault,) = model.faults
    assert fault.reason((1,)).startswith("the shoulder-grip distance is 0.6067 m, but the arm")
    assert np.isfinite(model.M[0]).all()
    assert np.isnan(model.eigenvalues(5.0)[1]).all()


def test_every_parameter_is_described():
    for cls in (Bicycle, Rider):
        for name, description in cls.descriptions().items():
            assert description.meaning, name
            assert description.symbol, name
