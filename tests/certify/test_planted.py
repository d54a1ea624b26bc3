"""Certificates against systems whose answer is known exactly: right, or undecided, never wrong."""

from __future__ import annotations

from fractions import Fraction
from itertools import pairwise

import flint
import mpmath
import numpy as np
import pytest

from certify.planted import AsBalls, complex_roots, exact, grazing, random_system, unstable_at
from singletrack.certify.certificate import certified

GAPS = [Fraction(sign, 10**power) for power in (12, 24, 60) for sign in (1, -1)]


def require_true(certificate, system, speeds):
    """Each claimed count is that of the roots in sixty digits."""
    for speed in speeds:
        claims = [each.unstable for each in certificate.ranges if each.start < speed < each.stop]
        assert claims in ([], [unstable_at(system, speed)])


def require_contiguous(certificate):
    """Ranges, crossings and undecided intervals cover all speeds."""
    spans = [(each.start, each.stop) for each in certificate.ranges] + list(certificate.undecided)
    spans = sorted(spans + [(c.speed.lower, c.speed.upper) for c in certificate.crossings])
    assert spans[0][0] == 0
    assert max(high for _, high in spans) == float("inf")
    reached = 0.0
    for low, high in spans:
        assert low <= reached
        reached = max(reached, high)


@pytest.mark.parametrize("n", [2, 3, 4])
@pytest.mark.parametrize("as_given", [lambda system: system, AsBalls], ids=["exact", "balls"])
def test_random_systems(n, as_given):
    rng = np.random.default_rng(n)
    for _ in range(6):
        system = random_system(rng, n)
        certificate = certified(as_given(system), {})
        assert certificate.status == "certified"
        require_contiguous(certificate)
        beside = [c.speed.lower * (1 - 1e-9) for c in certificate.crossings]
        beside += [c.speed.upper * (1 + 1e-9) for c in certificate.crossings]
        require_true(certificate, system, [*rng.uniform(0, 20, 4), 1e3, *beside])
        for crossing, (before, after) in zip(certificate.crossings, pairwise(certificate.ranges), strict=True):
            assert (crossing.before, crossing.after) == (before.unstable, after.unstable)
            assert crossing.before != crossing.after


@pytest.mark.parametrize("gap", GAPS, ids=[f"{float(gap):g}" for gap in GAPS])
@pytest.mark.parametrize("as_given", [lambda system: system, AsBalls], ids=["exact", "balls"])
def test_two_speeds_next_to_each_other_are_told_apart(gap, as_given):
    rng = np.random.default_rng(7)
    found = 0
    for _ in range(6):
        system, kappa = grazing(rng, gap)
        certificate = certified(as_given(system), {})
        require_contiguous(certificate)
        with mpmath.workdps(80):
            share = abs(gap / kappa)
            part = mpmath.sqrt(mpmath.mpf(share.numerator) / share.denominator)
            places = [mpmath.sqrt(1 - part), mpmath.sqrt(1 + part)] if gap / kappa < 0 else []
            # Two roots may also add up to zero without a crossing, one on either side.
            for crossing in certificate.crossings:
                if crossing.kind == "pair" and abs(crossing.speed.lower - 1) < 1e-3:
                    off = min(abs(mpmath.mpf(crossing.speed.middle) - place) for place in places)
                    assert off <= mpmath.mpf(crossing.speed.radius)
                    at, aside = (Fraction(mpmath.nstr(x, 70)) for x in (mpmath.mpf(crossing.speed.middle), part / 50))
                    assert crossing.before == unstable_at(system, at - aside)
                    assert crossing.after == unstable_at(system, at + aside)
                    found += 1
        assert certificate.status == "certified"
        require_true(certificate, system, [0.5, 2.0])
    assert found or gap > 0


def test_a_pair_that_touches_the_axis_is_a_touch_exactly_and_undecided_in_balls():
    rng = np.random.default_rng(11)
    stable_beside = 0
    for trial in range(24):
        system, _ = grazing(rng, Fraction(0))
        certificate = certified(system, {})
        assert certificate.status == "certified"
        require_true(certificate, system, [0.9, 1.1])
        beside = {unstable_at(system, Fraction(999, 1000)), unstable_at(system, Fraction(1001, 1000))}
        if beside == {0}:
            stable_beside += 1
            assert [c.direction for c in certificate.crossings if c.speed.contains(1.0)] == ["touches"]
            assert not any(low < 1 < high for low, high in certificate.stable_ranges)
        if trial % 8:
            continue
        blurred = certified(AsBalls(system), {})
        require_true(blurred, system, [0.9, 1.1])
        assert blurred.status == "undecided in part"
        assert any(low <= 1 <= high for low, high in blurred.undecided)
    assert stable_beside


