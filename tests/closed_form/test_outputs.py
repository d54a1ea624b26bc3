"""Joint angles and hand forces: the closed form against the engine's nonlinear equations, symmetry, batches, errors."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
import pytest

from mechanisms import random_mechanism
from singletrack import InputError, closed_form, coefficients, load_bicycle, load_rider
from singletrack.closed_form import rider_outputs
from singletrack.control import frequency_response, lateral_force, response, save_mat, with_ground, with_inputs
from singletrack.linear import state_space
from singletrack.multibody import Force, accelerations, bicycle_model, build, driving_forces, loop_forces, ride
from singletrack.multibody.bicycle.balance import holding_inputs
from singletrack.posture import Options, seat

if TYPE_CHECKING:
    from singletrack.multibody.engine.model import Model

STRATOS, BROWSER, RIDER = load_bicycle("stratos"), load_bicycle("browser"), load_rider("rider-a")
SOFT = {"springs": {"hands": 5000.0}, "dampers": {"hands": 50.0}}
CASES = [
    (STRATOS, Options("leaned", torso_lean=True)),
    (BROWSER, Options("upright")),
    (STRATOS, Options("one-hand")),
    (STRATOS, Options("leaned", **SOFT)),
    (STRATOS.replace(frame_torsion_stiffness=5e3, frame_hinge_x=0.9, frame_hinge_z=-0.6), Options("leaned")),
    (STRATOS.replace(rear_tyre_radius=0.02, front_tyre_radius=0.02), Options("leaned", arms="bent")),
    (STRATOS, Options(random_mechanism(1))),  # a loop to the handlebar, and one between two joints
    (STRATOS, Options(random_mechanism(4))),  # two directions kept perpendicular
]


def values(model: Model, names: tuple[str, ...], state: Any, forces: dict[str, float]) -> Any:
    """What the engine says of the outputs at a state and under forces, the rear wheel's speed held."""
    forces = forces | {"rear wheel torque": driving_forces(state, {"rear wheel": 0.0}, forces)["rear wheel"]}
    _at, rotations = model.equations.poses(state.q, state.parameters)
    place = [body.name for body in model.system.bodies].index("rear frame")
    turn = rotations.full()[:, 3 * place : 3 * place + 3]
    hands = {hand: turn.T @ force for hand, force in loop_forces(state, forces).items()}
    rows = dict(zip(model.system.rows, accelerations(state, forces).multipliers, strict=True))
    found = []
    for name in names:
        if " force " in name:
            hand, axis = name.rsplit(" force ", 1)
            found.append(hands[hand]["xyz".index(axis)])
        elif name.endswith(" moment"):
            found.append(-rows[f"{name.removesuffix(' moment')} (angle 1)"])
        else:
            found.append(state.rate(name.removesuffix(" rate")) if name.endswith(" rate") else state[name])
    return np.array(found)


@pytest.mark.parametrize(("bicycle", "options"), CASES, ids=lambda case: getattr(case, "title", None))
def test_outputs_are_the_differences_of_the_nonlinear_equations(bicycle: Any, options: Any) -> None:
    """Loops opened and closed by algebra against constraint forces of another derivation, to the differences' error."""
    speed, step = 4.0, 1e-5
    outputs, model = rider_outputs(bicycle, RIDER, options), bicycle_model(bicycle, RIDER, options)
    linear = closed_form.coefficients(bicycle, RIDER, options)
    n, names = linear.freedoms, linear.coordinates
    system = state_space(linear, speed, outputs.names, outputs)
    hold = holding_inputs(ride(model, 0.0))

    def at(x: Any, f: Any) -> Any:
        state = ride(model, speed, dict(zip(names, x[:n], strict=True)), dict(zip(names, x[n:], strict=True)))
        pushed = {name: hold[name] + value for name, value in zip(linear.inputs, f, strict=True)}
        return values(model, outputs.names, state, pushed)

    still = np.zeros(2 * n)
    np.testing.assert_allclose(at(still, np.zeros(n)), outputs.rest, atol=1e-9)
    found = np.array([(at(x, np.zeros(n)) - at(-x, np.zeros(n))) / (2 * step) for x in step * np.eye(2 * n)]).T
    np.testing.assert_allclose(found, system.C, rtol=1e-6, atol=1e-7 * np.abs(system.C).max())
    pushed = np.array([(at(still, f) - at(still, -f)) / 2 for f in np.eye(n)]).T
    np.testing.assert_allclose(pushed, system.D, rtol=1e-9, atol=1e-11)


def test_a_push_at_the_shoulder_reaches_the_hand_at_once() -> None:
    options = Options("leaned")
    push = {"push": "right shoulder"}
    column = lateral_force(STRATOS, "right shoulder", RIDER, options)
    linear = with_inputs(closed_form.coefficients(STRATOS, RIDER, options), {"push": column})
    outputs = rider_outputs(STRATOS, RIDER, options, push)
    system = state_space(linear, 4.0, outputs.names, outputs)
    plain = bicycle_model(STRATOS, RIDER, options)
    point = tuple(float(x) for x in seat(STRATOS, RIDER, options).skeleton[22])
    force = Force("push", "torso twist link", point, (0.0, 1.0, 0.0))
    model = build(plain.system.replace(inputs=(*plain.system.inputs, force)))
    state = ride(model, 4.0)
    found = (
        values(model, outputs.names, state, {"push": 1.0}) - values(model, outputs.names, state, {"push": -1.0})
    ) / 2
    np.testing.assert_allclose(found, system.D[:, -1], rtol=1e-8, atol=1e-9)
    assert np.abs(system.D[-6:, -1]).max() > 0.01


