"""A bicycle in nodes and elements is the same bicycle as from bodies and joints."""

from __future__ import annotations

import re

import numpy as np
import pytest

from singletrack import load_bicycle, spacar
from singletrack.closed_form import Tyre, tyre_model
from singletrack.multibody import coefficients


def bicycle_file(bicycle) -> str:
    """Return a bicycle in the dialect of Twente; z points up there, so that products with z change sign."""
    b = bicycle
    tilt, wheel_base = float(b.steer_axis_tilt), float(b.wheel_base)
    foot = wheel_base + float(b.trail)
    head = (foot - 0.8 * np.tan(tilt), 0.0, 0.8)
    lines = [
        "% bicycle from its parameters",
        "pinbody 1 1 2 3",
        "pinbody 2 1 2 4",
        "pinbody 3 3 6 5",
        "pinbody 4 3 6 7",
    ]
    lines += [
        f"hinge 6 2 6 {float(np.sin(tilt))!r} 0 {float(-np.cos(tilt))!r}",
        "hinge 9 6 11 0 1 0",
        "wheel 10 7 11 12 0 1 0",
        "hinge 11 2 13 0 1 0",
        "wheel 12 4 13 14 0 1 0",
        "hinge 13 18 16 0 0 1",
        "hinge 14 16 15 1 0 0",
        "hinge 15 15 2 0 1 0",
    ]
    places = {
        1: (b.rear_frame_x, 0.0, -b.rear_frame_z),
        3: head,
        4: (0.0, 0.0, b.rear_wheel_radius),
        5: (b.front_frame_x, 0.0, -b.front_frame_z),
        7: (wheel_base, 0.0, b.front_wheel_radius),
        12: (wheel_base, 0.0, 0.0),
        14: (0.0, 0.0, 0.0),
    }
    lines += [f"x {node} {float(x)!r} {float(y)!r} {float(z)!r}" for node, (x, y, z) in places.items()]
    lines += [
        "fix 18",
        "dyne 14 1",
        "dyne 6 1",
        "dyne 11 1",
        "kine 9 1",
        "kine 13 1",
        "kinx 14 1",
        "kinx 14 2",
        "rlse 15 1",
    ]
    lines += ["end", "halt"]
    for node, orientation, part in ((1, 2, "rear_frame"), (5, 6, "front_frame")):
        xx, yy, zz, xz = (float(getattr(b, f"{part}_inertia_{axes}")) for axes in ("xx", "yy", "zz", "xz"))
        lines += [
            f"xm {node} {float(getattr(b, f'{part}_mass'))!r}",
            f"xm {orientation} {xx!r} 0 {-xz!r} {yy!r} 0 {zz!r}",
        ]
    for node, orientation, part in ((4, 13, "rear_wheel"), (7, 11, "front_wheel")):
        xx, yy = (float(getattr(b, f"{part}_inertia_{axes}")) for axes in ("xx", "yy"))
        lines += [f"xm {node} {float(getattr(b, f'{part}_mass'))!r}", f"xm {orientation} {xx!r} 0 0 {yy!r} 0 {xx!r}"]
    lines += [f"gravity 0 0 {-float(b.gravity)!r}", "end", "end"]
    return "\n".join(lines)


@pytest.mark.parametrize("name", ["benchmark", "stratos"])
def test_linear_model_equals_that_of_bodies_and_joints(name):
    bicycle = load_bicycle(name)
    model, expected = spacar.read_text(bicycle_file(bicycle)), coefficients(bicycle)
    gravity = float(bicycle.gravity)
    for speed in (0.0, 3.0, 7.0):
        state = model.state(ed={(11, 1): speed / float(bicycle.rear_wheel_radius)})
        small = model.linearise(model.motion(state))
        assert small.coordinates[:3] == ("e 6 1", "e 11 1", "e 14 1")
        # Their steer is about the axis pointing down, as here; their lean about x, as here.
        pick = np.ix_([2, 0], [2, 0])
        scale = np.max(abs(expected.M))
        np.testing.assert_allclose(small.M[pick], expected.M, rtol=1e-10, atol=1e-10 * scale)
        np.testing.assert_allclose(small.C[pick], speed * expected.C1, rtol=1e-10, atol=1e-9)
        np.testing.assert_allclose(small.K[pick], gravity * expected.K0 + speed**2 * expected.K2, rtol=1e-10, atol=1e-9)
        other = np.delete(small.K[[2, 0]], [0, 2], axis=1)
        assert np.max(abs(other)) < 1e-9 * np.max(abs(small.K[pick]))


