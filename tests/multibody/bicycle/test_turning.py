"""Steady turns: by hand, through folds, with riders, and their eigenvalues against differences of the accelerations."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from singletrack import InputError, coefficients, load_bicycle, load_rider, turn
from singletrack.errors import ModelError
from singletrack.multibody import (
    accelerations,
    bicycle_model,
    circle,
    hands_free_family,
    held_turn,
    held_turns,
    loop_forces,
    ride,
    simulate,
    steady_motion,
    wheel_forces,
)
from singletrack.multibody.bicycle.turning import turn_eigenvalues
from singletrack.public.turning import turn_family

CASES = {
    "benchmark": ("benchmark", None, "rigid"),
    "leaned": ("stratos", "rider-a", "leaned"),
    "upright": ("browser", "rider-a", "upright"),
}


def design(name: str) -> Any:
    which, rider, posture = CASES[name]
    return load_bicycle(which), rider and load_rider(rider), posture


@pytest.mark.parametrize(
    ("name", "speed", "lean"), [("benchmark", 6.0, 0.4), ("leaned", 5.5, -0.3), ("upright", 5.0, 0.2)]
)
def test_a_held_turn_goes_on_and_carries_its_weight(name: str, speed: float, lean: float) -> None:
    model = bicycle_model(*design(name))
    found = held_turn(model, speed, lean=lean)
    assert found.state["lean"] == lean
    run = simulate(found.state, np.linspace(0.0, 0.5, 6), found.inputs)
    for coordinate in ("lean", "steer"):
        angle = run.q.sel(coordinate=coordinate).to_numpy()
        np.testing.assert_allclose(angle, angle[0], atol=1e-6)
    way = circle(found)
    forces = np.array(list(wheel_forces(found.state, found.inputs).values()))
    mass = sum(float(model.system.parameters.get(f"{body.name} mass", 0.0)) for body in model.system.bodies)
    assert forces[:, 2].sum() == pytest.approx(9.81 * mass, rel=1e-9)
    assert np.sign(forces[:, 1].sum()) == np.sign(lean)
    # the contact goes round one point
    points, yaw = run.contact.sel(wheel="rear wheel").to_numpy(), run.q.sel(coordinate="yaw").to_numpy()
    travelled = np.hypot(*np.diff(points[:, :2], axis=0).T)
    np.testing.assert_allclose(travelled, abs(2.0 * way.radius * np.sin(np.diff(yaw) / 2.0)), rtol=1e-6)
    assert way.path_speed == pytest.approx(abs(found.state.rate("yaw") * way.radius), rel=1e-12)


@pytest.mark.parametrize(("name", "radius"), [("benchmark", 8.0), ("leaned", -12.0), ("upright", 9.0)])
def test_a_turn_has_the_radius_asked_for(name: str, radius: float) -> None:
    model = bicycle_model(*design(name))
    found = held_turn(model, 5.0, radius=radius)
    assert circle(found).radius == pytest.approx(radius, rel=1e-8)
    again = held_turn(model, 5.0, lean=found.state["lean"])
    assert again.state["steer"] == pytest.approx(found.state["steer"], rel=1e-7)
    assert again.inputs["steer torque"] == pytest.approx(found.inputs["steer torque"], rel=1e-5, abs=1e-7)


@pytest.mark.parametrize(
    ("name", "speed", "lean"), [("benchmark", 6.0, 0.4), ("leaned", 5.5, 0.3), ("upright", 5.0, 0.2)]
)
def test_eigenvalues_are_those_of_sixth_order_differences(name: str, speed: float, lean: float) -> None:
    model = bicycle_model(*design(name))
    found = held_turn(model, speed, lean=lean)
    base = found.state
    free = list(base.partition.independent_speeds)
    guess = {coordinate: base[coordinate] for coordinate in model.system.coordinates}

    def change(x: Any) -> Any:
        rates = {"lean": x[2], "steer": x[3]}
        state = ride(model, speed, {"lean": x[0], "steer": x[1]}, rates, guess=guess)
        from singletrack.multibody import move

        state = move(state, rates | {"rear wheel": x[4]})
        return np.array([x[2], x[3], *accelerations(state, found.inputs).a[free]])

    x = np.array([base["lean"], base["steer"], 0.0, 0.0, base.rate("rear wheel")])
    steps = np.array([1e-2, 1e-2, 1e-2, 1e-2, 1e-1]) * (0.5 if name == "upright" else 1.0)
    matrix = np.zeros((5, 5))
    for i, h in enumerate(steps):
        along = np.eye(5)[i] * h
        pairs = [change(x + k * along) - change(x - k * along) for k in (1, 2, 3)]
        matrix[:, i] = (45.0 * pairs[0] - 9.0 * pairs[1] + pairs[2]) / (60.0 * h)
    exact, by_differences = turn_eigenvalues(found), np.sort_complex(np.linalg.eigvals(matrix))
    np.testing.assert_allclose(by_differences, exact, atol=1e-9 * np.max(abs(exact)))


def test_the_fold_of_the_hands_free_family_is_passed_without_a_jump() -> None:
    """Basu-Mandal et al. 2007: from the capsize bifurcation over a greatest lean to rest."""
    model = bicycle_model(load_bicycle("benchmark"))
    family = hands_free_family(model, 6.0)
    lean, steer, rate = (
        np.array([pick(motion.state) for motion in family.motions])
        for pick in (lambda s: s["lean"], lambda s: s["steer"], lambda s: s.rate("rear wheel"))
    )
    speed = -0.3 * rate
    assert family.end == "it stands still"
    assert speed[0] == pytest.approx(6.024262015388, abs=1e-4)  # Meijaard et al. 2007, Table 2
    assert np.all(np.diff(steer) > 0.0)
    assert np.all(np.diff(speed) < 0.0)  # never backwards, never another family
    top = int(np.argmax(lean))
    assert 0 < top < len(lean) - 1
    steps = np.sqrt(np.diff(lean) ** 2 + np.diff(steer) ** 2 + (np.diff(rate) / 20.08) ** 2)
    assert np.max(steps) < 0.06
    at_rest = steady_motion(model, rates={"rear wheel": 0.0}, resting=["lean", "steer"], guess={"steer": 1.33}).state
    assert steer[-1] == pytest.approx(at_rest["steer"], abs=0.01)
    left = hands_free_family(model, 6.0, right=False)
    assert left.motions[5].state["lean"] == pytest.approx(-lean[5], rel=1e-8)


def turned_back(bicycle: Any) -> Any:
    """The bicycle with its front assembly turned by 180 deg about the steer axis and pitched onto its wheels again."""
    b, tilt = bicycle, float(bicycle.steer_axis_tilt)
    foot, axis = np.array([b.wheel_base + b.trail, 0.0]), np.array([np.sin(tilt), np.cos(tilt)])
    flip = 2.0 * np.outer(axis, axis) - np.eye(2)
    rear = np.array([0.0, -float(b.rear_wheel_radius)])
    hub, front = (
        foot + flip @ (np.array(at) - foot)
        for at in ((b.wheel_base, -b.front_wheel_radius), (b.front_frame_x, b.front_frame_z))
    )
    across, height = hub - rear, float(b.rear_wheel_radius - b.front_wheel_radius)
    pitch = np.arctan2(across[1], across[0]) - np.arcsin(height / np.hypot(*across))
    turn = np.array([[np.cos(pitch), np.sin(pitch)], [-np.sin(pitch), np.cos(pitch)]])
    frame = np.array([b.rear_frame_x, b.rear_frame_z])
    hub, front, frame, foot = (rear + turn @ (at - rear) for at in (hub, front, frame, foot))
    axis = turn @ axis
    changes: dict[str, float] = {"wheel_base": hub[0], "steer_axis_tilt": np.arctan2(*axis)}
    changes["trail"] = foot[0] - foot[1] / axis[1] * axis[0] - hub[0]
    for name, centre, turns in (("front_frame", front, turn @ flip), ("rear_frame", frame, turn)):
        xx, xz, zz = (getattr(b, f"{name}_inertia_{axes}") for axes in ("xx", "xz", "zz"))
        inertia = turns @ np.array([[xx, xz], [xz, zz]]) @ turns.T
        changes |= {f"{name}_x": centre[0], f"{name}_z": centre[1], f"{name}_inertia_xx": inertia[0, 0]}
        changes |= {f"{name}_inertia_xz": inertia[0, 1], f"{name}_inertia_zz": inertia[1, 1]}
    return bicycle.replace(**changes), pitch


def test_the_family_with_the_handlebar_reversed_starts_at_capsize_and_ends_flat_and_fast() -> None:
    """Basu-Mandal et al. 2007: from the capsize bifurcation of the reversed bicycle towards spinning flat in circles.

    Where it starts is known from the linear equations of a bicycle that is built the other way round.
    """
    bicycle = load_bicycle("benchmark")
    reversed_bicycle, pitch = turned_back(bicycle)
    (capsize,) = coefficients(reversed_bicycle).critical_speeds().capsize
    family = hands_free_family(bicycle_model(bicycle), 7.5, guess={"steer": np.pi})
    states = [motion.state for motion in family.motions]
    assert -0.3 * states[0].rate("rear wheel") == pytest.approx(capsize, abs=1e-6)
    assert states[0]["pitch"] == pytest.approx(pitch, abs=1e-6)
    lean, yaw, off, rate = (
        np.array([pick(state) for state in states])
        for pick in (
            lambda s: s["lean"],
            lambda s: s.rate("yaw"),
            lambda s: abs(s["steer"] - np.pi),
            lambda s: -s.rate("rear wheel"),
        )
    )
    steps = np.sqrt(np.diff(lean) ** 2 + np.diff(off) ** 2 + (np.diff(rate) / rate[0]) ** 2)
    assert np.max(steps) < 0.06  # two folds of the lean, no jump
    assert np.count_nonzero(np.diff(np.sign(np.diff(lean)))) == 2
    # In the end it lies down, its front wheel steered straight again, and turns the faster the flatter it lies.
    assert family.end == "fell to the right"
    last = slice(-30, None)
    assert np.all(np.diff(lean[last]) > 0.0)
    assert np.all(np.diff(yaw[last]) > 0.0)
    assert np.all(np.diff(rate[last]) > 0.0)
    assert np.all(np.diff(off[last]) < 0.0)
    assert off[-1] < 0.2 * off.max()
    assert circle(family.motions[-1]).radius < 4.0


def test_turns_end_where_a_hand_a_wheel_or_the_ground_ends_them() -> None:
    upright = held_turns(bicycle_model(*design("upright")), 5.0)
    assert upright.end == "left hand at the end of its reach"  # the outer hand of a turn to the right
    assert 0.37 < upright.motions[-1].state["steer"] < 0.41
    outer = [loop_forces(m.state, m.inputs)["left hand"] for m in upright.motions[:: len(upright.motions) // 4]]
    assert np.linalg.norm(outer[-1]) > 2.0 * np.linalg.norm(outer[0])
    rigid = held_turns(bicycle_model(*design("benchmark")), 5.0)
    assert rigid.end == "rear wheel off the ground"
    last = wheel_forces(rigid.motions[-1].state, rigid.motions[-1].inputs)["rear wheel"]
    assert 0.0 < last[2] < 20.0
    with pytest.raises(ModelError, match=r"no such turn at 2 m/s: left hand at the end of its reach \(greatest lean"):
        held_turn(bicycle_model(*design("upright")), 2.0, lean=0.6)


def test_modes_keep_their_names_through_a_turn() -> None:
    bicycle, rider, posture = design("leaned")
    family = turn_family(bicycle, rider, posture, speed=5.5)
    assert family.names == ("weave", "weave", "capsize", "castering", "speed")
    values = family.eigenvalues
    assert np.max(abs(values[:, 4])) < 1e-5  # the neighbouring turn, all the way
    for motion in (0, len(values) // 3):
        found = turn(bicycle, rider, posture, speed=5.5, lean=family.turns[motion].lean)
        np.testing.assert_allclose(found.eigenvalues, values[motion], atol=1e-6)
    straight = turn(bicycle, rider, posture, speed=5.5, lean=0.0)
    np.testing.assert_allclose(straight.eigenvalues, values[0], atol=1e-2)
    assert straight.radius == np.inf
    assert straight.to_dict()["radius"] is None
    assert abs(straight.hand_torque) < 1e-9


@pytest.mark.parametrize("lean", [0.002, -0.002])
def test_a_wide_turn_demands_friction_as_the_acceleration_does(lean: float) -> None:
    """Both wheels share weight and side force alike, m g and m v^2 / R, up to what the spinning wheels take."""
    found = turn(load_bicycle("benchmark"), speed=5.0, lean=lean)
    assert found.friction == pytest.approx(abs(found.lateral_acceleration) / 9.81, rel=0.01)
    assert turn(load_bicycle("benchmark"), speed=5.0, lean=0.0).friction < 1e-9


@pytest.mark.parametrize("name", list(CASES))
def test_one_wheel_demands_as_much_as_the_whole_or_more(name: str) -> None:
    """The whole bicycle's force is horizontal over normal like tan of the angle at which it is pushed."""
    bicycle, rider, posture = design(name)
    found, mirrored = (turn(bicycle, rider, posture, speed=5.5, lean=lean) for lean in (0.3, -0.3))
    whole = np.sum(list(found.wheel_forces.values()), axis=0)
    assert found.friction >= abs(whole[1]) / whole[2] * (1 - 1e-9)
    assert found.friction == pytest.approx(mirrored.friction, rel=1e-8)
    assert found.to_dict()["friction"] == found.friction


def test_nonsense_is_refused() -> None:
    model = bicycle_model(load_bicycle("benchmark"))
    for wrong, message in (
        ({"lean": 0.1, "radius": 3.0}, "either the lean or the radius"),
        ({}, "either the lean or the radius"),
        ({"radius": 0.0}, "radius: 0.0 m"),
    ):
        with pytest.raises(InputError, match=message):
            held_turn(model, 5.0, **wrong)
    for speed in (0.0, -3.0, np.nan):
        with pytest.raises(InputError, match="a turn needs a speed above zero"):
            held_turn(model, speed, lean=0.1)
