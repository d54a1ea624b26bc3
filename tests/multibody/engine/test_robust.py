"""Odd machines and odd numbers: each works, or is refused by name."""

from __future__ import annotations

import pickle
from typing import Any

import numpy as np
import pytest

from singletrack import load_bicycle, load_rider
from singletrack.errors import ModelError
from singletrack.multibody import (
    GROUND,
    Body,
    Force,
    Sensor,
    Spring,
    System,
    Torque,
    Wheel,
    accelerations,
    assemble,
    bicycle_model,
    build,
    close_distance,
    close_point,
    free,
    linearise,
    move,
    parameter,
    prismatic,
    revolute,
    ride,
    simulate,
    steady_motion,
)

ORIGIN, Y = (0, 0, 0), (0, 1, 0)


def pendulum(**more: Any) -> Any:
    return build(System([Body("bob", 1.0, (0, 0, 1))], [revolute("swing", GROUND, "bob", ORIGIN, Y)], **more))


@pytest.mark.parametrize("ratio", [1e8, 1e13, 1e16])
def test_a_stiff_spring_elsewhere_does_not_hide_a_soft_mode(ratio: float) -> None:
    bodies = [Body("one", 1.0, (0, 0, 1)), Body("two", 1.0, (0, 0, 1))]
    joints = [
        revolute("soft", GROUND, "one", ORIGIN, Y, stiffness=1e-3),
        revolute("stiff", GROUND, "two", ORIGIN, Y, stiffness=1e-3 * ratio),
    ]
    small = linearise(assemble(build(System(bodies, joints, gravity=0.0))))
    assert small.coordinates == ("soft", "stiff")
    frequencies = np.sort(abs(small.eigenvalues()))[::2]
    assert frequencies == pytest.approx(np.sqrt([1e-3, 1e-3 * ratio]), rel=1e-12)


def test_units_do_not_decide_what_matters() -> None:
    # a heavy weight on a soft seat post beside a pendulum of a few grams
    bodies = [Body("truck", 1e6, ORIGIN), Body("bob", 1e-3, (0, 0, 1e-3))]
    joints = [
        prismatic("post", GROUND, "truck", (0, 0, 1), stiffness=1e9),
        prismatic("away", GROUND, "bob", (1, 0, 0)),
    ]
    small = linearise(assemble(build(System(bodies, joints, gravity=0.0))))
    assert small.coordinates == ("post",)  # where the bob is along its rail matters to nothing


@pytest.mark.parametrize("far", [30.0, 1e4])
def test_far_from_the_origin_nothing_changes(far: float) -> None:
    model = bicycle_model(load_bicycle("browser"), load_rider("rider-a"), "upright")
    here, there = (linearise(ride(model, 5.0, {"x": place, "y": -place, "yaw": 0.7})) for place in (0.0, far))
    assert here.coordinates == there.coordinates == ("lean", "steer")
    np.testing.assert_allclose(there.K, here.K, rtol=1e-11, atol=1e-9)
    np.testing.assert_allclose(there.eigenvalues(), here.eigenvalues(), rtol=1e-8, atol=1e-9)


def test_directions_have_length_one() -> None:
    twice = pendulum(
        down=(0, 0, 2),
        inputs=[Force("push", "bob", (0, 0, 1), (3, 0, 0)), Torque("turn", "bob", (0, 5, 0))],
        sensors=[Sensor("place", "bob", (0, 0, 1), (7, 0, 0))],
    )
    state = assemble(twice, {"swing": 0.3})
    assert accelerations(state).a == pytest.approx([-9.81 * np.sin(0.3)])
    level = assemble(twice)
    assert accelerations(level, {"push": 1.0}).a == pytest.approx([1.0])
    assert accelerations(level, {"turn": 1.0}).a == pytest.approx([1.0])
    assert linearise(level, outputs=["place"]).C_matrix[0, 0] == pytest.approx(1.0)
    for make in (
        lambda: pendulum(down=ORIGIN),
        lambda: Force("push", "bob", ORIGIN, ORIGIN),
        lambda: Torque("turn", "bob", ORIGIN),
        lambda: Sensor("place", "bob", direction=ORIGIN),
    ):
        with pytest.raises(ModelError, match="its length is zero"):
            make()


