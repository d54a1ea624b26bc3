"""The family of steady turns that a bicycle rides with no hands and no torques, over the lean angle."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from singletrack.errors import InputError, unknown_name
from singletrack.multibody.engine.equilibrium import steady_motion
from singletrack.multibody.engine.linearise import linearise

if TYPE_CHECKING:
    from collections.abc import Mapping

    import xarray as xr

    from singletrack.arrays import Array
    from singletrack.multibody.engine.model import Model, State

__all__ = ["free_turns"]

RESTING = ("lean", "steer")


def free_turns(
    model: Model, values: Array, speed: float, *, along: str = "lean", guess: Mapping[str, float] | None = None
) -> xr.Dataset:
    """Return the steady turns without torques that continue each other from nearly straight running outwards.

    The family begins at straight running at the capsize speed, so ``speed`` should be near it.

    Parameters
    ----------
    model
        From :func:`bicycle_model`.
    values
        Lean or steer angles, rad, (k,), none of them zero; the smallest on each side should be small.
    speed
        Where to look for the first turn, m/s.
    along
        ``lean`` or ``steer``: which angle is given. The lean of a family may have a greatest value, beyond which
        only the steer goes on.
    guess
        Coordinates to start with, where not near straight running.

    Returns
    -------
    xarray.Dataset
        Over ``turn``: ``lean``, ``steer`` (rad), ``speed`` (m/s, radius times turning rate of the rear wheel),
        ``yaw_rate`` (rad/s), ``radius`` of the circle of the frame's point drawn at the rear contact (m) and
        ``growth``, the largest real part of an eigenvalue (1/s); negative where the turn is stable.

    Raises
    ------
    InputError
        For an unknown ``along``.
    ModelError
        Where no turn is found, as beyond the greatest lean.

    Examples
    --------
    >>> from singletrack import load_bicycle
    >>> from singletrack.multibody import bicycle_model
    >>> turns = free_turns(bicycle_model(load_bicycle("benchmark")), [1e-3, 0.1], speed=6.0)
    >>> turns.speed.round(3).values.tolist()
    [6.024, 5.998]
    """
    import xarray as xr  # slow to import

    if along not in RESTING:
        raise InputError(unknown_name("angle to go along", along, RESTING))
    values = np.asarray(values, dtype=float)
    wheel = model.system.parameters["rear radius"]
    found: dict[float, State] = {}
    for side in (values[values > 0.0], values[values < 0.0]):
        start, rate = dict(guess or {}), -speed / wheel
        for value in sorted(side.tolist(), key=abs):
            given = {along: value}
            state = steady_motion(model, given, resting=RESTING, guess=start, guess_rates={"rear wheel": rate}).state
            start, rate = {name: state[name] for name in model.system.coordinates}, state.rate("rear wheel")
            found[value] = state
    states = [found[value] for value in values.tolist()]
    columns = {
        "lean": [state["lean"] for state in states],
        "steer": [state["steer"] for state in states],
        "speed": [-wheel * state.rate("rear wheel") for state in states],
        "yaw_rate": [state.rate("yaw") for state in states],
        "radius": [np.hypot(state.rate("x"), state.rate("y")) / abs(state.rate("yaw")) for state in states],
        "growth": [_growth(state) for state in states],
    }
    return xr.Dataset({name: ("turn", column) for name, column in columns.items()})


def _growth(state: State) -> float:
    """Return the largest real part of the eigenvalues, but for the zero that leads to the neighbouring turn."""
    values = linearise(state, keep=RESTING).eigenvalues()
    return float(np.max(np.delete(values, np.argmin(abs(values))).real))
