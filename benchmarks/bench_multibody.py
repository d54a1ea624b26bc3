"""How long the multibody engine takes: derivation, one evaluation of the accelerations, a ride of ten seconds.

Budgets on one core: build and linearise the upright rider in 1 s, nonlinear accelerations in 100 microseconds, ten
seconds of nonlinear riding in 2 s. Run with ``make benchmark`` or ``pytest benchmarks --benchmark-enable``.
"""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from singletrack import load_bicycle, load_rider
from singletrack.multibody import bicycle, bicycle_model, coefficients, linearise, ride, simulate
from singletrack.multibody.engine.evaluation import right_side

RIDES = {
    "benchmark": ("benchmark", None, "rigid"),
    "upright": ("browser", "rider-a", "upright"),
    "leaned": ("stratos", "rider-a", "leaned"),
}


def design(name: Any) -> Any:
    which, rider, posture = RIDES[name]
    return load_bicycle(which), rider and load_rider(rider), posture


@pytest.mark.parametrize("name", RIDES)
def test_derive_and_linearise(benchmark: Any, name: Any) -> Any:
    def work() -> Any:
        bicycle.KINDS.clear()
        return linearise(ride(bicycle_model(*design(name)), 5.0))

    assert benchmark(work).speeds == ("lean", "steer", "rear wheel")


@pytest.mark.parametrize("name", RIDES)
def test_coefficients_of_a_known_kind(benchmark: Any, name: Any) -> Any:
    arguments = design(name)
    coefficients(*arguments)
    assert benchmark(coefficients, *arguments).M.shape == (2, 2)


@pytest.mark.parametrize("name", RIDES)
def test_one_evaluation_of_the_accelerations(benchmark: Any, name: Any) -> Any:
    state = ride(bicycle_model(*design(name)), 5.0, {"lean": 0.1, "steer": 0.05}, {"lean": 0.3})
    evaluate = right_side(state)
    y = np.concatenate([state.q, state.u[list(state.partition.independent_speeds)]])
    assert np.all(np.isfinite(benchmark(evaluate, 0.0, y)))


KICKS = {"benchmark": (4.6, 0.5), "leaned": (6.5, 0.5), "upright": (6.5, 1e-5)}  # the upright rider capsizes soon


@pytest.mark.parametrize("name", RIDES)
def test_ten_seconds_of_riding(benchmark: Any, name: Any) -> Any:
    speed, kick = KICKS[name]
    start = ride(bicycle_model(*design(name)), speed, rates={"lean": kick})
    run = benchmark.pedantic(simulate, (start, np.linspace(0.0, 10.0, 1001)), rounds=3, warmup_rounds=1)
    energy = run.energy.to_numpy()
    assert np.max(abs(energy - energy[0])) < 1e-8 * abs(energy[0])
