"""Standard deviations of parameters carried through to matrices, eigenvalues and critical speeds.

Linear propagation with exact derivatives wherever it holds; where roots of the characteristic polynomial come close to
one another compared with their uncertainty, it does not, and a seeded sample (Monte Carlo) takes its place.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from singletrack.analysis.derivatives import Derivatives, derivatives, shifted
from singletrack.errors import InputError
from singletrack.linear import CoefficientMatrices, coefficients

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from singletrack.arrays import Array
    from singletrack.parameters import Bicycle, Rider

__all__ = [
    "CriticalSpeedUncertainty",
    "EigenvalueUncertainty",
    "LinearUncertainty",
    "Sample",
    "eigenvalue_uncertainty",
    "linear_uncertainty",
    "sample_designs",
]

#: Linear propagation is used for a root whose distance from every other is more than this many of the distance's own
#: standard deviations. Two roots a ± √d with d uncertain by σ are 2√d apart, uncertain by σ/√d: at this ratio d = 3 σ,
#: and the neglected terms of the distance's spread are of relative size (σ/d)²/4, some 3 %.
CLEARANCE = 6.0
_CHUNK = 250
_MOST_SAMPLES = 100_000
# Curvature's share of the linear deviation up to which it is left out: it adds 3 % to the deviation then.
_BEND = 0.25


@dataclass(frozen=True, eq=False)
class EigenvalueUncertainty:
    """Eigenvalues by mode with what they may be.

    Attributes
    ----------
    speeds : array, shape (n,)
        In m/s.
    eigenvalues : complex array, shape (n, 4)
        Of the design as given, in 1/s; columns as in :class:`singletrack.linear.Modes`.
    real_deviation, imaginary_deviation : array, shape (n, 4)
        Standard deviations in 1/s.
    real_interval, imaginary_interval : array, shape (2, n, 4)
        Bounds of the central 95 %, in 1/s.
    linear : bool array, shape (n, 4)
        Where linear propagation holds; elsewhere the numbers come from a sample (or are not to be trusted, if none
        was drawn).
    """

    speeds: np.ndarray
    eigenvalues: np.ndarray
    real_deviation: np.ndarray
    imaginary_deviation: np.ndarray
    real_interval: np.ndarray
    imaginary_interval: np.ndarray
    linear: np.ndarray


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


@dataclass(frozen=True, eq=False)
class LinearUncertainty:
    """First-order propagation from parameters to results.

    Attributes
    ----------
    derivatives : Derivatives
        With respect to the uncertain parameters.
    covariance : array, shape (k, k)
        Of those parameters, SI.
    sigma_points : CoefficientMatrices
        Of the 2 k designs one standard deviation away, either way, along the k principal directions.
    """

    derivatives: Derivatives
    covariance: np.ndarray
    sigma_points: CoefficientMatrices

    @property
    def model(self) -> CoefficientMatrices:
        """The coefficient matrices of the design as given."""
        return self.derivatives.model

    def _deviation(self, gradient: np.ndarray) -> np.ndarray:
        """Return the standard deviation of what has a gradient (..., k)."""
        variance = np.einsum("...i,ij,...j->...", gradient, self.covariance, gradient)
        result: np.ndarray = np.sqrt(np.maximum(variance, 0.0))
        return result

    def matrices(self) -> dict[str, np.ndarray]:
        """Return the standard deviations (2, 2) of ``M, C1, K0, K2``, in their units."""
        return {name: self._deviation(np.moveaxis(d, 0, -1)) for name, d in self.derivatives.matrices.items()}

    def eigenvalues(self, speeds: Array) -> EigenvalueUncertainty:
        """Return the modes' eigenvalues at speeds (n,) in m/s with their standard deviations."""
        modes = self.model.modes(speeds)
        roots = modes.eigenvalues
        gradient = self.derivatives.eigenvalues(modes.speeds[:, None], roots)
        real, imaginary = self._deviation(gradient.real), self._deviation(gradient.imag)
        apart = gradient[:, :, None] - gradient[:, None, :]
        spread = np.hypot(self._deviation(apart.real), self._deviation(apart.imag))
        gap = np.abs(roots[:, :, None] - roots[:, None, :])
        gap[:, range(4), range(4)] = np.inf
        with np.errstate(invalid="ignore"):
            linear = (gap > CLEARANCE * spread).all(axis=-1) & self._nearly_straight(
                modes.speeds, roots, real, imaginary
            )
        intervals = [np.stack([x - _Z95 * s, x + _Z95 * s]) for x, s in ((roots.real, real), (roots.imag, imaginary))]
        return EigenvalueUncertainty(modes.speeds, roots, real, imaginary, intervals[0], intervals[1], linear)

    def _nearly_straight(
        self, speeds: np.ndarray, roots: np.ndarray, real: np.ndarray, imaginary: np.ndarray
    ) -> np.ndarray:
        """Tell where the roots' curvature adds little to their spread (where the slope vanishes, it is all there is).

        Of y = a x + b x² with x normal, the variance is a² + 2 b²; b from the sigma points, those that can exist.
        """
        moved = np.concatenate([chunk.modes(speeds).eigenvalues for chunk in _chunks(self.sigma_points)])
        bend = np.nan_to_num((moved[::2] + moved[1::2]) / 2 - roots)
        curved = [np.sqrt(2 * (part**2).sum(axis=0)) for part in (bend.real, bend.imag)]
        small = 1e-9 * np.abs(roots)
        straight: np.ndarray = (curved[0] < _BEND * real + small) & (curved[1] < _BEND * imaginary + small)
        return straight

    def critical_speeds(self) -> CriticalSpeedUncertainty:
        """Return all critical speeds with their standard deviations."""
        critical = self.model.critical_speeds()
        weave, capsize = np.asarray(critical.weave), np.asarray(critical.capsize)
        deviations = (
            self._deviation(self.derivatives.critical_speeds(v, kind))
            for v, kind in ((weave, "weave"), (capsize, "capsize"))
        )
        weave_deviation, capsize_deviation = deviations
        return CriticalSpeedUncertainty(weave, weave_deviation, capsize, capsize_deviation)


