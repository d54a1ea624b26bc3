"""Characteristic polynomials and Bezout determinants over any commutative ring: sums and products only, no division.

Structural zeros stay exact: a product with an exact zero is one, and nothing is subtracted that should cancel.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache
from typing import TYPE_CHECKING, Any

import flint

if TYPE_CHECKING:
    from collections.abc import Sequence

__all__ = ["bezout_determinant", "characteristic_coefficients", "determinant"]


@dataclass(frozen=True)
class _InS:
    """A polynomial in s, its coefficients elements of a ring, the constant one first."""

    terms: tuple[Any, ...]

    def __add__(self, other: _InS) -> _InS:
        short, long = sorted((self.terms, other.terms), key=len)
        return _InS((*(a + b for a, b in zip(short, long, strict=False)), *long[len(short) :]))

    def __neg__(self) -> _InS:
        return _InS(tuple(-a for a in self.terms))

    def __mul__(self, other: _InS) -> _InS:
        found: list[Any] = [None] * (len(self.terms) + len(other.terms) - 1)
        for i, a in enumerate(self.terms):
            for j, b in enumerate(other.terms):
                found[i + j] = a * b if found[i + j] is None else found[i + j] + a * b
        return _InS(tuple(found))


def determinant(rows: Sequence[Sequence[Any]]) -> Any:
    """Return the determinant of a square matrix by expansion along its rows, each minor once: n 2ⁿ products.

    Parameters
    ----------
    rows : sequence of sequences, shape (n, n)
        Of elements of a commutative ring: anything with +, - and *.

    Examples
    --------
    >>> determinant([[2, 1, 0], [1, 3, 1], [0, 1, 4]])
    18
    """
    minors: dict[frozenset[int], Any] = {frozenset([k]): entry for k, entry in enumerate(rows[-1])}
    for row in reversed(rows[:-1]):
        larger: dict[frozenset[int], Any] = {}
        for columns, minor in minors.items():
            for k in set(range(len(rows))) - columns:
                odd = sum(column < k for column in columns) % 2
                term = (-row[k] if odd else row[k]) * minor
                key = columns | {k}
                larger[key] = larger[key] + term if key in larger else term
        minors = larger
    return minors[frozenset(range(len(rows)))]


def characteristic_coefficients(M: Any, C: Any, K: Any) -> list[Any]:
    """Return a_0 … a_2n of det(M s² + C s + K) = Σ a_k s^k.

    Parameters
    ----------
    M, C, K : sequences of sequences, shape (n, n)
        Of elements of a ring, such as polynomials in the speed.

    Examples
    --------
    >>> characteristic_coefficients([[1, 0], [0, 1]], [[0, 0], [0, 2]], [[3, 0], [0, 5]])
    [15, 6, 8, 2, 1]
    """
    n = len(M)
    entries = [[_InS((K[i][j], C[i][j], M[i][j])) for j in range(n)] for i in range(n)]
    return list(determinant(entries).terms)


def bezout_determinant(coefficients: Sequence[Any]) -> Any:
    """Return the determinant D that vanishes where two roots of a polynomial add up to zero.

    Parameters
    ----------
    coefficients : sequence, shape (2 n + 1,)
        a_0 … a_2n, elements of a ring that also know products with integers.

    Notes
    -----
    With z = s², p(s) = E(z) + s O(z); s and -s are both roots, or s = 0 is a double one, where E and O have a common
    root, that is where their resultant vanishes: up to a power of a_2n, which is no zero, the determinant of their
    Bezout matrix, n x n, of (E(x) O(y) - E(y) O(x)) / (x - y). It is the last but one of Hurwitz's determinants (but
    for a power of a_2n), and by Orlando's formula the product of all sums of two roots. It is written out as a
    polynomial in the a_k first: what cancels there would leave balls about zero in place of nothing.

    Examples
    --------
    (s + 1) (s - 1) (s + 2) (s + 3), and without the pair:

    >>> bezout_determinant([-6, -5, 5, 5, 1]), bezout_determinant([24, 50, 35, 10, 1]) != 0
    (0, True)
    """
    total: Any = None
    for exponents, factor in _monomials(len(coefficients) // 2).items():
        term: Any = None
        for coefficient, exponent in zip(coefficients, exponents, strict=True):
            for _ in range(exponent):
                term = coefficient if term is None else term * coefficient
        term = term * factor
        total = term if total is None else total + term
    return total


@cache
def _monomials(n: int) -> dict[tuple[int, ...], int]:
    """Return the determinant as a polynomial in a_0 … a_2n: factors by exponents."""
    names = [f"a{k}" for k in range(2 * n + 1)]
    generators = flint.fmpz_mpoly_ctx.get(names, flint.Ordering.lex).gens()
    even, odd = list(generators[0::2]), [*generators[1::2], 0 * generators[0]]

    def entry(i: int, j: int) -> Any:
        pairs = ((j + k + 1, i - k) for k in range(min(i, n - 1 - j) + 1))
        return sum((even[high] * odd[low] - even[low] * odd[high] for high, low in pairs), 0 * generators[0])

    found = determinant([[entry(i, j) for j in range(n)] for i in range(n)])
    return {tuple(map(int, exponents)): int(factor) for exponents, factor in found.to_dict().items()}
