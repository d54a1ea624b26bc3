"""Sampled feedback in the nonlinear ride against the linear model, sampled exactly."""

from __future__ import annotations

import numpy as np
import pytest

from singletrack import InputError, coefficients, load_bicycle
from singletrack.control import discretised
from singletrack.errors import ModelError
from singletrack.multibody import Pulse, bicycle_model, ride, simulate
from singletrack.parameters import Feedback
from singletrack.public.riding import ride_for

SPEED, PERIOD, PUSH = 4.0, 0.02, 1e-4
GAINS = {("steer torque", "lean rate"): 8.0, ("steer torque", "steer rate"): -1.0, ("lean torque", "lean"): -3.0}


def sampled(feedback, count, push=PUSH):
    """Return lean, steer and their rates at the samples: linear, torques held, bounded, whole periods late."""
    system = coefficients(load_bicycle("benchmark")).state_space(SPEED)
    F, G, _ = discretised(system, PERIOD)
    K = np.zeros((len(system.inputs), len(system.states)))
    for (target, signal), gain in feedback.gains.items():
        K[system.inputs.index(target), system.states.index(signal)] = gain
    late = round(feedback.delay / PERIOD)
    x, states, commands = np.eye(4)[system.states.index("lean rate")] * push, [], [np.zeros(2)] * late
    for _ in range(count):
        states.append(x)
        commands.append(np.clip(K @ x, -feedback.limit, feedback.limit))
        x = F @ x + G @ commands[len(states) - 1]
    return np.array(states), system.states


@pytest.mark.parametrize("more", [{}, {"delay": 3 * PERIOD}, {"limit": 2e-4}, {"delay": PERIOD, "limit": 3e-4}])
def test_small_rides_are_the_linear_model_sampled(more):
    feedback = Feedback(GAINS, period=PERIOD, **more)
    expected, names = sampled(feedback, 51)
    start = ride(bicycle_model(load_bicycle("benchmark")), SPEED, rates={"lean": PUSH})
    run = simulate(start, PERIOD * np.arange(51), feedback=feedback)
    for name in ("lean", "steer"):
        found = run.q.sel(coordinate=name).to_numpy()
        np.testing.assert_allclose(found, expected[:, names.index(name)], atol=1e-5 * abs(found).max())
    torque = run.input.sel(input_name="steer torque").to_numpy()
    assert abs(torque).max() <= feedback.limit
    assert abs(torque).max() > 1e-4


def test_a_delay_between_two_samples_is_between_the_rides_of_its_neighbours():
    start = ride(bicycle_model(load_bicycle("benchmark")), SPEED, rates={"lean": PUSH})

    def lean(delay):
        run = simulate(start, np.linspace(0, 1, 11), feedback=Feedback(GAINS, period=PERIOD, delay=delay))
        return float(run.q.sel(coordinate="lean")[-1])

    early, middle, late = (lean(k * PERIOD) for k in (1.0, 1.5, 2.0))
    assert min(early, late) < middle < max(early, late)


def test_feedback_adds_to_what_is_given_and_says_so_in_the_results():
    start = ride(bicycle_model(load_bicycle("benchmark")), SPEED)
    feedback = Feedback({("steer torque", "lean"): 5.0}, period=PERIOD, limit=0.01)
    run = simulate(start, np.linspace(0, 0.5, 51), {"steer torque": Pulse(0.0, 0.1, 1.0)}, feedback=feedback)
    torque = run.input.sel(input_name="steer torque").to_numpy()
    assert torque[0] == 1.0
    assert abs(torque[20:]).max() == pytest.approx(0.01)


def test_feedback_keeps_a_falling_bicycle_up_and_its_delay_throws_it_down():
    bicycle, gains = load_bicycle("benchmark"), {("steer torque", "lean rate"): 12.0}
    ride_of = {"speed": 3.0, "push": 0.3, "duration": 5.0}
    assert not ride_for(bicycle, **ride_of).whole
    assert ride_for(bicycle, feedback=Feedback(gains), **ride_of).whole
    assert not ride_for(bicycle, feedback=Feedback(gains, delay=0.4), **ride_of).whole


@pytest.mark.parametrize(
    ("gains", "words"),
    [
        ({("steer torqe", "lean"): 1.0}, "unknown input 'steer torqe'"),
        ({("steer torque", "leen"): 1.0}, "unknown signal 'leen'"),
        ({("steer torque", "lean"): [1.0, 2.0]}, "must be a number"),
    ],
)
def test_unknown_names_and_gains_that_depend_on_speed_are_refused(gains, words):
    start = ride(bicycle_model(load_bicycle("benchmark")), SPEED)
    with pytest.raises(ModelError, match=words):
        simulate(start, [0.0, 1.0], feedback=Feedback(gains))


@pytest.mark.parametrize(
    ("values", "words"),
    [
        ({"limit": 0.0}, "limit = 0.0, must be greater than zero"),
        ({"delay": -0.1}, "delay = -0.1, must be finite, zero or greater"),
        ({"period": 1e-9}, "period = 1e-09, must be at least 0.0001 s"),
        ({"gains": {("steer torque", "lean"): float("nan")}}, "must be finite"),
        ({"gains": {("steer torque", "lean"): 1e300}}, "must be finite numbers from"),
        ({"gains": {("steer torque", "lean"): []}}, "one or more"),
    ],
)
def test_what_no_controller_has_is_refused(values, words):
    with pytest.raises(InputError, match=words):
        Feedback(**values)
