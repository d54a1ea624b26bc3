"""Singular positions: passed where the branch continues, named where it does not, and not seen where there are none."""

from __future__ import annotations

from contextlib import suppress
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.special import ellipj

from singletrack.errors import ModelError
from singletrack.multibody import (
    GROUND,
    Body,
    Event,
    Sensor,
    Spring,
    System,
    accelerations,
    assemble,
    build,
    close_point,
    linearise,
    move,
    prismatic,
    revolute,
    simulate,
    spherical,
    steady_motion,
)

Y, Z = (0, 1, 0), (0, 0, 1)
ORIGIN = (0, 0, 0)


def four_bars(count: int) -> Any:
    """The N-four-bar mechanism of the benchmark library for multibody dynamics: N + 1 cranks hang on N bars in a row.

    Rods of 1 m and 1 kg; in the flat position every loop can move in two ways, and all N ranks are lost at once.
    """
    third = 1.0 / 12.0
    bodies = [Body(f"crank {i}", 1.0, (i, 0, -0.5), (third, third, 0)) for i in range(count + 1)]
    bodies += [Body(f"bar {i}", 1.0, (i + 0.5, 0, -1), (0, third, third)) for i in range(count)]
    joints = [revolute(f"crank {i}", GROUND, f"crank {i}", (i, 0, 0), Y) for i in range(count + 1)]
    joints += [revolute(f"bar {i}", f"crank {i}", f"bar {i}", (i, 0, -1), Y) for i in range(count)]
    loops = [close_point(f"pin {i}", f"bar {i}", f"crank {i + 1}", (i + 1, 0, -1), normal=Y) for i in range(count)]
    return build(System(bodies, joints, loops))


def one_pendulum(count: int, times: Any) -> Any:
    """The angle over time of the same motion without loops: all cranks turn alike, the bars never turn."""
    inertia, moment = (count + 1) / 3.0 + count, (0.5 * (count + 1) + count) * 9.81
    found = solve_ivp(
        lambda _, y: [y[1], moment * np.sin(y[0]) / inertia],
        (times[0], times[-1]),
        [0.0, -1.0],
        "DOP853",
        times,
        rtol=1e-12,
        atol=1e-12,
    )
    return found.y[0]


@pytest.mark.parametrize("count", [1, 2, 3, 8])
def test_chains_of_four_bars_go_through_their_singular_positions(count: int) -> None:
    state = move(assemble(four_bars(count)), {"crank 0": -1.0})
    flat = Event("flat", lambda _, state: np.cos(state["crank 0"]))
    times = np.linspace(0.0, 10.0, 101)
    run = simulate(state, times, events=[flat], singular="pass")
    assert len(run.attrs["singular_times"]) == run.event.size == 10
    np.testing.assert_allclose(run.attrs["singular_times"], run.event_time, atol=1e-6)
    energy = run.energy.to_numpy()
    np.testing.assert_allclose(energy, energy[0], rtol=0, atol=1e-6 * count)  # the library asks for 0.1 J
    assert run.residual.max() < 1e-11
    cranks = run.q.sel(coordinate=[f"crank {i}" for i in range(count + 1)]).to_numpy()
    assert np.ptp(cranks, axis=1).max() < 1e-9  # on the branch on which it came
    np.testing.assert_allclose(cranks[:, 0], one_pendulum(count, times), atol=2e-6)


def test_forty_four_bars_at_a_modest_tolerance() -> None:
    state = move(assemble(four_bars(40)), {"crank 0": -1.0})
    run = simulate(state, np.linspace(0.0, 2.0, 21), singular="pass", rtol=1e-7)
    assert len(run.attrs["singular_times"]) == 2
    energy = run.energy.to_numpy()
    np.testing.assert_allclose(energy, energy[0], rtol=0, atol=1e-2)
    np.testing.assert_allclose(run.q[:, 0], one_pendulum(40, run.time.to_numpy()), atol=1e-5)


@pytest.mark.parametrize("count", [1, 2, 3])
@pytest.mark.parametrize("rtol", [1e-4, 1e-10])
def test_a_singular_position_is_reported_with_time_place_and_loop(count: int, rtol: float) -> None:
    # two ranks lost at once keep the sign of every determinant: reported all the same
    state = move(assemble(four_bars(count)), {"crank 0": -1.0})
    message = r"singular at t = 0\.7[01]\d* s: pin 0.*more than one way.*crank 0 -1\.57"
    with pytest.raises(ModelError, match=message):
        simulate(state, np.linspace(0.0, 10.0, 101), rtol=rtol)
    run = simulate(state, np.linspace(0.0, 10.0, 101), rtol=rtol, trouble="end")
    assert "lose rank" in run.attrs["end"]
    assert 0.6 < float(run.time[-1]) < 0.72