# Half-width of the central 95 % of a normal distribution, in standard deviations.
_Z95 = 1.959963984540054


@dataclass(frozen=True, eq=False)
class Sample:
    """A batch of designs drawn from the uncertainty of the parameters.

    Attributes
    ----------
    nominal : CoefficientMatrices
        Of the design as given.
    model : CoefficientMatrices
        Of the n designs that can exist, shape (n, 2, 2) each.
    drawn : int
        How many were drawn; those that no body can be or in which the rider does not reach are left out.
    """

    nominal: CoefficientMatrices
    model: CoefficientMatrices
    drawn: int

    def eigenvalues(self, speeds: Array) -> EigenvalueUncertainty:
        """Return the modes' eigenvalues at speeds (n,) in m/s with the spread of the sample."""
        nominal = self.nominal.modes(speeds)
        parts = [chunk.modes(speeds).eigenvalues for chunk in _chunks(self.model)]
        roots = np.concatenate(parts)
        intervals = [np.quantile(part, (0.025, 0.975), axis=0) for part in (roots.real, roots.imag)]
        real, imaginary = roots.real.std(axis=0, ddof=1), roots.imag.std(axis=0, ddof=1)
        linear = np.zeros(real.shape, dtype=bool)
        return EigenvalueUncertainty(
            nominal.speeds, nominal.eigenvalues, real, imaginary, intervals[0], intervals[1], linear
        )

    def critical_speeds(self) -> CriticalSpeedUncertainty:
        """Return all critical speeds of the design as given, with the spread of those of the same rank in the sample.

        Where designs of the sample lack a speed the others have, the spread is that of the ones that have it.
        """
        own, drawn = self.nominal.critical_speeds(), self.model.critical_speeds()
        weave, capsize = np.asarray(own.weave), np.asarray(own.capsize)
        spread = [
            np.nanstd(speeds[:, : len(values)], axis=0, ddof=1)
            for speeds, values in ((drawn.weave_speeds, weave), (drawn.capsize_speeds, capsize))
        ]
        return CriticalSpeedUncertainty(weave, spread[0], capsize, spread[1])


