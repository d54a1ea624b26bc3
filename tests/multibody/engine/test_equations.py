"""The equations of motion against a second derivation: Lagrange's, from the energies alone."""

from __future__ import annotations

from typing import Any

import casadi as ca
import numpy as np
import pytest

from singletrack.errors import ModelError
from singletrack.multibody import (
    GROUND,
    Body,
    CoordinateForce,
    Force,
    Sensor,
    Spring,
    System,
    Torque,
    accelerations,
    assemble,
    build,
    cylindrical,
    free,
    linearise,
    move,
    planar,
    prismatic,
    revolute,
    simulate,
    spherical,
    universal,
)

INERTIA = (0.3, 0.4, 0.5, 0.02, -0.03, 0.01)


def body(name: Any, x: Any) -> Any:
    return Body(name, 1.5 + x, (x, 0.1 - x, 0.3 * x), INERTIA)


def chain() -> Any:
    """All kinds of joints, one after the other, with springs."""
    joints = [
        free("a", GROUND, "1", (0.1, 0.2, 0.3)),
        universal("b", "1", "2", (0.5, 0, 0), ((0, 1, 0), (1, 0, 1)), stiffness=(3.0, 4.0), preload=0.7),
        cylindrical("c", "2", "3", (0.7, 0.1, 0), (1, 2, 3), stiffness=5.0),
        prismatic("d", "1", "4", (1, 1, 0)),
        spherical("e", "4", "5", (0.2, 0.2, 0.9)),
        planar("f", "5", "6", (0.1, 0.2, 0.7), normal=(0, 1, 1), along=(1, 0, 0)),
        revolute("g", "6", "7", (0.3, 0.3, 0.3), (2, 1, 0)),
    ]
    springs = [Spring("s", "3", "7", (0.9, 0, 0), (0.1, 0.4, 1.0), stiffness=20.0, rest=0.4, preload=2.0)]
    return System([body(str(i), 0.2 * i) for i in range(1, 8)], joints, springs=springs)


def test_newton_and_euler_agree_with_lagrange() -> None:
    model = build(chain())
    n = len(model.system.coordinates)
    q, u, a = (ca.MX.sym(name, n) for name in "qua")
    p = model.parameters()
    kinetic, potential = model.equations.energy(q, u, p)
    momentum = ca.gradient(kinetic, u)
    lagrange = ca.jtimes(momentum, ca.vertcat(q, u), ca.vertcat(u, a)) - ca.gradient(kinetic - potential, q)
    expected = ca.Function("lagrange", [q, u, a], [lagrange, ca.hessian(kinetic, u)[0]])
    rng = np.random.default_rng(1)
    for _ in range(5):
        values = rng.uniform(-1.0, 1.0, (3, n))
        force, mass = expected(*values)
        _, own_mass = model.kinetics(values[0], p)
        own_bias, _ = model.equations.bias(values[0], values[1], [], p)
        np.testing.assert_allclose(own_mass, mass.full(), rtol=0, atol=1e-12 * np.max(abs(mass.full())))
        own_force = own_mass @ values[2] + own_bias.full().ravel()
        np.testing.assert_allclose(own_force, force.full().ravel(), rtol=0, atol=1e-11 * np.max(abs(force.full())))


def test_the_mass_matrix_is_symmetric_and_positive() -> None:
    model = build(chain())
    rng = np.random.default_rng(2)
    for q in rng.uniform(-1.0, 1.0, (5, len(model.system.coordinates))):
        _, mass = model.kinetics(q, model.parameters())
        np.testing.assert_allclose(mass, mass.T, rtol=0, atol=1e-12 * np.max(abs(mass)))
        assert np.all(np.linalg.eigvalsh(mass) > 0.0)


def test_far_from_the_origin_nothing_changes() -> None:
    model = build(chain())
    rates = dict(zip(model.system.coordinates, np.random.default_rng(3).uniform(-1, 1, 18), strict=True))
    here, there = (accelerations(move(assemble(model, {"a.x": x}), rates)) for x in (0.0, 2.0**10))
    np.testing.assert_allclose(there.a, here.a, rtol=1e-10, atol=1e-10)


def test_a_tumbling_body_keeps_energy_and_angular_momentum() -> None:
    inertia = np.array([1.0, 2.0, 2.5])
    system = System([Body("book", 1.0, inertia=tuple(inertia))], [free("fly", GROUND, "book")], gravity=0.0)
    state = move(assemble(build(system)), {"fly.1": 0.3, "fly.2": 1.1, "fly.3": 0.2})
    run = simulate(state, np.linspace(0.0, 4.0, 41))
    np.testing.assert_allclose(run.energy, run.energy[0], rtol=1e-9)
    yaw, lean, pitch = (run.q.sel(coordinate=f"fly.{i}").to_numpy() for i in (1, 2, 3))
    rates = np.array([run.u.sel(coordinate=f"fly.{i}") for i in (1, 2, 3)])

    def turn(axis: Any, angle: Any) -> Any:
        c, s = np.cos(angle), np.sin(angle)
        i, j = [(1, 2), (2, 0), (0, 1)][axis]
        matrix = np.zeros((len(angle), 3, 3))
        matrix[:, axis, axis] = 1.0
        matrix[:, i, i] = matrix[:, j, j] = c
        matrix[:, i, j], matrix[:, j, i] = -s, s
        return matrix

    Z, X, Y = turn(2, yaw), turn(0, lean), turn(1, pitch)
    R = Z @ X @ Y
    spin = (
        np.stack([np.eye(3)[None, :, 2].repeat(len(yaw), 0), Z[:, :, 0], (Z @ X)[:, :, 1]], axis=2)
        @ rates.T[:, :, None]
    )
    momentum = (R @ (inertia[:, None] * (np.swapaxes(R, 1, 2) @ spin)))[:, :, 0]
    np.testing.assert_allclose(momentum, momentum[:1].repeat(len(yaw), 0), atol=1e-8)
    assert np.ptp(lean) > 0.5  # it does tumble


