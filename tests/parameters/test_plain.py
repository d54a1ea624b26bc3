"""The short way through validation lets nothing pass that the long way refuses, and takes the usual numbers."""

from __future__ import annotations

from math import inf, nan, nextafter

import pytest
from hypothesis import given
from hypothesis import strategies as st

from singletrack import Bicycle, InputError, Rider, load_bicycle, load_rider
from singletrack.parameters.description import faults_of_value
from singletrack.parameters.plausibility import USUAL

DESCRIBED = {f"{record.kind} {name}": p for record in (Bicycle, Rider) for name, p in record.descriptions().items()}


def is_sound(value: float, name: str) -> bool:
    return not [fault for fault in faults_of_value("it", value, DESCRIBED[name]) if fault.bad.any()]


@pytest.mark.parametrize("name", DESCRIBED)
def test_the_plain_range_ends_where_faults_begin(name: str) -> None:
    low, high = DESCRIBED[name].plain
    assert low < high
    assert is_sound(low, name)
    assert is_sound(high, name)
    assert not is_sound(nextafter(high, inf), name)
    below = nextafter(low, -inf)
    assert not is_sound(below, name)


@given(name=st.sampled_from(sorted(DESCRIBED)), value=st.floats(allow_nan=True, allow_infinity=True))
def test_outside_of_the_plain_range_only_zero_is_sound(name: str, value: float) -> None:
    low, high = DESCRIBED[name].plain
    assert is_sound(value, name) == (low <= value <= high) or value == 0


@pytest.mark.parametrize("record", [load_bicycle("stratos"), load_rider("rider-a")], ids=lambda record: record.kind)
@pytest.mark.parametrize("value", [nan, inf, -inf, 1e300])
def test_no_record_is_made_of_a_number_that_is_none(record: Bicycle | Rider, value: float) -> None:
    for name in record.values():
        with pytest.raises(InputError, match=name):
            record.replace(**{name: value})


def test_what_is_usual_is_plain() -> None:
    for name, (low, high) in USUAL.items():
        for key in (f"bicycle {name}", f"rider {name}"):
            if key in DESCRIBED:
                least, most = DESCRIBED[key].plain
                assert least <= max(low, least) <= high <= most
