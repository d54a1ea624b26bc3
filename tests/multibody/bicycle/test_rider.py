"""Riders on the multibody engine: the closed form as second opinion, statics by hand, large motions."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from hypothesis import HealthCheck, assume, given, settings
from hypothesis import strategies as st
from scipy.optimize import brentq

from singletrack import coefficients as closed_form
from singletrack import load_bicycle, load_rider
from singletrack.errors import InputError, ModelError, PostureError
from singletrack.library import shipped
from singletrack.multibody import (
    accelerations,
    bicycle_model,
    coefficients,
    free_turns,
    loop_forces,
    ride,
    simulate,
    steady_motion,
    wheel_forces,
)
from singletrack.posture import Options, seat

NAMES = ("M", "C1", "K0", "K2")
SEATS = [("rigid", None), ("upright", None), ("upright", "abduction"), ("leaned", "abduction"), ("leaned", "axial")]


def assert_engines_agree(bicycle: Any, rider: Any, posture: Any, shoulder: Any = None) -> Any:
    ours = coefficients(bicycle, rider, Options(posture, shoulder))
    theirs = closed_form(bicycle, rider, posture, shoulder)
    for name in NAMES:
        one, other = getattr(ours, name), np.asarray(getattr(theirs, name))
        np.testing.assert_allclose(one, other, rtol=1e-9, atol=1e-9 * np.max(abs(other)), err_msg=name)


@pytest.mark.parametrize("name", shipped("bicycle"))
def test_both_engines_agree_without_a_rider(name: Any) -> Any:
    assert_engines_agree(load_bicycle(name), None, "rigid")


@pytest.mark.parametrize("rider", shipped("rider"))
@pytest.mark.parametrize("name", [name for name in shipped("bicycle") if not load_bicycle(name).missing_geometry()])
@pytest.mark.parametrize(("posture", "shoulder"), SEATS)
def test_both_engines_agree_on_every_shipped_rider(name: Any, rider: Any, posture: Any, shoulder: Any) -> Any:
    assert_engines_agree(load_bicycle(name), load_rider(rider), posture, shoulder)


@settings(max_examples=50, deadline=None, derandomize=True, suppress_health_check=[HealthCheck.filter_too_much])
@given(data=st.data())
def test_both_engines_agree_on_random_bicycles_and_riders(data: Any) -> Any:
    posture, shoulder = data.draw(st.sampled_from(SEATS))
    bicycle = load_bicycle(data.draw(st.sampled_from(["stratos", "browser"])))
    rider = load_rider("rider-a").on(bicycle)

    def vary(record: Any) -> Any:
        inertias = data.draw(st.floats(0.8, 1.2))  # of one body together, so that it stays a body's
        changes = {}
        for name, value in record.values().items():
            if "fraction" in name:
                continue
            factor = inertias if "inertia" in name else data.draw(st.floats(0.93, 1.07))
            changes[name] = value * factor
        return record.replace(**changes)

    try:
        varied, person = vary(bicycle), vary(rider)
        closed_form(varied, person, posture, shoulder)
    except (InputError, PostureError):
        assume(False)  # noqa: FBT003  # hypothesis takes it so
    assert_engines_agree(varied, person, posture, shoulder)


def hand_forces_by_hand(posture: Any) -> Any:
    """Forward and downward force of each hand on its grip, from the moments about y of the hinged parts alone.

    The forces on what hangs beyond a hinge about y (weight, and the grip's reaction at the end) have no moment about
    it: one equation for each of the two hinges between the frame and the hand.
    """
    carried = posture.carried_by or {}
    joints = {joint.name: joint for joint in posture.joints}
    if posture.name == "upright":
        hinges, share = ["left elbow", "left shoulder flexion"], 1.0
    else:
        hinges, share = ["left shoulder flexion", "torso pitch"], 0.5  # the torso is shared by two hands

    def beyond(hinge: Any) -> Any:
        for name, segment in posture.segments.items():
            chain = [joint.name for joint in posture.chain(carried.get(name, ""))]
            if hinge in chain:
                yield segment

    grip = next(loop.point for loop in posture.loops if loop.name == "left hand")
    rows, right = [], []
    for hinge in hinges:
        point = joints[hinge].point
        weight = sum(-(segment.centre - point)[0] * segment.mass * 9.81 for segment in beyond(hinge))
        arm = grip - point
        rows.append([-arm[2], arm[0]])  # moment about y of the force on the grip, taken from the rider
        right.append(weight * (share if hinge == "torso pitch" else 1.0))
    return np.linalg.solve(rows, -np.array(right))


@pytest.mark.parametrize(("name", "posture"), [("browser", "upright"), ("stratos", "leaned"), ("browser", "leaned")])
def test_hands_press_on_the_bar_as_statics_demands(name: Any, posture: Any) -> Any:
    bicycle, rider = load_bicycle(name), load_rider("rider-a")
    forces = loop_forces(ride(bicycle_model(bicycle, rider, posture), 0.0))
    x, z = hand_forces_by_hand(seat(bicycle, rider, posture))
    for hand in ("left hand", "right hand"):
        assert forces[hand] == pytest.approx([x, 0.0, z], rel=1e-9, abs=1e-9)


def test_the_leaned_rider_presses_harder_than_the_upright_one() -> Any:
    rider = load_rider("rider-a")
    leaned = loop_forces(ride(bicycle_model(load_bicycle("stratos"), rider, "leaned"), 0.0))["left hand"]
    upright = loop_forces(ride(bicycle_model(load_bicycle("browser"), rider, "upright"), 0.0))["left hand"]
    assert leaned[2] > 3 * abs(upright[2])
    assert 2 * leaned[2] < 0.68 * 72.0 * 9.81  # but not with more than head, torso and arms weigh


@pytest.mark.parametrize(("name", "posture"), [("browser", "upright"), ("stratos", "leaned")])
def test_large_motions_keep_hands_energy_and_symmetry(name: Any, posture: Any) -> Any:
    model = bicycle_model(load_bicycle(name), load_rider("rider-a"), posture)
    assert len(model.system.coordinates) == 15
    start = ride(model, 6.0, {"steer": 0.25, "lean": 0.1}, {"lean": -0.4})
    assert len(start.freedoms) == 3
    run = simulate(start, np.linspace(0.0, 1.5, 31), rtol=1e-12, atol=1e-13)
    assert run.residual.max() < 1e-12
    np.testing.assert_allclose(run.energy.to_numpy(), float(run.energy[0]), rtol=1e-9)
    mirrored = ride(model, 6.0, {"steer": -0.25, "lean": -0.1}, {"lean": 0.4})
    for coordinate, sign in {"lean": -1, "steer": -1, "yaw": -1, "pitch": 1, "rear wheel": 1}.items():
        i = model.system.coordinates.index(coordinate)
        assert accelerations(mirrored).a[i] == pytest.approx(sign * accelerations(start).a[i], rel=1e-9, abs=1e-9)
    left, right = (loop_forces(mirrored)[hand] for hand in ("left hand", "right hand"))
    assert left * [1, -1, 1] == pytest.approx(loop_forces(start)["right hand"], rel=1e-8, abs=1e-8)
    assert right * [1, -1, 1] == pytest.approx(loop_forces(start)["left hand"], rel=1e-8, abs=1e-8)


def test_an_upright_rider_cannot_steer_further_than_the_arm_reaches() -> Any:
    bicycle, rider = load_bicycle("browser"), load_rider("rider-a")
    points = seat(bicycle, rider, "upright").skeleton
    tilt = bicycle.steer_axis_tilt
    foot, axis = np.array([bicycle.wheel_base + bicycle.trail, 0, 0]), np.array([np.sin(tilt), 0, np.cos(tilt)])

    def reach(steer: Any) -> Any:
        """From the left shoulder to the left grip, which goes away when the steer turns to the right."""
        arm = points[20] - foot
        turned = np.cos(steer) * arm + np.sin(steer) * np.cross(axis, arm) + (1 - np.cos(steer)) * axis * (axis @ arm)
        return np.linalg.norm(foot + turned - points[22])

    stretched = rider.upper_arm_length + rider.lower_arm_length
    limit = brentq(lambda steer: reach(steer) - stretched, 0.0, 1.0)
    model = bicycle_model(bicycle, rider, "upright")
    close_to = ride(model, 0.0, {"steer": 0.9 * limit})  # further, the elbow's plane would lie flat: another limit
    assert abs(close_to["left shoulder rotation"]) > abs(close_to["right shoulder rotation"])
    with pytest.raises(ModelError, match=r"left hand \(point \d\): the loop cannot close"):
        ride(model, 0.0, {"steer": 1.01 * limit})


def test_the_leaned_torso_twists_at_once_and_pitches_later() -> Any:
    model = bicycle_model(load_bicycle("stratos"), load_rider("rider-a"), "leaned")
    small, double = (ride(model, 0.0, {"steer": angle}) for angle in (1e-3, 2e-3))
    assert double["torso twist"] / small["torso twist"] == pytest.approx(2.0, rel=1e-4)
    assert double["torso pitch"] / small["torso pitch"] == pytest.approx(4.0, rel=1e-4)


@pytest.mark.parametrize(("name", "posture"), [("browser", "upright"), ("stratos", "leaned"), ("stratos", "rigid")])
def test_riders_go_round_in_circles(name: Any, posture: Any) -> Any:
    bicycle, rider = load_bicycle(name), load_rider("rider-a")
    matrices = closed_form(bicycle, rider, posture)
    model = bicycle_model(bicycle, rider, posture)
    if posture == "upright":  # no capsize speed: it takes a torque to hold the turn
        held = steady_motion(
            model,
            {"lean": 1e-3},
            {"rear wheel": -5.0 / float(bicycle.rear_wheel_radius)},
            resting=["lean", "steer"],
            adjust=["steer torque"],
        )
        small = np.array([held.state["lean"], held.state["steer"]])
        stiffness = matrices.gravity * matrices.K0 + 25.0 * matrices.K2
        assert stiffness @ small == pytest.approx([0.0, held.inputs["steer torque"]], abs=1e-5)
        return
    capsize = max(float(speed) for speed in matrices.critical_speeds().capsize)
    turns = free_turns(model, [1e-3, 0.1, 0.2], speed=capsize)
    assert turns.speed[0] == pytest.approx(capsize, abs=1e-4)
    assert turns.steer[2] > turns.steer[1] > 0.0


def test_the_wheels_carry_bicycle_and_rider() -> Any:
    bicycle, rider = load_bicycle("stratos"), load_rider("rider-a")
    total = sum(getattr(bicycle, f"{part}_mass") for part in ("rear_wheel", "rear_frame", "front_frame", "front_wheel"))
    for posture, _ in SEATS[:3]:
        loads = wheel_forces(ride(bicycle_model(bicycle, rider, posture), 0.0))
        assert sum(load[2] for load in loads.values()) == pytest.approx((total + 72.0) * 9.81, rel=1e-12)


def test_designs_of_one_kind_share_one_derivation() -> Any:
    rider = load_rider("rider-a")
    one = bicycle_model(load_bicycle("browser"), rider, "upright")
    other = bicycle_model(load_bicycle("stratos"), rider, "upright")
    assert one.equations is other.equations
    assert one.system.parameters != other.system.parameters
