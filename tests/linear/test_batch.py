"""Batches: any field an array, faults in place, the same on JAX, with exact gradients."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
import pytest

from singletrack import InputError, coefficients, load_bicycle, load_rider
from singletrack.arrays import complex_steps

if TYPE_CHECKING:
    from collections.abc import Iterator

    from singletrack import Bicycle, CoefficientMatrices, Rider

MATRICES = ("M", "C1", "K0", "K2")
POSTURES = ("rigid", "upright", "leaned")
SPEEDS = np.array([0.0, 3.0, 8.0])


def seated(name: str = "browser") -> tuple[Bicycle, Rider]:
    bicycle = load_bicycle(name)
    return bicycle, load_rider("rider-a").on(bicycle)


def changed(record: Any, name: str, factor: Any) -> Any:
    return record.replace(**{name: getattr(record, name) * factor})


def every_field() -> list[tuple[str, str]]:
    bicycle, rider = seated()
    return [("bicycle", name) for name in bicycle.values()] + [("rider", name) for name in rider.values()]


@pytest.mark.parametrize("posture", POSTURES)
def test_any_field_may_be_an_array(posture: str) -> None:
    """Each design of a batch is the design alone, whichever field varies."""
    factors = np.array([0.99, 1.0, 1.01])
    bicycle, rider = seated()
    for owner, name in every_field():

        def model(factor: Any, owner: str = owner, name: str = name) -> CoefficientMatrices:
            if owner == "bicycle":
                return coefficients(changed(bicycle, name, factor), rider, posture)
            return coefficients(bicycle, changed(rider, name, factor), posture)

        batch = model(factors)
        roots = batch.eigenvalues(SPEEDS)
        for i, factor in enumerate(factors):
            alone = model(factor)
            for matrix in MATRICES:
                found = np.broadcast_to(getattr(batch, matrix), (3, 2, 2))[i]
                np.testing.assert_allclose(found, getattr(alone, matrix), rtol=1e-12, atol=1e-12, err_msg=name)
            found = np.broadcast_to(roots, (3, 3, 4))[i]
            np.testing.assert_allclose(found, alone.eigenvalues(SPEEDS), rtol=1e-7, err_msg=name)


@pytest.mark.parametrize("posture", POSTURES)
def test_leading_dimensions_broadcast(posture: str) -> None:
    bicycle, rider = seated("stratos")
    trails, masses = np.linspace(0.05, 0.06, 3)[:, None], np.linspace(60.0, 90.0, 4)
    batch = coefficients(bicycle.replace(trail=trails), rider.replace(rider_mass=masses), posture)
    assert batch.shape == (3, 4)
    assert batch.valid.all()
    assert batch.eigenvalues(SPEEDS).shape == (3, 4, 3, 4)
    assert batch.modes(SPEEDS).eigenvalues.shape == (3, 4, 3, 4)
    assert batch.critical_speeds().ranges.shape == (3, 4, 3, 2)
    corner = coefficients(bicycle.replace(trail=0.06), rider.replace(rider_mass=60.0), posture)
    np.testing.assert_allclose(batch.M[2, 0], corner.M, rtol=1e-12)


@pytest.mark.parametrize("posture", POSTURES)
def test_order_of_designs_does_not_matter(posture: str) -> None:
    rng = np.random.default_rng(1)
    bicycle, rider = seated()
    trails, order = rng.uniform(0.02, 0.08, 50), rng.permutation(50)
    one = coefficients(bicycle.replace(trail=trails), rider, posture).eigenvalues(SPEEDS)
    other = coefficients(bicycle.replace(trail=trails[order]), rider, posture).eigenvalues(SPEEDS)
    np.testing.assert_allclose(other, one[order], rtol=1e-9)


def test_many_speeds_and_designs_fall_into_pieces_without_a_seam() -> None:
    bicycle = load_bicycle("benchmark").replace(trail=np.linspace(0.01, 0.1, 37))
    many = np.linspace(0.0, 12.0, 20_001)  # one design in several pieces
    speeds = many[::20]  # 37 x 1001 problems: several pieces
    roots = coefficients(bicycle).eigenvalues(speeds)
    for i, k in [(0, 0), (7, 991), (8, 0), (36, 1000)]:
        alone = coefficients(load_bicycle("benchmark").replace(trail=bicycle.trail[i])).eigenvalues(speeds[k])
        np.testing.assert_allclose(roots[i, k], alone[0], rtol=1e-10)
    np.testing.assert_array_equal(coefficients(bicycle).eigenvalues(many)[3, ::20], roots[3])


class TestFaults:
    def test_bad_values_are_flagged_in_place(self) -> None:
        trail = np.array([0.05, np.nan, 0.05, 0.05])
        mass = np.array([4.0, 4.0, -1.0, 4.0])
        bicycle = load_bicycle("stratos").replace(trail=trail, front_frame_mass=mass)
        model = coefficients(bicycle)
        assert model.valid.tolist() == [True, False, False, True]
        reasons = [fault.reason((i,)) for i in (1, 2) for fault in model.faults if fault.bad[i]]
        assert reasons == [
            "trail = nan m, must be a finite number",
            "front_frame_mass = -1 kg, must be greater than zero",
        ]
        roots = model.eigenvalues(SPEEDS)
        assert np.isnan(roots[[1, 2]]).all()
        np.testing.assert_array_equal(roots[0], roots[3])
        alone = coefficients(load_bicycle("stratos").replace(trail=0.05, front_frame_mass=4.0))
        np.testing.assert_allclose(roots[0], alone.eigenvalues(SPEEDS), rtol=1e-10)

    @pytest.mark.parametrize("posture", POSTURES)
    def test_a_rider_who_cannot_reach_is_flagged_in_place(self, posture: str) -> None:
        bicycle, rider = seated()
        model = coefficients(bicycle, rider.replace(upper_arm_length=np.array([0.28, 0.05, 0.29])), posture)
        assert model.valid.tolist() == [True, False, True]
        assert "the shoulder-grip distance is" in model.faults[0].reason((1,))
        assert np.isfinite(model.eigenvalues(SPEEDS)[[0, 2]]).all()

    def test_loops_that_cannot_move_are_flagged_in_place(self) -> None:
        """An arm stretched to its full length has no angle left at the elbow."""
        bicycle, rider = seated()
        lengths = np.array([0.33, 0.2, 0.33])
        straight = coefficients(bicycle, rider.replace(lower_arm_length=lengths), "rigid")
        points = reach(bicycle, rider)
        lengths[1] = points - rider.upper_arm_length
        assert straight.valid.tolist() == [True, False, True]
        model = coefficients(bicycle, rider.replace(lower_arm_length=lengths * np.array([1, 1 + 1e-15, 1])), "upright")
        assert model.valid.tolist() == [True, False, True]
        assert np.isfinite(model.M[[0, 2]]).all()


def reach(bicycle: Bicycle, rider: Rider) -> float:
    from singletrack.body import skeleton

    points = skeleton(bicycle, rider)
    return float(np.linalg.norm((points[15] - (points[19] + points[20]) / 2)[[0, 2]]))


@pytest.fixture
def jax() -> Iterator[Any]:
    module = pytest.importorskip("jax")
    with module.enable_x64(new_val=True):
        yield module


def matrices(bicycle: Any, rider: Any, posture: str) -> tuple[Any, ...]:
    model = coefficients(bicycle, rider, posture)
    return tuple(getattr(model, name) for name in MATRICES)


@pytest.mark.slow
@pytest.mark.parametrize("posture", POSTURES)
def test_jax_gradients_of_all_parameters_agree_with_complex_steps(jax: Any, posture: str) -> None:
    bicycle, rider = seated()

    def function(b: dict[str, Any], r: dict[str, Any]) -> tuple[Any, ...]:
        return matrices(bicycle.replace(**b), rider.replace(**r), posture)

    arguments = tuple({k: jax.numpy.asarray(v) for k, v in record.values().items()} for record in (bicycle, rider))
    for found, wanted in zip(function(*arguments), matrices(bicycle, rider, posture), strict=True):
        np.testing.assert_allclose(found, wanted, rtol=1e-13, atol=1e-13)
    gradients = jax.jit(jax.jacfwd(function, argnums=(0, 1)))(*arguments)
    step = 1e-40
    for owner, name in every_field():
        which = ("bicycle", "rider").index(owner)
        record = (bicycle, rider)[which]
        with complex_steps():
            moved = record.replace(**{name: complex(getattr(record, name), step)})
            stepped = matrices(*((moved, rider) if owner == "bicycle" else (bicycle, moved)), posture)
        for matrix, gradient in zip(stepped, gradients, strict=True):
            exact = np.imag(matrix) / step
            scale = 1 + np.abs(exact).max()
            np.testing.assert_allclose(gradient[which][name], exact, rtol=1e-9, atol=1e-12 * scale, err_msg=name)


def test_jax_compiles_and_maps(jax: Any) -> None:
    bicycle = load_bicycle("benchmark")
    trails = np.linspace(0.02, 0.1, 5)

    def roots(trail: Any) -> Any:
        return coefficients(bicycle.replace(trail=trail)).eigenvalues(jax.numpy.asarray(SPEEDS))

    wanted = coefficients(bicycle.replace(trail=trails)).eigenvalues(SPEEDS)
    mapped = jax.jit(jax.vmap(roots))(jax.numpy.asarray(trails))
    np.testing.assert_allclose(mapped, wanted, rtol=1e-9)
    np.testing.assert_allclose(roots(jax.numpy.asarray(trails)), wanted, rtol=1e-9)


def test_jax_gradient_of_eigenvalues_is_that_of_perturbation_theory(jax: Any) -> None:
    """ds/dp = -u'(dP/dp)w / u'(dP/ds)w, with the null vectors u and w of P(s) = M s² + v C1 s + g K0 + v² K2."""
    bicycle, v = load_bicycle("benchmark"), 4.0

    def roots(trail: Any) -> Any:
        return coefficients(bicycle.replace(trail=trail)).eigenvalues(jax.numpy.asarray([v]))[0]

    gradient = np.asarray(jax.jacfwd(roots)(jax.numpy.asarray(bicycle.trail)))
    model = coefficients(bicycle)
    with complex_steps():
        moved = coefficients(bicycle.replace(trail=complex(bicycle.trail, 1e-40)))
    change = {name: np.imag(getattr(moved, name)) / 1e-40 for name in MATRICES}
    for s, found in zip(model.eigenvalues(v)[0], gradient, strict=True):
        pencil = model.M * s**2 + v * model.C1 * s + 9.81 * model.K0 + v**2 * model.K2
        left, _, right = np.linalg.svd(pencil)
        u, w = left[:, -1].conj(), right[-1].conj()
        by_s = u @ (2 * s * model.M + v * model.C1) @ w
        by_trail = u @ (change["M"] * s**2 + v * change["C1"] * s + 9.81 * change["K0"] + v**2 * change["K2"]) @ w
        np.testing.assert_allclose(found, -by_trail / by_s, rtol=1e-9)


@pytest.mark.parametrize("posture", ["upright", "leaned"])
def test_any_one_field_may_be_traced(jax: Any, posture: str) -> None:
    """JAX arrays and plain numbers mix, whichever field it is."""
    bicycle, rider = seated()
    for owner, name in every_field():

        def function(value: Any, owner: str = owner, name: str = name) -> tuple[Any, ...]:
            if owner == "bicycle":
                return matrices(bicycle.replace(**{name: value}), rider, posture)
            return matrices(bicycle, rider.replace(**{name: value}), posture)

        shapes = jax.eval_shape(function, jax.numpy.asarray(0.5))
        assert [shape.shape for shape in shapes] == [(2, 2)] * 4


def test_jax_reverse_mode_gradient(jax: Any) -> None:
    bicycle, rider = seated()

    def steer_inertia(trail: Any) -> Any:
        return coefficients(bicycle.replace(trail=trail), rider, "upright").M[1, 1]

    with complex_steps():
        moved = coefficients(bicycle.replace(trail=complex(bicycle.trail, 1e-40)), rider, "upright")
    found = jax.grad(steer_inertia)(jax.numpy.asarray(bicycle.trail))
    np.testing.assert_allclose(found, np.imag(moved.M[1, 1]) / 1e-40, rtol=1e-12)


def test_single_precision_is_refused() -> None:
    module = pytest.importorskip("jax")
    with module.enable_x64(new_val=False), pytest.raises(InputError, match="jax_enable_x64"):
        coefficients(load_bicycle("benchmark").replace(trail=module.numpy.asarray(0.08)))
