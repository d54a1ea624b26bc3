"""The family of steady turns that a bicycle rides with no hands and no torques, through its folds."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from singletrack.errors import InputError, ModelError, unknown_name
from singletrack.multibody.bicycle.turning import SMALL, STEP, resting, turn_eigenvalues
from singletrack.multibody.engine.continuation import Family, follow
from singletrack.multibody.engine.equilibrium import SteadyMotion, steady_motion

if TYPE_CHECKING:
    from collections.abc import Mapping

    import xarray as xr

    from singletrack.arrays import Array
    from singletrack.multibody.engine.model import Model

__all__ = ["free_turns", "hands_free_family"]

ANGLES = ("lean", "steer")


def hands_free_family(
    model: Model,
    speed: float,
    *,
    right: bool = True,
    guess: Mapping[str, float] | None = None,
    along: str = "lean",
    first: float = SMALL,
) -> Family:
    """Return the turns without torques, from nearly straight running at the capsize speed to where the bicycle stands.

    Parameters
    ----------
    model
        From :func:`bicycle_model`.
    speed
        Where to look for the first turn, m/s.
    right
        Turns to the right, or to the left.
    guess
        Coordinates to start with, rad.
    along, first
        The angle that is given of the first turn, ``lean`` or ``steer``, and its size, rad.

    Examples
    --------
    >>> from singletrack import load_bicycle
    >>> from singletrack.multibody import bicycle_model
    >>> family = hands_free_family(bicycle_model(load_bicycle("benchmark")), 6.0)
    >>> family.end, round(max(motion.state["lean"] for motion in family.motions), 2)
    ('it stands still', 0.42)
    """
    sign = 1.0 if right else -1.0
    wheel = model.system.parameters["rear radius"]
    start = steady_motion(
        model,
        {along: sign * first},
        resting=resting(model),
        guess=guess,
        guess_rates={"rear wheel": -speed / wheel},
    )
    forward = np.sign(start.state.rate("rear wheel"))

    def stands(motion: SteadyMotion) -> str:
        return "it stands still" if motion.state.rate("rear wheel") * forward <= 0.0 else ""

    return follow(start, resting(model), towards={along: sign}, step=STEP, until=stands)


def free_turns(
    model: Model, values: Array, speed: float, *, along: str = "lean", guess: Mapping[str, float] | None = None
) -> xr.Dataset:
    """Return the steady turns without torques that continue each other from nearly straight running outwards.

    The family begins at straight running at the capsize speed, so ``speed`` should be near it. It is followed by the
    length of its arc, so that a fold is passed without a jump to another family.

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
        Coordinates to start with, rad, where not near straight running.

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

    if along not in ANGLES:
        raise InputError(unknown_name("angle to go along", along, ANGLES))
    values = np.asarray(values, dtype=float)
    found: dict[float, SteadyMotion] = {}
    for side in (values[values > 0.0], values[values < 0.0]):
        if len(side):
            found |= _of_family(model, sorted(side.tolist(), key=abs), speed, along, guess)
    turns = [found[value] for value in values.tolist()]
    wheel = model.system.parameters["rear radius"]
    states = [turn.state for turn in turns]
    columns = {
        "lean": [state["lean"] for state in states],
        "steer": [state["steer"] for state in states],
        "speed": [-wheel * state.rate("rear wheel") for state in states],
        "yaw_rate": [state.rate("yaw") for state in states],
        "radius": [np.hypot(state.rate("x"), state.rate("y")) / abs(state.rate("yaw")) for state in states],
        "growth": [_growth(turn) for turn in turns],
    }
    return xr.Dataset({name: ("turn", column) for name, column in columns.items()})


def _of_family(
    model: Model, values: list[float], speed: float, along: str, guess: Mapping[str, float] | None
) -> dict[float, SteadyMotion]:
    """Return the turns with some values of an angle, in the order in which the family comes to them."""
    names = model.system.coordinates
    right = values[0] > 0.0
    family = hands_free_family(model, speed, right=right, guess=guess, along=along, first=abs(values[0]))
    found = {values[0]: family.motions[0]}
    for value in values[1:]:
        near = next((m for m in family.motions if abs(m.state[along]) >= abs(value)), None)
        if near is None:
            greatest = max(abs(motion.state[along]) for motion in family.motions)
            raise ModelError(
                f"no steady motion found with {along} {value:g} rad: the greatest of this family is {greatest:.4g} rad"
            )
        found[value] = steady_motion(
            model,
            {along: value},
            resting=resting(model),
            guess={name: near.state[name] for name in names},
            guess_rates={"rear wheel": near.state.rate("rear wheel")},
        )
    return found


def _growth(turn: SteadyMotion) -> float:
    """Return the largest real part of the eigenvalues, but for the zero that leads to the neighbouring turn."""
    values = turn_eigenvalues(turn)
    return float(np.max(np.delete(values, np.argmin(abs(values))).real))
