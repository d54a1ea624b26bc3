"""Arms: straight or bent, in the plane of the bicycle or out of it, on any bar."""

from __future__ import annotations

import numpy as np
import pytest

from singletrack import InputError, PostureError, closed_form, load_bicycle, load_rider, multibody
from singletrack.body import rider_segments, skeleton
from singletrack.mechanics import combine
from singletrack.parameters.shapes import SegmentShape
from singletrack.posture import Options, seat

BICYCLE, RIDER = load_bicycle("browser"), load_rider("rider-a")


def arms(points):
    return [[points[a] for a in chain] for chain in ((21, 23, 19), (22, 24, 20))]


@pytest.mark.parametrize(("width", "drop", "angle"), [(0.6, 0.0, None), (0.36, -0.1, 0.7), (0.5, -0.05, 1.2)])
def test_arms_out_of_plane_keep_their_lengths_and_mirror(width, drop, angle):
    bicycle = BICYCLE.replace(handlebar_width=width, handlebar_drop=drop)
    points = skeleton(bicycle, RIDER.replace(elbow_drop_angle=angle))
    right, left = arms(points)
    for shoulder, elbow, grip in (right, left):
        assert np.linalg.norm(elbow - shoulder) == pytest.approx(RIDER.upper_arm_length, rel=1e-12)
        assert np.linalg.norm(grip - elbow) == pytest.approx(RIDER.lower_arm_length, rel=1e-12)
    np.testing.assert_allclose(left, np.array(right) * [1, -1, 1], atol=1e-15)
    assert points[19][1] - points[20][1] == pytest.approx(width)
    assert points[19][2] == pytest.approx(points[16][2] + drop)
    normal = points.elbow_axis("right")
    for line in (right[1] - right[0], right[2] - right[1]):
        assert abs(normal @ line) < 1e-14


def test_elbows_hang_down_unless_turned_out():
    bicycle = BICYCLE.replace(handlebar_width=0.62)

    def elbow(angle=None):
        return skeleton(bicycle, RIDER.replace(elbow_drop_angle=angle))[23]

    hanging = elbow()
    assert skeleton(bicycle, RIDER).elbow_axis("right")[2] == 0.0
    for angle in (1.5, 1.0, 0.5):
        assert elbow(angle)[2] < hanging[2]
        assert elbow(angle)[1] > hanging[1]


def test_a_bar_as_wide_as_the_shoulders_changes_nothing():
    same = BICYCLE.replace(handlebar_width=RIDER.shoulder_to_shoulder, handlebar_drop=0.0)
    np.testing.assert_allclose(skeleton(same, RIDER).points, skeleton(BICYCLE, RIDER).points, atol=1e-15)
    for posture in ("upright", "leaned"):
        one, other = (closed_form.coefficients(bicycle, RIDER, posture) for bicycle in (same, BICYCLE))
        np.testing.assert_allclose(one.M, other.M, rtol=1e-12)


@pytest.mark.parametrize("options", [Options("upright"), Options("leaned"), Options("leaned", arms="bent")])
def test_engines_agree_on_wide_bars_and_turned_elbows(options):
    bicycle = BICYCLE.replace(handlebar_width=0.58, handlebar_drop=-0.04)
    rider = RIDER.replace(elbow_drop_angle=1.0)
    one, other = (make.coefficients(bicycle, rider, options) for make in (closed_form, multibody))
    for name in ("M", "C1", "K0", "K2"):
        expected = getattr(one, name)
        np.testing.assert_allclose(getattr(other, name), expected, rtol=0, atol=1e-10 * np.abs(expected).max())


def test_a_bar_out_of_reach():
    with pytest.raises(PostureError, match=r"shoulder-grip distance is .* but the arm"):
        skeleton(BICYCLE.replace(handlebar_width=1.4), RIDER)


def test_straight_arms_are_one_cylinder_each():
    points = skeleton(BICYCLE, RIDER)
    segments = rider_segments(RIDER, points, "straight")
    assert len(segments) == 8
    arm = segments["right_arm"]
    assert float(arm.mass) == pytest.approx(72.0 * (0.022 + 0.028))
    np.testing.assert_allclose(arm.centre, (points[21] + points[19]) / 2)
    assert float(arm.radius) == pytest.approx((0.30 * 0.28 + 0.23 * 0.33) / 0.61 / (2 * np.pi))
    length = np.linalg.norm(points[19] - points[21])
    along = (points[19] - points[21]) / length
    assert along @ arm.inertia @ along == pytest.approx(float(arm.mass * arm.radius**2) / 2)
    bent = combine([rider_segments(RIDER, points)[f"right_{part}_arm"] for part in ("upper", "lower")])
    assert float(bent.mass) == pytest.approx(float(arm.mass))


def test_straight_arms_of_known_shape_keep_both_parts_moments():
    """Parts with the shape of their cylinders: the whole is that of two cylinders in line."""
    points = skeleton(BICYCLE, RIDER)

    def cylinder(kind):
        length, radius = getattr(RIDER, f"{kind}_length"), getattr(RIDER, f"{kind}_circumference") / (2 * np.pi)
        across = np.sqrt((3 * radius**2 + length**2) / 12) / length
        return SegmentShape(0.5, radius / np.sqrt(2) / length, across, across)

    shaped = RIDER.replace(shapes={kind: cylinder(kind) for kind in ("upper_arm", "lower_arm")})
    arm = rider_segments(shaped, points, "straight")["right_arm"]
    line = points[19] - points[21]
    along = line / np.linalg.norm(line)
    expected = sum(
        72.0 * fraction * (around / (2 * np.pi)) ** 2 / 2 for fraction, around in ((0.028, 0.30), (0.022, 0.23))
    )
    assert along @ arm.inertia @ along == pytest.approx(expected)
    stretched = 0.28 / 0.61 * np.linalg.norm(line)
    assert np.linalg.norm(arm.centre - points[21]) == pytest.approx(
        (0.028 * 0.14 + 0.022 * (stretched + 0.165)) / 0.05, rel=1e-12
    )


def test_torso_as_given():
    width, thickness = RIDER.torso_section
    assert thickness == pytest.approx(0.2199, abs=1e-4)
    given = RIDER.replace(torso_width=0.40)
    assert given.torso_section == (0.40, thickness)
    assert RIDER.replace(torso_thickness=0.2).torso_section == (width, 0.2)
    with pytest.raises(InputError, match="torso_width"):
        RIDER.replace(torso_width=-0.1)
    # A chest that goes around no torso of the derived width is no matter where both are given.
    RIDER.replace(chest_circumference=0.5, torso_width=0.3, torso_thickness=0.2)


def test_seated_straight_arms_have_their_names():
    assert {"right_arm", "left_arm"} < set(seat(BICYCLE, RIDER, "leaned").segments)
    assert "right_upper_arm" in seat(BICYCLE, RIDER, Options("leaned", arms="bent")).segments
