"""A million random problems: backward errors of both solvers, and the worst differences judged by fifty digits.

Run with ``pytest benchmarks/bench_accuracy.py --benchmark-enable -n 0 -s``.
"""

from __future__ import annotations

from typing import Any

import mpmath
import numpy as np

from bench_batches import random_pencils
from singletrack.linear.quartic.solve import quartic_roots

EPS = np.finfo(float).eps
COUNT, WORST = 1_000_000, 200


def pencil(s: np.ndarray, M: np.ndarray, C: np.ndarray, K: np.ndarray) -> np.ndarray:
    """Return P(s) = M s² + C s + K, (n, 4, 2, 2), for s (n, 4)."""
    at = s[..., None, None]
    return at * (at * M[:, None] + C[:, None]) + K[:, None]


def scale(s: np.ndarray, *matrices: np.ndarray) -> np.ndarray:
    """Return the size of P(s)'s terms, (n, 4)."""
    norms = [np.linalg.norm(matrix, axis=(-2, -1))[:, None] for matrix in matrices]
    size = np.abs(s)
    return size * (size * norms[0] + norms[1]) + norms[2]


def smallest_singular_value(a: np.ndarray) -> np.ndarray:
    frobenius = np.sum(np.abs(a) ** 2, axis=(-2, -1))
    determinant = np.abs(a[..., 0, 0] * a[..., 1, 1] - a[..., 0, 1] * a[..., 1, 0])
    largest = np.sqrt((frobenius + np.sqrt(np.maximum(frobenius**2 - 4 * determinant**2, 0.0))) / 2)
    return determinant / largest


def conditions(s: np.ndarray, M: np.ndarray, C: np.ndarray, K: np.ndarray) -> np.ndarray:
    """Return the relative condition number of each eigenvalue (n, 4)."""
    left, _, right = np.linalg.svd(pencil(s, M, C, K))
    slope = 2 * s[..., None, None] * M[:, None] + C[:, None]
    product = np.einsum("nki,nkij,nkj->nk", left[..., :, 1].conj(), slope, right[..., 1, :].conj())
    return scale(s, M, C, K) / (np.abs(s) * np.abs(product))


def exact_roots(M: np.ndarray, C: np.ndarray, K: np.ndarray) -> list[Any]:
    with mpmath.workdps(50):
        m, c, k = (mpmath.matrix(a.tolist()) for a in (M, C, K))

        def mixed(a: Any, b: Any) -> Any:
            return a[0, 0] * b[1, 1] - a[0, 1] * b[1, 0]

        five = [mixed(m, m), mixed(m, c) + mixed(c, m), mixed(m, k) + mixed(k, m) + mixed(c, c)]
        five += [mixed(c, k) + mixed(k, c), mixed(k, k)]
        return list(mpmath.polyroots(five, maxsteps=500, extraprec=500))


def error(found: complex, exact: list[Any]) -> float:
    with mpmath.workdps(50):
        return float(min(abs(mpmath.mpc(found) - x) / abs(x) for x in exact))


def test_differences_are_conditioning(benchmark: Any) -> None:
    M, C, K, state, coefficients = random_pencils(COUNT)
    ours = benchmark.pedantic(quartic_roots, tuple(coefficients), rounds=1)
    theirs = np.sort_complex(np.linalg.eigvals(state).astype(complex))
    report = {}
    for name, roots in (("ours", ours), ("numpy", theirs)):
        backward = smallest_singular_value(pencil(roots, M, C, K)) / scale(roots, M, C, K) / EPS
        report[name] = [np.median(backward), np.quantile(backward, 0.999), backward.max()]
    gap = (np.abs(ours - theirs) / np.abs(theirs)).max(axis=1)
    worst = np.argsort(-gap)[:WORST]
    condition = conditions(ours[worst], M[worst], C[worst], K[worst])
    errors: dict[str, list[float]] = {"ours": [], "numpy": []}
    ratios: dict[str, list[float]] = {"ours": [], "numpy": []}
    for i, kappa in zip(worst, condition, strict=True):
        exact = exact_roots(M[i], C[i], K[i])
        for name, roots in (("ours", ours), ("numpy", theirs)):
            found = [error(root, exact) for root in roots[i]]
            errors[name].append(max(found))
            ratios[name].append(max(e / (EPS * max(k, 1.0)) for e, k in zip(found, kappa, strict=True)))
    lines = [f"largest relative difference {gap.max():.1e}; of the {WORST} largest, judged by fifty digits:"]
    for name in ("ours", "numpy"):
        median, most, largest = report[name]
        lines.append(
            f"{name}: backward error median {median:.2f}, 99.9 % {most:.1f}, largest {largest:.0f} units of rounding; "
            f"of those {WORST} the largest error {max(errors[name]):.1e}, median {np.median(errors[name]):.1e}, "
            f"at most {max(ratios[name]):.1f} units of rounding times the condition number"
        )
    closer = sum(a <= b for a, b in zip(errors["ours"], errors["numpy"], strict=True))
    lines.append(f"ours is the closer one in {closer} of {WORST}")
    print("\n" + "\n".join(lines))  # noqa: T201
    assert max(ratios["ours"]) < 50
