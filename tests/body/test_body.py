"""Solids, rigid-body arithmetic, skeleton and segments."""

from __future__ import annotations

from math import acos, atan2, cos, pi, sin, sqrt, tan

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from singletrack import InputError, PostureError, load_bicycle, load_rider
from singletrack.body import rider_segments, skeleton
from singletrack.mechanics import RigidBody, combine
from singletrack.mechanics.solids import cylinder_inertia, prism_inertia, sphere_inertia

RIDER = load_rider("rider-a")


def random_axis(rng, plane=False):
    axis = rng.normal(size=3) * (np.array([1.0, 0.0, 1.0]) if plane else 1.0)
    return axis / np.linalg.norm(axis)


def sampled_inertia(mass, points):
    """Inertia of a cloud of equal point masses about the origin."""
    square = np.einsum("ni,ni->n", points, points)
    return mass * (np.eye(3) * square.mean() - np.einsum("ni,nj->ij", points, points) / len(points))


def frame_of(axis):
    other = np.cross(axis, [0.3, 1.0, -0.2])
    other /= np.linalg.norm(other)
    return np.stack([axis, other, np.cross(axis, other)], axis=-1)


@pytest.mark.parametrize("seed", range(4))
def test_cylinder_is_its_volume(seed):
    """Against Gauss quadrature over the volume."""
    rng = np.random.default_rng(seed)
    mass, radius, length, axis = 3.0, rng.uniform(0.1, 1), rng.uniform(0.1, 2), random_axis(rng)
    nodes, weights = np.polynomial.legendre.leggauss(8)
    angle = np.linspace(0, 2 * pi, 16, endpoint=False)
    r = radius * (nodes + 1) / 2
    x, rr, a = np.meshgrid(length / 2 * nodes, r, angle, indexing="ij")
    weight = weights[:, None, None] * (weights * (nodes + 1))[None, :, None] * np.ones(16)
    points = np.stack([x, rr * np.cos(a), rr * np.sin(a)], axis=-1).reshape(-1, 3) @ frame_of(axis).T
    weight = weight.ravel() / weight.sum()
    expected = mass * (np.eye(3) * (weight @ (points**2).sum(1)) - np.einsum("n,ni,nj->ij", weight, points, points))
    np.testing.assert_allclose(cylinder_inertia(mass, radius, length, axis), expected, rtol=1e-12, atol=1e-14)


@pytest.mark.parametrize("seed", range(4))
def test_prism_is_its_corners(seed):
    """The second moment of a box is a third of that of its corners."""
    rng = np.random.default_rng(seed)
    axis = random_axis(rng, plane=True)
    length, width, thickness = rng.uniform(0.1, 1, 3)
    normal = np.cross(axis, [0.0, 1.0, 0.0])
    signs = np.array(np.meshgrid([-1, 1], [-1, 1], [-1, 1])).reshape(3, -1).T / 2
    corners = signs @ np.stack([length * axis, width * np.array([0, 1.0, 0]), thickness * normal])
    expected = sampled_inertia(2.0, corners) / 3
    np.testing.assert_allclose(prism_inertia(2.0, length, width, thickness, axis), expected, rtol=1e-12, atol=1e-15)


def test_sphere_has_the_same_moment_about_all_axes():
    np.testing.assert_allclose(sphere_inertia(3.0, 0.5), 0.4 * 3.0 * 0.25 * np.eye(3), rtol=1e-15)


@given(st.integers(0, 2**32 - 1))
@settings(max_examples=30, deadline=None)
def test_combining_bodies(seed):
    """Order and grouping do not matter, momentum is kept, and the inertia is one that a body can have."""
    rng = np.random.default_rng(seed)
    bodies = [
        RigidBody(
            rng.uniform(0.1, 5), rng.normal(size=3), cylinder_inertia(1.0, *rng.uniform(0.1, 1, 2), random_axis(rng))
        )
        for _ in range(4)
    ]
    whole = combine(bodies)
    shuffled = combine([bodies[i] for i in rng.permutation(4)])
    grouped = combine([combine(bodies[:2]), combine(bodies[2:])])
    for other in (shuffled, grouped):
        np.testing.assert_allclose(other.centre, whole.centre, atol=1e-13)
        np.testing.assert_allclose(other.inertia, whole.inertia, atol=1e-12)
    np.testing.assert_allclose(whole.mass * whole.centre, sum(b.mass * b.centre for b in bodies), atol=1e-13)
    moments = np.linalg.eigvalsh(whole.inertia)
    assert moments[0] > 0
    assert moments[2] <= moments[0] + moments[1] + 1e-12
    point = rng.normal(size=3)
    np.testing.assert_allclose(
        whole.inertia_about(point), sum(b.inertia_about(point) for b in bodies), rtol=1e-10, atol=1e-11
    )


