"""Geometry from a sheet: against the skeleton, in circles, and where it contradicts itself."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from singletrack import InputError, catalogue, load_bicycle
from singletrack.body.skeleton import frame_points
from singletrack.catalogue.geometry import resolve
from singletrack.catalogue.points import points_of
from singletrack.catalogue.sheet import Sheet, tyre_size

BASE = {"head_angle": "70 deg", "fork_offset": "50 mm", "wheel_size": "37-622", "wheel_base": "1.08 m"}


def geometry(**entries):
    return resolve(Sheet.of(entries), lambda: np.zeros(3))


def value(name, **entries):
    return float(geometry(**entries).values[name][0])


def test_trail_of_a_printed_chart():
    # Surly Cross-Check, 56 cm: 72 deg, 44 mm, its chart's tyre of 41 mm rolls on 352 mm: trail 67 to 69 mm.
    trail = value(
        "trail",
        head_angle="72 deg",
        fork_offset="44 mm",
        front_wheel_radius=0.352,
        rear_wheel_radius=0.352,
        wheel_base=1.0,
    )
    assert trail == pytest.approx((0.352 * math.cos(math.radians(72)) - 0.044) / math.sin(math.radians(72)))
    assert 0.066 < trail < 0.070


@settings(max_examples=25)
@given(
    tilt=st.floats(0.2, 0.5),
    trail=st.floats(0.02, 0.1),
    radius=st.floats(0.28, 0.37),
    base=st.floats(0.95, 1.2),
    stay=st.floats(0.41, 0.48),
    drop=st.floats(0.02, 0.08),
    stack=st.floats(0.52, 0.7),
)
def test_each_way_to_say_it_gives_the_same_bicycle(tilt, trail, radius, base, stay, drop, stack):
    wheels = {"rear_wheel_radius": radius, "front_wheel_radius": radius}
    known = {"chain_stay_length": stay, "bottom_bracket_drop": drop}
    offset = radius * math.sin(tilt) - trail * math.cos(tilt)
    bracket = math.sqrt(stay**2 - drop**2)
    centre = math.hypot(base - bracket, drop)
    reach = base + trail - (radius - drop + stack) * math.tan(tilt) - bracket
    first = geometry(steer_axis_tilt=tilt, trail=trail, wheel_base=base, **wheels, **known)
    for other in (
        {"head_angle": math.pi / 2 - tilt, "fork_offset": offset, "front_centre": centre},
        {"trail": trail, "fork_offset": offset, "wheel_base": base},
        {"steer_axis_tilt": tilt, "trail": trail, "stack": stack, "reach": reach if reach > 0 else None},
    ):
        if other.get("reach", 0) is None:
            continue
        second = geometry(**other, **wheels, **known)
        for name in ("trail", "steer_axis_tilt", "wheel_base", "bottom_bracket_height"):
            assert second.values[name][0] == pytest.approx(first.values[name][0], abs=1e-9)


@pytest.mark.parametrize("name", ["stratos", "browser"])
def test_points_are_those_of_the_skeleton(name):
    bicycle = load_bicycle(name)
    grip = frame_points(bicycle)[19]
    told = (
        "wheel_base",
        "trail",
        "steer_axis_tilt",
        "rear_wheel_radius",
        "front_wheel_radius",
        "bottom_bracket_height",
        "chain_stay_length",
        "fork_length",
        "seat_tube_angle",
        "seat_tube_length",
    )
    sheet = {key: getattr(bicycle, key) for key in told}
    sheet |= {
        "saddle_height": bicycle.seat_tube_length + bicycle.seat_post_length,
        "grip_x": grip[0],
        "grip_height": -grip[2],
    }
    found = geometry(**{key: float(entry) for key, entry in sheet.items()})
    points, theirs = points_of(found), frame_points(bicycle)
    pairs = {"rear hub": 2, "bottom bracket": 5, "front hub": 7, "seat tube top": 10, "crown": 11, "saddle": 13}
    for point, number in pairs.items():
        np.testing.assert_allclose(points[point][0], theirs[number], atol=1e-9)
    for length in ("stem_length", "handlebar_length", "seat_post_length"):
        assert found.values[length][0] == pytest.approx(getattr(bicycle, length), abs=1e-9)


def test_low_grips_are_below_a_short_stem():
    made = catalogue.bicycle(**BASE, grip_height="0.75 m", grip_x="0.75 m")
    grip = frame_points(made)[19]
    assert float(made.stem_length) == pytest.approx(0.02, abs=1e-3)
    np.testing.assert_allclose(grip, [0.75, 0.0, -0.75], atol=2e-3)


@pytest.mark.parametrize(
    ("entries", "both"),
    [
        ({"trail": "60 mm"}, ("trail", "60.0 mm", "71.4 mm")),
        ({"steer_axis_tilt": "25 deg"}, ("steer_axis_tilt", "25.00 deg", "20.00 deg")),
        (
            {"front_centre": "0.60 m", "chain_stay_length": "445 mm", "bottom_bracket_drop": "60 mm"},
            ("wheel_base", "1080.0 mm", "1037.9 mm"),
        ),
        (
            {"bottom_bracket_drop": "60 mm", "bottom_bracket_height": "300 mm"},
            ("bottom_bracket_height", "300.0 mm", "282."),
        ),
        ({"front_wheel_radius": "0.30 m"}, ("front_wheel_radius", "300.0 mm", "342.")),
    ],
)
def test_contradictions_are_shown_with_both_values(entries, both):
    with pytest.raises(InputError) as caught:
        catalogue.bicycle(**BASE, **entries)
    assert all(part in str(caught.value) for part in both), str(caught.value)
    assert both[0] in caught.value.parameters


def test_rounding_of_a_chart_is_no_contradiction():
    catalogue.bicycle(**BASE, trail="69 mm")


@pytest.mark.parametrize(
    ("entries", "text"),
    [
        ({"wheel_base": None}, "wheel_base"),
        ({"wheel_size": None}, "wheel_size"),
        ({"head_angle": None}, "head_angle"),
        ({"wheel_size": "28 x 1.75"}, "37-622"),
        ({"wheel_size": 622}, "must be text"),
        ({"bar": "butterfly"}, "drop"),
        ({"head_angle": "700 deg"}, "at most 90 deg"),
        ({"head_angle": "70 +/- 30 deg"}, "at most 5.7 deg"),
        ({"stack": "-1 m"}, "greater than zero"),
        ({"stack": "5 kg"}, "no length"),
        ({"stak": "0.6 m"}, "did you mean stack"),
        ({"chain_stay_length": "20 mm"}, "bracket"),
        ({"saddle_height": "0.4 m", "seat_tube_length": "0.5 m"}, "not above"),
        ({"total_mass": "nan kg"}, "finite"),
    ],
)
def test_what_is_wrong_is_told(entries, text):
    with pytest.raises(InputError, match=text):
        catalogue.bicycle(**{**BASE, **entries})


def test_tyre_sizes():
    assert tyre_size(" 50-559 ") == (0.05, 0.559)
    # A loaded 37-622 rolls some 2.15 m in a turn.
    assert 2.13 < 2 * math.pi * value("front_wheel_radius", **BASE) < 2.17
