"""Values with their derivatives with respect to a few parameters, over balls or polynomials of balls."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Sequence

__all__ = ["Centred", "Dual", "narrowed"]


@dataclass(frozen=True)
class Dual:
    """An enclosure of a function over a box of parameters, and of its partial derivatives there.

    Attributes
    ----------
    value : arb or arb_poly
    slopes : tuple of arb or arb_poly, shape (k,)
        By each of the k parameters that are intervals.

    Examples
    --------
    >>> x = Dual(3, (1, 0))
    >>> y = Dual(2, (0, 1))
    >>> x * y + x
    Dual(value=9, slopes=(3, 3))
    """

    value: Any
    slopes: tuple[Any, ...]

    def __add__(self, other: Dual) -> Dual:
        return Dual(self.value + other.value, tuple(a + b for a, b in zip(self.slopes, other.slopes, strict=True)))

    def __sub__(self, other: Dual) -> Dual:
        return Dual(self.value - other.value, tuple(a - b for a, b in zip(self.slopes, other.slopes, strict=True)))

    def __neg__(self) -> Dual:
        return Dual(-self.value, tuple(-a for a in self.slopes))

    def __mul__(self, other: Dual | int) -> Dual:
        if isinstance(other, int):
            return Dual(self.value * other, tuple(a * other for a in self.slopes))
        both = zip(self.slopes, other.slopes, strict=True)
        return Dual(self.value * other.value, tuple(a * other.value + self.value * b for a, b in both))

    def __truediv__(self, other: Dual) -> Dual:
        quotient = self.value / other.value
        both = zip(self.slopes, other.slopes, strict=True)
        return Dual(quotient, tuple((a - quotient * b) / other.value for a, b in both))

    def through(self, value: Any, slope: Any) -> Dual:
        """Return f of this.

        Parameters
        ----------
        value, slope : arb
            Enclosures of f and f' over what this encloses.
        """
        return Dual(value, tuple(slope * a for a in self.slopes))


@dataclass(frozen=True)
class Centred:
    """A dual number with its value in the middle of the box."""

    dual: Dual
    middle: Any

    def __add__(self, other: Centred) -> Centred:
        return Centred(self.dual + other.dual, self.middle + other.middle)


def narrowed(dual: Dual, middle: Any, halves: Sequence[Any]) -> Dual:
    """Return a dual number of balls, its value made narrower by what the mean value theorem says.

    Parameters
    ----------
    dual : Dual
    middle : arb
        Encloses the value in the middle of the box.
    halves : sequence of arb, shape (k,)
        Balls of all differences of a parameter from its middle.
    """
    other = sum((slope * half for slope, half in zip(dual.slopes, halves, strict=True)), middle)
    both = dual.value.is_finite() and other.is_finite()
    return Dual(dual.value.intersection(other), dual.slopes) if both else dual
