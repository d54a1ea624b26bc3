"""The characteristic polynomial: a quartic in s whose coefficients are polynomials in the forward speed.

    det(M s² + v C1 s + g K0 + v² K2) = a4 s⁴ + v a3(u) s³ + a2(u) s² + v a1(u) s + a0(u),    u = v²

With the mixed determinant D(A, B) = A11 B22 + B11 A22 - A12 B21 - B12 A21:

    a4 = det M            a3 = D(M, C1)            a2 = g D(M, K0) + u (det C1 + D(M, K2))
    a1 = g D(C1, K0) + u D(C1, K2)                 a0 = g² det K0 + u g D(K0, K2) + u² det K2
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from singletrack.arrays import Array, as_arrays, vector

if TYPE_CHECKING:
    from singletrack.linear.matrices import CoefficientMatrices

__all__ = ["CharacteristicPolynomial", "characteristic_polynomial"]


@dataclass(frozen=True, eq=False)
class CharacteristicPolynomial:
    """Coefficients in ascending powers of u = v²; ``a3`` and ``a1`` are to be multiplied by v.

    Attributes
    ----------
    a4, a3 : array, shape (..., 1)
    a2, a1 : array, shape (..., 2)
    a0 : array, shape (..., 3)
    """

    a4: Array
    a3: Array
    a2: Array
    a1: Array
    a0: Array

    def at(self, speeds: Array) -> Array:
        """Return the quartic's coefficients a4 to a0 at speeds (n,) in m/s, shape (..., n, 5)."""
        _, (v,) = as_arrays(speeds)
        u = v * v
        a4, a3, a2, a1, a0 = (a[..., None, :] for a in (self.a4, self.a3, self.a2, self.a1, self.a0))
        return vector(
            a4[..., 0] + 0.0 * v,
            a3[..., 0] * v,
            a2[..., 0] + a2[..., 1] * u,
            (a1[..., 0] + a1[..., 1] * u) * v,
            a0[..., 0] + (a0[..., 1] + a0[..., 2] * u) * u,
        )

    def monic_at(self, speeds: Array) -> tuple[Array, Array, Array, Array]:
        """Return b, c, d, e of s⁴ + b s³ + c s² + d s + e, each of shape (..., n), at speeds (n,) or (..., n)."""
        _, (v,) = as_arrays(speeds)
        u = v * v
        b, c, d, e = (a / self.a4 for a in (self.a3, self.a2, self.a1, self.a0))
        return (
            b * v,
            c[..., :1] + c[..., 1:] * u,
            (d[..., :1] + d[..., 1:] * u) * v,
            e[..., :1] + (e[..., 1:2] + e[..., 2:] * u) * u,
        )

    def rows(self, which: Any) -> CharacteristicPolynomial:
        """Return the polynomials of some designs: an index or a mask of the first axis."""
        return CharacteristicPolynomial(*(a[which] for a in (self.a4, self.a3, self.a2, self.a1, self.a0)))

    def flat(self) -> tuple[CharacteristicPolynomial, tuple[int, ...]]:
        """Return the polynomials with all designs on one axis, and the shape (...) of the batch, as NumPy arrays."""
        import numpy as np  # noqa: PLC0415

        all_five = [np.asarray(a) for a in (self.a4, self.a3, self.a2, self.a1, self.a0)]
        batch = np.broadcast_shapes(*(a.shape[:-1] for a in all_five))
        one_axis = (np.broadcast_to(a, (*batch, a.shape[-1])).reshape(-1, a.shape[-1]) for a in all_five)
        return CharacteristicPolynomial(*one_axis), batch


def mixed_determinant(a: Array, b: Array) -> Array:
    """Return D(A, B) of matrices (..., 2, 2): the part of det(A + B) that is linear in both."""
    return (
        a[..., 0, 0] * b[..., 1, 1]
        + b[..., 0, 0] * a[..., 1, 1]
        - a[..., 0, 1] * b[..., 1, 0]
        - b[..., 0, 1] * a[..., 1, 0]
    )


def determinant(a: Array) -> Array:
    """Return the determinants of matrices (..., 2, 2)."""
    return a[..., 0, 0] * a[..., 1, 1] - a[..., 0, 1] * a[..., 1, 0]


def characteristic_polynomial(model: CoefficientMatrices) -> CharacteristicPolynomial:
    """Return the characteristic polynomial of the coefficient matrices.

    Examples
    --------
    At rest the roots of a bicycle come in pairs of opposite sign: no odd powers.

    >>> from singletrack import coefficients, load_bicycle
    >>> polynomial = characteristic_polynomial(coefficients(load_bicycle("benchmark")))
    >>> abs(polynomial.at([0.0])[0, 1::2]).tolist()
    [0.0, 0.0]
    """
    M, C1, K0, K2 = model.M, model.C1, model.K0, model.K2
    _, (g,) = as_arrays(model.gravity)
    return CharacteristicPolynomial(
        determinant(M)[..., None],
        mixed_determinant(M, C1)[..., None],
        vector(g * mixed_determinant(M, K0), determinant(C1) + mixed_determinant(M, K2)),
        vector(g * mixed_determinant(C1, K0), mixed_determinant(C1, K2)),
        vector(g * g * determinant(K0), g * mixed_determinant(K0, K2), determinant(K2)),
    )
