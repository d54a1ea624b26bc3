"""Effort against other derivations: Riccati, python-control, long simulations, 50 digits."""

from __future__ import annotations

import mpmath
import numpy as np
import pytest
import scipy.linalg

from singletrack import InputError, coefficients, load_bicycle, load_rider
from singletrack.control import (
    Weights,
    closed_loop,
    discretised,
    effort,
    frequency_response,
    gramian,
    impulse_response,
    lateral_force,
    least_energy,
    lqr_schedule,
    response,
    save_mat,
    step_response,
    with_ground,
    with_inputs,
    with_path,
)
from singletrack.control.effort import PUSH, feedback_gain
from singletrack.linear import critical_speeds, eigenvalues


@pytest.fixture(scope="module")
def model():
    return coefficients(load_bicycle("stratos"), load_rider("rider-a"), "leaned")


@pytest.mark.parametrize("speed", [1.0, 3.0, 5.0])
def test_least_energy_is_the_limit_of_the_riccati_equation(model, speed):
    system = model.state_space(speed)
    b = system.B[:, [1]]
    start = np.array([0.0, 0.0, PUSH, 0.0])
    costs = []
    for weight in (1e-4, 1e-5):
        X = scipy.linalg.solve_continuous_are(system.A, b, weight * np.eye(4), np.eye(1))
        costs.append(start @ X @ start)
    limit = costs[1] + (costs[1] - costs[0]) / 9  # linear in the weight
    assert least_energy(system.A, b, start) == pytest.approx(limit, rel=1e-3)


def test_lqr_against_python_control(model):
    control = pytest.importorskip("control")
    system = model.state_space(4.0)
    b, weights = system.B[:, [1]], Weights()
    Q = np.diag([weights.angle**-2] * 2 + [weights.rate**-2] * 2)
    K, X, _ = control.lqr(system.A, b, Q, np.eye(1))
    gain, cost = feedback_gain(system.A, b, weights)
    np.testing.assert_allclose(gain, K, rtol=1e-8)
    np.testing.assert_allclose(cost, X, rtol=1e-8)
    np.testing.assert_allclose(lqr_schedule(model, [4.0])[0], K[0], rtol=1e-8)


def test_push_norm_and_largest_torque_against_a_long_simulation(model):
    found = effort(model, [4.0])
    system = model.state_space(4.0)
    gain, _ = feedback_gain(system.A, system.B[:, [1]], Weights())
    closed = system.A - system.B[:, [1]] @ gain
    step, state = 1e-3, system.B[:, 0].copy()
    F = scipy.linalg.expm(closed * step)
    torques = []
    for _ in range(20_000):
        torques.append(float((gain @ state).item()))
        state = F @ state
    energy = np.trapezoid(np.square(torques), dx=step)
    assert found.push_norm[0] == pytest.approx(np.sqrt(energy), rel=1e-4)
    pushed = np.array([0.0, 0.0, PUSH, 0.0])
    series = [abs(float((gain @ np.linalg.matrix_power(F, k) @ pushed).item())) for k in range(0, 2000, 5)]
    assert found.largest_torque[0] == pytest.approx(max(series), rel=5e-3)


def test_a_stable_bicycle_needs_no_energy_and_an_unreached_one_cannot(model):
    assert effort(model, [7.0]).least_energy[0] == 0.0
    A = np.diag([1.0, -1.0])
    assert least_energy(A, np.array([[0.0], [1.0]]), np.array([1.0, 0.0])) == np.inf
    with pytest.raises(InputError, match="unknown input"):
        effort(model, [7.0], "torso torque")


def test_the_gramian_gives_the_least_energy(model):
    system = model.state_space(3.0)
    W = gramian(system, "steer torque")
    assert np.allclose(W, W.T)
    assert np.linalg.eigvalsh(W)[0] > 0


@pytest.mark.parametrize("hold", ["zero", "first"])
def test_discretisation_against_50_digits(model, hold):
    system, step = model.state_space(5.0), 0.05
    F, G0, G1 = discretised(system, step, hold=hold)
    with mpmath.workdps(50):
        A, B = mpmath.matrix(system.A.tolist()), mpmath.matrix(system.B.tolist())
        exact = mpmath.expm(A * step)
        inverse = A**-1
        first = inverse * (exact - mpmath.eye(4)) * B
        ramp = inverse * (first - step * B) / step
    assert np.abs(F - np.array(exact.tolist(), dtype=float)).max() < 1e-12
    held = first if hold == "zero" else first - ramp
    assert np.abs(G0 - np.array(held.tolist(), dtype=float)).max() < 1e-12
    assert np.abs(G1 - (0 if hold == "zero" else np.array(ramp.tolist(), dtype=float))).max() < 1e-12