def _chunks(model: CoefficientMatrices) -> list[CoefficientMatrices]:
    """Return a batch in pieces that keep temporary arrays small."""
    whole = _whole(model, model.shape[0])
    M, C1, K0, K2, gravity = whole.M, whole.C1, whole.K0, whole.K2, whole.gravity
    pieces = [slice(i, i + _CHUNK) for i in range(0, model.shape[0], _CHUNK)]
    return [CoefficientMatrices(M[p], C1[p], K0[p], K2[p], gravity[p]) for p in pieces]


def _whole(model: CoefficientMatrices, count: int) -> CoefficientMatrices:
    """Return a batch of n designs in full: a matrix that depends on no uncertain parameter comes without the batch."""
    matrices = (np.broadcast_to(matrix, (count, 2, 2)) for matrix in (model.M, model.C1, model.K0, model.K2))
    M, C1, K0, K2 = matrices
    gravity = np.broadcast_to(np.asarray(model.gravity, dtype=float), (count,))
    return CoefficientMatrices(M, C1, K0, K2, gravity, faults=model.faults)


def _root(covariance: np.ndarray) -> np.ndarray:
    """Return R with R R' = covariance, its columns along principal directions of the scaled parameters."""
    scale = np.sqrt(np.diag(covariance))
    safe = np.where(scale > 0, scale, 1.0)
    values, vectors = np.linalg.eigh(covariance / np.outer(safe, safe))
    root: np.ndarray = safe[:, None] * vectors * np.sqrt(np.maximum(values, 0.0))
    return root


def _covariance(
    bicycle: Bicycle, rider: Rider | None, covariance: tuple[Sequence[str], Array] | None
) -> tuple[tuple[str, ...], np.ndarray]:
    """Return the uncertain parameters and their covariance: as given, else independent standard deviations."""
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


def _checked(deviations: Mapping[str, Array]) -> list[tuple[str, float]]:
    for name, deviation in deviations.items():
        if not np.isfinite(deviation) or deviation < 0:
            raise InputError(f"standard deviation of {name} = {deviation}, must be finite and zero or more")
    return [(name, float(deviation)) for name, deviation in deviations.items()]


def linear_uncertainty(
    bicycle: Bicycle,
    rider: Rider | None = None,
    posture: str = "rigid",
    shoulder: str | None = None,
    covariance: tuple[Sequence[str], Array] | None = None,
) -> LinearUncertainty:
    """Propagate the standard deviations of the records to first order.

    Parameters
    ----------
    bicycle, rider, posture, shoulder
        As for :func:`singletrack.coefficients`; single designs, with standard deviations.
    covariance : (names, array of shape (k, k)), optional
        Covariance of parameters that correlate (:class:`singletrack.parameters.measure.Measurement` has it); the
        standard deviations of other parameters stay in force. Without it, parameters are independent.

    Raises
    ------
    InputError
        If no parameter has a standard deviation, or as :func:`singletrack.coefficients` does.

    Examples
    --------
    >>> from dataclasses import replace
    >>> from singletrack import load_bicycle
    >>> bicycle = replace(load_bicycle("stratos"), standard_deviations={"trail": 0.0016})
    >>> linear_uncertainty(bicycle).critical_speeds().weave_deviation.round(3).tolist()
    [0.006]
    """
    rider = _seated(bicycle, rider)
    names, matrix = _covariance(bicycle, rider, covariance)
    shifts = np.repeat(_root(matrix).T, 2, axis=0) * np.tile([1.0, -1.0], len(names))[:, None]
    around = coefficients(*shifted(bicycle, rider, names, shifts), posture, shoulder)
    slopes = derivatives(bicycle, rider, posture, shoulder, names)
    return LinearUncertainty(slopes, matrix, _whole(around, 2 * len(names)))


def _seated(bicycle: Bicycle, rider: Rider | None) -> Rider | None:
    """Return the rider with the forward lean angle on this bicycle; refuse a batch of designs."""
    for record in (bicycle, rider):
        if record is not None and record.shape != ():
            raise InputError(
                f"{record.name or record.kind}: is a batch of shape {record.shape}, must be a single design"
            )
    return None if rider is None else rider.on(bicycle)


