"""Machines: composite joints, gears, kept directions, reactions, drives, outputs that are forces, buckling."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from scipy.interpolate import CubicSpline

from singletrack import load_bicycle, load_rider
from singletrack.errors import ModelError
from singletrack.multibody import (
    GROUND,
    Body,
    CoordinateForce,
    Force,
    Joint,
    Motion,
    Ratio,
    System,
    accelerations,
    assemble,
    bicycle_model,
    buckling_load,
    build,
    close_direction,
    close_point,
    driving_forces,
    held_turn,
    inverse_dynamics,
    joint_reactions,
    linearise,
    loop_forces,
    move,
    prismatic,
    revolute,
    ride,
    simulate,
)

ORIGIN, X, Y, Z = (0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)


def test_motions_in_any_order_are_the_joints_one_after_the_other() -> None:
    boom = Body("boom", 3.0, (0.8, 0.1, -1.2), (0.2, 0.5, 0.6, 0.01, 0.02, 0.03))
    foot = (0.2, 0.0, -1.0)
    motions = (
        Motion("slew", rotates=True, axis=Z),
        Motion("luff", rotates=True, axis=Y),
        Motion("reach", rotates=False, axis=X),
        Motion("roll", rotates=True, axis=(1, 0, 1)),
    )
    at_once = build(System([boom], [Joint("crane", GROUND, "boom", foot, motions)]))
    links = [Body("one"), Body("two"), Body("three"), boom]
    chain = [
        revolute("slew", GROUND, "one", foot, Z),
        revolute("luff", "one", "two", foot, Y),
        prismatic("reach", "two", "three", X),
        revolute("roll", "three", "boom", foot, (1, 0, 1)),
    ]
    one_by_one = build(System(links, chain))
    q = {"slew": 0.4, "luff": -0.3, "reach": 0.7, "roll": 0.5}
    u = {"slew": 1.0, "luff": 0.6, "reach": -0.8, "roll": 1.4}
    first, second = (move(assemble(model, q), u) for model in (at_once, one_by_one))
    np.testing.assert_allclose(accelerations(first).a, accelerations(second).a, rtol=1e-11)
    np.testing.assert_allclose(
        at_once.kinetics(first.q, first.parameters)[1], one_by_one.kinetics(second.q, second.parameters)[1], atol=1e-12
    )
    np.testing.assert_allclose(joint_reactions(first)["crane"].force, joint_reactions(second)["roll"].force, rtol=1e-10)
    run = simulate(first, np.linspace(0.0, 1.0, 11))
    np.testing.assert_allclose(run.energy, float(run.energy[0]), rtol=1e-8)


def test_a_gear_adds_the_other_wheels_inertia() -> None:
    bodies = [Body("small", 1.0, ORIGIN, (0.1, 0.2, 0.1)), Body("large", 1.0, X, (1.0, 2.0, 1.0))]
    joints = [revolute("small", GROUND, "small", ORIGIN, Y), revolute("large", GROUND, "large", X, Y)]
    drive = CoordinateForce("drive", "small")
    gear = Ratio("teeth", {"small": 1.0, "large": 3.0}, offset=0.3)
    model = build(System(bodies, joints, ratios=[gear], inputs=[drive], gravity=0.0, independent=("small",)))
    state = assemble(model, {"small": 0.0})
    assert state["large"] == pytest.approx(0.1, abs=1e-13)
    response = accelerations(state, {"drive": 5.0})
    assert response.a == pytest.approx([5.0 / (0.2 + 2.0 / 9.0), -5.0 / (0.2 + 2.0 / 9.0) / 3.0])
    assert 3.0 * response.multipliers[0] == pytest.approx(2.0 * response.a[1])  # what turns the large wheel
    assert state.model.system.rows == ("teeth (ratio)",)
    with pytest.raises(ModelError, match="ratio teeth: unknown coordinate 'smal'"):
        System(bodies, joints, ratios=[Ratio("teeth", {"smal": 1.0})])
    with pytest.raises(ModelError, match="ratio teeth: needs a coordinate"):
        Ratio("teeth", {"small": 0.0})


def test_a_kept_direction_makes_a_parallelogram() -> None:
    # a tray on the end of an arm, kept level, moves as a point mass does
    bodies = [Body("arm", 0.0), Body("tray", 2.0, (1, 0, 0), (0.3, 0.4, 0.5))]
    joints = [revolute("arm", GROUND, "arm", ORIGIN, Y), revolute("wrist", "arm", "tray", X, Y)]
    level = close_direction("level", GROUND, "tray", Z)
    state = assemble(build(System(bodies, joints, [level], independent=("arm",))), {"arm": 0.4})
    assert state["wrist"] == pytest.approx(-0.4, abs=1e-12)
    assert accelerations(state).a[0] == pytest.approx(9.81 * np.cos(0.4) * -1.0, rel=1e-12)


def rod(name: str, start: Any, end: Any) -> Body:
    start, end = np.array(start, float), np.array(end, float)
    along = end - start
    inertia = (along @ along * np.eye(3) - np.outer(along, along)) / 12.0
    i = inertia
    return Body(name, 1.0, (start + end) / 2.0, (i[0, 0], i[1, 1], i[2, 2], i[0, 1], i[1, 2], i[0, 2]))


def test_reactions_do_not_depend_on_where_the_loop_is_cut() -> None:
    corners = [(0.0, 0, 0), (0.0, 0, -1.0), (2.0, 0, -1.5), (2.5, 0, 0)]
    bodies = [rod("crank", *corners[:2]), rod("coupler", *corners[1:3]), rod("rocker", corners[3], corners[2])]
    crank, rocker = (
        revolute("crank", GROUND, "crank", corners[0], Y),
        revolute("rocker", GROUND, "rocker", corners[3], Y),
    )
    at_rocker = System(
        bodies,
        [crank, rocker, revolute("a", "crank", "coupler", corners[1], Y)],
        [close_point("b", "coupler", "rocker", corners[2], normal=Y)],
    )
    at_crank = System(
        bodies,
        [crank, rocker, revolute("b", "rocker", "coupler", corners[2], Y)],
        [close_point("a", "coupler", "crank", corners[1], normal=Y)],
    )
    one, other = (move(assemble(build(s), {"crank": 0.3}), {"crank": 2.0}) for s in (at_rocker, at_crank))
    first, second = joint_reactions(one), joint_reactions(other)
    for name in ("crank", "rocker"):
        np.testing.assert_allclose(first[name].force, second[name].force, atol=1e-10)
        np.testing.assert_allclose(first[name].moment[1], 0.0, atol=1e-10)  # a hinge carries none about its axis
    np.testing.assert_allclose(first["a"].force, -loop_forces(other)["a"], atol=1e-10)
    np.testing.assert_allclose(second["b"].force, -loop_forces(one)["b"], atol=1e-10)


@pytest.mark.parametrize(("name", "posture"), [("benchmark", "rigid"), ("browser", "upright"), ("stratos", "leaned")])
def test_a_bicycle_hangs_on_nothing(name: str, posture: str) -> None:
    rider = None if posture == "rigid" else load_rider("rider-a")
    model = bicycle_model(load_bicycle(name), rider, posture)
    turn = held_turn(model, 5.0, lean=0.2)
    state = move(turn.state, {"lean": 0.1, "steer": -0.2, "rear wheel": turn.state.rate("rear wheel")})
    carried = joint_reactions(state, {"steer torque": 1.0})
    # the free joint to the ground carries nothing: hands, wheels and inertia balance
    np.testing.assert_allclose(carried["frame"].force, 0.0, atol=1e-8)
    np.testing.assert_allclose(carried["frame"].moment, 0.0, atol=1e-8)


def test_driving_forces_give_the_accelerations_wanted() -> None:
    bodies = [rod("upper", ORIGIN, (0, 0, 1)), rod("lower", (0, 0, 1), (0, 0, 2))]
    joints = [revolute("hip", GROUND, "upper", ORIGIN, Y), revolute("knee", "upper", "lower", (0, 0, 1), Y)]
    inputs = [CoordinateForce("hip torque", "hip"), CoordinateForce("knee torque", "knee")]
    state = move(
        assemble(build(System(bodies, joints, inputs=inputs)), {"hip": 0.3, "knee": 0.5}), {"hip": 1.0, "knee": -2.0}
    )
    both = driving_forces(state, {"hip": 2.0, "knee": -1.0})
    given = accelerations(state, {f"{name} torque": force for name, force in both.items()}).a
    assert given == pytest.approx([2.0, -1.0], rel=1e-12)
    one = driving_forces(state, {"knee": 4.0}, {"hip torque": 0.7})
    assert accelerations(state, {"hip torque": 0.7, "knee torque": one["knee"]}).a[1] == pytest.approx(4.0, rel=1e-12)
    with pytest.raises(ModelError, match="unknown independent coordinate 'ankle'"):
        driving_forces(state, {"ankle": 1.0})


def slider_crank() -> Any:
    joints = [
        revolute("crank", GROUND, "crank", ORIGIN, Y),
        revolute("rod", "crank", "rod", (0.3, 0, 0), Y),
        prismatic("slide", GROUND, "piston", X),
    ]
    bodies = [rod("crank", ORIGIN, (0.3, 0, 0)), rod("rod", (0.3, 0, 0), (1.3, 0, 0)), Body("piston", 2.0, (1.3, 0, 0))]
    pin = close_point("pin", "rod", "piston", (1.3, 0, 0), normal=Y)
    return build(System(bodies, joints, [pin], inputs=[CoordinateForce("motor", "crank")], independent=("crank",)))


def test_the_torque_that_makes_a_motion_makes_it() -> None:
    model = slider_crank()

    def swing(t: float) -> tuple[float, float, float]:
        return np.sin(2.0 * t), 2.0 * np.cos(2.0 * t), -4.0 * np.sin(2.0 * t)

    times = np.linspace(0.0, 2.0, 21)
    found = inverse_dynamics(model, {"crank": swing}, times)
    start = move(assemble(model), {"crank": 2.0})

    def motor(t: float) -> float:
        return float(inverse_dynamics(model, {"crank": swing}, [t], guess={"rod": -0.3 * np.sin(2 * t)}).drive[0, 0])

    assert motor(0.4) == pytest.approx(float(found.drive.sel(time=0.4)[0]), rel=1e-10)
    fine = np.linspace(0.0, 1.0, 41)
    spline = CubicSpline(fine, [motor(t) for t in fine])
    run = simulate(start, np.linspace(0.0, 1.0, 11), {"motor": lambda t: float(spline(t))})
    np.testing.assert_allclose(run.q.sel(coordinate="crank"), np.sin(2.0 * run.time), atol=1e-4)
    # power: the motor's work is the change of energy
    work = np.trapezoid(found.drive[:, 0] * 2.0 * np.cos(2.0 * times), times)
    ends = [
        move(assemble(model, {"crank": swing(t)[0]}, guess={"rod": -0.3 * swing(t)[0]}), {"crank": swing(t)[1]})
        for t in (0.0, 2.0)
    ]
    energy = [sum(float(part) for part in model.equations.energy(s.q, s.u, s.parameters)) for s in ends]
    assert work == pytest.approx(energy[1] - energy[0], abs=0.05)
    # the reaction of the crank's bearing about its axis is the drive
    np.testing.assert_allclose(found.moment.sel(joint="crank", axis="y"), found.drive[:, 0], atol=1e-9)


def test_accelerations_and_forces_are_outputs_with_their_inputs() -> None:
    slide = prismatic("slide", GROUND, "cart", X)
    cart = System([Body("cart", 2.0)], [slide], inputs=[CoordinateForce("push", "slide")])
    small = linearise(assemble(build(cart)), outputs=["slide''"])
    assert small.D_matrix.tolist() == [[0.5]]
    model = bicycle_model(load_bicycle("benchmark"))
    turn = held_turn(model, 5.0, lean=0.2)
    outputs = ["lean''", "steer''", "yaw''", "front wheel (lateral)", "rear wheel (height)"]
    small = linearise(turn.state, turn.inputs, outputs=outputs)
    base = turn.state

    def observed(lean: float, steer: float, rates: Any, torque: float) -> Any:
        guess = {name: base[name] for name in model.system.coordinates}
        state = ride(model, 5.0, {"lean": base["lean"] + lean, "steer": base["steer"] + steer}, guess=guess)
        state = move(state, {"lean": rates[0], "steer": rates[1], "rear wheel": base.rate("rear wheel") + rates[2]})
        response = accelerations(state, turn.inputs | {"steer torque": turn.inputs["steer torque"] + torque})
        named = dict(zip(model.system.coordinates, response.a, strict=True))
        forces = dict(zip(model.system.rows, response.multipliers, strict=True))
        return np.array([*(named[name] for name in ("lean", "steer", "yaw")), forces[outputs[3]], forces[outputs[4]]])

    steps = np.eye(6) * 1e-4
    columns = [(observed(s[0], s[1], s[2:5], s[5]) - observed(-s[0], -s[1], -s[2:5], -s[5])) / 2e-4 for s in steps]
    np.testing.assert_allclose(small.C_matrix, np.array(columns[:5]).T, atol=2e-5)
    np.testing.assert_allclose(small.D_matrix[:, 1], columns[5], atol=1e-7)
    assert np.all(small.D_matrix[:, 1] != 0.0)


@pytest.mark.parametrize("count", [1, 2, 5])
def test_a_column_of_links_buckles_where_the_textbook_says(count: int) -> None:
    """Rigid links with springs k at the lower joints: P = 4 (k/l) sin^2(pi / (2 (2 n + 1)))."""
    stiffness, length = 7.0, 0.5
    bodies = [Body(f"link {i}", 1e-3, (0, 0, -length * (i + 0.5))) for i in range(count)]
    joints = [
        revolute(f"j{i}", f"link {i - 1}" if i else GROUND, f"link {i}", (0, 0, -length * i), Y, stiffness=stiffness)
        for i in range(count)
    ]
    push = Force("load", f"link {count - 1}", (0, 0, -length * count), Z)
    state = assemble(build(System(bodies, joints, inputs=[push], gravity=0.0)))
    found = buckling_load(state, "load")
    expected = 4.0 * stiffness / length * np.sin(np.pi / 2.0 * (2 * np.arange(count) + 1) / (2 * count + 1)) ** 2
    np.testing.assert_allclose(found.loads, expected, rtol=1e-9)
    assert found.shapes.shape == (count, count)
    growth = [
        linearise(state, {"load": factor * float(found.loads[0])}).eigenvalues().real.max() for factor in (0.99, 1.01)
    ]
    assert growth[0] < 1e-3 < growth[1]
    with pytest.raises(ModelError, match="buckling: load = 0 does not leave the machine at rest"):
        buckling_load(assemble(state.model, {"j0": 0.1, **({"j1": -0.05} if count > 1 else {})}), "load")
