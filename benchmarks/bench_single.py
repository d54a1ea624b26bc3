"""One design, made anew from numbers each time: matrices, and eigenvalues at 1001 speeds, as ratios in one run.

Run with ``make benchmark`` or ``pytest benchmarks/bench_single.py --benchmark-enable -n 0``; the table is at the end.
What it may cost in calls is tested (tests/closed_form/test_calls.py).
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
import pytest

import peers
from singletrack import Bicycle, Rider, coefficients, load_bicycle, load_rider
from singletrack.closed_form.coefficients import by_arrays
from singletrack.closed_form.programs import program_of
from singletrack.closed_form.single import single_design
from singletrack.linear.quartic import solve as quartic
from singletrack.posture import Options

if TYPE_CHECKING:
    from collections.abc import Callable

SPEEDS = np.linspace(0.0, 10.0, 1001)
BROWSER = load_bicycle("browser")
RIDER = load_rider("rider-a").on(BROWSER)


def given(record: Bicycle | Rider) -> dict[str, Any]:
    """Return what a record is made from."""
    return {name: getattr(record, name) for name in type(record).__dataclass_fields__ if name in record.__dict__}


def maker(posture: str) -> Callable[[], Any]:
    """Return a function that makes records and model anew."""
    bicycle, rider = given(BROWSER), given(RIDER)
    return lambda: coefficients(Bicycle(**bicycle), Rider(**rider) if posture else None, posture or "rigid")


@pytest.mark.parametrize("posture", ["rigid", "upright", "leaned"])
def test_from_numbers_to_matrices(compare: Any, posture: str) -> None:
    options = Options(posture)
    bicycle = load_bicycle("stratos") if posture == "leaned" else BROWSER
    own, theirs = given(bicycle), given(load_rider("rider-a").on(bicycle))
    compare(
        lambda: coefficients(Bicycle(**own), Rider(**theirs), posture),
        lambda: by_arrays(Bicycle(**own), Rider(**theirs), options),
        names=(f"one {posture} rider from numbers to matrices", "the same by the equations for arrays"),
        repeat=40,
        pairs=15,
    )


def test_parts_of_one_design(compare: Any) -> None:
    """How much of a design is arithmetic: the program alone against all around it."""
    options = Options("upright")
    program = program_of(BROWSER, RIDER, options)
    assert program is not None
    values = BROWSER.values() | RIDER.values() | {"handlebar_drop": 0.0}
    values |= dict(zip(("torso_width", "torso_thickness"), RIDER.torso_section, strict=True))
    inputs = [values[name] for name in (*program.of_bicycle, *program.of_rider)]
    run = program.function()
    for work, name in (
        (lambda: single_design(BROWSER, RIDER, options), "the model of two records"),
        (maker("upright"), "records, oddities and model"),
    ):
        compare(lambda: run(*inputs), work, names=("the program of one upright rider", name), repeat=200, pairs=15)


@pytest.mark.parametrize("kernel", ["numba", "NumPy alone"])
@pytest.mark.parametrize("posture", ["upright", ""])
def test_1001_speeds_anew(compare: Any, kernel: str, posture: str, monkeypatch: pytest.MonkeyPatch) -> None:
    if kernel == "numba":
        pytest.importorskip("numba")
        quartic.use_compiled()
    else:
        monkeypatch.setattr(quartic._Kernel, "compiled", None)  # noqa: SLF001
        monkeypatch.setattr(quartic, "_WORTH_COMPILING", np.inf)
    make, model = maker(posture), peers.model(BROWSER)
    if not posture:
        expected = np.sort_complex(model.calc_eigen(v=SPEEDS)[0])
        np.testing.assert_allclose(expected, make().eigenvalues(SPEEDS), rtol=1e-8)
    compare(
        lambda: make().eigenvalues(SPEEDS),
        lambda: model.calc_eigen(v=SPEEDS),
        names=(f"1001 speeds of {'an upright rider' if posture else 'a bicycle'}, anew, {kernel}", "their calc_eigen"),
        target="40",
        repeat=10,
        pairs=15,
    )
