"""Sensitivities: against complex steps through the equations themselves, and across folds."""

from __future__ import annotations

import numpy as np
import pytest

from singletrack import InputError, load_bicycle, load_rider
from singletrack.analysis.designs import Design
from singletrack.analysis.ends import critical_ends
from singletrack.analysis.sensitivity import sensitivity
from singletrack.analysis.sobol import design_results, sobol_indices
from singletrack.arrays import complex_steps
from singletrack.linear import critical_speeds, eigenvalues
from singletrack.posture import Options

STEP = 1e-40


def designs():
    rider = load_rider("rider-a")
    yield Design.of(load_bicycle("benchmark"))
    yield Design.of(load_bicycle("browser"), rider, "rigid")
    yield Design.of(load_bicycle("stratos"), rider, "leaned")
    springs = {"torso lean": 300.0, "steer": 2.0}
    dampers = {"torso lean": 30.0}
    lean = Options("leaned", torso_lean=True, springs=springs, dampers=dampers)
    yield Design.of(load_bicycle("stratos"), rider, lean)


def determinant(entries):
    """Return the determinant of a matrix of polynomials, by cofactors: no complex number that was not there before."""
    if len(entries) == 1:
        return entries[0][0]
    total = np.zeros(1)
    for j, entry in enumerate(entries[0]):
        minor = [row[:j] + row[j + 1 :] for row in entries[1:]]
        total = np.polyadd(total, (-1) ** j * np.polymul(entry, determinant(minor)))
    return total


def residual(model, v, w):
    """Return the even and the odd part of det P(i w) at speed v, both analytic in everything."""
    C = model.C0 + v * model.C1
    K = model.S0 + model.gravity * model.K0 + v**2 * model.K2
    M, n = np.asarray(model.M), model.freedoms
    polynomial = determinant([[np.array([M[i, j], C[i, j], K[i, j]]) for j in range(n)] for i in range(n)])[::-1]
    even, odd = polynomial[::2], polynomial[1::2]
    return np.array([np.polyval((part * (-1.0) ** np.arange(len(part)))[::-1], w**2) for part in (even, odd)])


def critical_by_newton(model, v, w):
    """Solve both parts for speed and frequency, in complex numbers; the frequency is zero for a real crossing."""
    x = np.array([v, w], dtype=complex)
    for _ in range(8):
        if w == 0:
            f = residual(model, x[0], 0.0)[0]
            slope = (residual(model, x[0] + 1e-6, 0.0)[0] - residual(model, x[0] - 1e-6, 0.0)[0]) / 2e-6
            x[0] -= f / slope
            continue
        f = residual(model, *x)
        columns = [(residual(model, *(x + d)) - residual(model, *(x - d))) / 2e-6 for d in 1e-6 * np.eye(2)]
        x -= np.linalg.solve(np.array(columns).T, f)
    return x[0]


@pytest.mark.parametrize("design", list(designs()), ids=lambda d: f"{d.title} {d.options.title}")
def test_critical_speeds_against_a_complex_step_through_the_equations(design):
    names = ["trail", "steer_axis_tilt", "front_wheel_mass", "rear_frame_x", "front_frame_inertia_zz"]
    names += [] if design.rider is None else ["rider_mass", "torso_length"]
    names += [] if not design.options.springs else ["spring at torso lean", "damper at torso lean", "spring at steer"]
    found = sensitivity(design, names=names)
    assert found.results
    h = 1e-20
    for row, result in enumerate(found.results):
        v = found.values[row]
        own = design.model()
        w = 0.0
        if "capsize" not in result:
            roots = eigenvalues(own, v)[0]
            w = float(roots[np.argmin(np.abs(roots.real) + 1e3 * (roots.imag <= 0))].imag)
        for column, name in enumerate(names):
            with complex_steps():
                moved = design.changed({name: design.values()[name] + 1j * h}).model()
            exact = critical_by_newton(moved, v, w).imag / h
            assert found.derivatives[row, column] == pytest.approx(exact, rel=1e-9, abs=1e-9), (result, name)


def test_matrix_entries_are_exact_to_a_complex_step():
    for design in designs():
        names = list(design.values())
        found = sensitivity(design, ["matrices"], names=names)
        rows = [i for i, name in enumerate(found.results) if name == "K0 steer, steer"]
        for column, name in enumerate(names):
            with complex_steps():
                moved = design.changed({name: design.values()[name] + 1j * STEP}).model()
            exact = np.imag(np.asarray(moved.K0)[1, 1]) / STEP
            assert found.derivatives[rows[0], column] == pytest.approx(exact, rel=1e-9, abs=1e-12)


