"""Standard deviations of parameters carried through to matrices, eigenvalues and critical speeds.

Linear propagation with exact derivatives wherever it holds; where roots of the characteristic polynomial come close to
one another compared with their uncertainty, it does not, and a seeded sample (Monte Carlo) takes its place.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from singletrack.analysis.derivatives import Derivatives, derivatives, shifted
from singletrack.analysis.sampling import Sample, sample_designs
from singletrack.analysis.spreads import (
    CriticalSpeedUncertainty,
    EigenvalueUncertainty,
    chunks,
    covariance_root,
    parameter_covariance,
    seated,
    whole_batch,
)
from singletrack.closed_form import coefficients
from singletrack.linear import critical_speeds
from singletrack.linear import modes as named_modes
from singletrack.model import LinearModel

if TYPE_CHECKING:
    from collections.abc import Sequence

    from singletrack.arrays import Array
    from singletrack.parameters import Bicycle, Rider
    from singletrack.posture import Options

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
# Curvature's share of the linear deviation up to which it is left out: it adds 3 % to the deviation then.
_BEND = 0.25


@dataclass(frozen=True, eq=False)
class LinearUncertainty:
    """First-order propagation from parameters to results.

    Attributes
    ----------
    derivatives : Derivatives
        With respect to the uncertain parameters.
    covariance : array, shape (k, k)
        Of those parameters, SI.
    sigma_points : LinearModel
        Of the 2 k designs one standard deviation away, either way, along the k principal directions.
    """

    derivatives: Derivatives
    covariance: np.ndarray
    sigma_points: LinearModel

    @property
    def model(self) -> LinearModel:
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
        modes = named_modes(self.model, speeds)
        roots = modes.eigenvalues
        gradient = self.derivatives.eigenvalues(modes.speeds[:, None], roots)
        real, imaginary = self._deviation(gradient.real), self._deviation(gradient.imag)
        apart = gradient[:, :, None] - gradient[:, None, :]
        spread = np.hypot(self._deviation(apart.real), self._deviation(apart.imag))
        gap = np.abs(roots[:, :, None] - roots[:, None, :])
        gap[:, range(roots.shape[1]), range(roots.shape[1])] = np.inf
        with np.errstate(invalid="ignore"):
            linear = (gap > CLEARANCE * spread).all(axis=-1) & self._nearly_straight(
                modes.speeds, roots, real, imaginary
            )
        intervals = [np.stack([x - _Z95 * s, x + _Z95 * s]) for x, s in ((roots.real, real), (roots.imag, imaginary))]
        return EigenvalueUncertainty(
            modes.speeds, roots, real, imaginary, intervals[0], intervals[1], linear, modes.names
        )

    def _nearly_straight(
        self, speeds: np.ndarray, roots: np.ndarray, real: np.ndarray, imaginary: np.ndarray
    ) -> np.ndarray:
        """Tell where the roots' curvature adds little to their spread (where the slope vanishes, it is all there is).

        Of y = a x + b x² with x normal, the variance is a² + 2 b²; b from the sigma points, those that can exist.
        """
        moved = np.concatenate([named_modes(chunk, speeds).eigenvalues for chunk in chunks(self.sigma_points)])
        bend = np.nan_to_num((moved[::2] + moved[1::2]) / 2 - roots)
        curved = [np.sqrt(2 * (part**2).sum(axis=0)) for part in (bend.real, bend.imag)]
        small = 1e-9 * np.abs(roots)
        straight: np.ndarray = (curved[0] < _BEND * real + small) & (curved[1] < _BEND * imaginary + small)
        return straight

    def critical_speeds(self) -> CriticalSpeedUncertainty:
        """Return all critical speeds with their standard deviations."""
        critical = critical_speeds(self.model)
        weave, capsize = np.asarray(critical.weave), np.asarray(critical.capsize)
        deviations = (
            self._deviation(self.derivatives.critical_speeds(v, kind))
            for v, kind in ((weave, "weave"), (capsize, "capsize"))
        )
        weave_deviation, capsize_deviation = deviations
        return CriticalSpeedUncertainty(weave, weave_deviation, capsize, capsize_deviation)


# Half-width of the central 95 % of a normal distribution, in standard deviations.
_Z95 = 1.959963984540054


def linear_uncertainty(
    bicycle: Bicycle,
    rider: Rider | None = None,
    options: Options | str = "rigid",
    covariance: tuple[Sequence[str], Array] | None = None,
) -> LinearUncertainty:
    """Propagate the standard deviations of the records to first order.

    Parameters
    ----------
    bicycle, rider
        Single designs, with standard deviations.
    options : Options or str
        How the rider sits, or a posture's name.
    covariance : (names, array of shape (k, k)), optional
        Covariance of parameters that correlate, in SI units (:class:`singletrack.measuring.measurement.Measurement` has
        it); the standard deviations of other parameters stay in force. Without it, parameters are independent.

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
    rider = seated(bicycle, rider)
    names, matrix = parameter_covariance(bicycle, rider, covariance)
    shifts = np.repeat(covariance_root(matrix).T, 2, axis=0) * np.tile([1.0, -1.0], len(names))[:, None]
    around = coefficients(*shifted(bicycle, rider, names, shifts), options)
    slopes = derivatives(bicycle, rider, options, names)
    return LinearUncertainty(slopes, matrix, whole_batch(around, 2 * len(names)))


def eigenvalue_uncertainty(
    bicycle: Bicycle,
    rider: Rider | None = None,
    options: Options | str = "rigid",
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
    straight = linear_uncertainty(bicycle, rider, options, covariance).eigenvalues(speeds)
    rows = ~straight.linear.all(axis=-1)
    if not rows.any():
        return straight
    drawn = sample_designs(bicycle, rider, options, covariance, samples, seed)
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
        straight.names,
    )
