"""Eigenvalues, eigenmotions and state space of any number of freedoms, with springs and dampers."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from linear.random_models import random_model
from singletrack import InputError, coefficients, load_bicycle
from singletrack.linear import eigenmotions, eigenvalues, state_space
from singletrack.linear import eigenvalues as _eigenvalues
from singletrack.linear.eigenvalues import _by_lapack

SPEEDS = np.array([0.0, 0.7, 3.0, 12.0])


def residuals(model, speeds, roots, motions):
    """Return |P(s) q| over the size of its terms, (..., k, 2 n)."""
    v = speeds[:, None, None]
    damping = model.C0[:, None] + v * model.C1[:, None]
    stiffness = model.S0[:, None] + 9.81 * model.K0[:, None] + v**2 * model.K2[:, None]
    s = roots[..., None, None]
    terms = (s**2 * model.M[:, None, None], s * damping[:, :, None], stiffness[:, :, None] + 0 * s)
    size = sum(np.linalg.norm(term, axis=(-2, -1)) for term in terms) * np.linalg.norm(motions, axis=-1)
    return np.linalg.norm(np.einsum("...ij,...j->...i", sum(terms), motions), axis=-1) / size


@pytest.mark.parametrize("damped", [True, False])
@pytest.mark.parametrize("n", [2, 3, 4])
def test_motions_solve_the_equations(n, damped):
    model = random_model(n, 50, seed=n, damped=damped)
    roots = eigenvalues(model, SPEEDS)
    assert roots.shape == (50, 4, 2 * n)
    np.testing.assert_array_equal(roots, np.sort_complex(roots))
    np.testing.assert_array_equal(np.sort_complex(roots.conj()), roots)
    motions = eigenmotions(model, SPEEDS, roots)
    assert motions.shape == (50, 4, 2 * n, n)
    assert residuals(model, SPEEDS, roots, motions).max() < 1e-12
    np.testing.assert_array_equal(motions[..., 0], 1.0)


@pytest.mark.parametrize("n", [2, 3, 4])
def test_state_space_has_the_same_eigenvalues(n):
    model = random_model(n, 10, seed=30 + n)
    system = state_space(model, SPEEDS)
    np.testing.assert_allclose(np.sort_complex(np.linalg.eigvals(system.A)), eigenvalues(model, SPEEDS), rtol=1e-8)
    lower = model.M[:, None] @ system.B[..., n:, :]
    np.testing.assert_allclose(lower, np.broadcast_to(model.B, lower.shape), atol=1e-10)
    assert system.states[n:] == tuple(f"{name} rate" for name in model.coordinates)


def test_two_freedoms_by_quartic_and_by_lapack_agree():
    moving = SPEEDS[1:]  # at rest, real parts that are zero but for rounding have no order
    for model in (random_model(2, 200, 9), random_model(2, 200, 9, damped=False)):
        np.testing.assert_allclose(_by_lapack(model, moving), eigenvalues(model, moving), rtol=1e-7, atol=1e-9)


def test_the_sum_of_roots_is_the_trace():
    for n in (2, 3, 4):
        model = random_model(n, 40, n)
        damping = model.C0[:, None] + SPEEDS[:, None, None] * model.C1[:, None]
        trace = -np.trace(np.linalg.solve(model.M[:, None], damping), axis1=-2, axis2=-1)
        np.testing.assert_allclose(eigenvalues(model, SPEEDS).sum(axis=-1), trace, atol=1e-9)


@given(st.integers(0, 2**32 - 1), st.integers(2, 4))
@settings(max_examples=20, deadline=None)
def test_order_of_further_coordinates_does_not_matter(seed, n):
    model = random_model(n, 3, seed)
    order = np.random.default_rng(seed).permutation(n)
    other = replace(
        model,
        **{name: getattr(model, name)[:, order][:, :, order] for name in ("M", "C0", "C1", "S0", "K0", "K2")},
    )
    np.testing.assert_allclose(eigenvalues(other, SPEEDS), eigenvalues(model, SPEEDS), rtol=1e-6, atol=1e-8)


def test_many_designs_and_speeds_fall_into_chunks_without_a_seam():
    model, speeds = random_model(3, 70, 1), np.linspace(0, 10, 101)
    roots = eigenvalues(model, speeds)
    for i in (0, 39, 40, 41, 69):
        np.testing.assert_array_equal(eigenvalues(model[i], speeds), roots[i])
    many = np.linspace(0, 10, 4200)
    np.testing.assert_array_equal(
        eigenvalues(model[0], many)[[0, 4095, 4096, 4199]], eigenvalues(model[0], many[[0, 4095, 4096, 4199]])
    )


def test_a_singular_mass_matrix_is_not_told():
    model = random_model(3, 3, 1)
    M = model.M.copy()
    M[1, 2] = M[1, :, 2] = 0.0
    roots = eigenvalues(replace(model, M=M), SPEEDS)
    assert np.isnan(roots[1]).all()
    np.testing.assert_array_equal(roots[[0, 2]], eigenvalues(model, SPEEDS)[[0, 2]])
    assert np.isnan(eigenmotions(replace(model, M=M), SPEEDS, roots)[1]).all()


def test_no_speeds_give_no_eigenvalues():
    for n in (2, 3):
        model = random_model(n, 4, 1)
        assert eigenvalues(model, []).shape == (4, 0, 2 * n)
        assert eigenvalues(model[0], []).shape == (0, 2 * n)
    assert coefficients(load_bicycle("benchmark")).eigenvalues([]).shape == (0, 4)


@pytest.mark.parametrize("speed", [1e200, -1e200, 3e8])
def test_faster_than_light_is_refused(speed):
    model = coefficients(load_bicycle("benchmark"))
    for ask in (model.eigenvalues, model.modes, model.state_space):
        with pytest.raises(InputError, match="at most 299792458 m/s"):
            ask([1.0, speed])


def test_jax_finds_the_same_and_differentiates():
    jax = pytest.importorskip("jax")
    for n in (2, 3):
        model, v, h = random_model(n, 4, 6), np.array([0.5, 4.0]), 1e-6
        with jax.enable_x64(new_val=True):

            def roots(springs, model=model, v=v):
                return _eigenvalues(replace(model, S0=springs), jax.numpy.asarray(v))

            found = np.asarray(jax.jit(roots)(jax.numpy.asarray(model.S0)))
            np.testing.assert_allclose(found, eigenvalues(model, v), rtol=1e-8)
            direction = np.random.default_rng(1).normal(size=model.S0.shape)
            slope = jax.jvp(roots, (jax.numpy.asarray(model.S0),), (jax.numpy.asarray(direction),))[1]
        ends = [eigenvalues(replace(model, S0=model.S0 + k * h * direction), v) for k in (1, -1)]
        np.testing.assert_allclose(slope, (ends[0] - ends[1]) / (2 * h), rtol=1e-4, atol=1e-6)
