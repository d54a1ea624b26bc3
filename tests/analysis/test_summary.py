"""What follows from a bicycle or a rider, as data."""

from __future__ import annotations

import dataclasses
import functools
import math
import sys

import numpy as np
import pytest

import singletrack.closed_form
from singletrack import coefficients, load_bicycle, load_rider
from singletrack.analysis.outline import outline
from singletrack.analysis.summary import derived, results
from singletrack.body.oddities import frame_oddities
from singletrack.body.reach import seat_oddities
from singletrack.commands import show
from singletrack.commands.model_options import ModelOptions
from singletrack.present.sketch import side_view


def by_name(record):
    return {quantity.name: quantity for quantity in derived(record)}


def test_a_bicycles_quantities_are_those_of_its_points():
    bicycle = load_bicycle("stratos")
    found = by_name(bicycle)
    (offset,), (trail,) = found["fork offset"].values, found["mechanical trail"].values
    # The steer axis, a line through the ground point ahead of the contact by the trail, and its distances.
    tilt = float(bicycle.steer_axis_tilt)
    foot = np.array([bicycle.wheel_base + bicycle.trail, 0.0])
    normal = np.array([math.cos(tilt), math.sin(-tilt)])
    hub, contact = np.array([bicycle.wheel_base, -bicycle.front_wheel_radius]), np.array([bicycle.wheel_base, 0.0])
    assert offset == pytest.approx((hub - foot) @ np.array([math.cos(tilt), -math.sin(tilt)]))
    assert trail == pytest.approx(-(contact - foot) @ normal)
    assert sum(found["load on wheels"].values) == pytest.approx(found["total mass"].values[0] * bicycle.gravity)
    # Moments about the rear contact balance.
    assert found["load on wheels"].values[1] * bicycle.wheel_base == pytest.approx(
        found["total mass"].values[0] * bicycle.gravity * found["centre of mass"].values[0]
    )


def test_principal_moments_are_eigenvalues_of_the_tensor():
    bicycle = load_bicycle("browser")
    found = by_name(bicycle)
    b = bicycle
    tensor = [
        [b.rear_frame_inertia_xx, b.rear_frame_inertia_xz],
        [b.rear_frame_inertia_xz, b.rear_frame_inertia_zz],
    ]
    larger, smaller = found["rear frame"].values
    assert [smaller, larger] == pytest.approx(np.linalg.eigvalsh(tensor).tolist())
    (angle,) = found["rear frame axis"].values
    axis = np.array([math.cos(angle), -math.sin(angle)])  # about y: from x towards -z
    np.testing.assert_allclose(np.array(tensor) @ axis, larger * axis, atol=1e-12)


def test_a_riders_segments_weigh_what_the_rider_weighs():
    rider = load_rider("rider-a")
    found = by_name(rider)
    masses = {name: quantity.values[0] for name, quantity in found.items() if name.endswith("mass")}
    total = sum(mass * (2 if "arm" in name or "leg" in name else 1) for name, mass in masses.items())
    assert total == pytest.approx(rider.rider_mass, rel=0.01)
    assert {"lean on stratos", "lean on browser"} <= set(found)


def test_results_have_deviations_only_where_parameters_have():
    bicycle = load_bicycle("stratos")
    plain = results(coefficients(bicycle), bicycle, None, "rigid")
    assert (dict(plain.matrix_deviations), dict(plain.speed_deviations)) == ({}, {})
    uncertain = dataclasses.replace(bicycle, standard_deviations={"trail": 0.002})
    spread = results(coefficients(uncertain), uncertain, None, "rigid")
    assert spread.critical.weave == plain.critical.weave
    # To first order the weave speed changes by its slope times the change of trail.
    moved = [coefficients(bicycle.replace(trail=0.0563 + dx)).critical_speeds().weave[0] for dx in (-1e-5, 1e-5)]
    assert spread.speed_deviations["weave"][0] == pytest.approx(abs(moved[1] - moved[0]) / 2e-5 * 0.002, rel=1e-4)


def test_show_computes_the_coefficients_once(monkeypatch, capsys):
    room = sys.modules[singletrack.closed_form.coefficients.__module__]
    calls = []
    # A single sound design goes through a program; whatever does not, through the equations for arrays.
    usual = room.single_design, room.by_arrays

    def counted(maker, *arguments):
        calls.append(arguments)
        return maker(*arguments)

    monkeypatch.setattr(room, "single_design", functools.partial(counted, usual[0]))
    monkeypatch.setattr(room, "by_arrays", functools.partial(counted, usual[1]))
    show.run("stratos", ModelOptions(rider="rider-a", posture="leaned"))
    assert "weave speed" in capsys.readouterr().out
    assert len(calls) == 1


def test_oddities_of_seat_and_frame():
    stratos, rider = load_bicycle("stratos"), load_rider("rider-a")
    assert frame_oddities(stratos) == seat_oddities(stratos, rider.on(stratos)) == ()
    (odd,) = frame_oddities(stratos.replace(trail=1.2))
    assert odd.parameter == "fork_length"
    assert "no rider can be seated" in odd.text
    short = rider.on(stratos).replace(lower_arm_length=0.993 * rider.lower_arm_length)
    assert any("barely within reach" in oddity.text for oddity in seat_oddities(stratos, short))


@pytest.mark.parametrize(
    "changes",
    [{"trail": 1.2}, {"fork_length": 0.04}, {"rear_frame_z": -99.0}, {"rear_frame_x": 99.0}, {"wheel_base": 1e-6}],
    ids=str,
)
def test_absurd_bicycles_are_drawn_small(changes):
    drawing = side_view(outline(load_bicycle("stratos").replace(**changes)))
    assert len(drawing) < 10_000
    assert max(map(len, drawing.splitlines())) <= 64
