"""Units at the edge."""

from __future__ import annotations

import contextlib
from math import isnan, radians

import pytest
from hypothesis import given
from hypothesis import strategies as st

from singletrack import InputError
from singletrack.parameters.units import COMMON_FACTORS, Quantity, parse_quantity, pint_factor


@pytest.mark.parametrize(
    ("text", "unit", "value"),
    [
        ("290 mm", "m", 0.29),
        ("29 cm", "m", 0.29),
        ("0.29", "m", 0.29),
        (0.29, "m", 0.29),
        (1, "kg", 1.0),
        ("63.9 deg", "rad", radians(63.9)),
        ("63.9°", "rad", radians(63.9)),
        ("1.1 rad", "rad", 1.1),
        ("250 g", "kg", 0.25),
        ("9.81 N/kg", "m/s**2", 9.81),
        ("9.81 m/s^2", "m/s**2", 9.81),
        ("0.05 kg*m^2", "kg*m**2", 0.05),
        ("0.05 kg m²", "kg*m**2", 0.05),
        ("0.05 kg·m²", "kg*m**2", 0.05),
        ("6.8 %", "", 0.068),
        ("  1e-3 km ", "m", 1.0),
    ],
)
def test_values(text, unit, value):
    assert parse_quantity(text, unit).value == pytest.approx(value, rel=1e-15)


@pytest.mark.parametrize("text", ["0.0563 +/- 0.0017 m", "0.0563±0.0017 m", "0.0563+/-0.0017", "56.3 +/- 1.7 mm"])
def test_uncertainty(text):
    quantity = parse_quantity(text, "m")
    assert (quantity.value, quantity.deviation) == (pytest.approx(0.0563), pytest.approx(0.0017))


@pytest.mark.parametrize(
    ("text", "unit", "reason"),
    [
        ("16.9 m", "rad", "no angle"),
        ("0.3 rad", "m", "no length"),
        ("5 kg", "m", "no length"),
        ("5 m", "kg", "no mass"),
        ("5 kg", "", "plain number"),
        ("5 furlong", "m", "unknown unit"),
        ("5 m**9**9**9", "m", "unknown unit"),
        ("5 __import__", "m", "unknown unit"),
        ("", "m", "not a number"),
        ("wide", "m", "not a number"),
        ("1,5 m", "m", "unknown unit"),
        (True, "m", "not a number"),
        ([1.0], "m", "not a number"),
        (None, "m", "not a number"),
        ("1 +/- -2 m", "m", "standard deviation"),
        (10**400, "m", "too large"),
        ("1e400", "m", "'1e400' is too large"),
        ("1e308 km", "m", "'1e308 km' is too large"),
        ("1 +/- 1e400 m", "m", "standard deviation"),
        ("৪.৪ m", "m", "digits other than 0 to 9"),
        ("1.٤ m", "m", "digits other than 0 to 9"),
        ("１ m", "m", "digits other than 0 to 9"),
        ("1_000 mm", "m", "unknown unit"),
    ],
)
def test_refusals(text, unit, reason):
    with pytest.raises(InputError, match=reason):
        parse_quantity(text, unit)


@pytest.mark.parametrize(("text", "unit"), COMMON_FACTORS)
def test_common_factors_are_those_of_pint(text, unit):
    assert COMMON_FACTORS[text, unit] == pint_factor("", text, unit)


def test_nan_is_left_to_the_record():
    assert isnan(parse_quantity("nan", "m").value)


@given(st.floats(allow_nan=False, allow_infinity=False))
def test_bare_numbers_keep_every_digit(number):
    assert parse_quantity(repr(number), "m") == Quantity(number)
    assert parse_quantity(number, "m") == Quantity(number)


@given(st.integers(-10_000_000, 10_000_000))
def test_millimetres_are_exact(millimetres):
    assert parse_quantity(f"{millimetres} mm", "m").value == millimetres / 1000


@given(st.text(max_size=40))
def test_any_text_is_read_or_refused(text):
    with contextlib.suppress(InputError):
        parse_quantity(text, "m")
