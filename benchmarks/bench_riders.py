"""What a free joint costs: matrices of 10 000 riders with torso lean against the same without, as ratios in one run.

Run with ``make benchmark`` or ``pytest benchmarks/bench_riders.py --benchmark-enable -n 0``.
"""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from singletrack import closed_form, load_bicycle, load_rider
from singletrack.posture import Options

COUNT = 10_000


def varied() -> Any:
    """A batch of bicycles and riders, every parameter another."""
    rng = np.random.default_rng(11)
    bicycle = load_bicycle("browser")
    rider = load_rider("rider-a").on(bicycle)

    def moved(record: Any) -> Any:
        values = {
            name: value for name, value in record.values().items() if name != "gravity" and "fraction" not in name
        }
        return record.replace(**{name: value * rng.uniform(0.995, 1.005, COUNT) for name, value in values.items()})

    return moved(bicycle), moved(rider)


@pytest.mark.parametrize("posture", ["upright", "leaned"])
def test_torso_lean_costs_at_most_twice(compare: Any, posture: str) -> None:
    bicycle, rider = varied()
    leaning = Options(posture, torso_lean=True)
    found = compare(
        lambda: closed_form.coefficients(bicycle, rider, posture),
        lambda: closed_form.coefficients(bicycle, rider, leaning),
        names=(f"10 000 {posture} riders", "the same with torso lean"),
        target="at most 2",
    )
    assert found <= 2.0