@pytest.mark.parametrize("joint", [free, spherical])
def test_quaternions_move_as_angles_do(joint: Any) -> Any:
    """Also through the attitude where the angles are singular: a lean of 90 degrees."""
    bodies = [Body("top", 2.0, (0.1, 0.2, 0.5), (0.3, 0.4, 0.5)), Body("rod", 1.0, (0.3, 0.2, 1.0), (0.1, 0.1, 0.01))]
    hinge = revolute("hinge", "top", "rod", (0.2, 0.2, 0.8), (1, 1, 0))

    def machine(**kind: Any) -> Any:
        return build(System(bodies, [joint("j", GROUND, "top", (0, 0, 0), **kind), hinge], gravity=0.1))

    angles, quaternion = machine(), machine(quaternion=True)
    rates = {"j.1": 0.3, "j.2": 2.5, "j.3": 0.4, "hinge": -1.0}
    # at zero angles the spin is (lean', pitch', yaw'), and the quaternion changes by half of it
    halves = {"j.q1": 1.25, "j.q2": 0.2, "j.q3": 0.15, "hinge": -1.0}
    times = np.linspace(0.0, 3.0, 31)
    start = move(assemble(quaternion), halves)
    assert start.rate("j.q0") == pytest.approx(0.0, abs=1e-14)
    run = simulate(start, times)
    np.testing.assert_allclose(run.energy.to_numpy(), float(run.energy[0]), rtol=0, atol=1e-8)
    assert run.residual.max() < 1e-13
    short = simulate(move(assemble(angles), rates), times[:4])  # before the angles get singular
    np.testing.assert_allclose(run.q.sel(coordinate="hinge")[:4], short.q.sel(coordinate="hinge"), atol=1e-9)
    np.testing.assert_allclose(run.energy[:4], short.energy, rtol=1e-9)
    attitude = 1.0 + run.q.sel(coordinate="j.q0").to_numpy()
    assert np.min(attitude) < 0.0 < np.max(attitude)  # it turns over, past the zero of the scalar part


def test_a_quaternion_takes_no_springs() -> Any:
    with pytest.raises(ModelError, match="joint j: a quaternion takes no stiffness; use angles instead"):
        spherical("j", GROUND, "top", (0, 0, 0), quaternion=True, stiffness=1.0)


def test_inputs_act_as_forces_and_torques_do() -> None:
    bob = Body("bob", 2.0, (0, 0, 1), (0.1, 0.1, 0.1))
    swing = revolute("swing", GROUND, "bob", (0, 0, 0), (0, 1, 0))
    inputs = [
        Force("push", "bob", (0, 0, 0.5), (1, 0, 0)),
        Force("thrust", "bob", (0, 0, 0.5), (1, 0, 0), follows=True),
        Torque("twist", "bob", (0, 1, 0)),
        CoordinateForce("motor", "swing"),
    ]
    sensors = [
        Sensor("height", "bob", (0, 0, 1), (0, 0, -1)),
        Sensor("speed", "bob", (0, 0, 1), (1, 0, 0), "velocity"),
        Sensor("gyro", "bob", direction=(0, 1, 0), kind="rate", follows=True),
    ]
    model = build(System([bob], [swing], inputs=inputs, sensors=sensors))
    state = assemble(model, {"swing": 0.4})
    free_fall = accelerations(state).a[0]
    gained = {name: (accelerations(state, {name: 1.0}).a[0] - free_fall) * 2.1 for name in ("push", "thrust")}
    assert gained == pytest.approx({"push": 0.5 * np.cos(0.4), "thrust": 0.5})
    for name in ("twist", "motor"):
        assert (accelerations(state, {name: 1.0}).a[0] - free_fall) * 2.1 == pytest.approx(1.0)
    small = linearise(assemble(model), outputs=["height", "speed", "gyro", "swing", "swing'"])
    np.testing.assert_allclose(small.C_matrix, [[0, 0], [0, 1], [0, 1], [1, 0], [0, 1]], atol=1e-14)
    np.testing.assert_allclose(small.B_matrix, [[0, 0, 0, 0], [0.5 / 2.1, 0.5 / 2.1, 1 / 2.1, 1 / 2.1]])


def test_springs_and_dampers_pull_and_brake() -> None:
    bob = Body("bob", 2.0)
    slide = prismatic("slide", GROUND, "bob", (1, 0, 0), stiffness=3.0, damping=0.5, preload=1.0)
    spring = Spring("coil", GROUND, "bob", (-1, 0, 0), (0, 0, 0), stiffness=7.0, damping=0.25, rest=0.5, preload=2.0)
    state = move(assemble(build(System([bob], [slide], springs=[spring])), {"slide": 0.2}), {"slide": 0.3})
    expected = 1.0 - 3.0 * 0.2 - 0.5 * 0.3 - 7.0 * (1.2 - 0.5) - 0.25 * 0.3 - 2.0
    assert 2.0 * accelerations(state).a[0] == pytest.approx(expected, rel=1e-13)