@pytest.mark.parametrize("gap", [Fraction(0), Fraction(1, 10**12), Fraction(1, 10**30)])
def test_two_real_roots_that_pass_zero_at_the_same_speed_or_nearly(gap):
    # Two decoupled freedoms, s² + s + v² - 1 and s² + s + v² - 1 - gap.
    one = [[1, 0], [0, 1]]
    system = exact(2, M=one, C0=one, S0=[[-1, 0], [0, -1 - gap]], K2=one)
    certificate = certified(system, {})
    counts = [each.unstable for each in certificate.ranges]
    assert certificate.status == "certified"
    assert (counts[0], counts[-1]) == (2, 0)
    assert [c.kind for c in certificate.crossings] == (["real"] * 2 if gap else ["both"])
    blurred = certified(AsBalls(system), {})
    # In balls, the leading coefficient of D is not seen to vanish: infinity stays open, and is said to.
    assert [c.kind for c in blurred.crossings] == ["real"] * (2 if gap else 0)
    assert any(low <= 1 <= high for low, high in blurred.undecided) == (not gap)
    assert all(low <= 1 <= high or low > 1e9 for low, high in blurred.undecided)


def test_a_root_and_a_pair_at_the_same_speed_are_both():
    # s² + s + v² - 1 and s² + (v - 1) s + 1, where a root passes zero and a pair the axis at v = 1.
    one = [[1, 0], [0, 1]]
    system = exact(2, M=one, C0=[[1, 0], [0, -1]], C1=[[0, 0], [0, 1]], S0=[[-1, 0], [0, 1]], K2=[[1, 0], [0, 0]])
    certificate = certified(system, {})
    assert [(c.kind, c.before, c.after) for c in certificate.crossings] == [("both", 3, 0)]
    assert certified(AsBalls(system), {}).status == "undecided in part"


def test_what_is_marginal_at_every_speed_is_said_to_be():
    one = [[1, 0], [0, 1]]
    without_damping = certified(exact(2, M=one, S0=[[1, 0], [0, 2]]), {})
    assert without_damping.always == "two roots add up to zero at every speed"
    assert without_damping.stable_ranges == []
    without_stiffness = certified(exact(2, M=one, C0=one, S0=[[1, 0], [0, 0]]), {})
    assert without_stiffness.always == "a root is zero at every speed"
    assert without_stiffness.at_rest is not None


def test_stable_at_every_speed_has_no_crossing_and_reaches_infinity():
    one = [[1, 0], [0, 1]]
    certificate = certified(exact(2, M=one, C0=one, S0=one), {})
    assert certificate.stable_ranges == [(0.0, float("inf"))]
    assert certificate.to_dict()["stable_ranges"] == [[0.0, None]]
    assert certificate.at_rest == (0, 4, 0, 0)


def test_a_mass_matrix_that_may_be_singular_decides_nothing():
    system = exact(2, M=[[1, 0], [0, 0]], C0=[[1, 0], [0, 1]], S0=[[1, 0], [0, 1]])
    certificate = certified(system, {})
    assert (certificate.status, certificate.ranges) == ("undecided", ())


def test_isolation_agrees_with_exact_arithmetic():
    from singletrack.certify.families import Family
    from singletrack.certify.isolation import isolate

    rng = np.random.default_rng(5)
    for _ in range(60):
        roots = sorted({Fraction(int(a), int(b)) for a, b in rng.integers(1, 90, (4, 2))})
        exact_polynomial = flint.fmpq_poly([1])
        for root in roots:
            exact_polynomial *= flint.fmpq_poly([flint.fmpq(-root.numerator, root.denominator), 1])
        exact_polynomial *= flint.fmpq_poly([int(rng.integers(1, 9)), 1, 1])
        with flint.ctx.workprec(128):
            found = isolate(Family(flint.arb_poly([flint.arb(c) for c in exact_polynomial.coeffs()])), 64)
            balls = [one.low.union(one.high) for one in found]
            places = [flint.arb(flint.fmpq(root.numerator, root.denominator)) for root in roots]
        assert all(one.single for one in found)
        assert all(any(ball.overlaps(place) for ball in balls) for place in places)
        more = [root for root, _ in complex_roots(exact_polynomial) if root.imag == 0 and root.real > 0]
        assert len(found) == len(more)
