"""Descriptions are checked as they are made, and every message names the element."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from singletrack.errors import ModelError
from singletrack.multibody import (
    GROUND,
    Body,
    CoordinateForce,
    Force,
    Pulse,
    Sampled,
    Sensor,
    Spring,
    System,
    Torque,
    Wheel,
    accelerations,
    assemble,
    build,
    close_distance,
    close_joint,
    close_point,
    cylindrical,
    fixed,
    free,
    linearise,
    move,
    parameter,
    planar,
    prismatic,
    revolute,
    simulate,
    spherical,
    steady_motion,
    universal,
)

Y = (0, 1, 0)
ORIGIN = (0, 0, 0)
BOB = Body("bob", 1.0, (0, 0, 1))
SWING = revolute("swing", GROUND, "bob", ORIGIN, Y)


@pytest.mark.parametrize(
    ("make", "says"),
    [
        (lambda: Body("lead", -1.0), "body lead: mass is -1"),
        (lambda: Body("lead", float("nan")), "body lead: mass is nan"),
        (lambda: Body("lead", "heavy"), "body lead: mass must be a number"),
        (lambda: Body("lead", 1.0, (0, 0)), "body lead: centre must have three components"),
        (lambda: Body("lead", 1.0, inertia=(1, 1)), "body lead: inertia must have 3 or 6"),
        (lambda: Body("lead", 1.0, inertia=(1, 1, 2.1)), "body lead: no body has the principal inertias"),
        (lambda: Body("lead", 1.0, inertia=(1, 1, 1, 2, 0, 0)), "body lead: no body has the principal inertias"),
        (lambda: revolute("pin", GROUND, "a", ORIGIN, ORIGIN), "joint pin: axis has no direction"),
        (lambda: revolute("pin", GROUND, "a", ORIGIN, Y, stiffness=(1, 2)), "joint pin: stiffness must be one number"),
        (lambda: universal("pin", GROUND, "a", ORIGIN, (Y, Y), coordinates=("p",)), "joint pin: 2 coordinates need 2"),
        (lambda: Wheel("rear", "a", ORIGIN, -0.3), "wheel rear: radius is -0.3"),
        (lambda: Wheel("rear", "a", ORIGIN, 0.3, crown=0.4), "wheel rear: crown is 0.4 m; allowed: at most"),
        (lambda: close_joint("end", "weld", "a", "b", point=ORIGIN), "loop end: unknown kind 'weld'"),
        (lambda: close_distance("rod", "a", "b", (ORIGIN, Y), 0.0), "loop rod: length is 0"),
        (lambda: Sampled([0.0, 0.0], [1.0, 2.0]), "sampled input: times must increase"),
        (lambda: Pulse(8.0, 0.0, 1.0), "pulse: start 8.0, duration 0.0"),
        (lambda: Sampled([0.0, 1.0], [1.0]), "two equal lists"),
    ],
)
def test_elements_refuse_what_cannot_be(make: Any, says: Any) -> None:
    with pytest.raises(ModelError, match=says):
        make()


@pytest.mark.parametrize(
    ("change", "says"),
    [
        (
            {"joints": (revolute("swing", GROUND, "bop", ORIGIN, Y),)},
            "joint swing: unknown body 'bop'; did you mean bob",
        ),
        ({"joints": (SWING, revolute("twin", GROUND, "bob", ORIGIN, Y))}, "body bob: two parents, .*swing and twin"),
        ({"joints": ()}, "body bob: no joint hangs it"),
        ({"joints": (revolute("swing", "bob", "bob", ORIGIN, Y),)}, "body bob: its joints lead round in a circle"),
        ({"joints": (SWING, revolute("up", "bob", GROUND, ORIGIN, Y))}, "joint up: the ground cannot be a child"),
        ({"bodies": (BOB, BOB)}, "body bob: the name is used 2 times"),
        ({"wheels": (Wheel("rear", "bo", ORIGIN, 0.3),)}, "wheel rear: unknown body 'bo'"),
        ({"wheels": (Wheel("rear", GROUND, ORIGIN, 0.3),)}, "wheel rear: the ground does not roll"),
        ({"closures": (close_point("end", "bob", "b", ORIGIN),)}, "loop end: unknown body 'b'"),
        ({"springs": (Spring("coil", "bob", "b", ORIGIN, ORIGIN),)}, "spring coil: unknown body 'b'"),
        ({"sensors": (Sensor("gyro", "b"),)}, "sensor gyro: unknown body 'b'"),
        ({"inputs": (Force("push", "b", ORIGIN, Y),)}, "input push: unknown body 'b'"),
        ({"inputs": (Torque("turn", "bob", Y, "b"),)}, "input turn: unknown body 'b'"),
        ({"inputs": (CoordinateForce("turn", "swin"),)}, "input turn: unknown coordinate 'swin'; did you mean swing"),
        ({"independent": ("swin",)}, "unknown independent coordinate 'swin'; did you mean swing"),
        ({"gravity": parameter("g")}, "gravity must be a number"),
        ({"down": (0, 0, float("inf"))}, "system: down is inf"),
    ],
)
def test_systems_refuse_what_does_not_fit(change: Any, says: Any) -> None:
    with pytest.raises(ModelError, match=says):
        System((BOB,), (SWING,)).replace(**change)


def test_a_machine_that_cannot_move_is_refused() -> None:
    with pytest.raises(ModelError, match="nothing can move"):
        build(System((BOB,), (fixed("weld", GROUND, "bob"),)))


def test_parameters_without_a_value_are_named() -> None:
    model = build(System((Body("bob", parameter("ballast"), (0, 0, 1)),), (SWING,)))
    with pytest.raises(ModelError, match="no value for the parameters ballast"):
        assemble(model)
    with pytest.raises(ModelError, match="unknown parameter 'balast'; did you mean ballast"):
        assemble(model, parameters={"balast": 1.0})
    assert accelerations(assemble(model, {"swing": 0.1}, {"ballast": 2.0})).a == pytest.approx(-9.81 * np.sin(0.1))


def test_a_loop_that_cannot_close_is_named() -> None:
    rod = close_distance("rod", GROUND, "bob", ((5, 0, 0), (0, 0, 1)), 1.0)
    with pytest.raises(ModelError, match=r"rod \(distance\): the loop cannot close"):
        assemble(build(System((BOB,), (SWING,), (rod,))))


def test_a_constraint_that_cannot_vary_is_named() -> None:
    rod = close_distance("rod", GROUND, GROUND, ((0, 0, 0), (0, 0, 1)), 2.0)
    with pytest.raises(ModelError, match=r"rod \(distance\): a constraint that cannot vary"):
        assemble(build(System((BOB,), (SWING,), (rod,))))


def test_the_number_of_freedoms_left_is_said() -> None:
    with pytest.raises(ModelError, match="the machine has 1 degrees of freedom left, not 0"):
        assemble(build(System((BOB,), (SWING,), independent=())))


def test_accelerations_that_are_not_determined_are_refused() -> None:
    with pytest.raises(ModelError, match="not determined: a freedom has no mass"):
        accelerations(assemble(build(System((Body("ghost"),), (revolute("swing", GROUND, "ghost", ORIGIN, Y),)))))


@pytest.mark.parametrize(
    ("act", "says"),
    [
        (lambda s: s["swin"], "unknown coordinate 'swin'"),
        (lambda s: assemble(s.model, independent=["swin"]), "unknown independent coordinate 'swin'"),
        (lambda s: move(s, {"swin": 1.0}), "unknown coordinate 'swin'"),
        (lambda s: assemble(s.model, {"swin": 1.0}), "unknown coordinate 'swin'"),
        (lambda s: accelerations(s, {"push": 1.0}), "unknown input 'push'"),
        (lambda s: simulate(s, [0.0, 1.0], {"push": 1.0}), "unknown input 'push'"),
        (lambda s: simulate(s, [0.0, 1.0], method="Euler"), "unknown method 'Euler'"),
        (lambda s: simulate(s, [0.0, 0.0]), "times: at least two, increasing"),
        (lambda s: linearise(s, outputs=["swin'"]), "unknown output"),
        (lambda s: linearise(s, keep=["swin"]), "unknown independent coordinate 'swin'"),
        (lambda s: linearise(assemble(s.model, {"swing": 0.5})), "not a steady motion: swing accelerates"),
        (lambda s: linearise(move(s, {"swing": 2.0})), "not a steady motion"),
        (lambda s: linearise(s).select(["swin"]), "unknown speed 'swin'"),
        (lambda s: steady_motion(s.model, resting=["swin"]), "unknown independent coordinate 'swin'"),
        (lambda s: steady_motion(s.model, rates={"swin": 0}, resting=["swing"]), "unknown independent speed 'swin'"),
        (lambda s: steady_motion(s.model, resting=[], adjust=["push"]), "unknown input 'push'"),
        (lambda s: steady_motion(s.model, {"swing": 0.5}, resting=["swing"]), "no steady motion found"),
    ],
)
def test_questions_about_names_that_do_not_exist(act: Any, says: Any) -> None:
    with pytest.raises(ModelError, match=says):
        act(assemble(build(System((BOB,), (SWING,)))))


def test_a_sensor_of_no_known_kind_is_refused() -> None:
    with pytest.raises(ModelError, match="sensor gyro: unknown kind 'smell'"):
        build(System((BOB,), (SWING,), sensors=(Sensor("gyro", "bob", kind="smell"),)))


def test_every_joint_has_its_freedoms() -> None:
    made = {
        fixed("j", GROUND, "bob"): 0,
        revolute("j", GROUND, "bob", ORIGIN, Y): 1,
        prismatic("j", GROUND, "bob", Y): 1,
        cylindrical("j", GROUND, "bob", ORIGIN, Y): 2,
        universal("j", GROUND, "bob", ORIGIN, (Y, (1, 0, 0))): 2,
        spherical("j", GROUND, "bob", ORIGIN): 3,
        planar("j", GROUND, "bob", ORIGIN, normal=Y, along=(1, 0, 0)): 3,
        free("j", GROUND, "bob"): 6,
    }
    assert {joint: len(joint.coordinates) for joint in made} == made
