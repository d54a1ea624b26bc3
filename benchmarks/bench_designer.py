"""A designer's questions, as ratios in one run: derivatives against differences, batches against one by one, and cores.

Run with ``pytest benchmarks/bench_designer.py --benchmark-enable -n 0``.
"""

from __future__ import annotations

import multiprocessing
import time
from concurrent.futures import ProcessPoolExecutor, ThreadPoolExecutor
from typing import Any

import numpy as np
import pytest

from singletrack import load_bicycle, load_rider
from singletrack.analysis.derivatives import derivatives_of
from singletrack.analysis.designs import Design
from singletrack.analysis.sheet_designs import SheetDesign
from singletrack.analysis.sobol import design_results
from singletrack.catalogue import estimate, expected
from singletrack.linear import critical_speeds

DESIGN = Design.of(load_bicycle("browser"), load_rider("rider-a"), "upright")
#: Has a weave speed, which the upright rider has not.
LEANED = Design.of(load_bicycle("stratos"), load_rider("rider-a"), "leaned")
NAMES = tuple(LEANED.values())
RANGED = ("trail", "steer_axis_tilt", "wheel_base", "torso_length", "handlebar_length")
RESULTS = design_results(DESIGN, RANGED, 5.0)
SHEET = {"head_angle": "69 deg", "fork_offset": "50 mm", "wheel_size": "37-622", "wheel_base": "1.10 m"}
CORES = 2


def points(count: int) -> np.ndarray:
    """Designs within 2 % of the first."""
    own = np.array([float(DESIGN.values()[name]) for name in RANGED])
    return own * np.random.default_rng(2).uniform(0.98, 1.02, (count, len(RANGED)))


def differences() -> np.ndarray:
    """Derivatives of the critical speeds by central differences, each design by itself, as one would without us."""
    own, h, rows = LEANED.values(), 1e-6, []
    for name in NAMES:
        ends = [critical_speeds(LEANED.changed({name: float(own[name]) + step}).model()) for step in (h, -h)]
        rows.append((ends[0].weave_speeds - ends[1].weave_speeds) / (2 * h))
    return np.array(rows)


def test_exact_derivatives_of_every_parameter_against_differences(compare: Any) -> None:
    def exact() -> Any:
        slopes = derivatives_of(LEANED, NAMES)
        return slopes.critical_speeds(critical_speeds(slopes.model).weave_speeds[:1], "weave")

    found = compare(
        exact, differences, names=(f"derivatives to {len(NAMES)} parameters, exact", "central differences"), target="5"
    )
    assert found > 5


def test_designs_of_a_sobol_study_in_one_batch_against_one_by_one(compare: Any) -> None:
    many, few = points(2000), points(40)
    found = compare(
        lambda: RESULTS(many),
        lambda: [RESULTS(row[None]) for row in few],
        names=("2000 designs of a Sobol study, one batch", "40 of them one by one"),
        target="1, which is 50 for each design",
        pairs=5,
    )
    assert found > 1


def test_a_sheet_that_changes_against_estimating_it_anew(compare: Any) -> None:
    design = SheetDesign.of_sheet(expected(**SHEET))
    found = compare(
        lambda: derivatives_of(design, tuple(design.entries)),
        lambda: [estimate(**SHEET) for _ in range(2)],
        names=("derivatives to all entries of a geometry sheet", "its estimate twice: one difference"),
        target="2",
        pairs=5,
    )
    assert found > 2


def _part(k: int) -> float:
    return float(np.nansum(RESULTS(points(8000)[k::CORES])["growth at 5 m/s"]))


@pytest.mark.parametrize("kind", ["threads", "processes"])
def test_cores(compare: Any, kind: str) -> None:
    """By the clock, so with nothing else running it says something; noted, not asserted."""
    if kind == "threads":
        pool: Any = ThreadPoolExecutor(CORES)
    else:
        pool = ProcessPoolExecutor(CORES, mp_context=multiprocessing.get_context("fork"))
    with pool:
        compare(
            lambda: list(pool.map(_part, range(CORES))),
            lambda: [_part(k) for k in range(CORES)],
            names=(f"8000 designs of a Sobol study, two {kind}", "one after the other (clock)"),
            pairs=5,
            clock=time.perf_counter,
        )