@pytest.mark.parametrize("lengths", [(1.0, 3.0, 2.5, 3.5), (1.0, 3.0, 1.2, 3.1), (1.0, 3.0, 1.02, 3.01)])
@pytest.mark.parametrize("rtol", [1e-4, 1e-9])
def test_four_bars_that_are_only_nearly_singular_go_on(lengths: Any, rtol: float) -> None:
    crank, coupler, rocker, base = lengths
    joints = [
        revolute("crank", GROUND, "crank", ORIGIN, Y),
        revolute("coupler", "crank", "coupler", (crank, 0, 0), Y),
        revolute("rocker", GROUND, "rocker", (base, 0, 0), Y),
    ]
    bodies = [
        Body("crank", 1.0, (crank / 2, 0, 0), (0.0, 0.1, 0.1)),
        Body("coupler", 1.0, (crank + coupler / 2, 0, 0), (0.0, 0.7, 0.7)),
        Body("rocker", 1.0, (base + rocker / 2, 0, 0), (0.0, 0.3, 0.3)),
    ]
    ends = {"point": (crank + coupler, 0, 0), "second_point": (base + rocker, 0, 0)}
    pin = close_point("pin", "coupler", "rocker", normal=Y, **ends)
    model = build(System(bodies, joints, [pin], gravity=0.0))
    state = move(assemble(model, {"crank": -1.0}, guess={"rocker": -1.5, "coupler": 0.3}), {"crank": -5.0})
    run = simulate(state, np.linspace(0.0, 3.0, 31), rtol=rtol)
    assert run.attrs["end"] == "all times reached"
    assert np.ptp(run.q.sel(coordinate="crank").to_numpy()) > 2.0 * np.pi
    assert run.residual.max() < 1e-11
    if rtol < 1e-8:
        np.testing.assert_allclose(run.energy, float(run.energy[0]), rtol=1e-5)


def top(inertia: Any) -> Any:
    """A body that turns freely, with a quaternion; its rates about its own axes are measured."""
    sensors = [
        Sensor(name, "body", kind="rate", direction=axis, follows=True)
        for name, axis in (("w1", (1, 0, 0)), ("w2", Y), ("w3", Z))
    ]
    joint = spherical("turn", GROUND, "body", ORIGIN, quaternion=True)
    return build(System([Body("body", 1.0, ORIGIN, inertia)], [joint], gravity=0.0, sensors=sensors))


@pytest.mark.parametrize("rtol", [1e-3, 1e-6, 1e-10])
def test_a_ball_spins_freely_about_any_axis_at_any_tolerance(rtol: float) -> None:
    rng = np.random.default_rng(3)
    model = top((0.5, 0.5, 0.5))
    for rate in 3.0 * rng.standard_normal((4, 3)):
        state = move(assemble(model), dict(zip(("turn.q1", "turn.q2", "turn.q3"), rate / 2.0, strict=True)))
        run = simulate(state, np.linspace(0.0, 20.0, 21), rtol=rtol, atol=rtol * 1e-2)
        assert run.attrs["end"] == "all times reached"
        assert run.residual.max() < 1e-13
        allowed = 1e-5 if rtol < 1e-9 else 0.3
        np.testing.assert_allclose(run.sensor, np.tile(rate, (21, 1)), atol=allowed)


def test_dzhanibekov() -> None:
    """Turning about the middle axis, a body flips to and fro: Euler's elliptic functions."""
    one, two, three = 1.0, 2.0, 2.5
    w3 = 2.0
    # nearly on the separatrix, which has the modulus one
    w1 = w3 * np.sqrt(three * (three - two) / (one * (two - one))) * np.sqrt(1.0 - 1e-3)
    energy, momentum = one * w1**2 + three * w3**2, (one * w1) ** 2 + (three * w3) ** 2
    rate = np.sqrt((three - two) * (momentum - energy * one) / (one * two * three))
    modulus = (two - one) * (energy * three - momentum) / ((three - two) * (momentum - energy * one))
    assert 0.998 < modulus < 1.0
    state = move(assemble(top((one, two, three))), {"turn.q1": w1 / 2.0, "turn.q3": w3 / 2.0})
    times = np.linspace(0.0, 30.0, 121)
    run = simulate(state, times, rtol=1e-12, atol=1e-13)
    sn, cn, dn, _ = ellipj(rate * times, modulus)
    middle = np.sqrt((energy * three - momentum) / (two * (three - two)))
    np.testing.assert_allclose(run.sensor, np.array([w1 * cn, middle * sn, w3 * dn]).T, atol=2e-5)
    flips = np.count_nonzero(np.diff(np.sign(run.sensor[:, 1])))
    assert flips >= 3
    np.testing.assert_allclose(run.energy, float(run.energy[0]), rtol=1e-8)


