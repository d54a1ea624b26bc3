"""Balls of python-flint: exact numbers and constants made balls, words for the digits that are proven."""

from __future__ import annotations

import math
from contextlib import contextmanager
from dataclasses import dataclass
from decimal import ROUND_CEILING, ROUND_FLOOR, Context
from fractions import Fraction
from typing import TYPE_CHECKING, Any

import flint

if TYPE_CHECKING:
    from collections.abc import Iterator

    from singletrack.parameters.exact import Exact

__all__ = ["Ball", "ball_of", "constant_ball", "exact_ball", "fraction_ball", "precision", "rounded_down", "rounded_up"]

#: Relative doubt of a constant of a program that is neither a short decimal nor a simple combination with pi.
_DOUBT = 2.0**-50
_SHORT = 12
#: Bits that hold the ends of any interval.
_ENOUGH = 4096


@contextmanager
def precision(bits: int) -> Iterator[None]:
    """Compute with so many bits within a `with`."""
    with flint.ctx.workprec(bits):
        yield


def fraction_ball(value: Fraction) -> Any:
    """Return the ball of a rational number (value)."""
    return flint.arb(flint.fmpq(value.numerator, value.denominator))


def exact_ball(value: Exact) -> Any:
    """Return the ball of an exact number (value)."""
    return fraction_ball(value.fraction) * flint.arb.pi() ** value.pi


def constant_ball(value: float) -> Any:
    """Return what a constant of a program stands for.

    Integers and short decimals stand for themselves, doubles next to a + b pi with small a and b for that sum, all
    others for anything that rounding may have made them from.

    Parameters
    ----------
    value : float

    Examples
    --------
    >>> with precision(128):
    ...     print(constant_ball(0.4).str(20, radius=False), constant_ball(3.141592653589793).str(20, radius=False))
    0.40000000000000000000 3.1415926535897932385
    """
    if not math.isfinite(value):
        return flint.arb.nan() if math.isnan(value) else flint.arb.pos_inf() * (1 if value > 0 else -1)
    text = repr(value)
    if len(text.partition("e")[0].lstrip("-").replace(".", "").strip("0")) <= _SHORT:
        return fraction_ball(Fraction(text))
    for a in (0, -1, -2, 1, 2):
        ratio = Fraction((value - a) / math.pi).limit_denominator(360)
        if ratio and abs(a + float(ratio) * math.pi - value) <= 2 * math.ulp(value):
            return flint.arb(a) + fraction_ball(ratio) * flint.arb.pi()
    return flint.arb(value, abs(value) * _DOUBT)


@dataclass(frozen=True, order=True)
class Ball:
    """A real number that is proven to lie between two doubles, and in a decimal's neighbourhood.

    Attributes
    ----------
    lower, upper : float
        Rounded outwards; ``upper`` may be infinite.
    middle, radius : str
        The number lies within ``middle`` plus or minus ``radius``, decimals that say more than doubles can.

    Examples
    --------
    >>> Ball(4.25, 4.75, "4.5", "0.25").contains(4.3)
    True
    """

    lower: float
    upper: float
    middle: str = ""
    radius: str = "0"

    def contains(self, value: float, slack: float = 0.0) -> bool:
        """Tell whether a number lies in the ball.

        Parameters
        ----------
        value : float
        slack : float
            Relative error that the number may have by itself.
        """
        doubt = slack * abs(value)
        return self.lower - doubt <= value <= self.upper + doubt

    @property
    def width(self) -> float:
        """Difference of the bounds."""
        return self.upper - self.lower

    def digits(self, most: int = 12) -> str:
        """Return the digits that are proven, at most so many, or both bounds where these differ early.

        Parameters
        ----------
        most : int
        """
        if math.isinf(self.upper):
            return f"beyond {rounded_down(self.lower)}"
        for count in range(most, 3, -1):
            low, high = (f"{bound:.{count}g}" for bound in (self.lower, self.upper))
            if low == high:
                return low
        return f"{rounded_down(self.lower)} … {rounded_up(self.upper)}"


def rounded_down(value: float, digits: int = 5) -> str:
    """Return a number as text that is not larger, with so many digits.

    Parameters
    ----------
    value : float
    digits : int

    Examples
    --------
    >>> rounded_down(5.98507, 4), rounded_up(5.98507, 4), rounded_up(9.0, 4)
    ('5.985', '5.986', '9')
    """
    return _rounded(value, digits, ROUND_FLOOR)


def rounded_up(value: float, digits: int = 5) -> str:
    """Return a number (value) as text that is not smaller, with so many digits."""
    return _rounded(value, digits, ROUND_CEILING)


def _rounded(value: float, digits: int, rounding: str) -> str:
    return f"{Context(prec=digits, rounding=rounding).create_decimal(value).normalize():f}"


def ball_of(value: Any, digits: int = 40) -> Ball:
    """Return an arb as a :class:`Ball`.

    Parameters
    ----------
    value : arb
    digits : int
        Most decimals that are kept.
    """
    low, high = outward(value)
    text = value.str(digits).strip("[]")
    middle, _, radius = text.partition("+/-")
    return Ball(low, high, middle.strip() or "0", radius.strip() or "0")


def outward(value: Any) -> tuple[float, float]:
    """Return doubles below and above an arb."""
    with precision(_ENOUGH):
        low, high = (float(bound) for bound in (value.lower(), value.upper()))
    return math.nextafter(low, -math.inf), math.nextafter(high, math.inf)
