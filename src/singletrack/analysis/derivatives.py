"""Exact derivatives of the coefficient matrices, eigenvalues and critical speeds with respect to parameters."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from singletrack.arrays import complex_steps
from singletrack.body.oddities import warn_of_oddities
from singletrack.closed_form import coefficients
from singletrack.errors import InputError
from singletrack.linear import eigenvalues
from singletrack.model import LinearModel

if TYPE_CHECKING:
    from collections.abc import Sequence

    from singletrack.arrays import Array
    from singletrack.parameters import Bicycle, Rider
    from singletrack.posture import Options

__all__ = ["Derivatives", "derivatives", "shifted"]

_STEP = 1e-30
_MATRICES = ("M", "C1", "K0", "K2")


@dataclass(frozen=True, eq=False)
class Derivatives:
    """The coefficient matrices of one design and their derivatives with respect to k parameters.

    Attributes
    ----------
    model : LinearModel
        Of shape (2, 2) each.
    names : tuple of str
        The k parameters.
    matrices : dict of str to array, shape (k, 2, 2)
        Derivatives of ``M, C1, K0, K2``, in their unit per SI unit of the parameter.
    gravity : array, shape (k,)
        Derivative of gravity: one for gravity itself, else zero.
    """

    model: LinearModel
    names: tuple[str, ...]
    matrices: dict[str, np.ndarray]
    gravity: np.ndarray

    def _pencil(self, speeds: Array, roots: Array) -> tuple[np.ndarray, np.ndarray]:
        """Return the adjugate of P(s) = M s² + v C1 s + g K0 + v² K2 and the slope d det P / ds, for s (..., )."""
        m, v, s = self.model, np.asarray(speeds)[..., None, None], np.asarray(roots)[..., None, None]
        P = m.M * s**2 + v * m.C1 * s + m.gravity * m.K0 + v**2 * m.K2
        adjugate = np.stack([P[..., 1, 1], -P[..., 0, 1], -P[..., 1, 0], P[..., 0, 0]], -1).reshape(P.shape)
        return adjugate, np.einsum("...ij,...ji->...", adjugate, 2 * m.M * s + v * m.C1)

    def eigenvalues(self, speeds: Array, roots: Array) -> np.ndarray:
        """Return the derivatives (..., k) of roots (...) at speeds broadcastable to (...), in 1/s per SI unit.

        From det P(s) = 0: ds/dp = -tr(adj P dP/dp) / tr(adj P dP/ds). Infinite or NaN where roots meet.
        """
        adjugate, slope = self._pencil(speeds, roots)
        v, s = np.asarray(speeds)[..., None, None, None], np.asarray(roots)[..., None, None, None]
        d = self.matrices
        stiffness = self.gravity[:, None, None] * np.asarray(self.model.K0) + self.model.gravity * d["K0"]
        change = d["M"] * s**2 + v * d["C1"] * s + stiffness + v**2 * d["K2"]
        with np.errstate(divide="ignore", invalid="ignore"):
            found: np.ndarray = -np.einsum("...ij,...kji->...k", adjugate, change) / slope[..., None]
        return found

    def eigenvalues_by_speed(self, speeds: Array, roots: Array) -> np.ndarray:
        """Return ds/dv (...) of roots (...) at speeds broadcastable to (...), in 1/m."""
        adjugate, slope = self._pencil(speeds, roots)
        v, s = np.asarray(speeds)[..., None, None], np.asarray(roots)[..., None, None]
        change = np.einsum("...ij,...ji->...", adjugate, self.model.C1 * s + 2 * v * self.model.K2)
        with np.errstate(divide="ignore", invalid="ignore"):
            found: np.ndarray = -change / slope
        return found

    def critical_speeds(self, speeds: Array, kind: str) -> np.ndarray:
        """Return the derivatives (n, k) of critical speeds (n,), in m/s per SI unit.

        Parameters
        ----------
        speeds : array, shape (n,)
            Weave or capsize speeds of the model.
        kind : {"weave", "capsize"}

        Notes
        -----
        The real part of a root stays zero: dv/dp = -Re(ds/dp) / Re(ds/dv), with s = 0 for capsize, s = i omega for
        weave.
        """
        v = np.atleast_1d(np.asarray(speeds, dtype=float))
        roots = np.zeros(len(v), dtype=complex)
        if kind == "weave" and len(v):
            all_roots = eigenvalues(self.model, v)
            distance = np.where(all_roots.imag > 0, np.abs(all_roots.real), np.inf)
            nearest = np.take_along_axis(all_roots, distance.argmin(-1)[:, None], axis=-1)[:, 0]
            roots = 1j * nearest.imag
        by_speed = self.eigenvalues_by_speed(v, roots).real
        with np.errstate(divide="ignore", invalid="ignore"):
            found: np.ndarray = -self.eigenvalues(v, roots).real / by_speed[:, None]
        return found


def shifted(
    bicycle: Bicycle, rider: Rider | None, names: Sequence[str], shifts: np.ndarray
) -> tuple[Bicycle, Rider | None]:
    """Return a batch of n designs with parameters changed by shifts (n, k), SI."""

    def changes(record: Bicycle | Rider) -> dict[str, Array]:
        own = record.values()
        return {name: own[name] + shifts[:, i] for i, name in enumerate(names) if name in own}

    moved_rider = None if rider is None else rider.replace(**changes(rider))
    return bicycle.replace(**changes(bicycle)), moved_rider


def derivatives(
    bicycle: Bicycle,
    rider: Rider | None = None,
    options: Options | str = "rigid",
    names: Sequence[str] = (),
) -> Derivatives:
    """Return the coefficient matrices and their derivatives with respect to parameters.

    Parameters
    ----------
    bicycle, rider
        Single designs.
    options : Options or str
        How the rider sits, or a posture's name.
    names : sequence of str
        Parameters of the bicycle or of the rider.

    Raises
    ------
    InputError
        If a name belongs to neither, or as :func:`singletrack.coefficients` does.

    Notes
    -----
    A complex step of 1e-30 in each parameter, all in one batch: exact to rounding, without differences.

    Examples
    --------
    >>> from singletrack import load_bicycle
    >>> slopes = derivatives(load_bicycle("benchmark"), names=["rear_frame_z", "rear_frame_mass"])
    >>> slopes.matrices["K0"][:, 0, 0].tolist()
    [85.0, -0.9]
    """
    names = tuple(names)
    known = {**bicycle.values(), **({} if rider is None else rider.values())}
    for name in names:
        if name not in known:
            raise InputError(f"{name} is no parameter of this bicycle or rider (known: {', '.join(known)})")
    warn_of_oddities(bicycle, rider)
    model = coefficients(bicycle, rider, options)
    with complex_steps():
        moved = coefficients(*shifted(bicycle, rider, names, 1j * _STEP * np.eye(len(names))), options)
    shape = (len(names), 2, 2)
    matrices = {n: np.broadcast_to(np.imag(getattr(moved, n)) / _STEP, shape) for n in _MATRICES}
    gravity = np.array([float(name == "gravity") for name in names])
    return Derivatives(model, names, matrices, gravity)
