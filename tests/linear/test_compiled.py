"""The compiled kernel of quartics and its own text run by Python: one and the same bits, as far as it answers."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from singletrack.linear.quartic.solve import quartic_roots

pytest.importorskip("numba")


def both(compiled: Any, shape: tuple[int, ...], *values: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return roots and which of them hold, the same from machine code and from the text it was made of."""
    results = []
    for solve in (compiled, compiled.py_func):
        roots, good = np.full((*shape, 4), np.nan, dtype=complex), np.zeros(shape, dtype=bool)
        with np.errstate(all="ignore"):
            solve(roots, good, *values)
        results.append((roots, good))
    np.testing.assert_array_equal(results[0][1], results[1][1])
    np.testing.assert_array_equal(results[0][0][results[0][1]], results[1][0][results[1][1]])
    return results[0]


@pytest.mark.parametrize("count", [1, 255, 256, 257, 600])
def test_the_loop_over_quartics(count: int) -> None:
    from singletrack.linear.quartic.compiled import roots_into

    rng = np.random.default_rng(count)
    coefficients = rng.standard_normal((4, count)) * 10.0 ** rng.integers(-3, 4, (4, 1))
    roots, good = both(roots_into, (count,), *coefficients)
    assert good.any()
    np.testing.assert_allclose(roots[good], quartic_roots(*coefficients)[good], rtol=1e-12)


@pytest.mark.parametrize("count", [1, 256, 300])
def test_the_loop_over_designs_and_speeds(count: int) -> None:
    """b = b0 v, c = c0 + c1 v², d = (d0 + d1 v²) v, e = e0 + e1 v² + e2 v⁴: at each speed the quartic with these."""
    from singletrack.linear.quartic.compiled import roots_at_speeds

    rng = np.random.default_rng(count)
    ratios, v = rng.standard_normal((8, 3)), np.linspace(0.1, 10.0, count)
    roots, good = both(roots_at_speeds, (3, count), ratios, v)
    assert good.any()
    b0, c0, c1, d0, d1, e0, e1, e2 = ratios[..., None]
    w = v * v
    wanted = quartic_roots(b0 * v, c0 + c1 * w, (d0 + d1 * w) * v, e0 + e1 * w + e2 * w * w)
    np.testing.assert_allclose(roots[good], wanted[good], rtol=1e-7)
