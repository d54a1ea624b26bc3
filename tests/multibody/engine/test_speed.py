"""The fast ways to the accelerations give what the plain ones give: trees, eliminations by hand, compiled code."""

from __future__ import annotations

import shutil
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from singletrack import load_bicycle, load_rider
from singletrack.errors import ModelError
from singletrack.multibody import (
    GROUND,
    Body,
    CoordinateForce,
    Joint,
    Motion,
    Spring,
    System,
    accelerations,
    assemble,
    bicycle_model,
    build,
    compile_equations,
    move,
    parameter,
    revolute,
    ride,
    simulate,
)
from singletrack.multibody.engine import kept
from singletrack.multibody.engine.dynamics import _reduced_numerically, reduced
from singletrack.multibody.engine.reduction import pivot_growth, reduced_expression


def tree(seed: int, count: int = 9) -> Any:
    """A random tree with composite joints, springs, a parameter and an input, in a random state."""
    rng = np.random.default_rng(seed)
    bodies, joints, names = [], [], [GROUND]
    for i in range(count):
        axes = rng.standard_normal((3, 3))
        inertia = axes @ axes.T
        inertia = np.trace(inertia) * np.eye(3) - inertia
        I = inertia
        six = (I[0, 0], I[1, 1], I[2, 2], I[0, 1], I[1, 2], I[0, 2])
        mass = parameter("load") if i == 4 else rng.uniform(0.5, 2.0)
        bodies.append(Body(f"b{i}", mass, rng.standard_normal(3), six))
        kinds = rng.integers(0, 2, rng.integers(1, 4))
        motions = [
            Motion(
                f"q{i}.{k}", rotates=bool(kind), axis=rng.standard_normal(3), stiffness=rng.uniform(0, 5), damping=0.1
            )
            for k, kind in enumerate(kinds)
        ]
        joints.append(
            Joint(f"j{i}", names[rng.integers(0, len(names))], f"b{i}", rng.standard_normal(3), tuple(motions))
        )
        names.append(f"b{i}")
    springs = [Spring("s", "b2", "b7", (0, 0, 1), (1, 0, 0), 3.0, 0.2, 0.5)]
    system = System(bodies, joints, springs=springs, inputs=[CoordinateForce("f", "q3.0")], parameters={"load": 1.3})
    model = build(system)
    n = len(system.coordinates)
    q, u = 0.5 * rng.standard_normal(n), rng.standard_normal(n)
    return replace(assemble(model), q=q, u=u)


@pytest.mark.parametrize("seed", range(4))
def test_a_tree_by_articulated_bodies_obeys_its_equations(seed: int) -> None:
    state = tree(seed)
    p, n = state.parameters, len(state.q)
    a = accelerations(state, {"f": 2.0}).a
    mass = state.model.kinetics(state.q, p)[1]
    h = state.model.equations.bias(state.q, state.u, [2.0], p)[0].full().ravel()
    np.testing.assert_allclose(mass @ a, -h, atol=1e-10 * np.max(abs(h)))
    assert reduced(state.model, state.partition).name() == "tree"
    sizes = n, 1, 0
    by_hand = reduced_expression(state.model.equations, state.partition, sizes)(state.q, state.u, [2.0], p)
    np.testing.assert_allclose(by_hand[1].full().ravel(), a, rtol=1e-8, atol=1e-9 * np.max(abs(a)))
    assert np.all(np.linalg.eigvalsh(mass) > 0.0)


@pytest.mark.parametrize(("name", "posture"), [("benchmark", "rigid"), ("stratos", "leaned"), ("browser", "upright")])
def test_elimination_by_hand_is_the_solvers(name: str, posture: str) -> None:
    model = bicycle_model(load_bicycle(name), None if posture == "rigid" else load_rider("rider-a"), posture)
    state = ride(model, 5.0, {"lean": 0.2, "steer": -0.1}, {"lean": 0.5, "steer": 0.3})
    u_i, f = state.u[list(state.partition.independent_speeds)], np.array([1.0, -2.0, 0.5])
    by_hand = reduced(model, state.partition)(state.q, u_i, f, state.parameters)
    by_solver = _reduced_numerically(model, state.partition)(state.q, u_i, f, state.parameters)
    for one, other in zip(by_hand, by_solver, strict=True):
        np.testing.assert_allclose(one.full(), other.full(), rtol=1e-10, atol=1e-10 * np.max(abs(other.full())))


def test_pivots_that_are_no_good_are_told() -> None:
    good, bad = np.array([[2.0, 1.0], [1.0, 3.0]]), np.array([[1e-9, 1.0], [1.0, 1.0]])
    assert pivot_growth(good) < 2.0
    assert pivot_growth(bad) > 1e8
    assert pivot_growth(np.array([[0.0, 1.0], [1.0, 0.0]])) == np.inf
    # with the rows in the order of partial pivoting growth is small whatever the state
    state = ride(bicycle_model(load_bicycle("browser"), load_rider("rider-a"), "upright"), 3.0, {"lean": 0.4})
    jacobian, _ = state.model.kinetics(state.q, state.parameters)
    block = jacobian[np.ix_(state.partition.pivots, state.partition.dependent_speeds)]
    assert pivot_growth(block / np.linalg.norm(block, axis=1, keepdims=True)) < 100.0


@pytest.mark.skipif(shutil.which("cc") is None, reason="no C compiler")
def test_compiled_equations_are_kept_and_the_same(tmp_path: Any) -> None:
    bob = [Body("one", 1.0, (0, 0, 1)), Body("two", 2.0, (0, 0, 2))]
    joints = [revolute("a", GROUND, "one", (0, 0, 0), (0, 1, 0)), revolute("b", "one", "two", (0, 0, 1), (0, 1, 0))]
    start = {"a": 0.5, "b": -0.3}
    plain = simulate(assemble(build(System(bob, joints)), start), np.linspace(0.0, 1.0, 11))
    compile_equations(tmp_path)
    try:
        fast = simulate(assemble(build(System(bob, joints)), start), np.linspace(0.0, 1.0, 11))
        libraries = list(tmp_path.glob("*.so"))
        assert len(libraries) == 1
        again = libraries[0].stat().st_mtime_ns
        simulate(move(assemble(build(System(bob, joints)), start), {"a": 1.0}), [0.0, 0.1])
        assert [path.stat().st_mtime_ns for path in tmp_path.glob("*.so")] == [again]  # found, not made anew
    finally:
        compile_equations(on=False)
    np.testing.assert_allclose(fast.q, plain.q, atol=1e-10)


def test_without_a_compiler_that_is_said(monkeypatch: Any) -> None:
    monkeypatch.setattr(kept.shutil, "which", lambda _: None)
    with pytest.raises(ModelError, match="needs a C compiler"):
        compile_equations()
