"""Motions prescribed within a simulation: references, work, inverse dynamics, errors."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.interpolate import CubicSpline

from singletrack import load_bicycle, load_rider
from singletrack.errors import ModelError
from singletrack.multibody import (
    Body,
    CoordinateForce,
    Function,
    Prescribed,
    System,
    assemble,
    bicycle_model,
    build,
    close_point,
    inverse_dynamics,
    move,
    prismatic,
    revolute,
    ride,
    simulate,
)
from singletrack.posture import Options

Y = (0, 1, 0)


def sine(size: float, w: float, start: float = 0.0) -> Any:
    """A motion that begins at a place with some rate."""
    return lambda t: (start + size * np.sin(w * t), size * w * np.cos(w * t), -size * w**2 * np.sin(w * t))


def smooth(size: float, w: float) -> Any:
    """A motion that begins at rest."""
    return lambda t: (size * (1 - np.cos(w * t)), size * w * np.sin(w * t), size * w**2 * np.cos(w * t))


def crane(length: float = 0.7) -> Any:
    bodies = [Body("cart", 3.0), Body("bob", 2.0, (0, 0, length))]
    joints = [prismatic("slide", "ground", "cart", (1, 0, 0)), revolute("swing", "cart", "bob", (0, 0, 0), Y)]
    return build(System(bodies, joints))


def test_a_crane_whose_cart_is_driven_swings_as_the_textbook_says() -> None:
    length, g, size, w = 0.7, 9.81, 0.1, 4.0
    state = move(assemble(crane(length), {"swing": 0.3}), {"slide": size * w, "swing": 0.0})
    times = np.linspace(0.0, 5.0, 101)
    run = simulate(state, times, prescribed={"slide": sine(size, w)})

    def slope(t: float, y: Any) -> list[float]:
        return [y[1], (-g * np.sin(y[0]) + size * w**2 * np.sin(w * t) * np.cos(y[0])) / length]

    swing, rate = solve_ivp(slope, (0, 5), [0.3, 0.0], t_eval=times, rtol=1e-12, atol=1e-13, method="DOP853").y
    np.testing.assert_allclose(run.q.sel(coordinate="swing"), swing, atol=1e-9)
    np.testing.assert_allclose(run.q.sel(coordinate="slide"), size * np.sin(w * times), atol=1e-14)
    turning = np.array([slope(t, y)[1] for t, y in zip(times, np.array([swing, rate]).T, strict=True)])
    pull = -5.0 * size * w**2 * np.sin(w * times) + 2.0 * length * (turning * np.cos(swing) - rate**2 * np.sin(swing))
    np.testing.assert_allclose(run.input.sel(input_name="slide drive"), pull, atol=1e-7)


@pytest.mark.parametrize("coordinate", ["steer", "torso lean"])
def test_what_it_takes_does_the_work_and_makes_the_motion(coordinate: str) -> None:
    """A rider steers or leans as given: energy grows by the drives' work, their torques alone make the same ride."""
    model = bicycle_model(load_bicycle("stratos"), load_rider("rider-a"), Options("leaned", torso_lean=True))
    law = {name: smooth(0.02 if name == coordinate else 0.0, 8.0) for name in ("steer", "torso lean")}
    state, times = ride(model, 6.0), np.linspace(0.0, 0.5, 51)
    run = simulate(state, times, prescribed=law)
    np.testing.assert_allclose(run.q.sel(coordinate=coordinate), 0.02 * (1 - np.cos(8.0 * times)), atol=1e-12)
    assert float(abs(run.q.sel(coordinate="lean")).max()) > 1e-3
    taken = {name: run.input.sel(input_name=name).values for name in ("steer torque", "torso torque")}
    rates = (run.u.sel(coordinate=name).values for name in law)
    power = sum(torque * rate for torque, rate in zip(taken.values(), rates, strict=True))
    work = CubicSpline(times, power).antiderivative()(times)
    assert np.abs(work).max() > 1e-2
    np.testing.assert_allclose(run.energy - run.energy[0], work, atol=1e-5)
    forces = {name: Function(CubicSpline(times, torque), max_step=0.1) for name, torque in taken.items()}
    again = simulate(state, times[::10], forces)
    np.testing.assert_allclose(again.q, run.q[::10], atol=1e-5)


def slider_crank() -> Any:
    bodies = [
        Body("crank", 1.0, (0.1, 0, 0), (0.01, 0.01, 0.01)),
        Body("rod", 0.5, (0.5, 0, 0), (0.02, 0.02, 0.02)),
        Body("piston", 0.3),
    ]
    joints = [
        revolute("crank", "ground", "crank", (0, 0, 0), Y),
        revolute("rod", "crank", "rod", (0.2, 0, 0), Y),
        prismatic("piston", "ground", "piston", (1, 0, 0)),
    ]
    return build(System(bodies, joints, [close_point("pin", "rod", "piston", (0.8, 0, 0), normal=Y)]))


