"""Systems whose critical speeds are known exactly, and the same numbers as balls."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from typing import Any

import flint
import numpy as np

from singletrack.certify.analysis import Factor
from singletrack.certify.determinants import bezout_determinant, characteristic_coefficients
from singletrack.certify.families import Family
from singletrack.certify.problems import MATRICES, ExactMatrices, Posed, always_of


def exact(n: int, **matrices) -> ExactMatrices:
    """Return a problem of rational matrices, zero where none is given; gravity is one."""
    full = {name: np.full((n, n), Fraction(0), dtype=object) for name in MATRICES}
    for name, rows in matrices.items():
        full[name] = np.array([[Fraction(x) for x in row] for row in rows], dtype=object)
    return ExactMatrices(full, Fraction(1))


def random_system(rng: np.random.Generator, n: int) -> ExactMatrices:
    """Return a system with springs and dampers, of small decimals."""

    def square() -> np.ndarray:
        return np.vectorize(lambda x: Fraction(round(100 * x), 100), otypes=[object])(rng.normal(size=(n, n)))

    root = square()
    M = root @ root.T + np.vectorize(Fraction, otypes=[object])(np.eye(n, dtype=int))
    K0 = square()
    damping = np.vectorize(Fraction, otypes=[object])(np.eye(n, dtype=int) * int(rng.integers(0, 3)))
    return exact(n, M=M, C0=damping, C1=square(), S0=square(), K0=K0 + K0.T, K2=square())


def grazing(rng: np.random.Generator, gap: Fraction) -> tuple[ExactMatrices, Fraction]:
    """Return an undamped system of two freedoms with D(v) / v² = kappa (v² - 1)² + gap, and kappa.

    With C1 = [c g; 1 0] and K = [k b'; 0 b], a_3 = c v, a_2 = k + b - g u, a_1 = (c b - b') v, a_0 = k b, u = v².
    k = (e_0 + e_2 u) / b and b' = c b - d_0 - d_2 u leave two linear equations for e_0 and e_2.
    """
    while True:
        c, b, g, d0, d2 = (Fraction(int(x), 7) for x in rng.integers(-20, 21, 5))
        if not c or not b or not d2:
            continue
        # kappa = c d2 (e2 / b - g) - d2², and the coefficients of u and 1.
        matrix = [
            [c * d2 / b, c * d0 / b - c * c + 2 * c * d2 / b],
            [c * d0 / b - c * c, -c * d2 / b],
        ]
        right = [
            2 * d0 * d2 + c * d0 * g - c * d2 * b + 2 * c * d2 * g + 2 * d2 * d2,
            d0 * d0 - c * d0 * b + gap - c * d2 * g - d2 * d2,
        ]
        det = matrix[0][0] * matrix[1][1] - matrix[0][1] * matrix[1][0]
        if not det:
            continue
        e0 = (right[0] * matrix[1][1] - matrix[0][1] * right[1]) / det
        e2 = (matrix[0][0] * right[1] - matrix[1][0] * right[0]) / det
        kappa = c * d2 * (e2 / b - g) - d2 * d2
        if not kappa:
            continue
        one = [[1, 0], [0, 1]]
        system = exact(
            2,
            M=one,
            C1=[[c, g], [1, 0]],
            K0=[[e0 / b, c * b - d0], [0, b]],
            K2=[[e2 / b, -d2], [0, 0]],
        )
        return system, kappa


@dataclass(frozen=True, eq=False)
class AsBalls:
    """The same matrices as balls: nothing about multiple roots is exact any more."""

    system: ExactMatrices
    dimensions: int = 0

    def posed(self, box):  # noqa: ARG002  # there is but one design
        def ball(x: Fraction):
            return flint.arb(flint.fmpq(x.numerator, x.denominator)) + flint.arb(
                0, flint.arb(2) ** (20 - flint.ctx.prec)
            )

        def polynomial(*terms: Fraction):
            return flint.arb_poly([ball(x) if x else flint.arb(0) for x in terms])

        of, n = self.system.matrices, len(self.system.matrices["M"])
        M, C, K = (np.empty((n, n), dtype=object) for _ in range(3))
        for at in np.ndindex(n, n):
            M[at] = polynomial(of["M"][at])
            C[at] = polynomial(of["C0"][at], of["C1"][at])
            K[at] = polynomial(of["S0"][at] + of["K0"][at], Fraction(0), of["K2"][at])
        sharp = characteristic_coefficients(M, C, K)
        constant, pairs = Family(sharp[0]), Family(bezout_determinant(sharp))
        always = always_of((constant.is_zero, pairs.is_zero))
        factors = () if always else (Factor(constant.stripped(), "real"), Factor(pairs.stripped(), "pair"))
        return Posed(sharp, factors, [a[0] for a in sharp], sharp[-1][0], always)


def complex_roots(polynomial: Any) -> Any:
    """Return the roots of a rational polynomial (fmpq_poly) in balls, with their multiplicities."""
    return polynomial.numer().complex_roots()


def unstable_at(system: ExactMatrices, speed) -> int:
    """Return the number of roots to the right at a speed: from the state matrix, exact, and each root enclosed."""
    of, n, v = system.matrices, len(system.matrices["M"]), Fraction(speed)

    def matrix(array: np.ndarray) -> flint.fmpq_mat:
        return flint.fmpq_mat([[flint.fmpq(x.numerator, x.denominator) for x in row] for row in array])

    M, C = matrix(of["M"]), matrix(of["C0"] + v * of["C1"])
    K = matrix(of["S0"] + of["K0"] + v * v * of["K2"])
    damping, stiffness = (-(M.inv() * other) for other in (C, K))
    rows = [[flint.fmpq(int(j == n + i)) for j in range(2 * n)] for i in range(n)]
    rows += [[*(stiffness[i, j] for j in range(n)), *(damping[i, j] for j in range(n))] for i in range(n)]
    with flint.ctx.workprec(400):
        roots = complex_roots(flint.fmpq_mat(rows).charpoly())
        return sum(count for root, count in roots if bool(root.real > 0))
