"""Roots of quartics: backward errors, hard cases against fifty digits, structure, one algorithm on every backend."""

from __future__ import annotations

import os
import subprocess
import sys
from itertools import combinations
from typing import TYPE_CHECKING, Any

import mpmath
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from singletrack.linear.quartic import hard
from singletrack.linear.quartic import solve as quartic
from singletrack.linear.quartic.solve import quartic_roots

if TYPE_CHECKING:
    from singletrack import CoefficientMatrices

EPS = np.finfo(float).eps
COUNT = 3000


def coefficients_of(roots: np.ndarray) -> np.ndarray:
    """Return b, c, d, e (4, n) of quartics with the given roots (n, 4)."""
    parts = [(-1) ** k * sum(np.prod(roots[:, list(at)], axis=1) for at in combinations(range(4), k)) for k in range(5)]
    return np.real(np.array(parts[1:]))


def backward_errors(roots: np.ndarray, coefficients: np.ndarray) -> np.ndarray:
    """Return |p(s)| over the sum of the sizes of its terms, (n, 4): how much the coefficients would have to change."""
    terms = np.stack([np.ones(len(roots)), *coefficients], axis=-1)[:, None, :] * roots[..., None] ** np.arange(
        4, -1, -1
    )
    size = np.abs(terms).sum(axis=-1)
    return np.abs(terms.sum(axis=-1)) / np.where(size == 0, 1.0, size)


def hard_quartics() -> dict[str, np.ndarray]:
    """Return families of coefficients (4, n), most with roots that nearly meet."""
    rng = np.random.default_rng(4)
    real = rng.standard_normal((COUNT, 4))
    pairs = rng.standard_normal((COUNT, 2)) + 1j * rng.standard_normal((COUNT, 2))
    families = {
        "real": coefficients_of(real),
        "two pairs": coefficients_of(np.concatenate([pairs, pairs.conj()], axis=1)),
        "graded": coefficients_of(real * [1e6, 1e3, 1.0, 1e-4]),
        "biquadratic": rng.standard_normal((4, COUNT)) * [[0.0], [1.0], [0.0], [1.0]],
        "zero root": rng.standard_normal((4, COUNT)) * [[1.0], [1.0], [1.0], [0.0]],
        "any": rng.standard_normal((4, COUNT)),
        "large": rng.standard_normal((4, COUNT)) * 1e8 ** np.arange(1, 5)[:, None],
        "small": rng.standard_normal((4, COUNT)) * 1e-9 ** np.arange(1, 5)[:, None],
    }
    for gap in (1e-3, 1e-7, 1e-12, 0.0):
        ascending = np.sort(real, axis=1)
        ascending[:, 2] = ascending[:, 1] * (1 + gap)
        families[f"inner two, gap {gap}"] = coefficients_of(ascending)
        outer = np.sort(real, axis=1)
        outer[:, 1] = outer[:, 0] * (1 + gap)
        families[f"outer two, gap {gap}"] = coefficients_of(outer)
        mixed = np.stack([pairs[:, 0], pairs[:, 0].conj(), real[:, 0], real[:, 0] * (1 + gap)], axis=1)
        families[f"real two beside a pair, gap {gap}"] = coefficients_of(mixed)
        twin = np.stack([pairs[:, 0], pairs[:, 0] * (1 + gap)], axis=1)
        families[f"pair at a pair, gap {gap}"] = coefficients_of(np.concatenate([twin, twin.conj()], axis=1))
        triple = real.copy()
        triple[:, 1], triple[:, 2] = real[:, 0] * (1 + gap), real[:, 0] * (1 - gap)
        families[f"triple, gap {gap}"] = coefficients_of(triple)
        near = np.stack([pairs[:, 0].real + 1j * gap, pairs[:, 1]], axis=1)
        families[f"pair near the axis, gap {gap}"] = coefficients_of(np.concatenate([near, near.conj()], axis=1))
    return families


HARD = hard_quartics()


@pytest.mark.parametrize("family", HARD)
def test_backward_error_is_rounding(family: str) -> None:
    errors = backward_errors(quartic_roots(*HARD[family]), HARD[family])
    # A dozen roundings.
    assert errors.max() < 12 * EPS


@pytest.mark.parametrize("family", ["any", "real", "two pairs", "graded", "biquadratic", "large", "small"])
def test_factors_need_no_help_where_roots_keep_apart(family: str) -> None:
    with np.errstate(all="ignore"):
        good = quartic.factor(*HARD[family], np.where, np.sqrt)[-1]
    assert good.mean() > 0.999


@pytest.mark.parametrize("family", HARD)
def test_real_roots_are_real_pairs_exact_conjugates_all_sorted(family: str) -> None:
    roots = quartic_roots(*HARD[family])
    np.testing.assert_array_equal(roots, np.sort_complex(roots))
    pairs = np.sort_complex(np.where(roots.imag != 0, roots, 0.0))
    np.testing.assert_array_equal(pairs, np.sort_complex(pairs.conj()))
    assert set(np.unique((roots.imag == 0).sum(axis=1))) <= {0, 2, 4}


