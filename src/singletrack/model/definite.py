"""A mass matrix must be positive definite: each motion has kinetic energy, else the equations do not stand."""

from __future__ import annotations

import numpy as np

from singletrack.arrays import Array, Fault
from singletrack.errors import InputError

__all__ = ["indefinite"]

#: Smallest eigenvalue of M scaled to a unit diagonal: below, accelerations are lost in rounding.
_SMALLEST = 1e-10


def indefinite(M: Array) -> Fault:
    """Return the fault of designs whose mass matrix is not positive definite.

    Parameters
    ----------
    M : array, shape (..., n, n)
        Symmetric, concrete; its real part is looked at.

    Examples
    --------
    >>> indefinite(np.array([[2.0, 1.0], [1.0, 0.5]])).bad.tolist()
    True
    """
    matrix = np.real(np.asarray(M))
    diagonal = np.diagonal(matrix, axis1=-2, axis2=-1)
    positive = (diagonal > 0).all(axis=-1)
    with np.errstate(all="ignore"):
        if matrix.shape[-1] == 2:  # in closed form, as it is asked for every design
            smallest = 1 - np.abs(matrix[..., 0, 1]) / np.sqrt(diagonal[..., 0] * diagonal[..., 1])
        else:
            scale = 1 / np.sqrt(np.where(diagonal > 0, diagonal, 1.0))
            scaled = scale[..., :, None] * matrix * scale[..., None, :]
            smallest = np.linalg.eigvalsh(np.where(np.isfinite(scaled), scaled, 0.0))[..., 0]
        # What is not finite has another fault.
        bad = np.isfinite(matrix).all(axis=(-2, -1)) & ~(positive & (smallest > _SMALLEST))
    return Fault(
        bad,
        "the mass matrix is not positive definite (smallest eigenvalue {smallest:.3g} of M scaled to a unit diagonal), "
        "must be: some motion moves no mass, such as steering a front assembly that is all on the steer axis",
        {"smallest": np.where(np.isfinite(smallest), smallest, 0.0)},
        InputError,
        (),
        "a bicycle of which every motion moves some mass",
    )
