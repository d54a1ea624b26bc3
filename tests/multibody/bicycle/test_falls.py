"""Every ride ends with a reason: random bicycles, riders, speeds and pushes."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from singletrack import load_bicycle, load_rider
from singletrack.errors import SingletrackError
from singletrack.multibody import Pulse, bicycle_model, ride, simulate

VARIED = ("wheel_base", "trail", "steer_axis_tilt", "rear_frame_mass", "front_frame_mass")
REASONS = (
    "all times reached",
    "fell to the left",
    "fell to the right",
    "front wheel off the ground",
    "rear wheel off the ground",
    "front wheel lies flat",
    "right hand at the end of its reach",
    "left hand at the end of its reach",
)


def random_ride(rng: np.random.Generator) -> Any:
    """A state, and pushes on it; None where the rider drawn does not fit the bicycle."""
    name = rng.choice(["benchmark", "stratos", "browser"])
    bicycle = load_bicycle(name)
    bicycle = bicycle.replace(**{key: float(getattr(bicycle, key)) * rng.uniform(0.85, 1.15) for key in VARIED})
    rider, posture = None, "rigid"
    if name != "benchmark":
        posture, size = str(rng.choice(["rigid", "leaned", "upright"])), rng.uniform(0.95, 1.05)
        rider = load_rider("rider-a")
        lengths = {key: float(value) * size for key, value in dict(rider.values()).items() if key.endswith("_length")}
        rider = rider.replace(rider_mass=float(rider.rider_mass) * rng.uniform(0.7, 1.3), **lengths)
    speed, rates = rng.uniform(0.3, 9.0), 0.3 * rng.standard_normal(2)
    pushes = {
        "steer torque": Pulse(rng.uniform(0, 2), rng.uniform(0.05, 2), 4.0 * rng.standard_normal()),
        "lean torque": Pulse(rng.uniform(0, 2), rng.uniform(0.05, 0.5), 100.0 * rng.standard_normal()),
    }
    try:
        model = bicycle_model(bicycle, rider, posture)
        return ride(model, speed, rates=dict(zip(("lean", "steer"), rates, strict=True))), pushes
    except SingletrackError:
        return None


@pytest.mark.parametrize("seed", range(5))
def test_random_rides_end_with_a_reason(seed: int) -> None:
    rng, ridden = np.random.default_rng(seed), 0
    while ridden < 4:
        drawn = random_ride(rng)
        if drawn is None:
            continue
        ridden += 1
        # no more than 3000 steps: that bounds the time of computing, to less than two seconds
        run = simulate(drawn[0], np.linspace(0.0, 10.0, 101), drawn[1], rtol=1e-8, atol=1e-9, most_steps=3000)
        assert run.attrs["end"] in REASONS
        assert run.attrs["end_time"] == float(run.time[-1])
        early = run.attrs["end_time"] < 10.0
        assert early == (run.attrs["end"] != "all times reached")
        assert np.all(run.wheel_force.sel(component="normal") > -1e-6)
        assert np.all(abs(run.q.sel(coordinate="lean")) < np.radians(80.0) + 1e-9)


def test_an_upright_rider_pushed_hard_falls_and_it_is_said() -> None:
    model = bicycle_model(load_bicycle("browser"), load_rider("rider-a"), "upright")
    run = simulate(ride(model, 5.0), np.linspace(0.0, 10.0, 101), {"steer torque": Pulse(0.0, 2.0, 2.0)})
    assert run.attrs["end"] in REASONS[1:]
    assert 0.5 < run.attrs["end_time"] < 3.0


@pytest.mark.parametrize("push", [5.0, -5.0])
def test_a_hand_at_the_end_of_its_reach_ends_the_ride(push: float) -> None:
    # upright on the Browser the outer hand cannot follow beyond 0.40 rad of steer
    model = bicycle_model(load_bicycle("browser"), load_rider("rider-a"), "upright")
    run = simulate(ride(model, 0.3), np.linspace(0.0, 5.0, 101), {"steer torque": push})
    hand = "left hand" if push > 0 else "right hand"
    assert run.attrs["end"] == f"{hand} at the end of its reach"
    assert abs(float(run.q.sel(coordinate="steer")[-1])) == pytest.approx(0.40, abs=0.02)
    # without ends the arm folds over to the other side, where no arm goes
    on = simulate(
        ride(model, 0.3), np.linspace(0.0, run.attrs["end_time"] + 0.1, 51), {"steer torque": push}, ends=False
    )
    assert on.attrs["end"] == "all times reached"