def table_4(b, r, lean):
    """The table's own code, line by line, by its own names."""
    rR, rF, w, c = b.rear_wheel_radius, b.front_wheel_radius, b.wheel_base, b.trail
    wrh, wfh, lcs, hbb = b.rear_hub_width, b.front_hub_width, b.chain_stay_length, b.bottom_bracket_height
    lst, last, lsp, lf = b.seat_tube_length, b.seat_tube_angle, b.seat_post_length, b.fork_length
    ls, lhb, laht, lafl = b.stem_length, b.handlebar_length, pi / 2 - b.steer_axis_tilt, lean
    lul, lll, lto, lss = r.upper_leg_length, r.lower_leg_length, r.torso_length, r.shoulder_to_shoulder
    lua, lla, lhh, ch = r.upper_arm_length, r.lower_arm_length, r.hip_joint_to_hip_joint, r.head_circumference
    v = np.array
    p = {1: v([0, 0, 0]), 2: v([0, 0, -rR])}
    p[3], p[4] = p[2] + v([0, wrh / 2, 0]), p[2] + v([0, -wrh / 2, 0])
    p[5] = v([sqrt(lcs**2 - (rR - hbb) ** 2), 0, -hbb])
    p[6] = v([w, 0, 0])
    p[7] = p[6] + v([0, 0, -rF])
    p[8], p[9] = p[7] + v([0, wfh / 2, 0]), p[7] + v([0, -wfh / 2, 0])
    p[10] = p[5] + v([-lst * cos(last), 0, -lst * sin(last)])
    f0 = rF * cos(laht) - c * sin(laht)
    down = sqrt(lf**2 - f0**2)
    p[11] = p[7] + v([-f0 * sin(laht) - down * cos(laht), 0, f0 * cos(laht) - down * sin(laht)])
    p[12] = v([p[11][0] - (p[11][2] - p[10][2]) / tan(laht), 0, p[10][2]])
    p[13] = p[10] + v([-lsp * cos(last), 0, -lsp * sin(last)])
    a1 = atan2(p[5][0] - p[13][0], p[5][2] - p[13][2])
    l1 = sqrt((p[5][0] - p[13][0]) ** 2 + (p[5][2] - p[13][2]) ** 2)
    a2 = acos((l1**2 + lul**2 - lll**2) / (2 * l1 * lul))
    p[14] = p[13] + v([lul * sin(a1 + a2), 0, lul * cos(a1 + a2)])
    p[15] = p[13] + v([lto * cos(lafl), 0, -lto * sin(lafl)])
    p[16] = p[12] + v([-ls * cos(laht), 0, -ls * sin(laht)])
    p[17], p[18] = p[16] + v([0, lss / 2, 0]), p[16] + v([0, -lss / 2, 0])
    p[19], p[20] = p[17] + v([-lhb, 0, 0]), p[18] + v([-lhb, 0, 0])
    p[21], p[22] = p[15] + v([0, lss / 2, 0]), p[15] + v([0, -lss / 2, 0])
    a1 = atan2(p[19][0] - p[21][0], p[19][2] - p[21][2])
    l1 = sqrt((p[19][0] - p[21][0]) ** 2 + (p[19][2] - p[21][2]) ** 2)
    a2 = acos((l1**2 + lua**2 - lla**2) / (2 * l1 * lua))
    p[23] = p[21] + v([lua * sin(a1 - a2), 0, lua * cos(a1 - a2)])
    p[24] = p[23] + v([0, -lss, 0])
    p[25] = p[15] + v([ch / (2 * pi) * cos(lafl), 0, -ch / (2 * pi) * sin(lafl)])
    for number, (start, side) in enumerate([(5, 1), (5, -1), (14, 1), (14, -1), (13, 1), (13, -1)], 26):
        p[number] = p[start] + v([0, side * lhh / 2, 0])
    return np.stack([p[number] for number in range(1, 32)])


