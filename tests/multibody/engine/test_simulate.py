"""Simulation: inputs are never stepped over, events are found, constraints are kept."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from singletrack.multibody import (
    GROUND,
    Body,
    CoordinateForce,
    Event,
    Function,
    Pulse,
    Sampled,
    Sensor,
    System,
    assemble,
    build,
    close_point,
    move,
    prismatic,
    revolute,
    simulate,
)


@pytest.fixture(scope="module")
def cart() -> Any:
    """A mass of 2 kg on a rail, pushed by an input: nothing happens but what the input does."""
    slide = prismatic("slide", GROUND, "cart", (1, 0, 0))
    system = System(
        [Body("cart", 2.0)], [slide], inputs=[CoordinateForce("push", "slide")], sensors=[Sensor("place", "cart")]
    )
    return assemble(build(system))


@pytest.mark.parametrize("method", ["DOP853", "RK45", "Radau"])
@pytest.mark.parametrize(
    "pulse",
    [
        Pulse(8.0, 0.05, 10.0),
        Sampled([0.0, 8.0, 8.05], [0.0, 10.0, 0.0], hold=True),
        Function(lambda t: 10.0 if 8.0 <= t < 8.05 else 0.0, breaks=(8.0, 8.05)),
    ],
)
def test_a_short_pulse_is_felt_exactly(cart: Any, pulse: Any, method: Any) -> Any:
    run = simulate(cart, [0.0, 8.0, 8.05, 10.0], {"push": pulse}, method=method)
    assert run.u[:, 0].to_numpy() == pytest.approx([0.0, 0.0, 0.25, 0.25], abs=1e-9)
    assert run.q[-1, 0] == pytest.approx(0.25 * 0.025 + 0.25 * 1.95, rel=1e-9)
    assert run.sensor.to_numpy() == pytest.approx(run.q.to_numpy())


def test_a_pulse_in_a_plain_function_is_felt_too(cart: Any) -> Any:
    run = simulate(cart, [0.0, 10.0], {"push": lambda t: 10.0 * (8.0 <= t < 8.05)})
    assert run.u[-1, 0] == pytest.approx(0.25, rel=1e-6)


def test_sampled_data_are_linear_between_samples(cart: Any) -> Any:
    times = np.array([0.0, 0.3, 0.31, 2.0])
    values = np.array([1.0, -2.0, 4.0, 0.0])
    run = simulate(cart, [0.0, 2.0], {"push": Sampled(times, values)})
    assert run.u[-1, 0] == pytest.approx(np.trapezoid(values, times) / 2.0, rel=1e-12)


def test_a_constant_input_is_a_constant_force(cart: Any) -> Any:
    run = simulate(cart, np.linspace(0.0, 1.0, 5), {"push": 4.0})
    assert run.q[:, 0].to_numpy() == pytest.approx(np.linspace(0.0, 1.0, 5) ** 2)
    assert run.a[:, 0].to_numpy() == pytest.approx(2.0)
    assert run.input[:, 0].to_numpy() == pytest.approx(4.0)


def test_events_are_found_where_they_happen(cart: Any) -> Any:
    moving = move(cart, {"slide": 1.0})
    events = [
        Event("half", lambda _, state: state["slide"] - 0.5),
        Event("never back", lambda _, state: 0.25 - state["slide"], direction=1),
        Event("end", lambda time, _: time - 1.5, terminal=True),
    ]
    run = simulate(moving, np.linspace(0.0, 4.0, 5), events=events)
    assert run.event.to_numpy().tolist() == ["half", "end"]
    assert run.event_time.to_numpy() == pytest.approx([0.5, 1.5], abs=1e-12)
    assert run.time.to_numpy() == pytest.approx([0.0, 1.0, 1.5])  # and no further
    assert run.q[-1, 0] == pytest.approx(1.5)


def test_a_pendulum_has_its_period() -> Any:
    from scipy.special import ellipk

    bob = Body("bob", 1.0, (0, 0, 1))
    model = build(System([bob], [revolute("swing", GROUND, "bob", (0, 0, 0), (0, 1, 0))], gravity=1.0))
    amplitude = 2.5
    quarter = Event("down", lambda _, state: state["swing"], terminal=True)
    run = simulate(assemble(model, {"swing": amplitude}), [0.0, 10.0], events=[quarter])
    assert run.time[-1] == pytest.approx(ellipk(np.sin(amplitude / 2) ** 2), rel=1e-9)


def test_constraints_hold_and_energy_is_kept_for_long() -> Any:
    bodies = [Body("one", 1.0, (0, 0, 1)), Body("two", 2.0, (1, 0, 1)), Body("bar", 1.0, (0.5, 0, 1), (0, 0.1, 0.1))]
    joints = [
        revolute("a", GROUND, "one", (0, 0, 0), (0, 1, 0)),
        revolute("b", GROUND, "two", (1, 0, 0), (0, 1, 0)),
        revolute("c", "one", "bar", (0, 0, 1), (0, 1, 0)),
    ]
    loop = close_point("pin", "bar", "two", (1, 0, 1), normal=(0, 1, 0))
    state = move(assemble(build(System(bodies, joints, [loop])), {"a": 1.0}), {"a": 1.0})
    run = simulate(state, np.linspace(0.0, 20.0, 41))
    assert run.residual.max() < 1e-13
    np.testing.assert_allclose(run.energy.to_numpy(), float(run.energy[0]), rtol=0, atol=1e-7)
    # the pin's force on the second crank, by its own moment balance about the pivot
    angle, turn = run.q.sel(coordinate="b").to_numpy(), run.a.sel(coordinate="b").to_numpy()
    force = run.loop_force.sel(loop="pin").to_numpy()
    moment = np.cos(angle) * force[:, 0] - np.sin(angle) * force[:, 2]
    np.testing.assert_allclose(moment, 2.0 * turn + 2.0 * 9.81 * np.sin(angle), atol=1e-9)
