"""The characteristic polynomial: a quartic in s whose coefficients are polynomials in the forward speed.

    det(M s² + v C1 s + g K0 + v² K2) = a4 s⁴ + v a3(u) s³ + a2(u) s² + v a1(u) s + a0(u),    u = v²

With the mixed determinant D(A, B) = A11 B22 + B11 A22 - A12 B21 - B12 A21:

    a4 = det M            a3 = D(M, C1)            a2 = g D(M, K0) + u (det C1 + D(M, K2))
    a1 = g D(C1, K0) + u D(C1, K2)                 a0 = g² det K0 + u g D(K0, K2) + u² det K2
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from singletrack.arrays import Array, as_arrays, namespace, stack, vector
from singletrack.linear.pencil import mass_units

if TYPE_CHECKING:
    from singletrack.model import LinearModel

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

    def ratios(self) -> np.ndarray:
        """Return the coefficients over the first, (8, m) for designs (m,), as :func:`.quartic.kernel.monic` takes."""
        return np.ascontiguousarray((np.concatenate([self.a3, self.a2, self.a1, self.a0], axis=-1) / self.a4).T)

    def rows(self, which: Any) -> CharacteristicPolynomial:
        """Return the polynomials of some designs: an index or a mask of the first axis.

        Parameters
        ----------
        which : index or mask
            Of the first axis of the batch.
        """
        return CharacteristicPolynomial(*(a[which] for a in (self.a4, self.a3, self.a2, self.a1, self.a0)))

    def flat(self) -> tuple[CharacteristicPolynomial, tuple[int, ...]]:
        """Return the polynomials with all designs on one axis, and the shape (...) of the batch, as NumPy arrays."""
        all_five = [np.asarray(a) for a in (self.a4, self.a3, self.a2, self.a1, self.a0)]
        batch = np.broadcast_shapes(*(a.shape[:-1] for a in all_five))
        one_axis = (np.broadcast_to(a, (*batch, a.shape[-1])).reshape(-1, a.shape[-1]) for a in all_five)
        return CharacteristicPolynomial(*one_axis), batch


def characteristic_polynomial(model: LinearModel) -> CharacteristicPolynomial:
    """Return the characteristic polynomial of two freedoms without springs and dampers, up to a factor.

    Parameters
    ----------
    model : LinearModel
        Of lean and steer, any batch (...).

    Examples
    --------
    At rest the roots of a bicycle come in pairs of opposite sign: no odd powers.

    >>> from singletrack import coefficients, load_bicycle
    >>> polynomial = characteristic_polynomial(coefficients(load_bicycle("benchmark")))
    >>> abs(polynomial.at([0.0])[0, 1::2]).tolist()
    [0.0, 0.0]
    """
    _, (g,) = as_arrays(model.gravity)
    entries = stack(model.matrices, -3)  # (..., 4, 2, 2)
    if isinstance(entries, np.ndarray) and entries.dtype.kind == "f":
        # No mass is too large or too small: a power of two for each coordinate, which changes no bit of the roots.
        d = mass_units(entries[..., 0, :, :])
        entries = entries * (d[..., :, None] * d[..., None, :])[..., None, :, :]
    e11, e12, e21, e22 = (entries[..., i, j] for i in (0, 1) for j in (0, 1))
    # For matrices A and B of the four, [A, B] = A11 B22 - A12 B21: det A = [A, A] and D(A, B) = [A, B] + [B, A].
    products = e11[..., :, None] * e22[..., None, :] - e12[..., :, None] * e21[..., None, :]
    mixed = products + namespace(products).matrix_transpose(products)
    M, C1, K0, K2 = range(4)
    return CharacteristicPolynomial(
        products[..., M, M, None],
        mixed[..., M, C1, None],
        vector(g * mixed[..., M, K0], products[..., C1, C1] + mixed[..., M, K2]),
        vector(g * mixed[..., C1, K0], mixed[..., C1, K2]),
        vector(g * g * products[..., K0, K0], g * mixed[..., K0, K2], products[..., K2, K2]),
    )
