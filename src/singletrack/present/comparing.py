"""Tables of designs side by side."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from singletrack.parameters.steps import step_of

if TYPE_CHECKING:
    from collections.abc import Sequence

    from singletrack.analysis.compare import Measure

__all__ = ["measure_rows"]

_KEPT = {"Hz", "1/s", "m/s", "N m/(m/s²)"}


def measure_rows(measures: Sequence[Measure]) -> list[list[str]]:
    """Return a table's rows: name with unit, the value of each design, the differences from the first.

    Parameters
    ----------
    measures : sequence of Measure
    """
    return [_row(one) for one in measures]


def _row(one: Measure) -> list[str]:
    plain = one.unit in _KEPT or one.name.startswith("damping ratio")
    unit, factor = (one.unit, 1.0) if plain else step_of(one.unit)[:2]
    deviations = one.deviations or (math.nan,) * len(one.values)
    apart = one.difference_deviations or tuple(math.hypot(deviations[0], sd) for sd in deviations)
    values = [_told(value * factor, sd * factor) for value, sd in zip(one.values, deviations, strict=True)]
    differences = [
        _told((value - one.values[0]) * factor, sd * factor, sign="+")
        for value, sd in zip(one.values[1:], apart[1:], strict=True)
    ]
    return [f"{one.name} ({unit})" if unit else one.name, *values, *differences]


def _told(value: float, deviation: float, sign: str = "") -> str:
    if math.isnan(value):
        return "none"
    return f"{value:{sign}.4g}" + ("" if math.isnan(deviation) else f" ± {deviation:.2g}")
