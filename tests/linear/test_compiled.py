"""The compiled kernel of quartics, its own text run by Python, and the kernel over arrays: one and the same bits."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from singletrack.linear.quartic.solve import _roots_into

pytest.importorskip("numba")


@pytest.mark.parametrize("count", [1, 255, 256, 257, 600])
def test_the_loop_over_numbers_is_the_kernel_over_arrays(count: int) -> None:
    from singletrack.linear.quartic.compiled import roots_into

    rng = np.random.default_rng(count)
    coefficients = rng.standard_normal((4, count)) * 10.0 ** rng.integers(-3, 4, (4, 1))
    results = []
    plain: Any = roots_into
    for solve in (_roots_into, roots_into, plain.py_func):
        roots, good = np.full((count, 4), np.nan, dtype=complex), np.zeros(count, dtype=bool)
        with np.errstate(all="ignore"):
            solve(roots, good, *coefficients)
        results.append((roots, good))
    assert results[0][1].any()
    for roots, good in results[1:]:
        np.testing.assert_array_equal(good, results[0][1])
        np.testing.assert_array_equal(roots[good], results[0][0][good])
