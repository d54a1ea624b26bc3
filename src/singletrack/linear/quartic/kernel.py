"""The kernel of the quartic: two real quadratic factors, polished by Newton's method, in plain arithmetic.

A monic quartic s⁴ + b s³ + c s² + d s + e is the product of s² + p₁ s + q₁ and s² + p₂ s + q₂, all real. The sum
y = q₁ + q₂ is a root of the resolvent cubic. Of its real roots that give real factors the best separated one is
taken; Halley's method finds it from outside, and Newton's method on the four equations for p₁, q₁, p₂, q₂ removes
what rounding and cancellation have done so far. Then the product of the factors is compared with the quartic.
docs/theory/eigenvalues.md has the error analysis.

The algorithm is written once, for NumPy arrays, JAX arrays and (compiled by numba) single numbers: that is why its
functions take ``where`` and ``sqrt`` as arguments, and say ``== False`` for "not".
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Callable

    from singletrack.arrays import Array

__all__ = [
    "cubic_start",
    "factor",
    "monic",
    "newton_step",
    "ordered_roots",
    "quadratic_roots",
    "reproduces",
    "resolvent_root",
    "sort_two",
]

#: Relative difference between the product of the factors and the quartic that rounding explains.
_ROUNDING = 2e-15
_THIRD = 1.0 / 3.0


def factor(
    b: Array,
    c: Array,
    d: Array,
    e: Array,
    where: Callable[..., Any],
    sqrt: Callable[..., Any],
    newton_steps: int = 1,
) -> tuple[Array, Array, Array, Array, Array]:
    """Factor quartics s⁴ + b s³ + c s² + d s + e into s² + p₁ s + q₁ and s² + p₂ s + q₂, all of them real.

    Parameters
    ----------
    b, c, d, e : array, shape (...)
    where, sqrt : callable
        Of the library the coefficients belong to.
    newton_steps : int

    Returns
    -------
    p1, q1, p2, q2 : array, shape (...)
    good : bool array, shape (...)
        Whether the product of the factors is the quartic, each coefficient to rounding of its terms.
    """
    y = resolvent_root(b, c, d, e, where, sqrt)
    # p = b/2 ± m, q = y/2 ± n: of m² and n² the one with the fewer cancelled digits gives a root, m n the other.
    m_square, n_square = 0.25 * b * b - c + y, 0.25 * y * y - e
    m_kept = m_square * (0.25 * y * y + abs(e)) > n_square * (0.25 * b * b + abs(c) + abs(y))
    first = sqrt(where(m_kept, m_square, n_square))
    other = (0.25 * b * y - 0.5 * d) / first
    m, n = where(m_kept, first, other), where(m_kept, other, first)
    # The factor with the larger q loses no digits; the other one follows from it: q₁ q₂ = e, p₁ q₂ + p₂ q₁ = d.
    turn = where((y < 0.0) == (n < 0.0), 1.0, -1.0)
    p1, q1 = 0.5 * b + turn * m, 0.5 * y + turn * n
    q2 = e / q1
    p2 = (d - p1 * q2) / q1
    for _ in range(newton_steps):
        p1, q1, p2, q2 = newton_step(b, c, d, e, p1, q1, p2, q2)
    return p1, q1, p2, q2, reproduces(b, c, d, e, p1, q1, p2, q2)


def monic(
    b: Array, c0: Array, c1: Array, d0: Array, d1: Array, e0: Array, e1: Array, e2: Array, v: Array
) -> tuple[Array, Array, Array, Array]:
    """Return b, c, d, e of the monic quartic at a speed, from what does not depend on it.

    Parameters
    ----------
    b, c0, c1, d0, d1, e0, e1, e2 : array, shape (...)
        Coefficients of :class:`~singletrack.linear.characteristic.CharacteristicPolynomial` over its first.
    v : array, shape (...)
        The speed in m/s.
    """
    u = v * v
    return b * v, c0 + c1 * u, (d0 + d1 * u) * v, e0 + (e1 + e2 * u) * u


def resolvent_root(
    b: Array, c: Array, d: Array, e: Array, where: Callable[..., Any], sqrt: Callable[..., Any]
) -> Array:
    """Return the root y = q₁ + q₂ of y³ - c y² + (b d - 4 e) y - (b² e - 4 c e + d²), for the best pair of factors.

    The roots are x₁x₂ + x₃x₄ and so on, one for each way to pair the quartic's roots x. Real factors come from the
    largest, or, if all x are real, from any: then from that end of the three which is farther from the middle one,
    because the distances between the roots of the cubic are those between the roots in different factors.

    Parameters
    ----------
    b, c, d, e : array, shape (...)
        Of x⁴ + b x³ + c x² + d x + e.
    where, sqrt : callable
        Of the arrays' namespace (or compiled stand-ins).
    """
    bd_4e = b * d - 4.0 * e
    P = bd_4e - c * c * _THIRD
    Q = c * (bd_4e * _THIRD - c * c * (2.0 / 27.0)) - b * b * e + 4.0 * c * e - d * d
    three = (P < 0.0) & (Q * Q * 6.75 <= -P * P * P)
    four_real = (8.0 * c < 3.0 * b * b) & (
        64.0 * e - 16.0 * c * c + 16.0 * b * b * c - 16.0 * b * d < 3.0 * b * b * b * b
    )
    inner = three & (Q > 0.0) & (four_real == False)  # noqa: E712  # arrays and numba's numbers share no other "not"
    sign = where(inner | (Q <= 0.0), 1.0, -1.0)
    q = -sign * Q  # u³ + P u = q with u = ±(y - c/3) > 0
    u = cubic_start(P, q, inner, where, sqrt)
    for _ in range(3):
        value, slope = u * (u * u + P) - q, 3.0 * u * u + P
        u = u - value * slope / (slope * slope - 3.0 * u * value)
    return sign * u + c * _THIRD


def cubic_start(P: Array, q: Array, inner: Array, where: Callable[..., Any], sqrt: Callable[..., Any]) -> Array:
    """Return the largest root of u³ + P u = q to a few per cent (``inner``: q < 0 and three real roots).

    Parameters
    ----------
    P, q : array, shape (...)
        Of the cubic.
    inner : array of bool, shape (...)
        Where q < 0 and all three roots are real.
    where, sqrt : callable
        Of the arrays' namespace (or compiled stand-ins).
    """
    size = abs(P)
    root = sqrt(size)
    cube = abs(q) + where(P < 0.0, size * root, 0.0) + 1e-300
    # Cube root to 5 %: x^(1/4 + 1/16 + 1/64 + 1/256), which takes square roots alone.
    fourth = sqrt(sqrt(cube))
    sixteenth = sqrt(sqrt(fourth))
    sixty_fourth = sqrt(sqrt(sixteenth))
    outer = fourth * sixteenth * sixty_fourth * sqrt(sqrt(sixty_fourth))
    outer = where(P < 0.0, outer, q / (P + outer * outer))
    # cos(acos(r) / 3) for -1 < r < 0, r = q / (2 h³), h² = -P/3: a parabola in cos(acos(r) / 2).
    h = root * 0.57735026918962576
    cosine = sqrt(where(inner, 0.5 + 0.25 * q / (h * h * h), 0.25))
    return where(inner, h * (1.0 + cosine * (1.1547 - 0.166 * cosine)), outer)


def newton_step(
    b: Array, c: Array, d: Array, e: Array, p1: Array, q1: Array, p2: Array, q2: Array
) -> tuple[Array, Array, Array, Array]:
    """Improve both factors: δ₁ f₂ + δ₂ f₁ = what the product lacks, each δ found modulo its own factor.

    So the correction of a factor is as accurate, relative to that factor, as its coefficients, however different in
    size the roots of the two factors are.

    Parameters
    ----------
    b, c, d, e : array, shape (...)
        Of x⁴ + b x³ + c x² + d x + e.
    p1, q1, p2, q2 : array, shape (...)
        Of the factors x² + p x + q.
    """
    rb, rc = b - (p1 + p2), c - (q1 + q2 + p1 * p2)
    rd, re = d - (p1 * q2 + p2 * q1), e - q1 * q2
    dp, dq = p2 - p1, q2 - q1
    resultant = dq * dq + dp * (q1 * p2 - p1 * q2)
    inverse = 1.0 / resultant
    s1, t1 = rd - p1 * rc + (p1 * p1 - q1) * rb, re + q1 * (p1 * rb - rc)
    s2, t2 = rd - p2 * rc + (p2 * p2 - q2) * rb, re + q2 * (p2 * rb - rc)
    return (
        p1 + (s1 * dq - t1 * dp) * inverse,
        q1 + (t1 * (dq - p1 * dp) + s1 * q1 * dp) * inverse,
        p2 + (t2 * dp - s2 * dq) * inverse,
        q2 - (t2 * (dq - p2 * dp) + s2 * q2 * dp) * inverse,
    )


def reproduces(b: Array, c: Array, d: Array, e: Array, p1: Array, q1: Array, p2: Array, q2: Array) -> Array:
    """Tell whether the product of the factors is the quartic, each coefficient to a few roundings of its terms.

    Parameters
    ----------
    b, c, d, e : array, shape (...)
        Of x⁴ + b x³ + c x² + d x + e.
    p1, q1, p2, q2 : array, shape (...)
        Of the factors x² + p x + q.
    """
    p12, p1q2, p2q1, q12 = p1 * p2, p1 * q2, p2 * q1, q1 * q2
    return (
        (abs(b - (p1 + p2)) <= _ROUNDING * (abs(p1) + abs(p2)))
        & (abs(c - (q1 + q2 + p12)) <= _ROUNDING * (abs(q1) + abs(q2) + abs(p12)))
        & (abs(d - (p1q2 + p2q1)) <= _ROUNDING * (abs(p1q2) + abs(p2q1)))
        & (abs(e - q12) <= _ROUNDING * abs(q12))
    )


def ordered_roots(
    p1: Array, q1: Array, p2: Array, q2: Array, where: Callable[..., Any], sqrt: Callable[..., Any]
) -> tuple[Array, ...]:
    """Return the roots of two factors, sorted by real then imaginary part: four real parts, then four imaginary.

    Parameters
    ----------
    p1, q1, p2, q2 : array, shape (...)
        Of the factors x² + p x + q.
    where, sqrt : callable
        Of the arrays' namespace (or compiled stand-ins).
    """
    a, ai, b, bi = quadratic_roots(p1, q1, where, sqrt)
    c, ci, d, di = quadratic_roots(p2, q2, where, sqrt)
    # Batcher's merge of two sorted pairs.
    a, ai, c, ci = sort_two(a, ai, c, ci, where)
    b, bi, d, di = sort_two(b, bi, d, di, where)
    b, bi, c, ci = sort_two(b, bi, c, ci, where)
    return a, b, c, d, ai, bi, ci, di


def quadratic_roots(
    p: Array, q: Array, where: Callable[..., Any], sqrt: Callable[..., Any]
) -> tuple[Array, Array, Array, Array]:
    """Return real and imaginary part of the lower, then of the upper root of s² + p s + q.

    Parameters
    ----------
    p, q : array, shape (...)
        Of the quadratic.
    where, sqrt : callable
        Of the arrays' namespace (or compiled stand-ins).
    """
    half = -0.5 * p
    discriminant = half * half - q
    real = discriminant >= 0.0
    root = sqrt(abs(discriminant))
    big = where(half < 0.0, half - root, half + root)
    small = where(big == 0.0, 0.0, q / where(big == 0.0, 1.0, big))  # no cancellation
    low, high = where(big < small, big, small), where(big < small, small, big)
    im = where(real, 0.0, root)
    return where(real, low, half), where(real, 0.0, -im), where(real, high, half), im


def sort_two(a: Array, ai: Array, b: Array, bi: Array, where: Callable[..., Any]) -> tuple[Array, Array, Array, Array]:
    """Return two complex numbers, given and returned as real and imaginary parts, the smaller one first.

    Parameters
    ----------
    a, ai : array, shape (...)
        Real and imaginary part of one.
    b, bi : array, shape (...)
        Those of the other.
    where : callable
        Of the arrays' namespace (or a compiled stand-in).
    """
    swap = (a > b) | ((a == b) & (ai > bi))
    return where(swap, b, a), where(swap, bi, ai), where(swap, a, b), where(swap, ai, bi)
