"""Numbers of a ride or a turn from Python: one real number each, within what is ridden, or refused by name."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from singletrack import InputError, load_bicycle, turn
from singletrack.public.riding import ride_for

NONE: tuple[Any, ...] = (
    True,
    "5",
    5 + 0j,
    np.array([5.0, 6.0]),
    np.ma.masked_array(5.0, mask=True),
    [5.0],
    {},
    1e308,
    np.inf,
    np.nan,
)
BENCHMARK = load_bicycle("benchmark")


@pytest.mark.parametrize("value", NONE, ids=repr)
def test_what_is_no_speed(value: Any) -> None:
    with pytest.raises(InputError, match=r"^speed: found .* must be a number from -1000 to 1000 m/s"):
        turn(BENCHMARK, speed=value, lean=0.1)
    with pytest.raises(InputError, match=r"^speed: "):
        ride_for(BENCHMARK, speed=value, duration=0.1)


@pytest.mark.parametrize("name", ["push", "lean", "duration"])
@pytest.mark.parametrize("value", NONE, ids=repr)
def test_what_starts_no_ride(name: str, value: Any) -> None:
    given = {"duration": 0.1} | {name: value}
    with pytest.raises(InputError, match=rf"^{name}: "):
        ride_for(BENCHMARK, speed=5.0, **given)


@pytest.mark.parametrize("name", ["lean", "radius"])
def test_what_is_no_turn(name: str) -> None:
    for value in NONE:
        with pytest.raises(InputError, match=rf"^{name}: "):
            turn(BENCHMARK, speed=5.0, **{name: value})


@pytest.mark.parametrize("kind", [np.float32, np.float16, np.float64, int])
def test_numbers_of_any_precision_are_computed_in_double(kind: type) -> None:
    assert turn(BENCHMARK, speed=kind(5), lean=0.125).to_dict() == turn(BENCHMARK, speed=5.0, lean=0.125).to_dict()
