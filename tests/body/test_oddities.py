"""What looks odd is a Python warning, once for each record, pointing at the program's own line."""

from __future__ import annotations

import warnings
from math import radians

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from singletrack import InputError, OddityWarning, coefficients, load_bicycle, load_rider
from singletrack.body.oddities import warn_of_oddities
from singletrack.body.reach import reach
from singletrack.body.skeleton import skeleton
from singletrack.library import shipped
from singletrack.parameters.plausibility import oddities

STRATOS, RIDER = load_bicycle("stratos"), load_rider("rider-a")


def said_of(*arguments):
    with warnings.catch_warnings(record=True, action="always") as said:
        coefficients(*arguments)
    return [warning for warning in said if warning.category is OddityWarning]


@pytest.mark.parametrize(
    ("changes", "parameter", "found", "expected"),
    [
        ({"trail": 60.0}, "trail", 60.0, "0 to 0.3 m"),
        ({"steer_axis_tilt": radians(72)}, "steer_axis_tilt", radians(72), "less than 45 deg"),
        ({"wheel_base": 4.0}, "wheel_base", 4.0, "0.5 to 3 m"),
    ],
)
def test_an_odd_bicycle_is_warned_about_once(changes, parameter, found, expected):
    bicycle = STRATOS.replace(**changes)
    warning, *others = said_of(bicycle)
    assert {other.message.parameter for other in others} <= {"fork_length"}  # which does not span such a trail
    message = warning.message
    assert (message.name, message.parameter, message.found, message.expected) == ("stratos", parameter, found, expected)
    assert str(message).startswith(f"stratos: {parameter} = ")
    assert warning.filename == __file__
    assert said_of(bicycle) == []
    assert said_of(bicycle.replace(**changes)) != []


def test_an_odd_rider_is_warned_about_once():
    rider = RIDER.replace(head_mass_fraction=0.4)
    found = [warning.message.parameter for warning in said_of(STRATOS, rider)]
    assert found == ["head_mass_fraction", "head_mass_fraction"]  # its size, and the sum of all
    assert said_of(STRATOS, rider) == []
    assert said_of(load_bicycle("browser"), rider) == []


def test_limbs_that_barely_reach_are_told_for_each_bicycle():
    share = float(reach(skeleton(STRATOS, RIDER), RIDER)["arm"])
    short = RIDER.replace(
        **{f"{part}_arm_length": getattr(RIDER, f"{part}_arm_length") * share / 0.999 for part in ("upper", "lower")}
    )
    (warning,) = said_of(STRATOS, short)
    assert str(warning.message).startswith("rider-a on stratos: the grip is barely within reach")
    assert said_of(STRATOS, short) == []
    assert said_of(load_bicycle("browser"), short) == []


def test_batches_are_left_alone():
    assert said_of(STRATOS.replace(trail=np.array([60.0, 61.0]))) == []
    assert said_of(STRATOS, RIDER.replace(head_mass_fraction=np.array([0.4]))) == []


@pytest.mark.parametrize("name", shipped("bicycle"))
def test_nothing_is_said_of_what_is_shipped(name):
    assert said_of(load_bicycle(name)) == []
    if name in RIDER.forward_lean_angles:
        assert said_of(load_bicycle(name), RIDER, "upright") == []


@given(st.data())
def test_whatever_is_allowed_is_warned_about_or_not_but_never_fails(data):
    """Warnings name parameters that exist, what was found there, and one line of words; batches of one say nothing."""
    base = data.draw(st.sampled_from([STRATOS, RIDER]))
    name = data.draw(st.sampled_from(list(base.descriptions())))
    least, most = base.descriptions()[name].bounds
    size = data.draw(st.floats(max(least, 1e-9), min(most, 1e3)))
    try:
        record = base.replace(**{name: data.draw(st.sampled_from([size, -size]))})
    except InputError:
        return
    with warnings.catch_warnings(record=True, action="always") as said:
        warn_of_oddities(record)
    for warning in said:
        message = warning.message
        assert isinstance(message, OddityWarning)
        assert message.parameter in record.descriptions()
        assert np.isfinite(message.found)
        assert message.expected
        assert "\n" not in str(message)
    assert {oddity.text for oddity in oddities(record)} <= {warning.message.reason for warning in said}
    warn_of_oddities(record.replace(**{name: np.array([getattr(record, name)])}))


@given(st.floats(60.0, 300.0))
def test_millimetres_are_recognised_where_they_make_sense(millimetres):
    (first, *_) = oddities(STRATOS.replace(trail=min(millimetres, 100.0)))
    assert "millimetres written as metres?" in str(first)
    assert "?" not in str(oddities(STRATOS.replace(trail=1.2))[0])
