"""A design given in decimals, or a box of designs given by intervals, posed as a problem for certificates."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from fractions import Fraction
from typing import TYPE_CHECKING, Any

import flint
import numpy as np

from singletrack.certify.analysis import Factor
from singletrack.certify.balls import constant_ball, exact_ball, fraction_ball
from singletrack.certify.determinants import bezout_determinant, characteristic_coefficients
from singletrack.certify.duals import Centred, Dual, narrowed
from singletrack.certify.families import Family
from singletrack.certify.operations import ball_operations, centred_operations
from singletrack.certify.problems import MATRICES, Box, Posed, always_of
from singletrack.certify.program import Program
from singletrack.parameters.exact import Exact
from singletrack.tracing.evaluate import evaluate

if TYPE_CHECKING:
    from collections.abc import Sequence


__all__ = ["TracedDesigns"]


@dataclass(frozen=True, eq=False)
class TracedDesigns:
    """Designs of one program: parameters exact, or intervals between two exact numbers.

    Attributes
    ----------
    program : Program
    values : mapping of str to Exact
        Of each parameter that the program reads and that is no interval.
    intervals : mapping of str to (Exact, Exact)
    added : mapping of str to array, shape (n, n)
        What is added to matrices, such as by feedback, in decimals.
    """

    program: Program
    values: Mapping[str, Exact]
    intervals: Mapping[str, tuple[Exact, Exact]]
    added: Mapping[str, np.ndarray]

    @property
    def dimensions(self) -> int:
        """Number of parameters that are intervals."""
        return len(self.intervals)

    def matrices(self, box: Box) -> dict[str, Any]:
        """Return M, C0, C1, S0, K0, K2 and gravity as arrays of balls, of the middle of a box."""
        middle = {name: (ends[0] + ends[1]) / 2 for name, ends in zip(self.intervals, box, strict=True)}
        inputs = [self._at(name, middle.get(name)) for name in self.program.reads]
        return self._run(inputs, ball_operations(), constant_ball)

    def posed(self, box: Box) -> Posed:
        """Return the polynomials of the designs of a box, in the precision at hand."""
        if not box:
            sharp = _coefficients(self.matrices(box), _Plain())
            return _posed([Family(a) for a in (*sharp, bezout_determinant(sharp))])
        ring = _WithSlopes(len(box))
        halves = tuple(_half(self.intervals[name], ends) for name, ends in zip(self.intervals, box, strict=True))
        entries = self._run(self._inputs(box), centred_operations(halves), ring.centred)
        sharp = _coefficients(_each(entries, "middle"), _Plain())
        wide = _coefficients(_each(entries, "dual"), ring)
        wide = [_narrowed_polynomial(*pair, halves) for pair in zip(wide, sharp, strict=True)]
        pairs = bezout_determinant(sharp), bezout_determinant(wide)
        families = [Family(a, dual.slopes, halves) for a, dual in (*zip(sharp, wide, strict=True), pairs)]
        return replace(_posed(families), influence=_influence(pairs[1], halves))

    def _run(self, inputs: Sequence[Any], operations: Mapping[str, Any], constant: Any) -> dict[str, Any]:
        program = self.program
        found = evaluate(program.graph, program.outputs, inputs, operations, constant)
        named = dict(zip((*MATRICES, "gravity"), found, strict=True))
        for name, matrix in self.added.items():
            for at in np.argwhere(matrix):
                named[name][tuple(at)] = named[name][tuple(at)] + constant(float(matrix[tuple(at)]))
        return named

    def _at(self, name: str, part: Fraction | None) -> Any:
        if part is None:
            return exact_ball(self.values[name])
        low, high = (exact_ball(end) for end in self.intervals[name])
        return low + (high - low) * fraction_ball(part)

    def _inputs(self, box: Box) -> list[Centred]:
        ends = dict(zip(self.intervals, box, strict=True))
        inputs = []
        for name in self.program.reads:
            slopes = tuple(fraction_ball(Fraction(int(name == other))) for other in ends)
            parts = [self._at(name, part) for part in ends.get(name, (None,))]
            middle = parts[0] if name not in ends else self._at(name, (ends[name][0] + ends[name][1]) / 2)
            inputs.append(Centred(Dual(parts[0].union(parts[-1]), slopes), middle))
        return inputs


def _half(interval: tuple[Exact, Exact], ends: tuple[Fraction, Fraction]) -> Any:
    """Return the ball of all differences from the middle of a box, along one parameter."""
    low, high = (exact_ball(end) for end in interval)
    half = (high - low) * fraction_ball((ends[1] - ends[0]) / 2)
    return half.union(-half)


class _Plain:
    """Polynomials of balls."""

    @staticmethod
    def polynomial(*terms: Any) -> Any:

        return flint.arb_poly(list(terms))

    @staticmethod
    def zero() -> Any:
        return fraction_ball(Fraction(0))


class _WithSlopes:
    """Polynomials of balls, with derivatives by so many parameters."""

    def __init__(self, count: int) -> None:
        self.count = count

    def polynomial(self, *terms: Dual) -> Dual:
        plain = _Plain.polynomial
        slopes = tuple(plain(*(term.slopes[k] for term in terms)) for k in range(self.count))
        return Dual(plain(*(term.value for term in terms)), slopes)

    def constant(self, value: float) -> Dual:
        return Dual(constant_ball(value), (_Plain.zero(),) * self.count)

    def centred(self, value: float) -> Centred:
        return Centred(self.constant(value), constant_ball(value))

    def zero(self) -> Dual:
        return self.constant(0.0)


def _each(entries: Mapping[str, np.ndarray], part: str) -> dict[str, np.ndarray]:
    """Return one part of all entries: those in the middle of the box, or those with slopes."""
    take = np.vectorize(lambda entry: getattr(entry, part), otypes=[object])
    return {name: take(array) for name, array in entries.items()}


def _narrowed_polynomial(dual: Dual, middle: Any, halves: Sequence[Any]) -> Dual:
    """Return a polynomial with each coefficient made narrower likewise."""
    length = max(part.length() for part in (dual.value, middle, *dual.slopes))
    each = [
        narrowed(Dual(dual.value[k], tuple(slope[k] for slope in dual.slopes)), middle[k], halves).value
        for k in range(length)
    ]
    return Dual(flint.arb_poly(each), dual.slopes)


def _coefficients(of: Mapping[str, Any], ring: Any) -> list[Any]:
    """Return a_0(v) … a_2n(v)."""
    n, zero, gravity = len(of["M"]), ring.zero(), of["gravity"].item()
    M, C, K = (np.empty((n, n), dtype=object) for _ in range(3))
    for at in np.ndindex(n, n):
        M[at] = ring.polynomial(of["M"][at])
        C[at] = ring.polynomial(of["C0"][at], of["C1"][at])
        K[at] = ring.polynomial(of["S0"][at] + gravity * of["K0"][at], zero, of["K2"][at])
    return characteristic_coefficients(M, C, K)


def _influence(dual: Dual, halves: Sequence[Any]) -> tuple[float, ...]:
    """Return how much each parameter of a box widens a polynomial, relative to its coefficients."""
    sizes = [float(c.abs_upper()) for c in dual.value.coeffs()]
    found = []
    for slope, half in zip(dual.slopes, halves, strict=True):
        wide = [float((c * half).abs_upper()) for c in slope.coeffs()]
        found.append(max((w / size for w, size in zip(wide, sizes, strict=False) if size), default=0.0))
    return tuple(found)


def _posed(families: Sequence[Family]) -> Posed:
    *coefficients, pairs = families
    constant, still = coefficients[0], [a(flint.arb(0)) for a in coefficients]
    always = always_of((constant.is_zero, pairs.is_zero))
    both = [half for half in (coefficients[0::2], coefficients[1::2]) if not any(a.is_zero for a in half)]
    halves = tuple(tuple(a.stripped() for a in half) for half in both)  # the signs are those at v > 0
    factors = () if always else (Factor(constant.stripped(), "real"), Factor(pairs.stripped(), "pair", halves))
    return Posed([a.middle for a in coefficients], factors, still, coefficients[-1](flint.arb(0)), always)
