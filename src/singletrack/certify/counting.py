"""How many roots of a polynomial have a positive real part: proven by Routh's scheme, or by enclosing each root."""

from __future__ import annotations

from itertools import pairwise
from typing import TYPE_CHECKING, Any, NamedTuple

import flint

from singletrack.certify.families import sign

if TYPE_CHECKING:
    from collections.abc import Sequence

__all__ = ["Sides", "alternates", "enclosed_roots", "sides_at_rest", "unstable_roots"]


class Sides(NamedTuple):
    """Numbers of roots with positive, negative real part, on the imaginary axis (zero among them), and at zero."""

    right: int
    left: int
    axis: int
    zero: int


def unstable_roots(coefficients: Sequence[Any]) -> int | None:
    """Return the number of roots to the right of the imaginary axis, None where it cannot be told.

    Parameters
    ----------
    coefficients : sequence of arb, shape (N + 1,)
        The constant one first; no root on the axis.

    Examples
    --------
    >>> import flint
    >>> unstable_roots([flint.arb(c) for c in (6, 11, 6, 1)]), unstable_roots([flint.arb(c) for c in (-6, 1, 4, 1)])
    (0, 1)
    """
    first, second = list(coefficients[::-1][0::2]), list(coefficients[::-1][1::2])
    signs = [sign(first[0])]
    for _ in range(len(coefficients) - 1):
        signs.append(sign(second[0]))
        if not signs[-1]:
            return _counted(coefficients)
        ratio = first[0] / second[0]
        padded = [*second[1:], 0]
        row = [a - ratio * b for a, b in zip(first[1:], padded, strict=False)]
        first, second = second, row or [0]
    return sum(one != other for one, other in pairwise(signs))


def alternates(signs: Sequence[int]) -> bool:
    """Tell whether signs alternate, none of them 0: a polynomial of such coefficients has no root z <= 0.

    Parameters
    ----------
    signs : sequence of int, shape (N + 1,)
        Of the coefficients, 0 for unknown.
    """
    return all(each * (-1) ** k == signs[0] != 0 for k, each in enumerate(signs))


def _counted(coefficients: Sequence[Any]) -> int | None:
    """Return the number of roots to the right from enclosures, where Routh's scheme meets a zero by chance."""
    roots = enclosed_roots(coefficients)
    if roots is None or not all(sign(root.real) for root in roots):
        return None
    return sum(sign(root.real) > 0 for root in roots)


def enclosed_roots(coefficients: Sequence[Any]) -> list[Any] | None:
    """Return balls (acb), each with exactly one root, ordered as eigenvalues are; None where they do not separate.

    Parameters
    ----------
    coefficients : sequence of arb, shape (N + 1,)
    """
    polynomial = flint.acb_poly(list(coefficients))
    for width in (
        flint.arb(flint.fmpq(1, 2 ** (flint.ctx.prec // 2))),
        flint.arb(1),
    ):  # else as wide as they have to be
        try:
            roots = polynomial.roots(tol=width)
        except (ValueError, ArithmeticError):
            continue
        return sorted(roots, key=lambda root: (float(root.real.mid()), float(root.imag.mid())))
    return None


def sides_at_rest(coefficients: Sequence[Any]) -> Sides | None:
    """Return on which side the roots lie where no odd power is: they come in pairs s, -s then; else by Routh's scheme.

    Parameters
    ----------
    coefficients : sequence of arb, shape (2 n + 1,)
        Those of odd powers exactly zero, or not.

    Examples
    --------
    An oscillation that neither grows nor dies, and a fall:

    >>> import flint
    >>> sides_at_rest([flint.arb(c) for c in (-12, 0, 1, 0, 1)])
    Sides(right=1, left=1, axis=2, zero=0)
    """
    total = len(coefficients) - 1
    if not all(bool(c == 0) for c in coefficients[1::2]):
        zero = next(k for k, c in enumerate(coefficients) if not bool(c == 0))
        right = unstable_roots(coefficients[zero:])
        return None if right is None else Sides(right, total - right - zero, zero, zero)
    squares = list(coefficients[0::2])
    zero = next(k for k, c in enumerate(squares) if not bool(c == 0))
    if alternates([sign(c) for c in squares[zero:]]):  # double roots need not be told apart
        right = len(squares) - 1 - zero
        return Sides(right, right, 2 * zero, 2 * zero)
    roots = enclosed_roots(squares[zero:])
    if roots is None:
        return None
    axis = right = 0
    for root in roots:
        real, crosses = sign(root.real), bool(root.imag.contains(0))
        if not crosses or real > 0:  # of s² = z that is no negative number, one of the two roots is to the right
            right += 1
        elif real < 0:  # alone in its ball, and so its own conjugate: a negative number
            axis += 2
        else:
            return None
    return Sides(right, right, axis + 2 * zero, 2 * zero)
