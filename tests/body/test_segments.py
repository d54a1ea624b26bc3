"""Segments where they belong: each limb on its own axis, shaped segments with their mass on the right side."""

from __future__ import annotations

from math import cos, pi, radians, sin
from typing import Any

import numpy as np
import pytest

from singletrack import load_bicycle, load_rider
from singletrack.body import rider_segments, skeleton
from singletrack.parameters.shapes import SEGMENTS, SegmentShape

BICYCLE = load_bicycle("stratos")
RIDER = load_rider("rider-a")
LIMBS = {
    "upper_arm": ((21, 23), (22, 24)),
    "lower_arm": ((23, 19), (24, 20)),
    "upper_leg": ((30, 28), (31, 29)),
    "lower_leg": ((28, 26), (29, 27)),
}
SHAPES = {
    name: SegmentShape(0.31 + 0.02 * i, 0.21 + 0.01 * i, 0.3 + 0.01 * i, 0.33 - 0.01 * i)
    for i, name in enumerate(SEGMENTS)
}


def unit(vector: Any) -> Any:
    return vector / np.linalg.norm(vector)


def about(tensor: Any, mass: float, axis: Any) -> float:
    """Return the radius of gyration about an axis that has to be a principal one."""
    np.testing.assert_allclose(tensor @ axis, axis * (axis @ tensor @ axis), atol=1e-12 * abs(tensor).max())
    return float(np.sqrt(axis @ tensor @ axis / mass))


def length_of(rider: Any, name: str) -> float:
    return rider.head_circumference / (2 * pi) if name == "head" else getattr(rider, f"{name}_length")


@pytest.mark.parametrize("name", LIMBS)
@pytest.mark.parametrize("side", [0, 1], ids=["right", "left"])
def test_a_limb_is_a_cylinder_between_its_joints(name: str, side: int) -> None:
    points = skeleton(BICYCLE, RIDER)
    segment = rider_segments(RIDER, points)[("right_", "left_")[side] + name]
    start, end = (np.asarray(points[number]) for number in LIMBS[name][side])
    length, radius = getattr(RIDER, f"{name}_length"), getattr(RIDER, f"{name}_circumference") / (2 * pi)
    assert segment.radius == pytest.approx(radius, rel=1e-14)
    np.testing.assert_allclose(segment.centre, (start + end) / 2, rtol=1e-14)
    axis = unit(end - start)
    assert about(segment.inertia, segment.mass, axis) == pytest.approx(radius / np.sqrt(2), rel=1e-12)
    for normal in (np.array([0.0, 1.0, 0.0]), np.cross(axis, [0.0, 1.0, 0.0])):
        expected = np.sqrt((3 * radius**2 + length**2) / 12)
        assert about(segment.inertia, segment.mass, normal) == pytest.approx(expected, rel=1e-12)


@pytest.mark.parametrize("name", SEGMENTS)
def test_a_shaped_segment_has_its_mass_on_the_side_of_its_inner_joint(name: str) -> None:
    points = skeleton(BICYCLE, RIDER)
    shaped = rider_segments(RIDER.replace(shapes=SHAPES), points)
    plain = rider_segments(RIDER, points)
    up = unit(points[15] - points[13])
    for side, found in enumerate(("right_", "left_")[: 2 if name in LIMBS else 1]):
        segment = shaped[found + name] if name in LIMBS else shaped[name]
        ends = LIMBS.get(name, {"head": ((15, 25),), "torso": ((13, 15),)}.get(name))[side]
        inner, outer = (np.asarray(points[number]) for number in ends)
        axis, shape, length = unit(outer - inner), SHAPES[name], length_of(RIDER, name)
        np.testing.assert_allclose(segment.centre, inner + shape.centre * length * axis, rtol=1e-13)
        sideways = np.array([0.0, 1.0, 0.0])
        radii = [
            about(segment.inertia, segment.mass, each) / length for each in (axis, sideways, np.cross(axis, sideways))
        ]
        expected = [shape.gyration_along, shape.gyration_sideways, shape.gyration_across]
        np.testing.assert_allclose(radii, expected, rtol=1e-12)
        assert segment.mass == (plain[found + name] if name in LIMBS else plain[name]).mass
        if name in {"head", "torso"}:
            np.testing.assert_allclose(axis, up, atol=1e-14)


