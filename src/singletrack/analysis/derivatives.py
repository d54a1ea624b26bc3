"""Exact derivatives of the coefficient matrices, eigenvalues and critical speeds with respect to parameters."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from singletrack.analysis.designs import Design
from singletrack.arrays import complex_steps
from singletrack.body.oddities import warn_of_oddities
from singletrack.errors import InputError
from singletrack.linear import eigenvalues
from singletrack.model import LinearModel
from singletrack.posture import Options

if TYPE_CHECKING:
    from collections.abc import Sequence

    from singletrack.arrays import Array, ArrayLike
    from singletrack.parameters import Bicycle, Rider

__all__ = ["Derivatives", "derivatives", "derivatives_of", "shifted"]

_STEP = 1e-30
_MATRICES = ("M", "C1", "K0", "K2")
_SPRUNG = ("C0", "S0")


@dataclass(frozen=True, eq=False)
class Derivatives:
    """The coefficient matrices of one design and their derivatives with respect to k parameters.

    Attributes
    ----------
    model : LinearModel
        Of shape (n, n) each.
    names : tuple of str
        The k parameters.
    matrices : dict of str to array, shape (k, n, n)
        Derivatives of ``M, C1, K0, K2``, and of ``C0, S0`` where there are springs or dampers, in their unit per SI
        unit of the parameter.
    gravity : array, shape (k,)
        Derivative of gravity: one for gravity itself, else zero.
    """

    model: LinearModel
    names: tuple[str, ...]
    matrices: dict[str, np.ndarray]
    gravity: np.ndarray

    def _pencil(self, speeds: ArrayLike, roots: Array) -> tuple[np.ndarray, np.ndarray]:
        """Return what is proportional to the adjugate of P(s), and with it the slope d det P / ds, for s (...).

        P(s) = M s² + (C0 + v C1) s + S0 + g K0 + v² K2. With more than two freedoms: the outer product of the vectors
        that P takes to zero from the right and from the left, which the adjugate is at a simple root but for a factor.
        """
        m, v, s = self.model, np.asarray(speeds), np.asarray(roots)[..., None, None]
        damping = m.damping(v)
        P = m.M * s**2 + damping * s + m.stiffness(v)
        if m.freedoms == 2:
            adjugate = np.stack([P[..., 1, 1], -P[..., 0, 1], -P[..., 1, 0], P[..., 0, 0]], -1).reshape(P.shape)
        else:
            left, _, right = np.linalg.svd(np.where(np.isfinite(P), P, 0.0))
            adjugate = np.conj(right[..., -1, :])[..., :, None] * np.conj(left[..., :, -1])[..., None, :]
        return adjugate, np.einsum("...ij,...ji->...", adjugate, 2 * m.M * s + damping)

    def eigenvalues(self, speeds: ArrayLike, roots: Array) -> np.ndarray:
        """Return the derivatives (..., k) of roots (...) at speeds broadcastable to (...), in 1/s per SI unit.

        From det P(s) = 0: ds/dp = -tr(adj P dP/dp) / tr(adj P dP/ds). Infinite or NaN where roots meet.
        """
        adjugate, slope = self._pencil(speeds, roots)
        v, s = np.asarray(speeds)[..., None, None, None], np.asarray(roots)[..., None, None, None]
        d = self.matrices
        stiffness = self.gravity[:, None, None] * np.asarray(self.model.K0) + self.model.gravity * d["K0"]
        change = d["M"] * s**2 + v * d["C1"] * s + stiffness + v**2 * d["K2"]
        if "C0" in d:
            change = change + d["C0"] * s + d["S0"]
        with np.errstate(divide="ignore", invalid="ignore"):
            found: np.ndarray = -np.einsum("...ij,...kji->...k", adjugate, change) / slope[..., None]
        return found

    def eigenvalues_by_speed(self, speeds: ArrayLike, roots: Array) -> np.ndarray:
        """Return ds/dv (...) of roots (...) at speeds broadcastable to (...), in 1/m."""
        adjugate, slope = self._pencil(speeds, roots)
        v, s = np.asarray(speeds)[..., None, None], np.asarray(roots)[..., None, None]
        change = np.einsum("...ij,...ji->...", adjugate, self.model.C1 * s + 2 * v * self.model.K2)
        with np.errstate(divide="ignore", invalid="ignore"):
            found: np.ndarray = -change / slope
        return found

    def critical_speeds(self, speeds: ArrayLike, kind: str) -> np.ndarray:
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
    """Return a batch of n designs with parameters changed by shifts (n, k), SI.

    Parameters
    ----------
    bicycle, rider : Bicycle, Rider or None
        Single designs.
    names : sequence of str
        The k parameters that change; those of the rider may be among them.
    shifts : array, shape (n, k)
        What is added, SI.
    """

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
    warn_of_oddities(bicycle, rider)
    return derivatives_of(Design(bicycle, rider, Options.of(options)), names)


def derivatives_of(design: Design, names: Sequence[str]) -> Derivatives:
    """Return the coefficient matrices of a design and their derivatives with respect to parameters.

    Parameters
    ----------
    design : Design
        A single one.
    names : sequence of str
        Parameters of bicycle, rider or posture (``spring at JOINT``, ``damper at JOINT``, ``elbow angle``).

    Raises
    ------
    InputError
        As :func:`derivatives`.
    """
    names = tuple(names)
    known = design.values()
    for name in names:
        if name not in known:
            raise InputError(f"{name} is no parameter of this bicycle or rider (known: {', '.join(known)})")
    model = design.model()
    with complex_steps():
        moved = design.shifted(names, 1j * _STEP * np.eye(len(names))).model()
    shape = (len(names), model.freedoms, model.freedoms)
    wanted = _MATRICES if model.is_undamped else (*_MATRICES, *_SPRUNG)
    matrices = {n: np.broadcast_to(np.imag(getattr(moved, n)) / _STEP, shape) for n in wanted}
    gravity = np.array([float(name == "gravity") for name in names])
    return Derivatives(model, names, matrices, gravity)