@pytest.mark.parametrize("name", ["stratos", "browser"])
def test_skeleton_is_table_4(name):
    bicycle = load_bicycle(name)
    expected = table_4(bicycle, RIDER, RIDER.on(bicycle).forward_lean_angle)
    np.testing.assert_allclose(skeleton(bicycle, RIDER).points, expected, rtol=1e-13, atol=1e-15)


@pytest.mark.parametrize("name", ["stratos", "browser"])
def test_limbs_have_their_lengths_and_the_front_hub_its_trail(name):
    bicycle = load_bicycle(name)
    p = skeleton(bicycle, RIDER)
    limbs = {(21, 23): "upper_arm", (23, 19): "lower_arm", (30, 28): "upper_leg", (28, 26): "lower_leg"}
    for (start, end), limb in limbs.items():
        assert np.linalg.norm(p[end] - p[start]) == pytest.approx(getattr(RIDER, f"{limb}_length"), rel=1e-12)
    # Fork crown, head tube top and stem lie on the steer axis, which meets the ground a trail ahead of the contact.
    foot = np.array([bicycle.wheel_base + bicycle.trail, 0.0, 0.0])
    for number in (11, 12, 16):
        along = p[number] - foot
        assert atan2(-along[0], -along[2]) == pytest.approx(bicycle.steer_axis_tilt, rel=1e-9)


def test_segments_are_the_rider():
    bicycle = load_bicycle("stratos")
    points = skeleton(bicycle, RIDER)
    segments = rider_segments(RIDER, points)
    assert len(segments) == 10
    whole = combine(list(segments.values()))
    assert whole.mass == pytest.approx(RIDER.rider_mass)
    assert abs(whole.centre[1]) < 1e-15  # left and right
    np.testing.assert_allclose(whole.inertia[1, [0, 2]], 0.0, atol=1e-14)
    np.testing.assert_array_equal(segments["head"].centre, points[25])
    for body in segments.values():
        moments = np.linalg.eigvalsh(body.inertia)
        assert moments[0] > 0
        assert moments[2] <= (moments[0] + moments[1]) * (1 + 1e-12)


def test_out_of_reach_says_both_lengths():
    stratos = load_bicycle("stratos")
    points = table_4(stratos, RIDER, RIDER.on(stratos).forward_lean_angle)
    distance = f"{np.linalg.norm(points[20] - points[18]):.4f}"  # points 21 and 19
    with pytest.raises(PostureError, match=rf"shoulder-grip distance is {distance} m, but the arm .* only 0\.4300 m"):
        skeleton(load_bicycle("stratos"), RIDER.replace(upper_arm_length=0.1))
    with pytest.raises(PostureError, match=r"hip-bracket distance is .* but the leg .* only 0\.5600 m"):
        skeleton(load_bicycle("stratos"), RIDER.replace(upper_leg_length=0.1))
    with pytest.raises(PostureError, match="cannot fold below"):
        skeleton(load_bicycle("browser"), RIDER.replace(upper_arm_length=1.2))


def test_frames_that_do_not_close():
    with pytest.raises(InputError, match="chain_stay_length"):
        skeleton(load_bicycle("stratos").replace(chain_stay_length=0.04), RIDER)
    with pytest.raises(InputError, match="fork_length"):
        skeleton(load_bicycle("stratos").replace(fork_length=0.03), RIDER)


def test_bicycle_without_frame_geometry_lists_what_is_missing():
    with pytest.raises(InputError, match=r"missing: bottom_bracket_height, chain_stay_length, .*stem_length"):
        skeleton(load_bicycle("benchmark"), RIDER.replace(forward_lean_angle=1.0))
