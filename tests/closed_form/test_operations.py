"""What many designs cost: operations of each program, passes over arrays, calls; times are for benchmarks.

Who makes a path longer on purpose raises its bound and says why; who makes it shorter lowers it.
"""

from __future__ import annotations

import sys
from functools import partial
from typing import Any

import numpy as np
import pytest

from calls import calls_of
from singletrack import closed_form, load_bicycle, load_rider
from singletrack.arrays import single_thread
from singletrack.closed_form import many
from singletrack.closed_form.generate import structures
from singletrack.closed_form.programs import program_named
from singletrack.linear import critical_speeds, modes
from singletrack.linear.quartic import solve as quartic

#: Operations of one design from its parameters to its matrices: so many passes over an array each.
MOST = {
    "bicycle": 159,
    "rigid": 628,
    "rigid-torso-lean": 649,
    "upright-axial": 1226,
    "upright-axial-torso-lean": 1771,
    "upright-abduction": 1232,
    "upright-abduction-torso-lean": 1777,
    "leaned-straight-abduction": 1550,
    "leaned-straight-abduction-torso-lean": 2292,
    "leaned-bent-abduction": 1666,
    "leaned-bent-abduction-torso-lean": 2408,
    "leaned-bent-axial": 1660,
    "leaned-bent-axial-torso-lean": 2402,
    "rigid-elbows-aside": 677,
    "upright-axial-elbows-aside": 1585,
    "leaned-straight-abduction-elbows-aside": 1568,
}


def test_every_structure_has_its_bound() -> None:
    assert set(MOST) == set(structures())


@pytest.mark.parametrize("name", MOST)
def test_operations_of_a_program(name: str) -> None:
    program = program_named(name)
    assert program is not None
    assert many._tape(program).passes <= MOST[name]


def test_operations_of_a_quartic() -> None:
    assert quartic._tape(quartic._all_at_once, 4).passes <= 344
    assert quartic._tape(quartic._from_ratios, 9).passes <= 355


def riders(count: int) -> Any:
    bicycle = load_bicycle("browser")
    rider = load_rider("rider-a").on(bicycle)
    return bicycle.replace(trail=np.linspace(0.05, 0.06, count)), rider.replace(rider_mass=np.linspace(70, 80, count))


def test_calls_do_not_grow_with_designs_within_a_stretch(monkeypatch: pytest.MonkeyPatch) -> None:
    """No loop over designs or speeds anywhere, however they are asked."""
    monkeypatch.setitem(sys.modules, "jax", None)
    monkeypatch.setattr(quartic._Kernel, "compiled", None)
    monkeypatch.setattr(quartic, "_WORTH_COMPILING", np.inf)
    monkeypatch.setattr(quartic, "_WORTH_RECORDING", np.inf)
    monkeypatch.setattr(many, "_WORTH_RECORDING", np.inf)
    counts = []
    for count in (20, 200):
        batch = riders(count)
        model = closed_form.coefficients(*batch, "upright")
        v = np.linspace(0.5, 10.0, 8)
        with single_thread():
            counts.append(
                (
                    calls_of(partial(closed_form.coefficients, *batch, "upright")),
                    calls_of(partial(modes, model, v)),
                    calls_of(partial(critical_speeds, model)),
                )
            )
    few, more = counts
    assert max(abs(a - b) for a, b in zip(few, more, strict=True)) <= 5  # a meeting of roots more, for some design
    for found, most in zip(more, (1900, 3000, 1250), strict=True):
        assert found <= most
