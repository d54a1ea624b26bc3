"""Rolling wheels against the textbook: discs, tori and balls on a level ground."""

from __future__ import annotations

from typing import Any

import casadi as ca
import numpy as np
import pytest

from singletrack.errors import ModelError
from singletrack.multibody import (
    GROUND,
    Body,
    System,
    Wheel,
    accelerations,
    assemble,
    build,
    free,
    linearise,
    move,
    simulate,
    steady_motion,
    wheel_forces,
)
from singletrack.multibody.engine.equations import _express

MASS, RADIUS, DIAMETRAL, AXIAL, G = 2.0, 0.4, 0.07, 0.13, 9.81


def disc(crown: Any = 0.0) -> Any:
    """A wheel on its own: yaw, lean and spin; its spin is about its axle, the last axis carried along."""
    body = Body("disc", MASS, (0, 0, -RADIUS), (DIAMETRAL, AXIAL, DIAMETRAL))
    joint = free("j", GROUND, "disc", (0, 0, -RADIUS), coordinates=("x", "y", "z", "yaw", "lean", "spin"))
    wheel = Wheel("rim", "disc", (0, 0, -RADIUS), RADIUS, crown=crown)
    return build(System([body], [joint], wheels=[wheel], independent=("yaw", "lean", "spin")))


def torus_moment(lean: Any, yaw_rate: Any, spin: Any, crown: Any) -> Any:
    """The moment about the heading that a steady roll leaves unbalanced, from Newton and Euler by hand.

    With e the axle, d the direction from the centre down the wheel's plane and k down, w3 = spin + yaw' sin(lean) the
    rate about the axle: the angular momentum C w3 e + A yaw' cos(lean) d turns at yaw' k; the centre moves forward at
    V = -|(w3 e + yaw' cos(lean) d) x ((r - c) d + c k)| and is accelerated by yaw' V to the side.
    """
    s, c = np.sin(lean), np.cos(lean)
    about_axle = spin + yaw_rate * s
    small = RADIUS - crown
    forward = -(about_axle * (small + crown * c) - yaw_rate * crown * c * s)
    change = yaw_rate * c * (DIAMETRAL * yaw_rate * s - AXIAL * about_axle)
    return change - (small * s * MASS * G - (small * c + crown) * MASS * yaw_rate * forward)


@pytest.mark.parametrize("crown", [0.0, 0.1])
@pytest.mark.parametrize("lean", [0.1, 0.5, 1.1])
def test_steady_rolling_in_a_circle(crown: Any, lean: Any) -> Any:
    found = steady_motion(disc(crown), {"lean": lean}, {"yaw": 2.0}, resting=["lean"], guess_rates={"spin": -8.0}).state
    assert torus_moment(lean, 2.0, found.rate("spin"), crown) == pytest.approx(0.0, abs=1e-10)
    height = (RADIUS - crown) * np.cos(lean) + crown
    assert found["z"] == pytest.approx(RADIUS - height, abs=1e-12)
    run = simulate(found, np.linspace(0.0, 3.0, 31))
    assert abs(run.q.sel(coordinate="lean") - lean).max() < 1e-7
    circle = run.contact.sel(wheel="rim").to_numpy()
    forward = np.hypot(run.u.sel(coordinate="x"), run.u.sel(coordinate="y")).to_numpy()
    side = np.array([-np.sin(run.q.sel(coordinate="yaw")), np.cos(run.q.sel(coordinate="yaw"))]).T
    middle = run.q.sel(coordinate=["x", "y"]).to_numpy() + side * forward[:, None] / 2.0
    np.testing.assert_allclose(middle, middle[:1].repeat(31, 0), atol=1e-6)  # the centre goes round one point
    assert np.ptp(np.linalg.norm(circle[:, :2] - middle, axis=1)) < 1e-6  # and so does the contact
    np.testing.assert_allclose(circle[:, 2], 0.0, atol=1e-13)