@pytest.mark.parametrize(("bicycle", "posture"), [(STRATOS, "leaned"), (BROWSER, "upright")])
def test_left_is_the_mirror_of_right(bicycle: Any, posture: str) -> None:
    model = coefficients(bicycle, RIDER, posture)
    for axis, sign in (("x", -1.0), ("y", 1.0), ("z", -1.0)):
        system = model.state_space([2.0, 6.0], [f"{side} hand force {axis}" for side in ("right", "left")])
        for part in (system.C, system.D):
            np.testing.assert_allclose(part[..., 0, :], sign * part[..., 1, :], atol=1e-9)


def test_hands_turn_the_bar_as_the_riders_mass_does() -> None:
    """At rest the moment of both hands about the steer axis is what the rider adds to the stiffness of the steer."""
    bicycle, options = BROWSER, Options("upright")
    outputs = rider_outputs(bicycle, RIDER, options).select([f"right hand force {axis}" for axis in "xyz"])
    posture = seat(bicycle, RIDER, options)
    grip = next(loop.point for loop in posture.loops if loop.name == "right hand")
    tilt = float(bicycle.steer_axis_tilt)
    foot, axis = np.array([bicycle.wheel_base + bicycle.trail, 0.0, 0.0]), np.array([np.sin(tilt), 0.0, np.cos(tilt)])
    # Force on the bar turned by the steer, and the grip that moved: the moment's change, of both hands.
    moved = np.cross(axis, grip - foot)
    force = float(bicycle.gravity) * outputs.K0[:, 1]
    moment = 2 * (np.cross(grip - foot, force) + np.cross(moved, outputs.rest)) @ axis
    with_rider, rigid = (coefficients(bicycle, RIDER, name) for name in ("upright", "rigid"))
    added = float(bicycle.gravity) * (with_rider.K0 - rigid.K0)[1, 1]
    # The trail's yaw of the frame lowers the rider alike whether he holds the bar or not, but for his arms' own sag.
    assert moment == pytest.approx(-added, rel=1e-9)


def test_batches_and_speeds_agree_with_single_designs() -> None:
    trails, names = np.array([0.05, 0.06]), ["steer", "right hand force z", "torso twist rate", "lean acceleration"]
    batch = coefficients(STRATOS.replace(trail=trails), RIDER, "leaned")
    several = batch.state_space([3.0, 5.0], names)
    assert several.outputs == tuple(names)
    assert several.C.shape == (2, 2, 4, 4)
    for k, trail in enumerate(trails):
        for j, speed in enumerate((3.0, 5.0)):
            one = coefficients(STRATOS.replace(trail=trail), RIDER, "leaned").state_space(speed, names)
            np.testing.assert_allclose(several.C[k, j], one.C, atol=1e-9)
            np.testing.assert_allclose(several.D[k, j], one.D, atol=1e-9)
    picked = batch[1:].state_space(3.0, names)
    np.testing.assert_array_equal(picked.C[0], batch.state_space(3.0, names).C[1])


def test_arms_out_of_reach_leave_the_other_designs_alone() -> None:
    lengths = np.array([float(RIDER.upper_arm_length), 0.1])
    batch = coefficients(STRATOS, RIDER.replace(upper_arm_length=lengths), "leaned")
    forces = batch.state_space(3.0, ["right hand force z"]).C
    assert np.isfinite(forces[0]).all()
    assert np.isnan(forces[1]).all()


def test_responses_show_outputs_by_name(tmp_path: Any) -> None:
    import scipy.io

    names = ["right hand force x", "lean"]
    system = with_ground(coefficients(BROWSER, RIDER, "upright")).state_space(5.0, names)
    time = np.linspace(0.0, 1.0, 101)
    u = np.random.default_rng(0).normal(size=(101, 3))
    seen = response(system, time, u, hold="zero")
    assert list(seen) == names
    whole = with_ground(coefficients(BROWSER, RIDER, "upright")).state_space(5.0)
    states = response(whole, time, u, hold="zero")
    x = np.stack([states[name] for name in whole.states], axis=-1)
    np.testing.assert_allclose(seen[names[0]], x @ system.C[0] + u @ system.D[0], atol=1e-12)
    # The way of an input at once: all that is left at high frequencies.
    high = frequency_response(system, [1e7]).sel(output=names[0]).values[0]
    np.testing.assert_allclose(high, system.D[0], atol=1e-5)
    assert system.to_control().output_labels == names
    save_mat(system, tmp_path / "a.mat")
    assert [str(name[0]) for name in scipy.io.loadmat(tmp_path / "a.mat")["outputs"].ravel()] == names


def test_what_cannot_be_known_is_refused() -> None:
    model = coefficients(STRATOS, RIDER, "leaned")
    pushed = with_inputs(model, {"push": np.array([1.0, 0.0])})
    with pytest.raises(InputError, match="input 'push': what it does at once"):
        pushed.state_space(3.0, ["right hand force x"])
    assert not pushed.state_space(3.0, ["torso twist"]).D.any()
    with pytest.raises(InputError, match="did you mean right hand force"):
        model.state_space(3.0, ["right hand"])
    with pytest.raises(InputError, match="must be a list of names"):
        model.state_space(3.0, "lean")
    with pytest.raises(InputError, match="unknown output"):
        coefficients(STRATOS).state_space(3.0, ["right hand force x"])
    with pytest.raises(InputError, match="name is that of another input"):
        rider_outputs(STRATOS, RIDER, "leaned", {"steer torque": "right shoulder"})
    with pytest.raises(InputError, match="must be of the model's"):
        coefficients(STRATOS).state_space(3.0, rider_outputs(STRATOS, RIDER, Options("leaned", torso_lean=True)))
    assert rider_outputs(STRATOS, RIDER, Options("rigid", torso_lean=True)).names == ()