def test_shapes_of_one_segment_leave_the_others_alone() -> None:
    points = skeleton(BICYCLE, RIDER)
    plain = rider_segments(RIDER, points)
    for name in SEGMENTS:
        shaped = rider_segments(RIDER.replace(shapes={name: SHAPES[name]}), points)
        for other in plain:
            same = np.array_equal(shaped[other].inertia, plain[other].inertia)
            assert same == (other.removeprefix("right_").removeprefix("left_") != name)


@pytest.mark.parametrize("length", [0.2, 0.45], ids=["grips ahead", "grips behind"])
def test_a_bar_as_wide_as_the_shoulders_changes_nothing(length: float) -> None:
    rider = RIDER.replace(forward_lean_angle=radians(50.0 if length > 0.2 else 75.0))
    bicycle = load_bicycle("browser").replace(handlebar_length=length)
    plain = skeleton(bicycle, rider)
    wide = skeleton(bicycle.replace(handlebar_width=rider.shoulder_to_shoulder), rider)
    assert (plain[19][0] < plain[21][0]) == (length > 0.2)
    np.testing.assert_allclose(wide.points, plain.points, atol=1e-14)
    np.testing.assert_allclose(wide.elbow_axis("right"), plain.elbow_axis("right"), atol=1e-12)


def test_a_straight_arm_is_one_cylinder_as_thick_as_both_parts() -> None:
    bicycle = load_bicycle("browser").replace(handlebar_width=0.5)  # arms that are not parallel
    points = skeleton(bicycle, RIDER)
    arms = rider_segments(RIDER, points, "straight")
    upper, lower = RIDER.upper_arm_length, RIDER.lower_arm_length
    around = (RIDER.upper_arm_circumference * upper + RIDER.lower_arm_circumference * lower) / (upper + lower)
    radius = around / (2 * pi)
    mass = (RIDER.upper_arm_mass_fraction + RIDER.lower_arm_mass_fraction) * RIDER.rider_mass
    for name, (start, end) in {"right_arm": (21, 19), "left_arm": (22, 20)}.items():
        shoulder, grip = np.asarray(points[start]), np.asarray(points[end])
        arm, line = arms[name], grip - shoulder
        assert arm.mass == pytest.approx(mass, rel=1e-14)
        assert arm.radius == pytest.approx(radius, rel=1e-14)
        np.testing.assert_allclose(arm.centre, (shoulder + grip) / 2, rtol=1e-14)
        assert about(arm.inertia, arm.mass, unit(line)) == pytest.approx(radius / np.sqrt(2), rel=1e-12)
        normal = unit(np.cross(line, [0.3, 1.0, 0.2]))
        expected = np.sqrt((3 * radius**2 + line @ line) / 12)
        assert about(arm.inertia, arm.mass, normal) == pytest.approx(expected, rel=1e-12)


