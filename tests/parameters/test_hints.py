"""Words of geometry sheets are answered with what to give instead."""

from __future__ import annotations

import math
import re

import pytest
from hypothesis import given
from hypothesis import strategies as st

from singletrack import Bicycle, InputError, load_bicycle, load_rider
from singletrack.parameters.hints import _OTHERWISE, unknown_parameter

STRATOS = load_bicycle("stratos")


@pytest.mark.parametrize(
    ("name", "says"),
    [
        ("head_angle", "steer_axis_tilt = 90 deg - head angle"),
        ("Head Angle", "steer_axis_tilt = 90 deg - head angle"),
        ("head-tube-angle", "steer_axis_tilt = 90 deg - head angle"),
        ("rake", "give trail = (front_wheel_radius"),
        ("wheelbase", "did you mean wheel_base?"),
        ("axle-to-crown", "did you mean fork_length?"),
        ("front_center", "give wheel_base = front centre"),
        ("stack", "where the head tube ends"),
        ("reach", "where the head tube ends"),
    ],
)
def test_words_of_geometry_sheets(name, says):
    with pytest.raises(InputError, match=re.escape(says)) as caught:
        STRATOS.replace(**{name: 1.0})
    assert caught.value.parameters == (name,)


def test_every_hint_names_parameters_that_exist():
    for advice in _OTHERWISE.values():
        named = re.findall(r"[a-z]+_[a-z_]+", advice)
        assert named == [] or set(named) <= set(Bicycle.descriptions()), advice


def test_the_formulas_of_the_hints_are_those_of_the_shipped_geometry():
    """What the hints say, applied to a sheet made from the Stratos, gives the Stratos."""
    b = STRATOS
    offset = b.front_wheel_radius * math.sin(b.steer_axis_tilt) - b.trail * math.cos(b.steer_axis_tilt)
    mechanical = b.trail * math.cos(b.steer_axis_tilt)
    sheet = {"rake": offset, "mechanical trail": mechanical}
    tilt = math.radians(90 - (90 - math.degrees(b.steer_axis_tilt)))
    assert (b.front_wheel_radius * math.sin(tilt) - sheet["rake"]) / math.cos(tilt) == pytest.approx(b.trail)
    assert sheet["mechanical trail"] / math.cos(tilt) == pytest.approx(b.trail)


def test_a_rider_has_no_head_angle():
    with pytest.raises(InputError, match="unknown rider parameter 'head_angle'"):
        load_rider("rider-a").replace(head_angle=1.0)


@given(st.text())
def test_any_name_is_answered_in_one_short_line(name):
    text = str(unknown_parameter("bicycle", name, Bicycle.descriptions()))
    assert len(text) < 500
    assert "\n" not in text
