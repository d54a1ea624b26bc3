"""Matrices and names of very many designs: what a design costs however many there are, and in which way.

Run with ``make benchmark`` or ``pytest benchmarks/bench_designs.py --benchmark-enable -n 0``. A row's first time is
that of the batch, the second of what it is compared with; divide by the number of designs.
"""

from __future__ import annotations

import time
from typing import Any

import numpy as np
import pytest

import peers
from bench_batches import SPEEDS, bicycles, riders
from singletrack import closed_form, coefficients, load_bicycle, load_rider
from singletrack.arrays import single_thread
from singletrack.closed_form import many
from singletrack.closed_form.coefficients import by_arrays
from singletrack.closed_form.programs import program_named
from singletrack.linear import eigenvalues, modes
from singletrack.linear.eigenvalues import eigenmotions
from singletrack.linear.quartic import solve as quartic
from singletrack.posture import Options

UPRIGHT = "upright-axial"
WAYS = ["machine code", "NumPy alone"]


def varied(count: int) -> tuple[Any, Any]:
    """Designs of which every parameter is another."""
    rng = np.random.default_rng(11)
    bicycle = load_bicycle("browser")

    def moved(record: Any) -> Any:
        values = {k: v for k, v in record.values().items() if k != "gravity" and "fraction" not in k}
        return record.replace(**{name: value * rng.uniform(0.995, 1.005, count) for name, value in values.items()})

    return moved(bicycle), moved(load_rider("rider-a").on(bicycle))


@pytest.fixture(params=WAYS)
def way(request: Any, monkeypatch: pytest.MonkeyPatch) -> str:
    """Programs and quartics compiled, or by NumPy, each ready before anything is measured."""
    monkeypatch.setattr(many, "_WORTH_COMPILING", np.inf)
    monkeypatch.setattr(quartic, "_WORTH_COMPILING", np.inf)
    monkeypatch.setattr(many, "_WORTH_RECORDING", -1)
    monkeypatch.setattr(quartic, "_WORTH_RECORDING", -1)
    if request.param == "machine code":
        pytest.importorskip("numba")
        quartic.use_compiled()
        program = program_named(UPRIGHT)
        assert program is not None
        many.use_compiled(program)
    else:
        monkeypatch.setattr(quartic._Kernel, "compiled", None)  # noqa: SLF001
        monkeypatch.setattr(many._Kernels, "compiled", {})  # noqa: SLF001
    return str(request.param)


@pytest.mark.parametrize("count", [10_000, 100_000])
def test_matrices_of_upright_riders(compare: Any, way: str, count: int) -> None:
    """No loss of cache: against the equations for arrays, which ran on the whole batch at once."""
    bicycle, rider = varied(count)
    compare(
        lambda: closed_form.coefficients(bicycle, rider, "upright"),
        lambda: by_arrays(bicycle, rider, Options("upright")),
        names=(f"matrices of {count} upright riders, {way}", "array by array, all at once"),
        target="1 us a design",
        pairs=5,
    )


def test_threads(compare: Any, way: str) -> None:
    """Two cores by the clock: means little on a machine that others use."""
    bicycle, rider = varied(100_000)

    def alone() -> Any:
        with single_thread():
            return closed_form.coefficients(bicycle, rider, "upright")

    compare(
        lambda: closed_form.coefficients(bicycle, rider, "upright"),
        alone,
        names=(f"matrices of 100000 upright riders, {way}, all cores, by the clock", "one thread"),
        clock=time.perf_counter,
    )


def test_xla(compare: Any) -> None:
    """The same equations compiled by XLA."""
    jax = pytest.importorskip("jax")
    bicycle, rider = varied(10_000)
    with jax.enable_x64(new_val=True):
        values = [{k: jax.numpy.asarray(v) for k, v in record.values().items()} for record in (bicycle, rider)]
        single = load_bicycle("browser"), load_rider("rider-a").on(load_bicycle("browser"))

        def matrices(b: Any, r: Any) -> Any:
            return by_arrays(single[0].replace(**b), single[1].replace(**r), Options("upright")).matrices

        compiled = jax.jit(matrices)
        compare(
            lambda: closed_form.coefficients(bicycle, rider, "upright"),
            lambda: jax.block_until_ready(compiled(*values)),
            names=("matrices of 10000 upright riders", "the same equations compiled by XLA"),
        )


def test_1000_upright_riders_at_101_speeds(compare: Any, way: str) -> None:
    """From parameters to eigenvalues, against the peer's bicycles without riders (a hundred of them, times ten)."""
    bicycle, rider = bicycles("browser", 1000), riders(1000)
    changes = [peers.parameters(bicycles("benchmark", 100), i) | {"v": SPEEDS} for i in range(100)]
    model = peers.model(load_bicycle("benchmark"))
    compare(
        lambda: coefficients(bicycle, rider, "upright").eigenvalues(SPEEDS),
        lambda: [model.calc_eigen(**change) for change in changes],
        names=(f"1000 upright riders x 101 speeds, {way}", "BicycleParameters calc_eigen, 100 bicycles x 101 speeds"),
        target="50 (500 of 1000)" if way == "machine code" else "20 (200 of 1000)",
        pairs=7,
        repeat=3,
    )


@pytest.mark.parametrize("speeds", [101, 11])
def test_names_of_modes(compare: Any, speeds: int) -> None:
    """What following and naming add to eigenvalues and motions, NumPy alone, one thread."""
    model = closed_form.coefficients(*varied(1000), "upright")
    v = np.linspace(0.0, 10.0, speeds)
    roots = eigenvalues(model, v)

    def plain() -> None:
        with single_thread():
            eigenvalues(model, v)
            eigenmotions(model, v, roots)

    def named() -> None:
        with single_thread():
            modes(model, v)

    compare(
        plain,
        named,
        names=(f"eigenvalues and motions, 1000 riders x {speeds} speeds", "the same with names"),
        target="0.3 us a problem more",
    )
