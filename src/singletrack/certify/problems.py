"""What is certified: matrices of a design or a box of designs, as polynomials in the speed, exact or of balls."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Any, Protocol

import flint
import numpy as np

from singletrack.certify.analysis import Factor
from singletrack.certify.determinants import bezout_determinant, characteristic_coefficients
from singletrack.certify.families import Family

__all__ = ["Box", "ExactMatrices", "Posed", "Problem"]

#: For each parameter that is an interval, the part of it that is meant, from 0 to 1.
Box = tuple[tuple[Fraction, Fraction], ...]
MATRICES = ("M", "C0", "C1", "S0", "K0", "K2")


@dataclass(frozen=True)
class Posed:
    """The polynomials of a box of designs: enclosures of the factors, and a_k of a design in its middle.

    Attributes
    ----------
    coefficients : sequence of arb_poly, shape (2 n + 1,)
    factors : tuple of Factor
    at_rest : sequence of arb, shape (2 n + 1,)
        Enclose a_k(0) of all designs.
    leading : arb
        Encloses a_2n = det M of all designs.
    always : str
        Why roots stay on the imaginary axis, or beyond it, at every speed; else empty.
    influence : tuple of float, shape (k,)
        How much each parameter that is an interval widens the enclosures.
    """

    coefficients: Sequence[Any]
    factors: tuple[Factor, ...]
    at_rest: Sequence[Any]
    leading: Any
    always: str = ""
    influence: tuple[float, ...] = ()


class Problem(Protocol):
    """Something whose stability can be certified."""

    @property
    def dimensions(self) -> int:
        """Number of parameters that are intervals."""

    def posed(self, box: Box) -> Posed:
        """Return the polynomials of the designs of a box, in the precision at hand."""


@dataclass(frozen=True, eq=False)
class ExactMatrices:
    """Matrices with rational entries: everything about multiple roots is decided exactly.

    Attributes
    ----------
    matrices : dict of str to array of Fraction, shape (n, n)
        M, C0, C1, S0, K0, K2.
    gravity : Fraction
    """

    matrices: dict[str, np.ndarray]
    gravity: Fraction
    dimensions: int = 0

    def posed(self, box: Box) -> Posed:  # noqa: ARG002  # there is but one design
        """Return the polynomials (box is not used): factors without multiple roots that have none in common."""

        def polynomial(*terms: Fraction) -> Any:
            return flint.fmpq_poly([flint.fmpq(term.numerator, term.denominator) for term in terms])

        of, n = self.matrices, len(self.matrices["M"])
        each = [(i, j) for i in range(n) for j in range(n)]
        M, C, K = (np.empty((n, n), dtype=object) for _ in range(3))
        for at in each:
            M[at] = polynomial(of["M"][at])
            C[at] = polynomial(of["C0"][at], of["C1"][at])
            K[at] = polynomial(of["S0"][at] + self.gravity * of["K0"][at], Fraction(0), of["K2"][at])
        exact = characteristic_coefficients(M, C, K)
        coefficients = [_as_balls(a) for a in exact]
        vanishing = exact[0], bezout_determinant(exact)
        always = always_of((vanishing[0].is_zero(), vanishing[1].is_zero()))
        at_rest = [a[0] for a in coefficients]
        return Posed(coefficients, () if always else _coprime(*vanishing), at_rest, coefficients[-1][0], always)


def always_of(zero: tuple[bool, bool]) -> str:
    """Return why some root is at no speed to the left of the axis, "" if that is not seen.

    Parameters
    ----------
    zero : (bool, bool)
        Whether a_0(v) and D(v) vanish identically.
    """
    if zero[0]:
        return "a root is zero at every speed"
    return "two roots add up to zero at every speed" if zero[1] else ""


def _as_balls(polynomial: Any) -> Any:
    return flint.arb_poly([flint.arb(c) for c in polynomial.coeffs()])


def _coprime(constant: Any, pairs: Any) -> tuple[Factor, ...]:
    """Return the events' factors: each root once, those of both polynomials apart."""
    single, double = (_squarefree(_stripped(polynomial)) for polynomial in (constant, pairs))
    both = single.gcd(double)
    parts = ((single // both, "real"), (double // both, "pair"), (both, "both"))
    return tuple(Factor(Family(_as_balls(part)), kind) for part, kind in parts if part.degree() > 0)


def _stripped(polynomial: Any) -> Any:
    count = 0
    while bool(polynomial[count] == 0):
        count += 1
    return polynomial.right_shift(count)


def _squarefree(polynomial: Any) -> Any:
    return polynomial // polynomial.gcd(polynomial.derivative()) if polynomial.degree() > 0 else polynomial