def test_eigenvalues_follow_their_derivatives():
    for design in designs():
        names = ["trail", "rear_frame_mass"]
        found = sensitivity(design, ["eigenvalues"], [3.1, 7.3], names)
        h = 1e-5
        for column, name in enumerate(names):
            value = float(design.values()[name])
            ends = [
                sensitivity(design.changed({name: value + d}), ["eigenvalues"], [3.1, 7.3], names).values
                for d in (h, -h)
            ]
            numeric = (ends[0] - ends[1]) / (2 * h)
            np.testing.assert_allclose(found.derivatives[:, column], numeric, rtol=1e-5, atol=1e-5)


def test_small_changes_move_critical_speeds_as_the_derivative_says():
    design = Design.of(load_bicycle("benchmark"))
    names = ("trail", "steer_axis_tilt", "front_frame_mass")
    found = sensitivity(design, names=names)
    ends = critical_ends(design, names, np.full(3, 1e-6))
    slope = (ends.speeds[..., 1] - ends.speeds[..., 0]) / 2e-6
    np.testing.assert_allclose(slope, found.derivatives, rtol=1e-5)


def test_across_a_fold_it_says_where_critical_speeds_cease():
    design = Design.of(load_bicycle("browser"))
    found = sensitivity(design, names=["front_wheel_mass", "trail"])
    row = found.row("weave speed")
    fold = found.folds[row, 0, 0]
    assert np.isfinite(fold)
    assert np.isnan(found.ends[row, 0, 0])
    assert found.ranked("weave speed")[0] == 0  # before everything that only moves it

    def weave(change):
        mass = design.bicycle.front_wheel_mass + change
        return critical_speeds(design.changed({"front_wheel_mass": mass}).model()).weave

    assert len(weave(fold + 1e-7)) != len(weave(fold - 1e-7))


def test_designs_that_cannot_be_are_told_from_folds():
    design = Design.of(load_bicycle("stratos"), load_rider("rider-a"), "leaned")
    found = sensitivity(design, names=["wheel_base"])  # 10 mm further forward the rider does not reach
    assert found.impossible.tolist() == [[False, True]]
    assert np.isnan(found.folds).all()


def test_ranking_by_deviation_needs_one():
    with pytest.raises(InputError, match="no parameter has a standard deviation"):
        sensitivity(Design.of(load_bicycle("benchmark")), by="deviation")
    with pytest.raises(InputError, match="unknown parameter 'trial'"):
        sensitivity(Design.of(load_bicycle("benchmark")), names=["trial"])


def test_sobol_on_ishigami():
    # Ishigami and Homma 1990: a = 7, b = 0.1, all indices in closed form.
    a, b = 7.0, 0.1

    def ishigami(x):
        return {"f": np.sin(x[:, 0]) + a * np.sin(x[:, 1]) ** 2 + b * x[:, 2] ** 4 * np.sin(x[:, 0])}

    found = sobol_indices(ishigami, dict.fromkeys("xyz", (-np.pi, np.pi)), samples=4096)
    variance = a**2 / 8 + b * np.pi**4 / 5 + b**2 * np.pi**8 / 18 + 0.5
    first = np.array([0.5 * (1 + b * np.pi**4 / 5) ** 2, a**2 / 8, 0.0]) / variance
    crossed = b**2 * np.pi**8 * (1 / 18 - 1 / 50) / variance
    np.testing.assert_allclose(found.first[0], first, atol=0.02)
    np.testing.assert_allclose(found.total[0], first + np.array([crossed, 0.0, crossed]), atol=0.02)
    assert found.deviation[0] == pytest.approx(np.sqrt(variance), rel=0.01)


def test_sobol_of_designs_and_where_it_has_no_meaning():
    design = Design.of(load_bicycle("benchmark"))
    names = ("trail", "steer_axis_tilt")
    ranges = {"trail": (0.07, 0.09), "steer_axis_tilt": (0.3, 0.33)}
    one, two = (sobol_indices(design_results(design, names, 5.0), ranges, 128, seed=3) for _ in range(2))
    np.testing.assert_array_equal(one.first, two.first)
    # Over a small range speeds are linear in both: shares are those of the slopes.
    slopes = sensitivity(design, names=list(names))
    widths = np.array([0.02, 0.03])
    for r, result in enumerate(("weave speed", "capsize speed")):
        part = (slopes.derivatives[slopes.row(result)] * widths) ** 2
        np.testing.assert_allclose(one.total[r], part / part.sum(), atol=0.06)
    with pytest.raises(InputError, match="does not exist for"):
        sobol_indices(design_results(design, ("trail",), 5.0), {"trail": (-0.08, 0.08)}, 64)
    with pytest.raises(InputError, match="power of two"):
        sobol_indices(design_results(design, ("trail",), 5.0), {"trail": (0.07, 0.08)}, 100)