def test_batches_and_labels(model):
    systems = model.state_space([3.0, 6.0])
    time = np.linspace(0, 1, 101)
    found = response(systems, time, start=[0, 0, 0.1, 0])
    alone = response(model.state_space(6.0), time, start=[0, 0, 0.1, 0])
    np.testing.assert_allclose(found["lean"].sel(speed=6.0), alone["lean"], rtol=1e-12)
    step = step_response(model.state_space(7.0), time, "steer torque")
    impulse = impulse_response(model.state_space(7.0), time, "steer torque")
    slope = np.gradient(step["lean"].values, time)
    np.testing.assert_allclose(slope[2:-2], impulse["lean"].values[2:-2], atol=2e-4)
    with pytest.raises(InputError, match="evenly spaced"):
        response(systems, [0.0, 0.1, 0.3])


def test_frequency_response_is_the_transfer_function(model):
    system = model.state_space(7.0)
    at = frequency_response(system, [2.0])
    direct = np.linalg.solve(2j * np.eye(4) - system.A, system.B)
    np.testing.assert_allclose(at.sel(frequency=2.0).values, direct, rtol=1e-12)


def test_feedback_is_a_model_again(model):
    gain, speed = 3.0, 4.0
    helped = closed_loop(model, {("steer torque", "lean rate"): [gain * 5.0, -gain], ("steer torque", "lean"): 2.0})
    system = model.state_space(speed)
    feedback = np.zeros((2, 4))
    feedback[1, 2], feedback[1, 0] = gain * (5.0 - speed), 2.0
    expected = np.sort_complex(np.linalg.eigvals(system.A + system.B @ feedback))
    np.testing.assert_allclose(np.sort_complex(eigenvalues(helped, speed)[0]), expected, rtol=1e-9)
    assert critical_speeds(helped).weave != critical_speeds(model).weave
    for wrong in ({("steer torque", "lean rate"): [1, 1, 1]}, {("steer torque", "roll"): 1.0}, {("bar", "lean"): 1.0}):
        with pytest.raises(InputError):
            closed_loop(model, wrong)


def test_forces_do_the_work_that_the_engine_says():
    """A force at the hip of the rigid rider: lean torque by its height, steer torque by what trail yaws the frame."""
    bicycle, rider = load_bicycle("stratos"), load_rider("rider-a")
    column = lateral_force(bicycle, "hip centre", rider, "rigid")
    x, z = 0.2677, -0.942
    mu = bicycle.trail * np.cos(bicycle.steer_axis_tilt) / bicycle.wheel_base
    np.testing.assert_allclose(column, [-z, mu * x], atol=1e-4)
    np.testing.assert_allclose(lateral_force(bicycle, (x, z)), [-z, mu * x])
    model = with_inputs(coefficients(bicycle, rider), {"saddle force": column})
    assert model.state_space(5.0).inputs[-1] == "saddle force"
    with pytest.raises(InputError, match="is there already"):
        with_inputs(model, {"saddle force": column})


def test_ground_that_accelerates_is_gravity_tipped_over():
    """Static equivalence: constant ground acceleration a acts like gravity turned by a / g about the x axis."""
    model = with_ground(coefficients(load_bicycle("benchmark")))
    np.testing.assert_array_equal(model.B[:, 2], model.K0[0])


def test_the_path_follows_from_steer(model):
    bicycle = load_bicycle("stratos")
    system = with_path(coefficients(bicycle, load_rider("rider-a"), "leaned").state_space(7.0), bicycle)
    assert system.C.shape == (7, 6)
    found = response(system, np.linspace(0, 2, 2001), start=[0, 0.05, 0, 0, 0, 0])
    yaw, y = found["yaw"].values, found["rear contact y"].values
    np.testing.assert_allclose(np.gradient(y, 1e-3)[5:-5], 7.0 * yaw[5:-5], atol=1e-4)


def test_matlab_reads_the_file(model, tmp_path):
    import scipy.io

    system = model.state_space([3.0, 6.0])
    save_mat(system, tmp_path / "a.mat")
    found = scipy.io.loadmat(tmp_path / "a.mat")
    np.testing.assert_array_equal(found["A"][:, :, 1], system.A[1])
    assert [str(name[0]) for name in found["states"].ravel()] == list(system.states)
