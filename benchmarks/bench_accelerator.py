"""The same equations on an accelerator, beside this machine's cores; skipped where there is none.

    pytest benchmarks/bench_accelerator.py --benchmark-enable -n 0 -s -rs

``SINGLETRACK_ACCELERATOR=cpu`` runs the same path on JAX's processor backend, which shows that it works and nothing
about speed. Matrices and eigenvalues of a million upright riders at one speed, in double precision; the fraction of the
memory's bandwidth is what goes in and out once, over the time, over what a copy of as much reaches in the same run.
"""

from __future__ import annotations

import os
import statistics
import time
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest

from bench_designs import varied
from singletrack import closed_form, load_bicycle, load_rider
from singletrack.closed_form.coefficients import by_arrays
from singletrack.linear import eigenvalues
from singletrack.posture import Options

if TYPE_CHECKING:
    from collections.abc import Callable

SPEED = np.array([5.0])
WANTED = os.environ.get("SINGLETRACK_ACCELERATOR", "")
COUNT = 1_000_000 if WANTED != "cpu" else 20_000


@pytest.fixture
def device() -> Any:
    """The accelerator, or what was asked for in its place."""
    jax = pytest.importorskip("jax")
    devices = [one for one in jax.devices() if one.platform != "cpu"]
    if WANTED == "cpu":
        devices = jax.devices("cpu")
    if not devices:
        pytest.skip("JAX finds no accelerator on this machine")
    return devices[0]


def median_seconds(work: Callable[[], Any], repeat: int = 5) -> float:
    work()
    times = []
    for _ in range(repeat):
        start = time.perf_counter()
        work()
        times.append(time.perf_counter() - start)
    return statistics.median(times)


def on_device(device: Any, bicycle: Any, rider: Any) -> tuple[Callable[[], Any], Callable[[], Any], int]:
    """Return the work and a copy of as much memory, and how many bytes go in and out."""
    import jax

    single = load_bicycle("browser"), load_rider("rider-a").on(load_bicycle("browser"))
    given = [
        {name: jax.device_put(value, device) for name, value in record.values().items()} for record in (bicycle, rider)
    ]

    def roots(b: Any, r: Any) -> Any:
        model = by_arrays(single[0].replace(**b), single[1].replace(**r), Options("upright"))
        return eigenvalues(model, SPEED)

    compiled = jax.jit(roots)
    found = jax.block_until_ready(compiled(*given))
    varied_bytes = sum(np.asarray(value).nbytes for record in (bicycle, rider) for value in record.values().values())
    total = varied_bytes + found.nbytes
    block = jax.device_put(np.ones(total // 16), device)
    copy = jax.jit(lambda x: x + 1.0)
    return (
        lambda: jax.block_until_ready(compiled(*given)),
        lambda: jax.block_until_ready(copy(block)),
        total,
    )


def test_a_million_riders(device: Any, benchmark: Any) -> None:
    import jax

    bicycle, rider = varied(COUNT)
    with jax.enable_x64(new_val=True):
        work, copy, total = on_device(device, bicycle, rider)
        here = eigenvalues(closed_form.coefficients(bicycle, rider, "upright"), SPEED)
        np.testing.assert_allclose(np.asarray(work())[:1000], here[:1000], rtol=1e-6, atol=1e-8)
        there, copied = median_seconds(work), median_seconds(copy)
        benchmark.pedantic(work, rounds=1)
    cores = median_seconds(lambda: eigenvalues(closed_form.coefficients(bicycle, rider, "upright"), SPEED), 3)
    benchmark.extra_info.update(device=str(device), seconds=there, cores=cores, bytes=total)
    print(  # noqa: T201
        f"\n{COUNT} upright riders, matrices and eigenvalues at one speed: {device.platform} "
        f"{there / COUNT * 1e9:.2f} ns a design, {total / there / 1e9:.1f} GB/s, {copied / there:.1%} of a copy's "
        f"bandwidth; this machine's cores {cores / COUNT * 1e9:.0f} ns a design: {cores / there:.1f} times as long"
    )
