"""What uncertain parameters are, and what comes of them: the parts that linear propagation and sampling share."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from singletrack.errors import InputError

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from singletrack.arrays import Array, Number
    from singletrack.model import LinearModel
    from singletrack.parameters import Bicycle, Rider

__all__ = [
    "CriticalSpeedUncertainty",
    "EigenvalueUncertainty",
    "chunks",
    "covariance_root",
    "parameter_covariance",
    "seated",
    "whole_batch",
]

_CHUNK = 250


@dataclass(frozen=True, eq=False)
class EigenvalueUncertainty:
    """Eigenvalues by mode, of f freedoms, with what they may be.

    Attributes
    ----------
    speeds : array, shape (n,)
        In m/s.
    eigenvalues : complex array, shape (n, 2 f)
        Of the design as given, in 1/s; columns as in :class:`singletrack.linear.Modes`.
    real_deviation, imaginary_deviation : array, shape (n, 2 f)
        Standard deviations in 1/s.
    real_interval, imaginary_interval : array, shape (2, n, 2 f)
        Bounds of the central 95 %, in 1/s.
    linear : bool array, shape (n, 2 f)
        Where linear propagation holds; elsewhere the numbers come from a sample (or are not to be trusted, if none
        was drawn).
    names : tuple of str
        Of the modes, one for each column.
    """

    speeds: np.ndarray
    eigenvalues: np.ndarray
    real_deviation: np.ndarray
    imaginary_deviation: np.ndarray
    real_interval: np.ndarray
    imaginary_interval: np.ndarray
    linear: np.ndarray
    names: tuple[str, ...] = ("weave", "weave", "capsize", "castering")


@dataclass(frozen=True, eq=False)
class CriticalSpeedUncertainty:
    """Critical speeds with their standard deviations, in m/s.

    Attributes
    ----------
    weave, capsize : array, shape (m,)
        All critical speeds, ascending.
    weave_deviation, capsize_deviation : array, shape (m,)
    """

    weave: np.ndarray
    weave_deviation: np.ndarray
    capsize: np.ndarray
    capsize_deviation: np.ndarray


def chunks(model: LinearModel) -> list[LinearModel]:
    """Return a batch in pieces that keep temporary arrays small.

    Parameters
    ----------
    model : LinearModel
        Of a batch (n,).
    """
    whole = whole_batch(model, model.shape[0])
    return [whole[i : i + _CHUNK] for i in range(0, model.shape[0], _CHUNK)]


def whole_batch(model: LinearModel, count: int) -> LinearModel:
    """Return a batch of n designs in full: a matrix that depends on no uncertain parameter comes without the batch.

    Parameters
    ----------
    model : LinearModel
        Matrices of shape (m, m) or (n, m, m).
    count : int
        The number n.
    """
    return model.broadcast_to((count,))


def covariance_root(covariance: np.ndarray) -> np.ndarray:
    """Return R with R R' = covariance, its columns along principal directions of the scaled parameters.

    Shape (k, k).

    Parameters
    ----------
    covariance : array, shape (k, k)
        Symmetric, without negative eigenvalues; in products of the parameters' units.
    """
    scale = np.sqrt(np.diag(covariance))
    safe = np.where(scale > 0, scale, 1.0)
    values, vectors = np.linalg.eigh(covariance / np.outer(safe, safe))
    root: np.ndarray = safe[:, None] * vectors * np.sqrt(np.maximum(values, 0.0))
    return root


def parameter_covariance(
    bicycle: Bicycle, rider: Rider | None, covariance: tuple[Sequence[str], Array] | None
) -> tuple[tuple[str, ...], np.ndarray]:
    """Return the uncertain parameters and their covariance: as given, else independent standard deviations.

    Parameters
    ----------
    bicycle, rider : Bicycle, Rider or None
        Whose standard deviations are taken where no covariance is given.
    covariance : pair, optional
        Names of k parameters, and their covariance, shape (k, k), SI.
    """
    deviations: dict[str, float] = {}
    for record in (bicycle, rider):
        if record is not None:
            present = record.values()
            deviations |= {name: sd for name, sd in _checked(record.standard_deviations) if name in present}
    if covariance is not None:
        names, matrix = tuple(covariance[0]), np.asarray(covariance[1], dtype=float)
        if matrix.shape != (len(names), len(names)) or not np.isfinite(matrix).all():
            raise InputError(f"covariance has shape {matrix.shape}, must be finite and {len(names)} x {len(names)}")
        others = {name: sd for name, sd in deviations.items() if name not in names}
        full = np.zeros((len(names) + len(others),) * 2)
        full[: len(names), : len(names)] = matrix
        np.fill_diagonal(full[len(names) :, len(names) :], np.square(list(others.values())))
        return (*names, *others), full
    used = {name: sd for name, sd in deviations.items() if sd > 0}
    if not used:
        raise InputError(
            f"{bicycle.name or 'bicycle'}: no parameter has a standard deviation; give them in the file, such as "
            'trail = "0.0563 +/- 0.0017 m"'
        )
    return tuple(used), np.diag(np.square(list(used.values())))


def _checked(deviations: Mapping[str, Number]) -> list[tuple[str, float]]:
    for name, deviation in deviations.items():
        if not np.isfinite(deviation) or deviation < 0:
            raise InputError(f"standard deviation of {name} = {deviation}, must be finite and zero or more")
    return [(name, float(deviation)) for name, deviation in deviations.items()]


def seated(bicycle: Bicycle, rider: Rider | None) -> Rider | None:
    """Return the rider with the forward lean angle on this bicycle; refuse a batch of designs."""
    for record in (bicycle, rider):
        if record is not None and record.shape != ():
            raise InputError(
                f"{record.name or record.kind}: is a batch of shape {record.shape}, must be a single design"
            )
    return None if rider is None else rider.on(bicycle)
