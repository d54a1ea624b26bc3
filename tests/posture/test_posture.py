"""Loops: closed to second order, mirror-symmetric, and refused where they cannot move."""

from __future__ import annotations

import numpy as np
import pytest

from singletrack import InputError, PostureError, coefficients, load_bicycle, load_rider
from singletrack.body import skeleton
from singletrack.posture import Options, seat, slaved_bodies, steered_skeleton
from singletrack.posture.motion import joint_motion

RIDER = load_rider("rider-a")
PASSIVE = [(name, posture) for posture in ("leaned", "upright", "moore-2012") for name in ("stratos", "browser")]


@pytest.mark.parametrize(("name", "posture"), PASSIVE)
def test_left_and_right_mirror_each_other(name, posture):
    """Steering left is the mirror image of steering right: J and H of one arm are those of the other."""
    bicycle = load_bicycle(name)
    seated = seat(bicycle, RIDER, posture)
    bodies = slaved_bodies(seated, bicycle)
    index = {segment: i for i, segment in enumerate(seated.segments)}
    mirror = np.array([1.0, -1.0, 1.0])
    for segment, right in index.items():
        left = index[segment.replace("right", "left")] if "right" in segment else None
        if left is None:
            continue
        np.testing.assert_allclose(bodies.displacement[0, left], -mirror * bodies.displacement[0, right], atol=1e-12)
        np.testing.assert_allclose(bodies.curvature[0, left], mirror * bodies.curvature[0, right], atol=1e-10)
        # Rotations are axial vectors: the mirror turns their sign around.
        np.testing.assert_allclose(bodies.rotation[0, left], mirror * bodies.rotation[0, right], atol=1e-12)


@pytest.mark.parametrize(("name", "posture"), PASSIVE)
def test_what_lies_in_the_middle_moves_sideways_first(name, posture):
    bicycle = load_bicycle(name)
    seated = seat(bicycle, RIDER, posture)
    bodies = slaved_bodies(seated, bicycle)
    for i, segment in enumerate(seated.segments):
        if segment in ("head", "torso"):
            np.testing.assert_allclose(bodies.displacement[0, i][[0, 2]], 0.0, atol=1e-14)
            np.testing.assert_allclose(bodies.curvature[0, i][1], 0.0, atol=1e-14)


@pytest.mark.parametrize(("name", "posture"), PASSIVE)
def test_error_of_second_order_is_of_third_order(name, posture):
    """Arms keep their lengths up to steer³: halving the angle divides the error by eight."""
    bicycle = load_bicycle(name)
    seated = seat(bicycle, RIDER, posture)

    def error(angle):
        points = steered_skeleton(seated, bicycle, np.asarray(angle))
        lengths = np.linalg.norm(points[[22, 18]] - points[[20, 22]], axis=1)  # points 21 to 23 to 19
        return np.abs(lengths - [RIDER.upper_arm_length, RIDER.lower_arm_length]).max()

    assert error(2e-3) / error(1e-3) == pytest.approx(8.0, rel=0.05)


def test_rigid_rider_does_not_move():
    bicycle = load_bicycle("stratos")
    bodies = slaved_bodies(seat(bicycle, RIDER), bicycle)
    for motion in (bodies.rotation, bodies.displacement, bodies.curvature):
        assert not motion.any()


def test_torso_of_the_leaned_rider_pitches_to_second_order_only():
    bicycle = load_bicycle("stratos")
    first, second, _ = joint_motion(seat(bicycle, RIDER, "leaned"), bicycle)
    assert abs(first["torso pitch"]) < 1e-14
    assert abs(second["torso pitch"]) > 1e-2


def test_shoulder_axes_differ():
    bicycle = load_bicycle("stratos")
    assert seat(bicycle, RIDER, "leaned").shoulder == "abduction"
    assert seat(bicycle, RIDER, "upright").shoulder == "axial"
    other = seat(bicycle, RIDER, Options("upright", "abduction"))
    assert [joint.name for joint in other.joints][:3] == [
        "right shoulder flexion",
        "right shoulder abduction",
        "right elbow",
    ]


def test_unknown_names():
    bicycle = load_bicycle("stratos")
    with pytest.raises(InputError, match="unknown posture 'uprigth'; did you mean upright"):
        coefficients(bicycle, RIDER, "uprigth")
    with pytest.raises(InputError, match="unknown shoulder"):
        seat(bicycle, RIDER, Options("leaned", "axal"))
    with pytest.raises(InputError, match="needs a rider"):
        coefficients(bicycle, posture="leaned")


def test_a_straight_arm_cannot_follow():
    """Upper and lower arm in one line: the elbow is singular, and the message says so."""
    bicycle = load_bicycle("stratos")
    points = skeleton(bicycle, RIDER)
    distance = float(np.linalg.norm(points[19] - points[21]))
    stretched = RIDER.replace(upper_arm_length=distance - RIDER.lower_arm_length + 1e-15)
    with pytest.raises(PostureError, match=r"reaches only|stretched straight"):
        coefficients(bicycle, stretched, "upright")
