"""Designs drawn from the uncertainty of the parameters, in one seeded batch."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from singletrack import linear
from singletrack.analysis.derivatives import shifted
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
from singletrack.errors import InputError
from singletrack.model import LinearModel

if TYPE_CHECKING:
    from collections.abc import Sequence

    from singletrack.arrays import Array
    from singletrack.parameters import Bicycle, Rider
    from singletrack.posture import Options

__all__ = ["Sample", "sample_designs"]

_MOST_SAMPLES = 100_000


@dataclass(frozen=True, eq=False)
class Sample:
    """A batch of designs drawn from the uncertainty of the parameters.

    Attributes
    ----------
    nominal : LinearModel
        Of the design as given.
    model : LinearModel
        Of the n designs that can exist, shape (n, 2, 2) each.
    drawn : int
        How many were drawn; those that no body can be or in which the rider does not reach are left out.
    """

    nominal: LinearModel
    model: LinearModel
    drawn: int

    def eigenvalues(self, speeds: Array) -> EigenvalueUncertainty:
        """Return the modes' eigenvalues at speeds (n,) in m/s with the spread of the sample."""
        nominal = linear.modes(self.nominal, speeds)
        parts = [linear.modes(chunk, speeds).eigenvalues for chunk in chunks(self.model)]
        roots = np.concatenate(parts)
        intervals = [np.quantile(part, (0.025, 0.975), axis=0) for part in (roots.real, roots.imag)]
        real, imaginary = roots.real.std(axis=0, ddof=1), roots.imag.std(axis=0, ddof=1)
        never_linear = np.zeros(real.shape, dtype=bool)
        return EigenvalueUncertainty(
            nominal.speeds,
            nominal.eigenvalues,
            real,
            imaginary,
            intervals[0],
            intervals[1],
            never_linear,
            nominal.names,
        )

    def critical_speeds(self) -> CriticalSpeedUncertainty:
        """Return all critical speeds of the design as given, with the spread of those of the same rank in the sample.

        Where designs of the sample lack a speed the others have, the spread is that of the ones that have it.
        """
        own, drawn = linear.critical_speeds(self.nominal), linear.critical_speeds(self.model)
        weave, capsize = np.asarray(own.weave), np.asarray(own.capsize)
        spread = [
            np.nanstd(speeds[:, : len(values)], axis=0, ddof=1)
            for speeds, values in ((drawn.weave_speeds, weave), (drawn.capsize_speeds, capsize))
        ]
        return CriticalSpeedUncertainty(weave, spread[0], capsize, spread[1])


def sample_designs(
    bicycle: Bicycle,
    rider: Rider | None = None,
    options: Options | str = "rigid",
    covariance: tuple[Sequence[str], Array] | None = None,
    samples: int = 2000,
    seed: int = 0,
) -> Sample:
    """Draw designs from the uncertainty of the parameters (normal distributions).

    Parameters
    ----------
    bicycle, rider, options, covariance
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
    rider = seated(bicycle, rider)
    names, matrix = parameter_covariance(bicycle, rider, covariance)
    drawn = np.random.default_rng(seed).standard_normal((samples, len(names))) @ covariance_root(matrix).T
    moved = coefficients(*shifted(bicycle, rider, names, drawn), options)
    good = np.broadcast_to(moved.valid, (samples,)) & np.isfinite(np.asarray(moved.M)).all(axis=(-2, -1))
    if good.sum() < max(10, samples // 10):
        raise InputError(
            f"{bicycle.name or 'bicycle'}: only {good.sum()} of {samples} designs within the standard deviations can "
            "exist; the standard deviations are too large for a sample"
        )
    return Sample(coefficients(bicycle, rider, options), whole_batch(moved, samples)[good], samples)