def test_worst_of_many_against_fifty_digits() -> None:
    """The error that is left is the conditioning: it never exceeds a few roundings times the condition number."""
    coefficients = np.random.default_rng(7).standard_normal((4, 20000))
    roots = quartic_roots(*coefficients)
    powers = roots[..., None] ** np.arange(4, -1, -1)
    all_five = np.concatenate([np.ones((1, 20000)), coefficients]).T[:, None, :]
    slope = (all_five[..., :4] * np.arange(4, 0, -1) * powers[..., 1:]).sum(axis=-1)
    condition = (np.abs(all_five) * np.abs(powers)).sum(axis=-1) / np.abs(slope * roots)
    for i in np.argsort(-condition.max(axis=1))[:40]:
        with mpmath.workdps(50):
            exact = mpmath.polyroots([1, *(mpmath.mpf(a) for a in coefficients[:, i])], maxsteps=500, extraprec=400)
            for root, number in zip(roots[i], condition[i], strict=True):
                nearest = min(abs(mpmath.mpc(root) - other) / abs(other) for other in exact)
                assert nearest <= 8 * EPS * number


finite = st.floats(-1e3, 1e3, allow_nan=False).map(lambda x: x if abs(x) > 1e-3 else 0.0)


@settings(max_examples=200, deadline=None)
@given(st.tuples(finite, finite, finite, finite))
def test_any_quartic_is_solved(abcd: tuple[float, ...]) -> None:
    roots = quartic_roots(*abcd)
    scale = max(1.0, *(abs(a) ** (1 / (k + 1)) for k, a in enumerate(abcd)))
    # The product of the roots' factors is the quartic, coefficients to rounding of the largest of their order.
    for k, (found, wanted) in enumerate(zip(coefficients_of(roots[None])[:, 0], abcd, strict=True)):
        assert abs(found - wanted) <= 100 * EPS * (2 * scale) ** (k + 1)


@pytest.mark.parametrize("factor", [1e-7, 1e9])
def test_roots_scale_with_the_unit_of_time(factor: float) -> None:
    b, c, d, e = HARD["any"]
    scaled = quartic_roots(b * factor, c * factor**2, d * factor**3, e * factor**4)
    np.testing.assert_allclose(scaled, quartic_roots(b, c, d, e) * factor, rtol=1e-10)


def test_mirrored_quartics_have_mirrored_roots() -> None:
    b, c, d, e = HARD["any"]
    mirrored = np.sort_complex(-quartic_roots(-b, c, -d, e))
    np.testing.assert_allclose(mirrored, quartic_roots(b, c, d, e), rtol=1e-11)


def test_numbers_that_are_none_stay_where_they_are() -> None:
    coefficients = HARD["any"][:, :10].copy()
    alone = quartic_roots(*coefficients)
    coefficients[2, 3], coefficients[0, 7] = np.nan, np.inf
    roots = quartic_roots(*coefficients)
    assert np.isnan(roots[[3, 7]]).all()
    np.testing.assert_array_equal(np.delete(roots, [3, 7], axis=0), np.delete(alone, [3, 7], axis=0))


def test_coefficients_broadcast() -> None:
    b, c = np.array([0.5, 1.0, 1.5])[:, None], np.array([1.0, 2.0])
    roots = quartic_roots(b, c, 0.3, 0.1)
    assert roots.shape == (3, 2, 4)
    np.testing.assert_array_equal(roots[2, 1], quartic_roots(1.5, 2.0, 0.3, 0.1))


def test_compiled_kernel_gives_the_same_bits(monkeypatch: pytest.MonkeyPatch) -> None:
    pytest.importorskip("numba")
    coefficients = np.concatenate(list(HARD.values()), axis=1)
    monkeypatch.setattr(quartic._Kernel, "compiled", None)
    monkeypatch.setattr(quartic._Kernel, "solved", 0)
    by_numpy = quartic_roots(*coefficients)
    assert quartic._Kernel.compiled is None
    assert quartic.use_compiled()
    np.testing.assert_array_equal(quartic_roots(*coefficients), by_numpy)


def test_compiled_kernel_comes_when_it_pays(monkeypatch: pytest.MonkeyPatch) -> None:
    pytest.importorskip("numba")
    monkeypatch.setattr(quartic._Kernel, "compiled", None)
    monkeypatch.setattr(quartic._Kernel, "solved", quartic._WORTH_COMPILING)
    quartic_roots(0.0, -5.0, 0.0, 4.0)
    assert quartic._Kernel.compiled is not None