@pytest.mark.parametrize("coordinate", ["crank", "rod", "piston"])
def test_loops_follow_whatever_coordinate_is_driven(coordinate: str) -> None:
    """The engine would choose other speeds: those prescribed are kept, and it takes what inverse dynamics says."""
    model = slider_crank()
    start = assemble(model, {"crank": 0.8}, guess={"rod": -1.0})
    law = sine(0.05, 6.0, start[coordinate])
    times = np.linspace(0.0, 1.0, 11)
    run = simulate(move(start, {coordinate: 0.3}), times, prescribed={coordinate: law})
    guess = {name: start[name] for name in model.system.coordinates}
    known = inverse_dynamics(model, {coordinate: law}, times, guess=guess)
    np.testing.assert_allclose(run.q, known.q, atol=1e-9)
    np.testing.assert_allclose(run.input.sel(input_name=f"{coordinate} drive"), known.drive[:, 0], atol=1e-7)
    assert float(run.residual.max()) < 1e-12


def test_recorded_motions_pass_through_their_values() -> None:
    recorded = np.array([0.0, 0.05, 0.02, -0.04, -0.04])
    motion = Prescribed.through(np.linspace(0.0, 2.0, 5), recorded)
    run = simulate(assemble(crane()), np.linspace(0.0, 3.0, 13), prescribed={"slide": motion})
    np.testing.assert_allclose(run.q.sel(coordinate="slide")[::2][:5], recorded, atol=1e-12)
    np.testing.assert_allclose(run.q.sel(coordinate="slide")[8:], recorded[-1], atol=1e-12)
    for wrong in (([0.0, 0.0], [0.0, 1.0]), ([0.0, 1.0], [0.0, np.nan]), ([0.0, 1.0], [0.0])):
        with pytest.raises(ModelError, match="must increase"):
            Prescribed.through(*map(np.array, wrong))


def test_implicit_methods_take_prescribed_motions() -> None:
    state = move(assemble(crane(), {"swing": 0.3}), {"slide": 0.4, "swing": 0.0})
    times = np.linspace(0.0, 0.5, 6)
    one, other = (
        simulate(state, times, prescribed={"slide": sine(0.1, 4.0)}, method=m, rtol=1e-9, atol=1e-10)
        for m in ("DOP853", "Radau")
    )
    np.testing.assert_allclose(one.q, other.q, atol=1e-7)


@pytest.mark.parametrize(
    ("law", "words"),
    [
        ({"slide": sine(0.1, 4.0, 0.2)}, "starts at 0.2 with the rate 0.4, but the state is at 0 with the rate 0;"),
        ({"slide": lambda t: (t**2, 3 * t, 3.0)}, "its rate at .* is not the derivative of its value"),
        ({"slide": lambda t: (t**2, 2 * t, 0.0)}, "its acceleration at .* is not the derivative of its rate"),
        ({"slide": lambda t: (t**2, 2 * t, np.nan if t else 2.0)}, "must be finite"),
        ({"slope": smooth(0.1, 1.0)}, "unknown coordinate 'slope'; did you mean slide"),
    ],
)
def test_motions_that_cannot_be_are_refused(law: Any, words: str) -> None:
    with pytest.raises(ModelError, match=words):
        simulate(assemble(crane()), np.array([0.0, 1.0]), prescribed=law)


def test_a_drive_is_not_given_twice_and_needs_a_freedom() -> None:
    system = crane().system
    model = build(system.replace(inputs=[CoordinateForce("winch", "slide")]))
    with pytest.raises(ModelError, match="input winch: it follows where slide is prescribed"):
        simulate(assemble(model), np.array([0.0, 1.0]), {"winch": 2.0}, prescribed={"slide": smooth(0.1, 1.0)})
    run = simulate(assemble(model), np.array([0.0, 1.0]), prescribed={"slide": smooth(0.1, 1.0)})
    assert list(run.input_name.values) == ["winch"]
    start = assemble(slider_crank(), {"crank": 0.8}, guess={"rod": -1.0})
    both = {name: (lambda _, x=start[name]: (x, 0.0, 0.0)) for name in ("crank", "piston")}
    with pytest.raises(ModelError, match="crank, piston: the constraints leave no such freedom"):
        simulate(start, np.array([0.0, 1.0]), prescribed=both)


def test_a_hand_that_cannot_follow_is_named() -> None:
    """Upright on the Browser the outer hand follows up to 0.40 rad of steer; a drive that goes on is stopped there."""
    model = bicycle_model(load_bicycle("browser"), load_rider("rider-a"), "upright")
    law = {"steer": lambda t: (0.3 * t * t, 0.6 * t, 0.6)}
    with pytest.raises(ModelError, match=r"hand cannot follow: steer is prescribed beyond what the loops allow"):
        simulate(ride(model, 2.0), np.array([0.0, 3.0]), prescribed=law, rtol=1e-7, atol=1e-8)


@pytest.mark.parametrize("law", [0.1, lambda t: (t, 1.0)])
def test_a_motion_is_a_function_of_three_numbers(law: Any) -> None:
    with pytest.raises(ModelError, match="returns three numbers"):
        simulate(assemble(crane()), np.array([0.0, 1.0]), prescribed={"slide": law})


@pytest.mark.parametrize("force", [np.nan, np.inf, lambda _: np.nan, lambda t: np.nan if t > 0.5 else 0.0])
def test_inputs_that_are_not_finite_end_at_once(force: Any) -> None:
    """A number is refused by name; a function that begins or goes on so ends the run, and no loop goes on for ever."""
    model = build(crane().system.replace(inputs=[CoordinateForce("winch", "slide")]))
    with pytest.raises(
        ModelError, match=r"input winch: (nan|inf); allowed: a finite number|an input is not finite there"
    ):
        simulate(assemble(model), np.array([0.0, 1.0]), {"winch": force})
