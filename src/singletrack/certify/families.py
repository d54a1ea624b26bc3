"""Polynomials in the speed that depend on parameters: one in the middle of a box, and how it changes over the box."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import flint

__all__ = ["Family", "sign"]


@dataclass(frozen=True, eq=False)
class Family:
    """All polynomials p(v; x) = middle(v) + Σ_k slopes_k(v; box) (x_k - middle_k), by the mean value theorem.

    The polynomial of one design is a family without slopes. A parameter's difference multiplies the whole of its slope:
    taken into each coefficient apart, the terms of the slope could no longer cancel.

    Attributes
    ----------
    middle : arb_poly
    slopes : tuple of arb_poly, shape (k,)
        Enclosures over the box of the derivatives by each parameter.
    halves : tuple of arb, shape (k,)
        Balls of all differences of a parameter from its middle.

    Examples
    --------
    All v - x with x between 1 and 3:

    >>> family = Family(flint.arb_poly([-2, 1]), (flint.arb_poly([-1]),), (flint.arb(0, 1),))
    >>> family.sign(flint.arb(4)), family.sign(flint.arb(2)), family.sign_over(flint.arb(0), flint.arb("0.9"))
    (1, 0, -1)
    """

    middle: Any
    slopes: tuple[Any, ...] = ()
    halves: tuple[Any, ...] = ()

    def __call__(self, speed: Any) -> Any:
        """Return the ball of all values at a speed (arb)."""
        changes = (slope(speed) * half for slope, half in zip(self.slopes, self.halves, strict=True))
        return sum(changes, self.middle(speed))

    def over(self, low: Any, high: Any) -> Any:
        """Return the ball of all values between two speeds (low, high: exact arbs)."""
        changes = (_over(slope, low, high) * half for slope, half in zip(self.slopes, self.halves, strict=True))
        return sum(changes, _over(self.middle, low, high))

    def sign(self, speed: Any) -> int:
        """Return the sign that all values at a speed have, 0 if that is not proven."""
        return sign(self(speed))

    def sign_over(self, low: Any, high: Any) -> int:
        """Return the sign that all values between two speeds (low, high) have, 0 if that is not proven."""
        return sign(self.over(low, high))

    @property
    def slope_families(self) -> tuple[Family, ...]:
        """The derivatives by each parameter."""
        return tuple(Family(slope) for slope in self.slopes)

    @property
    def is_zero(self) -> bool:
        """Whether all of them vanish identically, seen from what is exactly zero."""
        return not any(part.length() for part in (self.middle, *self.slopes))

    def _each(self, change: Any) -> Family:
        return Family(change(self.middle), tuple(map(change, self.slopes)), self.halves)

    def derivative(self) -> Family:
        """Return the derivatives with respect to the speed."""
        return self._each(lambda part: part.derivative())

    def turned(self) -> Family:
        """Return v^d p(1/v), d the largest degree: infinity becomes zero."""
        length = max(part.length() for part in (self.middle, *self.slopes))
        return self._each(lambda part: flint.arb_poly([part[k] for k in reversed(range(length))]))

    def stripped(self) -> Family:
        """Return the polynomials without the powers of v that all have as a factor; not for those that vanish."""
        count = 0
        while all(bool(part[count] == 0) for part in (self.middle, *self.slopes)):
            count += 1
        return self._each(lambda part: part.right_shift(count))

    def is_finite(self) -> bool:
        """Tell whether all coefficients are finite."""
        return all(c.is_finite() for part in (self.middle, *self.slopes) for c in part.coeffs())


def sign(value: Any) -> int:
    """Return the sign of an arb (value), 0 if it may be zero."""
    return 1 if bool(value > 0) else -1 if bool(value < 0) else 0


def _over(polynomial: Any, low: Any, high: Any) -> Any:
    """Return the values of a polynomial between two speeds, by its expansion about the middle."""
    middle = ((low + high) / 2).mid()
    half = (high - middle).union(low - middle)
    value = flint.arb(0)
    for coefficient in reversed(polynomial(flint.arb_poly([middle, 1])).coeffs()[1:]):
        value = (value + coefficient) * half
    # The value in the middle itself: the expansion's has been through more operations, and is wider.
    return value + polynomial(middle)