@pytest.mark.parametrize("factor", [0.9, 1.1])
def test_an_upright_disc_needs_the_critical_speed(factor: Any) -> Any:
    critical = np.sqrt(DIAMETRAL * MASS * G * RADIUS / (AXIAL * (AXIAL + MASS * RADIUS**2)))
    rolling = move(assemble(disc()), {"spin": -factor * critical})
    values = linearise(rolling).eigenvalues()
    expected = (AXIAL * (AXIAL + MASS * RADIUS**2) * (factor * critical) ** 2 - DIAMETRAL * MASS * G * RADIUS) / (
        DIAMETRAL * (DIAMETRAL + MASS * RADIUS**2)
    )  # square of the frequency of small wobbles
    assert np.max(values.imag if factor > 1 else values.real) == pytest.approx(np.sqrt(abs(expected)), rel=1e-9)
    assert (np.max(values.real) > 1e-3) == (factor < 1)


def test_a_hoop_and_a_coin_have_their_textbook_speeds() -> Any:
    for inertia, over in (((0.5, 1.0, 0.5), 4.0), ((0.25, 0.5, 0.25), 3.0)):  # v^2 = g r / 4, g r / 3
        body = Body("disc", 1.0, (0, 0, -1), inertia)
        joint = free("j", GROUND, "disc", (0, 0, -1), coordinates=("x", "y", "z", "yaw", "lean", "spin"))
        model = build(
            System([body], [joint], wheels=[Wheel("rim", "disc", (0, 0, -1), 1.0)], independent=("yaw", "lean", "spin"))
        )
        growth = [
            np.max(linearise(move(assemble(model), {"spin": -f * np.sqrt(G / over)})).eigenvalues().real)
            for f in (0.999, 1.001)
        ]
        assert growth[0] > 1e-2
        assert growth[1] < 1e-5


def test_a_ball_does_not_care_how_it_lies() -> Any:
    body = Body("ball", 3.0, (0, 0, -0.2), (0.05, 0.05, 0.05))
    joint = free("j", GROUND, "ball", (0, 0, -0.2), coordinates=("x", "y", "z", "yaw", "lean", "spin"))
    model = build(System([body], [joint], wheels=[Wheel("skin", "ball", (0, 0, -0.2), 0.2, crown=0.2)]))
    state = move(assemble(model, {"lean": 0.7}), {"spin": 3.0, "lean": 1.0})
    assert state["z"] == pytest.approx(0.0, abs=1e-14)
    run = simulate(state, np.linspace(0.0, 2.0, 9))
    velocity = run.u.sel(coordinate=["x", "y"]).to_numpy()
    np.testing.assert_allclose(velocity, velocity[:1].repeat(9, 0), atol=1e-9)  # rolls straight on
    assert run.wheel_force.sel(component="normal").to_numpy() == pytest.approx(3.0 * G)


def test_a_tumbling_disc_keeps_its_energy() -> Any:
    state = move(assemble(disc(0.05), {"lean": 0.3}), {"spin": -6.0, "yaw": 1.0, "lean": 0.2})
    run = simulate(state, np.linspace(0.0, 3.0, 31))
    np.testing.assert_allclose(run.energy.to_numpy(), float(run.energy[0]), rtol=1e-10)
    assert run.residual.max() < 1e-13
    assert np.ptp(run.q.sel(coordinate="lean").to_numpy()) > 0.05


def test_constraint_rates_are_those_of_the_constraints() -> Any:
    for crown in (0.0, 0.1):
        s = _express(disc(crown).system)
        sinking = ca.Function("f", [s.q, s.u], [ca.jtimes(s.phi, s.q, s.u), s.rate[0]])
        q, u = np.random.default_rng(4).uniform(-1.0, 1.0, (2, 6))
        assert float(sinking(q, u)[0]) == pytest.approx(float(sinking(q, u)[1]), rel=1e-12)


def test_a_wheel_carries_its_weight() -> Any:
    loads = wheel_forces(assemble(disc()))
    assert loads["rim"] == pytest.approx([0.0, 0.0, MASS * G], abs=1e-12)


def test_a_wheel_that_lies_flat_is_singular() -> Any:
    with pytest.raises(ModelError):
        accelerations(assemble(disc(), {"lean": np.pi / 2}))