def test_robot_runs_as_it_stands(robot):
    model = spacar.read_text(robot)
    assert model.freedoms == ("e 6 1", "e 11 1", "e 14 1", "e 16 1")
    small = model.linearise(model.motion(model.state(ed={(11, 1): 50.0})))
    assert small.inputs == ("1: e 6 1", "3: e 16 1", "4: e 11 1")
    assert small.coordinates[4:] == ("x 14 1", "x 14 2", "e 9 1", "e 15 1")
    # The speed forward is the radius times the turning rate of the rear wheel.
    np.testing.assert_allclose(small.N[0], [0, 0.1, 0, 0], atol=1e-12)
    np.testing.assert_allclose(small.C_matrix[0, 8:], [0, 1, 0, 0], atol=1e-12)


def test_rolling_is_kept_while_it_rides(robot):
    text = robot.replace("xm 4 0.5122\n", "xm 4 0.5122\ned 11 1 40\ne 14 1 0.05\n")
    model = spacar.read_text(text)
    motions = model.run(np.linspace(0.0, 0.2, 5))
    for motion in motions:
        for wheel in (10, 12):
            np.testing.assert_allclose(model.by_element(motion.state.e)[wheel], 0.0, atol=1e-9)
            np.testing.assert_allclose(model.by_element(motion.rates)[wheel], 0.0, atol=1e-9)
    assert model.by_element(motions[-1].state.e)[11][0] > 2 * np.pi  # the wheel's angle goes on beyond a turn


def test_tyres_without_delay_are_dampers_of_the_slip():
    """Two derivations of a bicycle that slips: nodes and elements with released slip, and the closed form."""
    bicycle, speed, cornering = load_bicycle("benchmark"), 5.0, 8e3
    rear, front = float(bicycle.rear_wheel_radius), float(bicycle.front_wheel_radius)
    text = (
        bicycle_file(bicycle).replace("kine 13 1", "dyne 13 1\nrlse 10 6\nrlse 12 6").replace("kinx 14 2", "dynx 14 2")
    )
    # Slip is the velocity times the radius.
    dampers = f"edamp 12 0 {cornering / speed / rear**2!r}\nedamp 10 0 {cornering / speed / front**2!r}\ngravity"
    model = spacar.read_text(text.replace("gravity", dampers))
    small = model.linearise(model.motion(model.state(ed={(11, 1): speed / rear})))
    values = small.eigenvalues()
    found = np.sort_complex(values[abs(values) > 1e-3])
    tyre = Tyre(cornering)
    np.testing.assert_allclose(found, tyre_model(bicycle, tyre, tyre).eigenvalues(speed)[0], rtol=1e-7)


def test_the_dialect_of_delft_gives_the_same_bicycle():
    """Bodies are beams with one orientation at both ends there, and ENHC pairs slips with kinematic coordinates."""
    bicycle = load_bicycle("stratos")
    twente = bicycle_file(bicycle)
    delft = re.sub(r"pinbody (\d+) (\d+) (\d+) (\d+)", r"BEAM \1 \2 \3 \4 \3", twente).replace("xm ", "MASS ")
    delft = delft.replace("% bicycle", "* bicycle").replace("halt\n", "")
    delft = delft.replace("kine 9 1\nkine 13 1", "ENHC 10 5 9 1\nENHC 10 6 13 1")
    models = [spacar.read_text(text) for text in (twente, delft)]
    assert [model.description.dialect for model in models] == ["twente", "delft"]
    one, other = (model.linearise(model.motion(model.state(ed={(11, 1): 20.0}))) for model in models)
    assert other.coordinates == one.coordinates
    for name in ("M", "C", "K", "N", "G"):
        np.testing.assert_allclose(getattr(other, name), getattr(one, name), rtol=1e-10, atol=1e-9)
