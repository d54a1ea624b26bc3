"""A simulation says how it ended: limits, wheels that lift, steps used up, and events that happen twice in a step."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from singletrack.errors import ModelError
from singletrack.multibody import (
    GROUND,
    Body,
    CoordinateForce,
    Event,
    Limit,
    Reach,
    System,
    Wheel,
    assemble,
    build,
    close_point,
    free,
    move,
    prismatic,
    revolute,
    simulate,
)

Y = (0, 1, 0)
ORIGIN = (0, 0, 0)


def cart(**more: Any) -> Any:
    slide = prismatic("slide", GROUND, "cart", (1, 0, 0))
    return build(System([Body("cart", 2.0)], [slide], inputs=[CoordinateForce("push", "slide")], **more))


@pytest.mark.parametrize("height", [0.5, 0.99, 0.9999])
def test_two_passages_within_one_step_are_found(height: float) -> None:
    # thrown with 2 m/s against 2 m/s^2: at the height h after 1 -+ sqrt(1 - h) s; one step of the integrator
    thrown = move(assemble(cart()), {"slide": 2.0})
    run = simulate(thrown, [0.0, 3.0], {"push": -4.0}, events=[Event("there", lambda _, s: s["slide"] - height)])
    half = np.sqrt(1.0 - height)
    assert run.event_time.to_numpy() == pytest.approx([1.0 - half, 1.0 + half], abs=1e-9)


def test_a_dip_that_does_not_reach_is_no_passage() -> None:
    thrown = move(assemble(cart()), {"slide": 2.0})
    event = Event("there", lambda _, state: state["slide"] - 1.0001)
    assert simulate(thrown, [0.0, 3.0], {"push": -4.0}, events=[event]).event.size == 0


def test_of_two_passages_in_a_step_the_terminal_one_ends_the_run() -> None:
    thrown = move(assemble(cart()), {"slide": 2.0})
    event = Event("there", lambda _, state: state["slide"] - 0.9999, terminal=True, direction=-1)
    run = simulate(thrown, [0.0, 3.0], {"push": -4.0}, events=[event])
    assert run.attrs["end_time"] == pytest.approx(1.01, abs=1e-9)
    assert run.attrs["end"] == "there"


def test_a_limit_ends_the_run_and_is_said() -> None:
    bob = Body("bob", 1.0, (0, 0, -1))
    swing = revolute("swing", GROUND, "bob", ORIGIN, Y)
    limits = [Limit("swing", -1.0, 0.5, above="hit the stop")]
    model = build(System([bob], [swing], limits=limits))
    for push, said, angle in ((0.1, "hit the stop", 0.5), (-0.1, "swing at its lower limit", -1.0)):
        run = simulate(move(assemble(model), {"swing": push}), np.linspace(0.0, 20.0, 201))
        assert run.attrs["end"] == said
        assert run.event.to_numpy().tolist() == [said]
        assert float(run.q[-1, 0]) == pytest.approx(angle, abs=1e-9)
        assert run.attrs["end_time"] == float(run.time[-1]) < 20.0
    on = simulate(move(assemble(model), {"swing": 0.1}), [0.0, 20.0], ends=False)
    assert on.attrs == {"end": "all times reached", "end_time": 20.0}
    begun_beyond = simulate(assemble(model, {"swing": 0.7}), [0.0, 1.0])
    assert begun_beyond.attrs == {"end": "hit the stop", "end_time": 0.0}


def test_an_arm_at_the_end_of_its_reach() -> None:
    # a two-link arm that pulls a slider: stretched, it cannot follow, and would fold over to the other side
    bodies = [Body("upper", 1.0, (0, 0, 0.5)), Body("lower", 1.0, (0.3, 0, 1.0)), Body("grip", 1.0)]
    joints = [
        revolute("shoulder", GROUND, "upper", ORIGIN, Y),
        revolute("elbow", "upper", "lower", (0, 0, 1), Y),
        prismatic("slide", GROUND, "grip", (1, 0, 0)),
    ]
    hand = close_point("hand", "lower", "grip", (0.6, 0, 1), normal=Y)
    limits = [Reach(("hand",), ("shoulder", "elbow"))]
    system = System(bodies, joints, [hand], gravity=0.0, independent=("slide",), limits=limits)
    run = simulate(move(assemble(build(system)), {"slide": 1.0}), np.linspace(0.0, 5.0, 51))
    assert run.attrs["end"] == "hand at the end of its reach"
    # stretched, the arm of 1 + 0.6 m reaches to x = sqrt(1.6^2 - 1) at the height of the hand
    assert float(run.q.sel(coordinate="slide")[-1]) == pytest.approx(np.sqrt(1.6**2 - 1.0) - 0.6, abs=1e-6)


def test_a_wheel_that_is_thrown_up_leaves_the_ground() -> None:
    """A hoop with its centre of mass off its axle hops when that goes over the top fast enough."""
    hoop = Body("hoop", 4.0, (0, 0, -0.7), (0.5, 1.0, 0.5))
    joint = free("j", GROUND, "hoop", (0, 0, -1), coordinates=("x", "y", "z", "yaw", "lean", "spin"))
    model = build(System([hoop], [joint], wheels=[Wheel("rim", "hoop", (0, 0, -1), 1.0)]))
    times = np.linspace(0.0, 2.0, 101)
    slow = simulate(move(assemble(model), {"spin": -3.0}), times)
    assert slow.attrs["end"] == "all times reached"
    run = simulate(move(assemble(model), {"spin": -12.0}), times)
    assert run.attrs["end"] == "rim off the ground"
    assert float(run.wheel_force.sel(wheel="rim", component="normal")[-1]) == pytest.approx(0.0, abs=1e-7)
    assert np.all(run.wheel_force.sel(component="normal")[:-1] > 0.0)
    # by hand: 0.3 m above the axle the centre of mass falls freely, height 1 - 0.3 cos(spin)
    spin, rate, change = (float(run[name].sel(coordinate="spin")[-1]) for name in ("q", "u", "a"))
    assert 0.3 * (np.cos(spin) * rate**2 + np.sin(spin) * change) == pytest.approx(-9.81, abs=1e-7)


def test_steps_are_bounded_and_what_is_wrong_is_said() -> None:
    pushed = assemble(cart())
    with pytest.raises(ModelError, match=r"gave up at t = .*all steps used up"):
        simulate(pushed, [0.0, 10.0], {"push": np.sin}, most_steps=20)
    run = simulate(pushed, np.linspace(0.0, 10.0, 101), {"push": np.sin}, most_steps=20, trouble="end")
    assert run.attrs["end"].startswith("gave up")
    assert run.attrs["end_time"] == float(run.time[-1]) < 10.0
    with pytest.raises(ModelError, match=r"cannot go on at t = 0\.[5-9]"):
        simulate(pushed, [0.0, 2.0], {"push": lambda t: np.nan if t > 0.55 else 1.0})


def test_nonsense_is_refused() -> None:
    state = assemble(cart())
    for wrong, message in (
        ({"method": "Euler"}, "unknown method 'Euler'"),
        ({"singular": "jump"}, "unknown way with singular positions 'jump'"),
        ({"trouble": "ignore"}, "unknown way with trouble 'ignore'"),
    ):
        with pytest.raises(ModelError, match=message):
            simulate(state, [0.0, 1.0], **wrong)  # type: ignore[arg-type]
    with pytest.raises(ModelError, match="times: at least two, increasing"):
        simulate(state, [0.0, np.nan])
    with pytest.raises(ModelError, match=r"limit of slide: low 1 must lie below high 0"):
        Limit("slide", 1.0, 0.0)
    with pytest.raises(ModelError, match="limit: unknown coordinate 'slid'; did you mean slide"):
        cart(limits=[Limit("slid", 0.0, 1.0)])
    with pytest.raises(ModelError, match="limit: unknown loop 'hand'"):
        cart(limits=[Reach(("hand",), ("slide",))])


def test_progress_is_told() -> None:
    told: list[float] = []
    simulate(assemble(cart()), [0.0, 1.0], {"push": np.sin}, progress=told.append)
    assert told == sorted(told)
    assert told[-1] == 1.0
