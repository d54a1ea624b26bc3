"""The pencil of a linear model in units of its own: designs on one axis, numbers of order one, any number of freedoms.

    P(s, v) = s² + (C0 + v C1) s + K0 + v² K2

Masses, the unit of speed and the unit of time are taken out first (by powers of two, which keep every bit), so that no
model is too heavy, too small or too slow to be computed. What is scaled is then multiplied by the inverse of M.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from singletrack.model import LinearModel

__all__ = ["Pencil", "mass_units", "pencil"]

#: Reciprocal condition number of a scaled mass matrix below which it counts as singular.
_SINGULAR = 1e-14


@dataclass(frozen=True, eq=False)
class Pencil:
    """The pencils of m designs with n freedoms; ``K0`` holds springs and gravity.

    Attributes
    ----------
    C0, C1, K0, K2 : array, shape (m, n, n)
        Multiplied by the inverse of M, in the units below.
    weights : array, shape (m, n)
        Square roots of M's diagonal, in the units in which the motions of the pencil are told.
    masses : array, shape (m, n)
        A motion of the pencil times this is one of the model.
    speed, rate : array, shape (m,)
        The unit of speed in m/s, the unit of s in 1/s.
    riding : array, shape (m,)
        The speed, in its unit, at which the stiffness of gravity and that of speed are alike: some 2 m/s for bicycles.
    told : bool array, shape (m,)
        Whether there is anything to compute: all numbers finite, M regular. Where not, all matrices are zero.
    """

    C0: np.ndarray
    C1: np.ndarray
    K0: np.ndarray
    K2: np.ndarray
    weights: np.ndarray
    masses: np.ndarray
    speed: np.ndarray
    rate: np.ndarray
    riding: np.ndarray
    told: np.ndarray

    def __len__(self) -> int:
        return len(self.told)

    @property
    def freedoms(self) -> int:
        """The number n of coordinates."""
        return int(self.C1.shape[-1])

    def rows(self, which: np.ndarray | slice) -> Pencil:
        """Return the pencils of some designs, in any order, also several times.

        Parameters
        ----------
        which : array or slice
            Indices of designs, or a mask.
        """
        return Pencil(*(getattr(self, name)[which] for name in self.__dataclass_fields__))

    def state(self, v: np.ndarray) -> np.ndarray:
        """Return the state matrices (m, k, 2 n, 2 n) at speeds (m, k): x' = A x of coordinates and rates.

        Parameters
        ----------
        v : array, shape (m, k)
            Speeds, in the pencil's units.
        """
        n, at = self.freedoms, v[..., None, None]
        result = np.zeros((*v.shape, 2 * n, 2 * n))
        result[..., :n, n:] = np.eye(n)
        result[..., n:, :n] = -(self.K0[:, None] + at**2 * self.K2[:, None])
        result[..., n:, n:] = -(self.C0[:, None] + at * self.C1[:, None])
        return result


def mass_units(M: np.ndarray) -> np.ndarray:
    """Return powers of two (..., n) with which M_ij d_i d_j has a diagonal from a quarter to one; one where M has none.

    >>> mass_units(np.diag([80.0, 0.25])).tolist()
    [0.0625, 1.0]
    """
    diagonal = np.diagonal(M, axis1=-2, axis2=-1)
    usable = np.isfinite(diagonal) & (diagonal > 0)
    exponent = np.frexp(np.where(usable, diagonal, 0.5))[1]
    units: np.ndarray = np.ldexp(1.0, -((exponent + 1) // 2))
    return units


def pencil(model: LinearModel) -> tuple[Pencil, tuple[int, ...]]:
    """Return the pencils of all designs on one axis, and the shape (...) of the batch.

    Parameters
    ----------
    model : LinearModel
        Any batch (...), any number of freedoms.
    """
    batch, n = model.shape, model.freedoms
    whole = model.broadcast_to(batch)
    with np.errstate(all="ignore"):  # numbers out of range are not told
        d = mass_units(np.asarray(whole.M, dtype=float)).reshape(-1, n)
        double = d[:, :, None] * d[:, None, :]
        names = ("M", "C0", "C1", "S0", "K0", "K2")
        M, C0, C1, S0, K0, K2 = (np.asarray(getattr(whole, a), dtype=float).reshape(-1, n, n) * double for a in names)
        weight = np.reshape(whole.gravity, (-1, 1, 1)) * K0
        parts = np.stack([C0, C1, S0 + weight, K2, weight])
        told = np.isfinite(M).all(axis=(-2, -1)) & np.isfinite(parts).all(axis=(0, -2, -1)) & whole.valid.ravel()
        M = np.where(told[:, None, None], M, np.eye(n))
        size = np.linalg.svd(M, compute_uv=False)
        told &= size[:, -1] > _SINGULAR * size[:, 0]
        M = np.where(told[:, None, None], M, np.eye(n))
        parts = np.linalg.solve(M, np.where(told[:, None, None], parts, 0.0))
        sizes = [np.abs(part).max(axis=(-2, -1)) for part in parts]
        speed, rate = _units(*sizes[:4])
        riding = np.sqrt(sizes[4]) / np.sqrt(sizes[3]) / speed
        riding = np.where(_usable(riding), riding, 1.0)
        C0, C1, K0, K2 = parts[:4] / _column(rate)
        C1, K0, K2 = C1 * _column(speed), K0 / _column(rate), K2 * _column(speed) / _column(rate) * _column(speed)
    weights = np.sqrt(np.abs(np.diagonal(M, axis1=-2, axis2=-1)))
    return Pencil(C0, C1, K0, K2, weights, d, speed, rate, riding, told), batch


def _units(c0: np.ndarray, c1: np.ndarray, k0: np.ndarray, k2: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return the units of speed and of s, powers of two, from the sizes (m,) of the matrices.

    At the unit of speed the parts of stiffness that do and do not change with speed are alike (or those of damping).
    """
    by_stiffness, by_damping = np.sqrt(k0) / np.sqrt(k2), c0 / c1
    speed = np.where(_usable(by_stiffness), by_stiffness, np.where(_usable(by_damping), by_damping, 1.0))
    rates = np.stack([c0, speed * c1, np.sqrt(k0), speed * np.sqrt(k2)])
    rate = np.max(np.where(_usable(rates), rates, 0.0), axis=0)
    rate = np.where(rate > 0, rate, 1.0)
    return np.ldexp(1.0, np.frexp(speed)[1]), np.ldexp(1.0, np.frexp(rate)[1])


def _usable(size: np.ndarray) -> np.ndarray:
    result: np.ndarray = np.isfinite(size) & (size > 0)
    return result


def _column(values: np.ndarray) -> np.ndarray:
    return values[:, None, None]
