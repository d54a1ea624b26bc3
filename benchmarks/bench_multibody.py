"""How long the multibody engine takes: derivation, one evaluation of the accelerations, a ride of ten seconds.

Budgets on one core: build and linearise the upright rider in 1 s, nonlinear accelerations in 100 microseconds, ten
seconds of nonlinear riding in 2 s. Run with ``make benchmark`` or ``pytest benchmarks --benchmark-enable``.
"""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from singletrack import load_bicycle, load_rider
from singletrack.multibody import (
    GROUND,
    Body,
    System,
    assemble,
    bicycle,
    bicycle_model,
    build,
    coefficients,
    compile_equations,
    linearise,
    revolute,
    ride,
    simulate,
)
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
        bicycle.model._DERIVED.clear()  # noqa: SLF001  # else the second round has it already
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


def chain(count: int, kind: str) -> Any:
    """A chain of links with damped hinges: all about y, or about x and y in turn."""
    bodies, joints = [], []
    for i in range(count):
        axis = (0, 1, 0) if kind == "plane" or i % 2 else (1, 0, 0)
        bodies.append(Body(f"link {i}", 1.0, (0, 0, i + 0.5), (0.08, 0.07, 0.02)))
        parent = f"link {i - 1}" if i else GROUND
        joints.append(revolute(f"hinge {i}", parent, f"link {i}", (0, 0, i), axis, damping=0.1))
    return build(System(bodies, joints))


def same_chain_in_mujoco(mujoco: Any, count: int, kind: str) -> Any:
    inner = ""
    for i in reversed(range(count)):
        axis = "0 1 0" if kind == "plane" or i % 2 else "1 0 0"
        inner = (
            f'<body pos="0 0 {1 if i else 0}"><joint type="hinge" axis="{axis}" damping="0.1"/>'
            f'<inertial pos="0 0 0.5" mass="1" diaginertia="0.08 0.07 0.02"/>{inner}</body>'
        )
    options = '<option gravity="0 0 9.81"><flag contact="disable"/></option>'
    return mujoco.MjModel.from_xml_string(f"<mujoco>{options}<worldbody>{inner}</worldbody></mujoco>")


@pytest.mark.parametrize("way", ["interpreted", "compiled"])
@pytest.mark.parametrize("kind", ["plane", "space"])
@pytest.mark.parametrize("count", [20, 50, 100])
def test_chains_of_links(compare: Any, count: int, kind: str, way: str) -> None:
    """One evaluation of the accelerations, equal to 1e-9, beside MuJoCo's forward dynamics in the same run."""
    mujoco = pytest.importorskip("mujoco")
    rng = np.random.default_rng(count)
    q, u = 0.3 * rng.standard_normal(count), 0.5 * rng.standard_normal(count)
    if way == "compiled":
        compile_equations()
    try:
        model = chain(count, kind)
        evaluate = right_side(assemble(model, dict(zip(model.system.coordinates, q, strict=True))))
    finally:
        compile_equations(on=False)
    y = np.concatenate([q, u])
    theirs = same_chain_in_mujoco(mujoco, count, kind)
    data = mujoco.MjData(theirs)
    data.qpos[:], data.qvel[:] = q, u
    mujoco.mj_forward(theirs, data)
    ours = evaluate(0.0, y)[count:]
    np.testing.assert_allclose(ours, data.qacc, rtol=0, atol=1e-9 * np.max(abs(ours)))

    def many(work: Any, *arguments: Any) -> Any:
        return lambda: [work(*arguments) for _ in range(500)]

    compare(
        many(evaluate, 0.0, y),
        many(mujoco.mj_forward, theirs, data),
        names=(f"500 evaluations of a chain of {count} links, {kind}, {way}", "MuJoCo mj_forward"),
    )