def sample_designs(
    bicycle: Bicycle,
    rider: Rider | None = None,
    posture: str = "rigid",
    shoulder: str | None = None,
    covariance: tuple[Sequence[str], Array] | None = None,
    samples: int = 2000,
    seed: int = 0,
) -> Sample:
    """Draw designs from the uncertainty of the parameters (normal distributions).

    Parameters
    ----------
    bicycle, rider, posture, shoulder, covariance
        As for :func:`linear_uncertainty`.
    samples : int
        How many, from 10 to 100000.
    seed : int
        The same seed draws the same designs.

    Raises
    ------
    InputError
        If no parameter has a standard deviation, ``samples`` is out of range, or hardly any design can exist.

    Examples
    --------
    >>> from dataclasses import replace
    >>> from singletrack import load_bicycle
    >>> bicycle = replace(load_bicycle("stratos"), standard_deviations={"trail": 0.0016})
    >>> sample_designs(bicycle, samples=100).model.shape
    (100,)
    """
    if not 10 <= samples <= _MOST_SAMPLES:
        raise InputError(f"samples = {samples}, must be from 10 to {_MOST_SAMPLES}")
    rider = _seated(bicycle, rider)
    names, matrix = _covariance(bicycle, rider, covariance)
    drawn = np.random.default_rng(seed).standard_normal((samples, len(names))) @ _root(matrix).T
    moved = coefficients(*shifted(bicycle, rider, names, drawn), posture, shoulder)
    good = np.broadcast_to(moved.valid, (samples,)) & np.isfinite(np.asarray(moved.M)).all(axis=(-2, -1))
    if good.sum() < max(10, samples // 10):
        raise InputError(
            f"{bicycle.name or 'bicycle'}: only {good.sum()} of {samples} designs within the standard deviations can "
            "exist; the standard deviations are too large for a sample"
        )
    gravity = np.broadcast_to(np.asarray(moved.gravity, dtype=float), (samples,))[good]
    whole = _whole(moved, samples)
    M, C1, K0, K2, gravity = (a[good] for a in (whole.M, whole.C1, whole.K0, whole.K2, whole.gravity))
    kept = CoefficientMatrices(M, C1, K0, K2, gravity)
    return Sample(coefficients(bicycle, rider, posture, shoulder), kept, samples)


def eigenvalue_uncertainty(
    bicycle: Bicycle,
    rider: Rider | None = None,
    posture: str = "rigid",
    shoulder: str | None = None,
    *,
    speeds: Array,
    covariance: tuple[Sequence[str], Array] | None = None,
    samples: int = 2000,
    seed: int = 0,
) -> EigenvalueUncertainty:
    """Return eigenvalues with their uncertainty: linear where that holds, from a sample where it does not.

    Parameters and errors as for :func:`linear_uncertainty` and :func:`sample_designs`; ``speeds`` (n,) in m/s.

    Examples
    --------
    >>> from dataclasses import replace
    >>> from singletrack import load_bicycle
    >>> bicycle = replace(load_bicycle("stratos"), standard_deviations={"trail": 0.0016})
    >>> eigenvalue_uncertainty(bicycle, speeds=[5.0]).linear.tolist()
    [[True, True, True, True]]
    """
    straight = linear_uncertainty(bicycle, rider, posture, shoulder, covariance).eigenvalues(speeds)
    rows = ~straight.linear.all(axis=-1)
    if not rows.any():
        return straight
    drawn = sample_designs(bicycle, rider, posture, shoulder, covariance, samples, seed)
    bent = drawn.eigenvalues(straight.speeds[rows])
    use = ~straight.linear[rows]

    def merged(linear: np.ndarray, sampled: np.ndarray) -> np.ndarray:
        out = linear.copy()
        out[..., rows, :] = np.where(use, sampled, linear[..., rows, :])
        return out

    return EigenvalueUncertainty(
        straight.speeds,
        straight.eigenvalues,
        merged(straight.real_deviation, bent.real_deviation),
        merged(straight.imaginary_deviation, bent.imaginary_deviation),
        merged(straight.real_interval, bent.real_interval),
        merged(straight.imaginary_interval, bent.imaginary_interval),
        straight.linear,
    )
