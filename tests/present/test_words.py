"""Critical speeds in words: one way everywhere."""

from __future__ import annotations

import dataclasses
import math

import numpy as np
import pytest

from designs import shipped_model
from singletrack.present.words import critical_speed_lines, range_text, speed_text


def test_directions_are_said_where_they_are_not_the_usual_ones():
    usual = critical_speed_lines(shipped_model("stratos", "rigid").critical_speeds())
    assert "stability" not in "".join(usual.values())
    model = shipped_model("stratos", "upright")
    critical = model.critical_speeds()
    assert critical.crossings
    lines = critical_speed_lines(critical)
    for crossing in critical.crossings:
        before, after = ((model.eigenvalues(crossing.speed + step).real > 0).sum() for step in (-1e-6, 1e-6))
        assert (crossing.direction == "gained") == (after < before)
        words = f"{crossing.speed:.3f} m/s"
        usual = {"weave": "gained", "capsize": "lost"}[crossing.mode]
        if crossing.direction != usual:
            words += f" (stability {crossing.direction})"
        assert words in lines[f"{crossing.mode} speed"]
    assert any("stability" in line for line in lines.values())


def test_never_and_could_not_tell_differ():
    assert set(critical_speed_lines(shipped_model("browser", "upright").critical_speeds()).values()) == {"never"}
    unknown = dataclasses.replace(shipped_model("stratos", "rigid").critical_speeds(), told=np.zeros((), dtype=bool))
    assert set(critical_speed_lines(unknown).values()) == {"could not tell"}


@pytest.mark.parametrize("ends", [(0.0, math.inf), (3.60534, math.inf)])
def test_ranges_without_end(ends):
    assert range_text(*ends) == f"above {ends[0]:.3f} m/s"
    assert speed_text(ends[0]) in range_text(*ends)
