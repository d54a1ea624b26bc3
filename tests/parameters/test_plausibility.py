"""Odd values are named with a reason; ordinary ones are left alone."""

from math import radians

import pytest

from singletrack import InputError, load_bicycle, load_rider
from singletrack.body.reach import reach, seat_oddities
from singletrack.body.skeleton import skeleton
from singletrack.library import shipped
from singletrack.parameters.plausibility import oddities


@pytest.mark.parametrize("name", shipped("bicycle"))
def test_shipped_bicycles_are_not_odd(name):
    assert oddities(load_bicycle(name)) == ()


def test_shipped_riders_are_not_odd_on_their_bicycles():
    rider = load_rider("rider-a")
    assert oddities(rider) == ()
    for name in rider.forward_lean_angles:
        assert seat_oddities(load_bicycle(name), rider) == ()


@pytest.mark.parametrize(
    ("changes", "parameter", "says"),
    [
        ({"trail": -0.02}, "trail", "is negative"),
        ({"trail": 0.6}, "trail", "outside what is usual"),
        ({"steer_axis_tilt": radians(0.295)}, "steer_axis_tilt", "written as degrees?"),
        ({"steer_axis_tilt": radians(73.1)}, "steer_axis_tilt", "is it the head angle?"),
        ({"seat_tube_angle": radians(1.3)}, "seat_tube_angle", "1.3 radians (74.5 deg)"),
        ({"trail": 60.0}, "trail", "millimetres written as metres?"),
        ({"seat_tube_length": 52.0}, "seat_tube_length", "centimetres written as metres?"),
        ({"wheel_base": 4.0}, "wheel_base", "is outside what is usual, 0.5 to 3 m"),
        ({"rear_frame_x": -2.0}, "rear_frame_x", "tip over backwards"),
        ({"rear_frame_x": -0.1}, "rear_frame_x", "behind the rear contact"),
        ({"front_frame_x": 9.0}, "rear_frame_x", "tip over forwards"),
        ({"gravity": 1.62}, "gravity", "outside what is usual"),
        ({"rear_wheel_inertia_yy": 0.9, "rear_wheel_inertia_xx": 0.5}, "rear_wheel_inertia_yy", "at the tread"),
        ({"standard_deviations": {"trail": 0.05}}, "trail", "more than half of it"),
    ],
)
def test_odd_bicycles(changes, parameter, says):
    found = oddities(load_bicycle("stratos").replace(**changes))
    assert any(odd.parameter == parameter and says in str(odd) for odd in found), list(map(str, found))


def test_a_product_of_inertia_may_be_about_zero():
    bicycle = load_bicycle("stratos").replace(standard_deviations={"rear_frame_inertia_xz": 0.05})
    assert oddities(bicycle) == ()


def test_mass_fractions_that_do_not_sum_to_one():
    found = oddities(load_rider("rider-a").replace(torso_mass_fraction=0.41))
    assert "sum to 0.9, not to 1: the segments weigh 64.8 kg of 72 kg" in str(found[0])


def test_a_grip_that_is_barely_within_reach():
    bicycle, rider = load_bicycle("stratos"), load_rider("rider-a")
    share = reach(skeleton(bicycle, rider), rider)["arm"]
    longer = 0.999 / float(share)
    short = rider.replace(upper_arm_length=0.28 / longer, lower_arm_length=0.33 / longer)
    assert "the arm is stretched to 99.9% of its length" in str(seat_oddities(bicycle, short)[0])


def test_a_batch_has_no_oddities_of_its_own():
    with pytest.raises(InputError, match="single design"):
        oddities(load_bicycle("stratos").replace(trail=[0.05, 0.06]))