def test_jax_finds_the_same_roots() -> None:
    jax = pytest.importorskip("jax")
    from singletrack.linear.quartic.jax import quartic_roots as by_jax

    few = np.concatenate([family[:, :100] for name, family in HARD.items() if "triple" not in name], axis=1)
    with double_precision(jax):
        roots = np.asarray(jax.jit(by_jax)(*few))
    assert backward_errors(roots, few).max() < 20 * EPS
    apart = np.concatenate([HARD[name] for name in ("any", "real", "two pairs", "large")], axis=1)
    with double_precision(jax):
        np.testing.assert_allclose(by_jax(*apart), quartic_roots(*apart), rtol=1e-9)


def double_precision(jax: Any) -> Any:
    """Return a context in which JAX computes in double precision."""
    return jax.enable_x64(new_val=True)


def pencil_errors(model: CoefficientMatrices, speeds: np.ndarray, roots: np.ndarray) -> np.ndarray:
    """Return the backward errors of eigenvalues (m, n, 4) of the quadratic pencil."""
    v = speeds[:, None, None]
    damping = v * model.C1[:, None]
    stiffness = np.asarray(model.gravity)[..., None, None, None] * model.K0[:, None] + v**2 * model.K2[:, None]
    s = roots[..., None, None]
    pencil = s**2 * model.M[:, None, None] + s * damping[:, :, None] + stiffness[:, :, None]
    norms = [np.linalg.norm(a, 2, axis=(-2, -1)) for a in (model.M[:, None], damping, stiffness)]
    size = np.abs(roots) ** 2 * norms[0][..., None] + np.abs(roots) * norms[1][..., None] + norms[2][..., None]
    return np.linalg.svd(pencil, compute_uv=False)[..., -1] / size


SPEEDS = np.array([0.0, 1e-9, 1e-3, 0.5, 3.0, 4.3, 6.0, 7.9, 20.0, 1e3, 1e6])


def test_backward_error_of_the_matrices_is_rounding(random_models: CoefficientMatrices) -> None:
    roots = random_models.eigenvalues(SPEEDS)
    assert pencil_errors(random_models, SPEEDS, roots).max() < 100 * EPS


@pytest.mark.parametrize("smallness", [1e-6, 1e-10, 1e-13])
def test_nearly_singular_mass_matrices(random_models: CoefficientMatrices, smallness: float) -> None:
    M = random_models.M.copy()
    M[:, 1, 1] = M[:, 0, 1] ** 2 / M[:, 0, 0] * (1 + smallness)
    model = type(random_models)(M, random_models.C1, random_models.K0, random_models.K2, random_models.gravity)
    roots = model.eigenvalues(SPEEDS)
    assert np.isfinite(roots).all()
    assert pencil_errors(model, SPEEDS, roots).max() < 50 * EPS


def test_no_place_for_machine_code_is_no_obstacle() -> None:
    """An installation that cannot be written to, no home folder: numba finds no place to keep what it compiled."""
    pytest.importorskip("numba")
    script = (
        "from singletrack.linear.quartic.solve import quartic_roots, use_compiled; use_compiled(); "
        "print(quartic_roots(0.0, -5.0, 0.0, 4.0).tolist())"
    )
    nowhere = {**os.environ, "NUMBA_CACHE_LOCATOR_CLASSES": "ZipCacheLocator"}
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, env=nowhere, check=False)
    assert done.stdout.strip() == "[(-2+0j), (-1+0j), (1+0j), (2+0j)]", done.stderr


def product_errors(roots: np.ndarray, coefficients: np.ndarray) -> np.ndarray:
    """Return how far the product of the roots' factors is from the quartic, relative to its terms, (4, n)."""
    size = np.abs(coefficients_of(-np.abs(roots)))
    return np.abs(coefficients_of(roots) - coefficients) / np.where(size == 0, 1.0, size)


@pytest.mark.parametrize("family", HARD)
def test_the_roots_together_are_those_of_the_quartic(family: str) -> None:
    """Each root alone may be exact and the four together not: three nearly equal ones, one of them twice."""
    assert np.nanmax(product_errors(quartic_roots(*HARD[family]), HARD[family])) < 1e-13


def test_wrong_roots_of_the_last_resort_do_not_leave(monkeypatch: pytest.MonkeyPatch) -> None:
    coefficients = HARD["triple, gap 0.0"][:, :50]
    monkeypatch.setattr(np.linalg, "eigvals", lambda companions: np.ones(companions.shape[:-1]))
    assert np.isnan(hard._solve_by_lapack(*coefficients)).all()


def test_numbers_far_out_of_range_are_solved() -> None:
    b, c, d, e = HARD["any"][:, :100]
    for size in (1e-70, 1e70):
        scaled = quartic_roots(b * size, c * size**2, d * size**3, e * size**4)
        np.testing.assert_allclose(scaled / size, quartic_roots(b, c, d, e), rtol=1e-9)