def governor(stiffness: float, damping: float) -> Any:
    """A flyball governor whose lower rods are springs and dampers, as stiff as in the benchmark library."""
    bodies = [Body("shaft", 1.0, ORIGIN, (0.05, 0.05, 0.05)), Body("sleeve", 3.0, (0, 0, 1), (0.02, 0.02, 0.02))]
    joints = [revolute("spin", GROUND, "shaft", ORIGIN, Z), prismatic("sleeve", "shaft", "sleeve", Z)]
    springs = []
    for side, sign in (("left", -1.0), ("right", 1.0)):
        bodies.append(Body(f"{side} arm", 5.0, (0, 0, 1), (0.01, 0.01, 0.01)))
        joints.append(revolute(f"{side} arm", "shaft", f"{side} arm", ORIGIN, (0, sign, 0)))
        rod = Spring(f"{side} rod", f"{side} arm", "sleeve", (0, 0, 0.5), (0, 0, 1), stiffness, damping, 0.5)
        springs.append(rod)
    return build(System(bodies, joints, springs=springs))


def test_a_stiff_governor_with_implicit_integrators() -> None:
    model = governor(8e5, 4e4)
    arms = {"left arm": np.pi / 6, "right arm": np.pi / 6}
    start = move(assemble(model, arms), {"spin": 2.0 * np.pi})
    explicit = simulate(start, [0.0, 0.1])
    implicit = simulate(start, [0.0, 0.1], method="Radau", rtol=1e-9, atol=1e-11)
    np.testing.assert_allclose(implicit.q, explicit.q, rtol=1e-6, atol=1e-9)
    long = {method: simulate(start, [0.0, 10.0], method=method, rtol=1e-7, atol=1e-9) for method in ("Radau", "BDF")}
    np.testing.assert_allclose(long["BDF"].q[-1], long["Radau"].q[-1], atol=2e-3)
    # nothing turns it: the angular momentum about the shaft stays
    q, u = long["Radau"].q.sel(coordinate="left arm"), long["Radau"].u.sel(coordinate="spin")
    about = 0.05 + 0.02 + 2.0 * (0.01 + 5.0 * np.sin(q) ** 2)
    np.testing.assert_allclose((about * u).to_numpy(), float(about[0] * u[0]), rtol=1e-5)


def test_exact_jacobians_are_those_of_the_right_side() -> None:
    from singletrack.multibody.engine.evaluation import Evaluator, slope_jacobian

    state = move(assemble(four_bars(2), {"crank 0": 0.4}), {"crank 0": 1.5})
    evaluator = Evaluator(state)
    y = np.concatenate([state.q, state.u[evaluator.free]])
    exact = slope_jacobian(evaluator)(0.0, y)
    # sixth-order differences
    h, weights = 1e-3, ((1, 45.0), (2, -9.0), (3, 1.0))
    for i, direction in enumerate(np.eye(len(y))):
        along = sum(
            w * (evaluator.slope(0.0, y + k * h * direction) - evaluator.slope(0.0, y - k * h * direction))
            for k, w in weights
        )
        np.testing.assert_allclose(exact[:, i], along / (60.0 * h), atol=1e-8 * np.max(abs(exact)))


def test_a_turning_governor_settles_where_porter_says() -> None:
    model = governor(8e5, 4e4)
    arms = {"left arm": 0.7, "right arm": 0.7}
    found = steady_motion(model, rates={"spin": 7.0}, resting=["left arm", "right arm", "sleeve"], guess=arms).state
    assert linearise(found).eigenvalues().real.max() < 1e-3
    # rods of half the arm's length at its middle, all but rigid: balls and sleeve by virtual work
    angle = found["left arm"]
    assert 2.0 * 5.0 * np.sin(angle) * np.cos(angle) * 49.0 == pytest.approx(
        (2.0 * 5.0 * np.sin(angle) + 3.0 * np.sin(angle)) * 9.81, rel=2e-3
    )


@pytest.mark.parametrize("count", [1, 15])  # eliminated by hand, solved by LAPACK
def test_in_a_singular_position_no_library_speaks(count: int) -> None:
    state = assemble(four_bars(count), {"crank 0": 0.4})
    flat = np.array([-np.pi / 2] * (count + 1) + [np.pi / 2] * count)
    lost = replace(state, q=flat)
    for ask in (lambda: accelerations(lost), lambda: move(lost, {"crank 0": 1.0})):
        # rounding may leave a pivot: then what comes out is huge, but a number
        with suppress(ModelError):
            found = ask()
            assert np.all(np.isfinite(found.a if hasattr(found, "a") else found.u))
