"""Numbers as they were written."""

from __future__ import annotations

from fractions import Fraction

import pytest

from singletrack import load_bicycle, load_rider
from singletrack.library import shipped
from singletrack.library.load import override
from singletrack.parameters.exact import exact_of_double, exact_quantity, exact_value
from singletrack.parameters.units import parse_quantity


@pytest.mark.parametrize(
    ("text", "unit"),
    [
        ("18.5 deg", "rad"),
        ("290 mm", "m"),
        ("0.0563 +/- 0.0017 m", "m"),
        ("12 in", "m"),
        ("9.81 N/kg", "m/s**2"),
        ("3 kg*m^2", "kg*m**2"),
        ("30 kg cm²", "kg*m**2"),
        ("1.5e-2", "m"),
        ("3.2 lb", "kg"),
        ("35.3 km/h^2", "m/s**2"),
    ],
)
def test_exact_rounds_to_the_double_that_is_read(text, unit):
    assert float(exact_quantity(text, unit)) == pytest.approx(parse_quantity(text, unit).value, rel=4e-16)


def test_units_without_an_exact_size_are_read_first():
    assert exact_quantity("9 dN/kg", "m/s**2").fraction == Fraction(9, 10)
    assert exact_quantity("1e-900 m", "m").fraction == 0


def test_more_digits_than_doubles_have(tmp_path):
    text = shipped("bicycle")["stratos"].read_text(encoding="utf-8")
    file = tmp_path / "long.toml"
    file.write_text(text.replace('trail = "0.0563 m"', "trail = 0.05630000000000000000001"), encoding="utf-8")
    assert exact_value(load_bicycle(file), "trail").fraction == Fraction("0.05630000000000000000001")


def test_what_no_longer_says_the_value_is_not_used():
    bicycle = load_bicycle("stratos")
    assert exact_value(bicycle.replace(trail=0.06), "trail").fraction == Fraction("0.06")
    assert exact_value(override(bicycle, {"trail": "61.5 mm"}), "trail").text == "61.5 mm"
    assert exact_value(bicycle.replace(steer_axis_tilt=0.3), "steer_axis_tilt").pi == 0


def test_lean_on_a_bicycle_keeps_its_text():
    rider = load_rider("rider-a").on(load_bicycle("browser"))
    exact = exact_value(rider, "forward_lean_angle")
    assert exact.pi == 1
    assert float(exact) == pytest.approx(rider.forward_lean_angle, rel=4e-16)


def test_doubles_are_their_shortest_decimals():
    assert exact_of_double(0.1).fraction == Fraction(1, 10)