def test_what_is_no_number_is_refused_by_name() -> None:
    model = pendulum()
    state = assemble(model)
    for ask, message in (
        (lambda: assemble(model, {"swing": np.nan}), "coordinate swing: nan"),
        (lambda: assemble(model, {"swing": "much"}), "coordinate swing: 'much'"),  # type: ignore[dict-item]
        (lambda: move(state, {"swing": np.inf}), "rate swing: inf"),
        (lambda: assemble(model, parameters={"gravity": np.nan}), "parameter gravity: nan"),
        (lambda: steady_motion(model, {"swing": np.nan}, resting=["swing"]), "coordinate swing: nan"),
        (lambda: Spring("s", "a", "b", ORIGIN, Y, np.nan), "spring s: stiffness is nan"),
        (lambda: Spring("s", "a", "b", (0, np.nan, 0), Y, 1.0), "spring s: first point is nan"),
        (lambda: parameter("gravity"), "parameter gravity: the name is taken"),
    ):
        with pytest.raises(ModelError, match=message):
            ask()


def test_a_spring_whose_ends_meet() -> None:
    linear = Spring("s", GROUND, "bob", (0, 0, 1), (0, 0, 1), 10.0)
    assert pytest.approx(np.array([[19.81]])) == linearise(assemble(pendulum(springs=[linear]))).K
    run = simulate(assemble(pendulum(springs=[linear]), {"swing": 0.1}), np.linspace(0.0, 3.0, 31))
    np.testing.assert_allclose(run.energy, float(run.energy[0]), rtol=0, atol=1e-9)
    for more in ({"rest": 0.1}, {"damping": 1.0}, {"preload": 1.0}):
        bent = Spring("s", GROUND, "bob", (0, 0, 1), (0, 0, 1), 10.0, **more)
        with pytest.raises(ModelError, match="spring s: its ends meet here"):
            assemble(pendulum(springs=[bent]))
    rod = close_distance("rod", GROUND, "bob", ((0, 0, 1), (0, 0, 1)), 0.5)
    with pytest.raises(ModelError, match="loop rod: its ends meet here"):
        assemble(pendulum(closures=[rod]))


def test_a_vertical_axle_is_refused_by_name() -> None:
    wheel = Wheel("rim", "disc", (0, 0, -0.3), 0.3, axle=(0, 0, 1))
    system = System([Body("disc", 1.0, (0, 0, -0.3), (0.1, 0.2, 0.1))], [free("j", GROUND, "disc")], wheels=[wheel])
    with pytest.raises(ModelError, match="wheel rim: its axle is vertical here"):
        assemble(build(system))


def test_a_machine_without_freedoms_rests() -> None:
    pin = close_point("pin", "bob", GROUND, (0, 0, 1), normal=Y)
    state = assemble(pendulum(closures=[pin], down=(1, 0, 0)))
    assert state.freedoms == ()
    small = linearise(state)
    assert small.eigenvalues().size == 0
    assert small.M.shape == (0, 0)
    for method in ("DOP853", "Radau"):
        run = simulate(state, [0.0, 1.0], method=method)
        assert run.attrs["end"] == "all times reached"
        # the pin keeps the bob from falling sideways
        assert run.loop_force[-1, 0].to_numpy() == pytest.approx([9.81, 0.0, 0.0], abs=1e-12)


@pytest.mark.parametrize("who", [None, "rider-a"])
def test_states_and_results_pickle(who: str | None) -> None:
    name, posture = ("browser", "upright") if who else ("benchmark", "rigid")
    state = ride(bicycle_model(load_bicycle(name), who and load_rider(who), posture), 5.0, {"lean": 0.1})
    again = pickle.loads(pickle.dumps(state))  # noqa: S301
    np.testing.assert_array_equal(accelerations(again).a, accelerations(state).a)
    upright = linearise(ride(state.model, 5.0))
    small = pickle.loads(pickle.dumps(upright))  # noqa: S301
    np.testing.assert_array_equal(small.A_matrix, upright.A_matrix)
    assert small.state["lean"] == 0.0
    run = simulate(again, [0.0, 0.1])
    same = pickle.loads(pickle.dumps(run))  # noqa: S301
    assert same.identical(run)
    assert same.attrs == run.attrs
