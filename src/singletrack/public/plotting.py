"""The figure of a model, from its numbers."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from singletrack.errors import InputError
from singletrack.linear import critical_speeds, modes
from singletrack.linear.eigenvalues import checked_speeds
from singletrack.present.plotting import Drawn, overlay_figure, single_figure
from singletrack.present.words import KILOMETRES, METRES

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from singletrack.analysis.uncertainty import EigenvalueUncertainty
    from singletrack.arrays import ArrayLike
    from singletrack.model import LinearModel

__all__ = ["figure_of_model"]

_FINE, _MOST = 401, 50


def figure_of_model(
    model: LinearModel,
    speeds: ArrayLike,
    *,
    width: float,
    title: str,
    kmh: bool,
    limit: float,
    uncertainty: EigenvalueUncertainty | None = None,
) -> Figure:
    """Return a figure of eigenvalues over the speed (arguments and errors as :meth:`CoefficientMatrices.plot`).

    Parameters
    ----------
    model : LinearModel
        Of shape () or (m,).
    speeds : array, shape (k,)
        In m/s.
    width : float
        In mm.
    title : str
    kmh : bool
    limit : float
        In 1/s.
    uncertainty : EigenvalueUncertainty, optional
    """
    v = np.sort(checked_speeds(speeds))
    if len(v) < 2 or v[0] == v[-1]:
        raise InputError(f"speeds: found {v.tolist()}, must be at least the lowest and the highest in m/s")
    fine = np.linspace(v[0], v[-1], _FINE) if len(v) == 2 else v
    unit = KILOMETRES if kmh else METRES
    if model.shape == ():
        drawn = Drawn("", modes(model, fine), critical_speeds(model), uncertainty)
        return single_figure(drawn, width, title, unit, limit)
    if len(model.shape) > 1 or not 1 <= model.shape[0] <= _MOST:
        raise InputError(f"plot: designs of shape {model.shape}, must be one, or up to {_MOST} along one axis")
    if uncertainty is not None:
        raise InputError(f"uncertainty: of one design only, found designs of shape {model.shape}")
    kept = [(i, model[i]) for i in np.flatnonzero(model.valid)]
    several = [Drawn(f"design {i}", modes(one, fine), critical_speeds(one)) for i, one in kept]
    return overlay_figure(several, width, title, unit, limit, ("design", [float(i) for i, _ in kept]))