def test_shaped_straight_arms_are_both_parts_in_line() -> None:
    shapes = {name: SHAPES[name] for name in ("upper_arm", "lower_arm")}
    rider = RIDER.replace(shapes=shapes)
    points = skeleton(BICYCLE, rider)
    arms = rider_segments(rider, points, "straight")
    upper, lower = rider.upper_arm_length, rider.lower_arm_length
    for name, (start, end) in {"right_arm": (21, 19), "left_arm": (22, 20)}.items():
        shoulder, grip = np.asarray(points[start]), np.asarray(points[end])
        axis = unit(grip - shoulder)
        elbow = shoulder + upper / (upper + lower) * (grip - shoulder)
        masses, centres, radii = [], [], []
        for kind, inner, length in (("upper_arm", shoulder, upper), ("lower_arm", elbow, lower)):
            masses.append(getattr(rider, f"{kind}_mass_fraction") * rider.rider_mass)
            centres.append(inner + shapes[kind].centre * length * axis)
            radii.append(np.array([shapes[kind].gyration_along, shapes[kind].gyration_sideways]) * length)
        arm = arms[name]
        whole = sum(masses)
        centre = sum(m * c for m, c in zip(masses, centres, strict=True)) / whole
        assert arm.mass == pytest.approx(whole, rel=1e-14)
        np.testing.assert_allclose(arm.centre, centre, rtol=1e-13)
        along = sum(m * r[0] ** 2 for m, r in zip(masses, radii, strict=True))
        sideways = sum(
            m * (r[1] ** 2 + (c - centre) @ (c - centre)) for m, r, c in zip(masses, radii, centres, strict=True)
        )
        assert axis @ arm.inertia @ axis == pytest.approx(along, rel=1e-12)
        assert arm.inertia[1, 1] == pytest.approx(sideways, rel=1e-12)
        around = (rider.upper_arm_circumference * upper + rider.lower_arm_circumference * lower) / (upper + lower)
        assert arm.radius == pytest.approx(around / (2 * pi), rel=1e-14)


@pytest.mark.parametrize(
    ("drop", "width"),
    [(drop, width) for drop in (None, 5.0, 35.0, 85.0) for width in (None, 0.3, 0.5) if drop is not None or width],
)
@pytest.mark.parametrize("behind", [False, True], ids=["grips ahead", "grips behind"])
def test_the_elbow_hangs_or_is_turned_outwards(drop: float | None, width: float | None, behind: bool) -> None:
    rider = RIDER.replace(elbow_drop_angle=None if drop is None else radians(drop))
    bicycle = load_bicycle("browser").replace(handlebar_width=width)
    if behind:
        bicycle = bicycle.replace(handlebar_length=0.45)
        rider = rider.replace(forward_lean_angle=radians(50.0))
    found = skeleton(bicycle, rider)
    assert (found[19][0] < found[21][0]) == behind
    points = [np.asarray(found[number]) for number in range(1, 32)]
    for side, (shoulder, elbow, grip) in (("right", (21, 23, 19)), ("left", (22, 24, 20))):
        outwards = 1.0 if side == "right" else -1.0
        start, bent, end = points[shoulder - 1], points[elbow - 1], points[grip - 1]
        assert np.linalg.norm(bent - start) == pytest.approx(rider.upper_arm_length, rel=1e-12)
        assert np.linalg.norm(end - bent) == pytest.approx(rider.lower_arm_length, rel=1e-12)
        line = unit(end - start)
        aside = unit((bent - start) - ((bent - start) @ line) * line)
        # An elbow bends one way: below an arm that reaches ahead, behind one that hangs, above one that reaches back.
        down = unit(np.array([0.0, 0.0, 1.0]) - line[2] * line) * (-1.0 if behind else 1.0)
        level = unit(np.cross(line, [0.0, 0.0, 1.0]))
        level = level * np.sign(level[1]) * outwards
        angle = radians(90.0 if drop is None else drop)
        np.testing.assert_allclose([aside @ down, aside @ level], [sin(angle), cos(angle)], atol=1e-12)
        axis = np.asarray(found.elbow_axis(side))
        assert np.linalg.norm(axis) == pytest.approx(1.0, rel=1e-12)
        np.testing.assert_allclose([axis @ (bent - start), axis @ (end - start)], 0.0, atol=1e-12)
        if drop is None or drop > 80:
            assert axis[1] > 0.5  # towards the right, both of them
    right, left = np.asarray(found.elbow_axis("right")), np.asarray(found.elbow_axis("left"))
    np.testing.assert_allclose(left, right * [-1.0, 1.0, -1.0], atol=1e-15)
    for one, other in ((17, 18), (19, 20), (21, 22), (23, 24)):
        np.testing.assert_allclose(points[other - 1], points[one - 1] * [1.0, -1.0, 1.0], atol=1e-15)
