"""Measured eigenvalues against a model: differences in numbers, with the model's own uncertainty where it is known."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
import scipy.stats

from singletrack.linear import modes

if TYPE_CHECKING:
    from singletrack.arrays import Array
    from singletrack.model import LinearModel

__all__ = ["ModeAgreement", "compare_modes"]


@dataclass(frozen=True, eq=False)
class ModeAgreement:
    """Measured and computed eigenvalues of one mode in n runs.

    Attributes
    ----------
    speeds : array, shape (n,)
        Middle of the speeds of each run, in m/s.
    measured, computed : complex array, shape (n,)
        In 1/s.
    deviations : array, shape (n, 2)
        Standard deviations of the differences' real and imaginary parts, from what is known of both sides.
    rms : float
        Of the differences, in 1/s.
    chi_square : float
        Sum of squares of the differences over their deviations; NaN without deviations.
    probability : float
        That chance alone gives as much or more.
    """

    speeds: np.ndarray
    measured: np.ndarray
    computed: np.ndarray
    deviations: np.ndarray
    rms: float
    chi_square: float
    probability: float


def compare_modes(
    model: LinearModel,
    lowest: Array,
    highest: Array,
    measured: Array,
    deviations: Array | None = None,
    mode: str = "weave",
) -> ModeAgreement:
    """Compare measured eigenvalues with those of a mode of a model.

    Parameters
    ----------
    model : LinearModel
        A single design.
    lowest, highest : array, shape (n,)
        Speeds in m/s between which each run was made.
    measured : complex array, shape (n,)
        In 1/s, with positive imaginary parts.
    deviations : array, shape (n, 2), optional
        Of real and imaginary part, of measurement and model together. What the speed's change in a run does to the
        model's eigenvalue is added (half its range over sqrt 3).
    mode : str

    Examples
    --------
    >>> import numpy as np
    >>> from singletrack import coefficients, load_bicycle
    >>> model = coefficients(load_bicycle("benchmark"))
    >>> own = model.modes([5.0]).eigenvalues[:, 0]
    >>> compare_modes(model, [4.9], [5.1], own, [[0.1, 0.1]]).rms < 0.01
    True
    """
    low, high = (np.atleast_1d(np.asarray(speeds, dtype=float)) for speeds in (lowest, highest))
    found = np.atleast_1d(np.asarray(measured, dtype=complex))
    middle = (low + high) / 2
    column = modes(model, middle).names.index(mode)
    computed, ends = (
        modes(model, middle).eigenvalues[:, column],
        [modes(model, speeds).eigenvalues[:, column] for speeds in (low, high)],
    )
    spread = np.stack([(ends[1] - ends[0]).real, (ends[1] - ends[0]).imag], axis=-1) / np.sqrt(12.0)
    own = np.zeros((len(found), 2)) if deviations is None else np.asarray(deviations, dtype=float)
    total = np.hypot(own, spread)
    gap = found - computed
    parts = np.stack([gap.real, gap.imag], axis=-1)
    known = total > 0
    chi = float(np.sum((parts[known] / total[known]) ** 2)) if known.any() else float("nan")
    probability = float(scipy.stats.chi2.sf(chi, int(known.sum()))) if known.any() else float("nan")
    rms = float(np.sqrt(np.mean(np.abs(gap) ** 2)))
    return ModeAgreement(middle, found, computed, total, rms, chi, probability)
