"""What one design costs, in calls: Python's own and those of compiled functions; times are for benchmarks.

Bounds are a tenth above what there is. Who makes a path longer on purpose raises its bound and says why; who makes it
shorter lowers it.
"""

from __future__ import annotations

import functools
import sys
from typing import Any

import numpy as np
import pytest

from calls import calls_of
from singletrack import Bicycle, Rider, coefficients, load_bicycle, load_rider
from singletrack.linear.quartic import solve as quartic

SPEEDS = np.linspace(0.0, 10.0, 1001)


@pytest.fixture(autouse=True)
def no_jax(monkeypatch: pytest.MonkeyPatch) -> None:
    """Whether another test has loaded JAX, whose arrays are then looked for, is no matter here."""
    monkeypatch.setitem(sys.modules, "jax", None)


def given(record: Bicycle | Rider) -> dict[str, Any]:
    return {name: getattr(record, name) for name in type(record).__dataclass_fields__ if name in record.__dict__}


BROWSER = load_bicycle("browser")
BICYCLE, RIDER = given(BROWSER), given(load_rider("rider-a").on(BROWSER))
#: From numbers to the model: of a bicycle alone, and of riders by posture; 6000 for the upright one in version 0.1.
MOST = {"": 250, "rigid": 430, "upright": 440, "leaned": 440}


@pytest.mark.parametrize("posture", MOST)
def test_one_design_from_numbers_to_matrices(posture: str) -> None:
    def anew() -> Any:
        rider = Rider(**RIDER) if posture else None
        return coefficients(Bicycle(**BICYCLE), rider, posture or "rigid")

    assert calls_of(anew) <= MOST[posture]


def test_records_are_made_and_changed() -> None:
    assert calls_of(lambda: (Bicycle(**BICYCLE), Rider(**RIDER))) <= 145
    assert calls_of(lambda: BROWSER.replace(trail=0.05)) <= 98


def test_eigenvalues_of_a_thousand_speeds(monkeypatch: pytest.MonkeyPatch) -> None:
    """As many calls as for ten speeds: no loop over them."""
    monkeypatch.setattr(quartic._Kernel, "compiled", None)
    monkeypatch.setattr(quartic._Kernel, "solved", 0)
    model = coefficients(Bicycle(**BICYCLE), Rider(**RIDER), "upright")
    many, few = (calls_of(functools.partial(model.eigenvalues, speeds)) for speeds in (SPEEDS, SPEEDS[:10]))
    assert many == few
    assert many <= 420
