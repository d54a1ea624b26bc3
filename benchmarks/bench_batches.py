"""Eigenvalues of many speeds, bicycles and riders, against BicycleParameters and NumPy, as ratios in one run.

Run with ``make benchmark`` or ``pytest benchmarks/bench_batches.py --benchmark-enable -n 0``; the table is at the end.
"""

from __future__ import annotations

import time
from typing import Any

import numpy as np
import pytest

import peers
from singletrack import coefficients, load_bicycle, load_rider
from singletrack.linear.quartic import solve as quartic

SPEEDS = np.linspace(0.0, 10.0, 101)


@pytest.fixture(params=["numba", "NumPy alone"])
def kernel(request: Any, monkeypatch: pytest.MonkeyPatch) -> str:
    """Both kernels, each loaded before anything is measured."""
    if request.param == "numba":
        pytest.importorskip("numba")
        quartic.use_compiled()
    else:
        monkeypatch.setattr(quartic._Kernel, "compiled", None)  # noqa: SLF001
        monkeypatch.setattr(quartic, "_WORTH_COMPILING", np.inf)
    return str(request.param)


def varied(record: Any, names: tuple[str, ...], count: int) -> Any:
    rng = np.random.default_rng(11)
    return record.replace(**{name: getattr(record, name) * rng.uniform(0.99, 1.01, count) for name in names})


def bicycles(name: str, count: int) -> Any:
    bicycle = load_bicycle(name)
    ours = [name for name in peers.names().values() if name != "gravity"]
    return varied(bicycle, tuple(ours), count)


def riders(count: int) -> Any:
    rider = load_rider("rider-a").on(load_bicycle("browser"))
    return varied(rider, ("rider_mass", "torso_length", "upper_arm_length", "chest_circumference"), count)


def test_1001_speeds_of_one_bicycle(compare: Any, kernel: str) -> None:
    bicycle, speeds = load_bicycle("benchmark"), np.linspace(0.0, 10.0, 1001)
    theirs = peers.model(bicycle)
    found = coefficients(bicycle).eigenvalues(speeds)
    np.testing.assert_allclose(np.sort_complex(theirs.calc_eigen(v=speeds)[0]), found, rtol=1e-9)
    compare(
        lambda: coefficients(bicycle).eigenvalues(speeds),
        lambda: theirs.calc_eigen(v=speeds),
        names=(f"1001 speeds of one bicycle, {kernel}", "BicycleParameters calc_eigen"),
        target="40",
        repeat=5,
    )


def test_1000_bicycles_at_101_speeds(compare: Any, kernel: str) -> None:
    batch = bicycles("benchmark", 1000)
    changes = [peers.parameters(batch, i) for i in range(1000)]
    for change in changes:
        change["v"] = SPEEDS
    model = peers.model(load_bicycle("benchmark"))
    ours = coefficients(batch).eigenvalues(SPEEDS)
    np.testing.assert_allclose(np.sort_complex(model.calc_eigen(**changes[7])[0]), ours[7], rtol=1e-8)
    compare(
        lambda: coefficients(batch).eigenvalues(SPEEDS),
        lambda: [model.calc_eigen(**change) for change in changes],
        names=(f"1000 bicycles x 101 speeds, {kernel}", "BicycleParameters calc_eigen, bicycle by bicycle"),
        target="100",
        pairs=3,
        repeat=5,
    )


@pytest.mark.parametrize("rigid", ["rigid riders", "bicycles alone"])
@pytest.mark.parametrize("posture", ["upright", "leaned"])
def test_1000_riders_at_101_speeds(compare: Any, kernel: str, posture: str, rigid: str) -> None:
    bicycle, rider = bicycles("browser", 1000), riders(1000)

    def theirs() -> Any:
        model = coefficients(bicycle, rider, "rigid") if rigid == "rigid riders" else coefficients(bicycle)
        return model.eigenvalues(SPEEDS)

    compare(
        theirs,
        lambda: coefficients(bicycle, rider, posture).eigenvalues(SPEEDS),
        names=(f"1000 {rigid} x 101 speeds, {kernel}", f"as many {posture} riders"),
        target="at most 1.5" if (posture, rigid) == ("upright", "rigid riders") else "",
        pairs=25,
    )


def random_pencils(count: int) -> tuple[np.ndarray, ...]:
    """Return M, C, K of random pencils M s² + C s + K, state matrices (count, 4, 4), quartics (4, count)."""
    rng = np.random.default_rng(5)
    half = rng.standard_normal((count, 2, 2))
    M = half @ half.transpose(0, 2, 1) + 0.01 * np.eye(2)
    C, K = rng.standard_normal((2, count, 2, 2)) * 3.0
    state = np.zeros((count, 4, 4))
    state[:, 0, 2] = state[:, 1, 3] = 1.0
    state[:, 2:] = -np.linalg.solve(M, np.concatenate([K, C], axis=-1))

    def mixed(a: np.ndarray, b: np.ndarray) -> np.ndarray:
        return a[:, 0, 0] * b[:, 1, 1] - a[:, 0, 1] * b[:, 1, 0]

    b, c = mixed(M, C) + mixed(C, M), mixed(M, K) + mixed(K, M) + mixed(C, C)
    return M, C, K, state, np.array([b, c, mixed(C, K) + mixed(K, C), mixed(K, K)]) / mixed(M, M)


def test_a_million_random_problems(compare: Any, kernel: str) -> None:
    *_, state, coefficients_ = random_pencils(1_000_000)
    compare(
        lambda: quartic.quartic_roots(*coefficients_),
        lambda: np.linalg.eigvals(state),
        names=(f"a million random 4x4 problems, {kernel}", "numpy.linalg.eigvals of the same matrices"),
        target="10",
        pairs=3,
    )


def test_matrices_by_the_multibody_engine(compare: Any) -> None:
    """Our other derivation: one design at a time, so one design here."""
    multibody = pytest.importorskip("singletrack.multibody")
    bicycle, rider = load_bicycle("browser"), load_rider("rider-a")
    compare(
        lambda: coefficients(bicycle, rider, "upright"),
        lambda: multibody.coefficients(bicycle, rider, "upright"),
        names=("matrices of one upright rider, closed form", "our multibody engine, equations already derived"),
        repeat=10,
    )


def test_gradients_of_all_parameters(compare: Any) -> None:
    """JAX against complex steps: the upright rider's matrices, with respect to all parameters of both records."""
    jax = pytest.importorskip("jax")
    bicycle = load_bicycle("browser")
    rider = load_rider("rider-a").on(bicycle)

    def matrices(b: Any, r: Any) -> Any:
        return coefficients(bicycle.replace(**b), rider.replace(**r), "upright").matrices

    def complex_steps() -> Any:
        # All parameters at once, as a batch of designs with one parameter stepped in each.
        names = [*bicycle.values(), *rider.values()]
        steps = 1e-40j * np.eye(len(names))
        changes = [
            {name: getattr(record, name) + steps[names.index(name)] for name in record.values()}
            for record in (bicycle, rider)
        ]
        return [np.imag(matrix) / 1e-40 for matrix in matrices(*changes)]

    with jax.enable_x64(new_val=True):
        values = [{k: jax.numpy.asarray(v) for k, v in record.values().items()} for record in (bicycle, rider)]
        compiled = jax.jit(jax.jacfwd(matrices, argnums=(0, 1)))
        compare(
            lambda: jax.block_until_ready(compiled(*values)),
            complex_steps,
            names=("gradient of an upright rider's matrices, JAX (compiled)", "complex steps as a batch, NumPy"),
            repeat=10,
            clock=time.perf_counter,
        )
