"""The benchmark bicycle of Meijaard et al. (2007) through the nonlinear equations."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from singletrack import load_bicycle
from singletrack.errors import InputError, ModelError
from singletrack.multibody import (
    Event,
    Pulse,
    accelerations,
    assemble,
    bicycle_model,
    build,
    coefficients,
    free_turns,
    linearise,
    move,
    ride,
    simulate,
    speed_polynomials,
    steady_motion,
    wheel_forces,
)

SHARED = Path(__file__).parents[4] / "shared" / "reference" / "meijaard2007.json"

# Meijaard, Papadopoulos, Ruina, Schwab 2007, Proc. R. Soc. A 463:1955-1982, equations (5.1) and (5.2)
PUBLISHED = {
    "M": [[80.81722, 2.31941332208709], [2.31941332208709, 0.29784188199686]],
    "K0": [[-80.95, -2.59951685249872], [-2.59951685249872, -0.80329488458618]],
    "K2": [[0.0, 76.59734589573222], [0.0, 2.65431523794604]],
    "C1": [[0.0, 33.86641391492494], [-0.85035641456978, 1.68540397397560]],
}


@pytest.fixture(scope="module")
def model() -> Any:
    return bicycle_model(load_bicycle("benchmark"))


def lean_and_steer(run: Any) -> Any:
    return run.q.sel(coordinate=["lean", "steer"]).to_numpy()


def test_the_published_coefficients_follow_from_the_nonlinear_equations() -> Any:
    found = coefficients(load_bicycle("benchmark"))
    for name, expected in PUBLISHED.items():
        np.testing.assert_allclose(getattr(found, name), expected, rtol=1e-11, atol=1e-13, err_msg=name)


def test_the_published_eigenvalues_at_all_speeds(model: Any) -> Any:
    if not SHARED.exists():
        pytest.skip(f"no reference numbers at {SHARED}")
    for speed, published in json.loads(SHARED.read_text())["eigenvalues"].items():
        small = linearise(ride(model, float(speed)), keep=["lean", "steer"])
        assert small.coordinates == ("lean", "steer")
        values = np.linalg.eigvals(small.A_matrix)
        values = np.delete(values, np.argmin(abs(values)))  # the forward speed is free to be another
        expected = np.array([complex(*pair) for pair in published])
        np.testing.assert_allclose(np.sort_complex(values), np.sort_complex(expected), rtol=1e-9, atol=1e-9)


def test_position_heading_and_wheel_angles_do_not_matter(model: Any) -> Any:
    small = linearise(ride(model, 5.0))
    assert small.coordinates == ("lean", "steer")
    elsewhere = linearise(ride(model, 5.0, {"x": 3.0, "y": -40.0, "yaw": 2.0, "rear wheel": 1.0, "front wheel": -9.0}))
    for name in ("M", "C", "K", "B"):
        np.testing.assert_allclose(getattr(elsewhere, name), getattr(small, name), atol=1e-11)


def test_the_state_space_goes_to_python_control(model: Any) -> Any:
    small = linearise(ride(model, 5.0))
    system = small.to_control()
    assert system.state_labels == ["lean", "steer", "lean'", "steer'", "rear wheel'"]
    assert system.input_labels == ["lean torque", "steer torque", "rear wheel torque"]
    np.testing.assert_allclose(np.sort_complex(system.poles()), small.eigenvalues(), atol=1e-9)


def test_springs_and_dampers_at_the_steer_add_to_the_polynomials(model: Any) -> Any:
    joints = list(model.system.joints)
    steer = next(i for i, joint in enumerate(joints) if joint.name == "steer")
    motion = replace(joints[steer].motions[0], stiffness=3.0, damping=0.5)
    joints[steer] = replace(joints[steer], motions=(motion,))
    sprung = build(model.system.replace(joints=tuple(joints)))
    found = speed_polynomials(assemble(sprung), {"rear wheel": -1 / 0.3}, ("lean", "steer"))
    np.testing.assert_allclose(found.S0, [[0, 0], [0, 3.0]], atol=1e-13)
    np.testing.assert_allclose(found.C0, [[0, 0], [0, 0.5]], atol=1e-13)
    for name, expected in PUBLISHED.items():
        np.testing.assert_allclose(getattr(found, name), expected, rtol=1e-11, atol=1e-12, err_msg=name)


def test_a_kick_to_the_benchmark_bicycle(model: Any) -> Any:
    # the simulation of Meijaard et al. 2007, section 5(b): 4.6 m/s, lean rate 0.5 rad/s
    run = simulate(ride(model, 4.6, rates={"lean": 0.5}), np.linspace(0.0, 5.0, 251))
    energy = run.energy.to_numpy()
    assert np.max(abs(energy - energy[0])) < 1e-9 * energy[0]
    assert run.residual.max() < 1e-10
    slip = []
    for q, u in zip(run.q.to_numpy(), run.u.to_numpy(), strict=True):
        jacobian, _ = model.kinetics(q, model.parameters())
        slip.append(np.max(abs(jacobian @ u)))
    assert np.max(slip) < 1e-10
    speed = -0.3 * run.u.sel(coordinate="rear wheel").to_numpy()
    # the energy of the lateral motion goes into the forward motion: m_T v dv = what the kick brought
    assert speed[0] == pytest.approx(4.6)
    assert 4.61 < speed[-1] < 4.64
    lateral = 0.5 * 80.81722 * 0.5**2
    rolling_mass = 94.0 + 0.12 / 0.3**2 + 0.28 / 0.35**2
    assert 0.5 * rolling_mass * (speed[-1] ** 2 - 4.6**2) == pytest.approx(lateral, rel=0.05)


def test_small_motions_decay_and_oscillate_as_linearised(model: Any) -> Any:
    state = ride(model, 5.0, rates={"lean": 1e-4, "steer": -2e-4})
    step = 0.05
    run = simulate(state, np.arange(0.0, 2.0, step), rtol=1e-12, atol=1e-16)
    names = ["lean", "steer"]
    x = np.hstack([run.q.sel(coordinate=names), run.u.sel(coordinate=names)])
    transition = np.linalg.lstsq(x[:-1], x[1:], rcond=None)[0]
    found = np.log(np.linalg.eigvals(transition).astype(complex)) / step
    weave = found[np.argmax(found.imag)]
    expected = linearise(ride(model, 5.0)).eigenvalues()
    expected = expected[np.argmax(expected.imag)]
    assert weave.real == pytest.approx(expected.real, rel=1e-4)
    assert weave.imag == pytest.approx(expected.imag, rel=1e-4)


def test_published_accelerations_of_a_wild_state(model: Any) -> Any:
    """Basu-Mandal, Chatterjee, Papadopoulos 2007, Proc. R. Soc. A 463:1983-2003, Table 1.

    Their angles: theta = -yaw, psi = pi/2 - lean, phi = pi - pitch, psi_f = -steer, beta_r and beta_f = -wheels.
    """
    state = ride(
        model,
        0.3 * 8.9129896614890,
        {"lean": np.pi / 2 - 0.9501292851472, "steer": -0.2311385135743},
        {"lean": -0.6068425835418, "steer": -0.4859824687093},
    )
    assert np.pi - state["pitch"] == pytest.approx(3.1257073014894, abs=1e-12)
    rates = {"yaw": -0.7830033527065, "pitch": 0.0119185528069, "front wheel": -8.0133620584155}
    assert {name: state.rate(name) for name in rates} == pytest.approx(rates, abs=1e-12)
    published = {
        "yaw": -0.8353281706379,
        "lean": 7.8555281128244,
        "pitch": -0.1205543897884,
        "steer": 4.6198904039403,
        "rear wheel": -1.8472554144217,
        "front wheel": -2.4548072904550,
    }
    found = dict(zip(model.system.coordinates, accelerations(state).a.tolist(), strict=True))
    assert {name: found[name] for name in published} == pytest.approx(published, rel=1e-11)


def hands_free_turn(model: Any, lean: Any) -> Any:
    return steady_motion(
        model,
        {"lean": lean},
        resting=["lean", "steer"],
        guess={"steer": 0.3 * lean},
        guess_rates={"rear wheel": -5.8 / 0.3},
    ).state


def test_hands_free_turns_start_at_the_capsize_speed(model: Any) -> Any:
    turns = free_turns(model, [-1e-4, 1e-4], speed=6.0)
    assert turns.speed.to_numpy() == pytest.approx(6.024262015388, abs=1e-6)  # Meijaard et al. 2007, Table 2
    found = coefficients(load_bicycle("benchmark"))
    static = 9.81 * found.K0 + 6.024262015388**2 * found.K2
    assert (turns.steer / turns.lean).to_numpy() == pytest.approx(-static[0, 0] / static[0, 1], rel=1e-5)


@pytest.mark.parametrize("lean", [-0.4, 0.1, 0.3])
def test_hands_free_turns_go_on_by_themselves(model: Any, lean: Any) -> Any:
    turn = hands_free_turn(model, lean)
    assert np.max(abs(accelerations(turn).a[[4, 6, 7]])) < 1e-9
    small = linearise(turn)
    growth = np.max(small.eigenvalues().real)  # what is unstable magnifies the rounding and the integrator's errors
    run = simulate(turn, np.linspace(0.0, 3.0, 31))
    stays = 1e-7 * np.exp(3.0 * growth)
    np.testing.assert_allclose(lean_and_steer(run), lean_and_steer(run)[:1].repeat(31, 0), rtol=0, atol=stays)
    assert stays < 1e-6
    # the forces of the ground carry the whole mass
    forces = wheel_forces(turn)
    assert sum(force[2] for force in forces.values()) == pytest.approx(94.0 * 9.81, rel=1e-9)
    assert min(abs(small.eigenvalues())) < 1e-6  # the neighbouring turn of the family


def test_the_family_of_hands_free_turns_ends_upright_with_the_front_wheel_across(model: Any) -> Any:
    """The handlebar-forward family of Basu-Mandal et al. 2007: from the capsize bifurcation to static equilibrium."""
    turns = free_turns(model, [1e-3, *np.arange(0.05, 1.31, 0.05)], speed=6.0, along="steer")
    assert np.all(np.diff(turns.speed) < 0.0)
    assert np.all(np.diff(turns.radius) < 0.0)
    top = int(np.argmax(turns.lean.to_numpy()))
    assert 0 < top < len(turns.lean) - 1  # the lean has a greatest value
    by_lean = free_turns(model, [0.1, 0.3, float(turns.lean[2])], speed=6.0)
    assert float(by_lean.steer[-1]) == pytest.approx(float(turns.steer[2]), rel=1e-9)
    end = steady_motion(model, rates={"rear wheel": 0.0}, resting=["lean", "steer"], guess={"steer": 1.33}).state
    assert end["lean"] == pytest.approx(0.0, abs=1e-9)
    assert 1.3 < end["steer"] < np.pi / 2
    assert np.max(linearise(end).eigenvalues().real) > 1.0
    last = turns.isel(turn=slice(-2, None))
    to_rest = float(last.steer[1] + last.lean[1] * np.diff(last.steer)[0] / -np.diff(last.lean)[0])
    assert to_rest == pytest.approx(end["steer"], abs=1e-3)
    with pytest.raises(ModelError, match="no steady motion found"):
        free_turns(model, [0.1, 0.3, 0.41, 0.45], speed=6.0)
    with pytest.raises(InputError, match="unknown angle to go along 'stear'; did you mean steer"):
        free_turns(model, [0.1], speed=6.0, along="stear")


def test_turns_to_the_left_mirror_turns_to_the_right(model: Any) -> Any:
    right, left = (hands_free_turn(model, lean) for lean in (0.3, -0.3))
    assert left["steer"] == pytest.approx(-right["steer"], rel=1e-10)
    assert left.rate("rear wheel") == pytest.approx(right.rate("rear wheel"), rel=1e-10)
    assert left["pitch"] == pytest.approx(right["pitch"], rel=1e-10)
    np.testing.assert_allclose(linearise(left).eigenvalues(), linearise(right).eigenvalues(), rtol=1e-6, atol=1e-8)


def test_a_steer_torque_holds_any_turn(model: Any) -> Any:
    held = steady_motion(
        model,
        {"lean": 0.3},
        {"rear wheel": -4.0 / 0.3},
        resting=["lean", "steer"],
        guess={"steer": 0.15},
        adjust=["steer torque"],
    )
    assert abs(held.inputs["steer torque"]) > 0.1
    run = simulate(held.state, np.linspace(0.0, 1.0, 11), held.inputs)
    np.testing.assert_allclose(lean_and_steer(run), lean_and_steer(run)[:1].repeat(11, 0), atol=1e-6)


def test_torques_do_the_work_they_should(model: Any) -> Any:
    run = simulate(ride(model, 5.0), np.linspace(0.0, 2.0, 401), {"steer torque": Pulse(0.5, 0.25, 1.0)})
    steer = run.q.sel(coordinate="steer").to_numpy()
    before, after = np.searchsorted(run.time, [0.5, 0.75])
    gained = run.energy.to_numpy()[after] - run.energy.to_numpy()[before]
    assert gained == pytest.approx(steer[after] - steer[before], rel=1e-7)
    assert run.q.sel(coordinate="lean").to_numpy()[-1] * 1.0 < 0.0  # countersteer: pushed right, it leans left


def test_a_fall_is_an_event(model: Any) -> Any:
    fallen = Event("fallen", lambda _, state: abs(state["lean"]) - 1.0, terminal=True)
    run = simulate(ride(model, 1.0, {"lean": 0.01}), np.linspace(0.0, 10.0, 101), events=[fallen])
    assert run.event.to_numpy().tolist() == ["fallen"]
    assert float(run.time[-1]) == float(run.event_time[0])
    assert abs(float(run.q.sel(coordinate="lean")[-1])) == pytest.approx(1.0, abs=1e-9)


def test_mirrored_states_have_mirrored_accelerations(model: Any) -> Any:
    coordinates, rates = {"lean": 0.3, "steer": -0.4, "yaw": 0.2}, {"lean": 0.7, "steer": 1.1}
    one = ride(model, 3.0, coordinates, rates)
    other = ride(model, 3.0, {n: -v for n, v in coordinates.items()}, {n: -v for n, v in rates.items()})
    sign = np.array([1, -1, 1, -1, -1, 1, 1, -1, 1])  # x, y, z, yaw, lean, pitch, rear wheel, steer, front wheel
    np.testing.assert_allclose(accelerations(other).a, sign * accelerations(one).a, atol=1e-10)


def test_gravity_can_be_another(model: Any) -> Any:
    weightless = assemble(model, {"lean": 0.3}, {"gravity": 0.0})
    np.testing.assert_allclose(accelerations(weightless).a, 0.0, atol=1e-12)
    assert move(weightless, {"rear wheel": 1.0}).rate("rear wheel") == 1.0


def test_batches_are_refused() -> Any:
    with pytest.raises(InputError, match=r"trail: an array of shape \(2,\); the multibody engine takes one design"):
        coefficients(load_bicycle("benchmark").replace(trail=np.array([0.05, 0.08])))
    with pytest.raises(InputError, match="posture leaned needs a rider"):
        coefficients(load_bicycle("stratos"), None, "leaned")
