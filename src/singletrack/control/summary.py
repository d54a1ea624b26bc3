"""Everything that is asked of a model's control at once."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from singletrack.control.controllability import LostMode, uncontrollable_speeds
from singletrack.control.effort import Effort, effort
from singletrack.control.measures import modal_controllability
from singletrack.linear import modes

if TYPE_CHECKING:
    from collections.abc import Sequence

    from singletrack.arrays import ArrayLike
    from singletrack.model import LinearModel

__all__ = ["ControlSummary", "control_summary"]


@dataclass(frozen=True, eq=False)
class ControlSummary:
    """What the inputs of a single design can do.

    Attributes
    ----------
    inputs : tuple of str
    uncontrollable : list of LostMode
    speeds : array, shape (k,)
        In m/s.
    modes : tuple of str
        Names of the 2 n modes.
    angles : dict of str to array, shape (k, 2 n)
        Modal controllability by input, in rad.
    efforts : dict of str to Effort
    """

    inputs: tuple[str, ...]
    uncontrollable: list[LostMode]
    speeds: np.ndarray
    modes: tuple[str, ...]
    angles: dict[str, np.ndarray]
    efforts: dict[str, Effort]

    def to_dict(self) -> dict[str, Any]:
        """Return the summary for JSON; angles in degrees."""
        return {
            "inputs": list(self.inputs),
            "uncontrollable": [loss.to_dict() for loss in self.uncontrollable],
            "speeds": self.speeds.tolist(),
            "modal_controllability": {name: np.degrees(angles).tolist() for name, angles in self.angles.items()},
            "modes": list(self.modes),
            "effort": {name: found.to_dict() for name, found in self.efforts.items()},
        }


def control_summary(
    model: LinearModel, speeds: ArrayLike, inputs: Sequence[str] | None = None, *, efforts: bool = True
) -> ControlSummary:
    """Return losses, modal angles and (if wanted) efforts at speeds (k,) in m/s, for some or all inputs.

    Raises
    ------
    InputError
        For a batch, or an input that the model does not have.

    Examples
    --------
    >>> from singletrack import coefficients, load_bicycle
    >>> found = control_summary(coefficients(load_bicycle("benchmark")), [3.0, 5.0])
    >>> found.angles["steer torque"].shape, len(found.uncontrollable) > 0
    ((2, 4), True)
    """
    wanted = tuple(model.inputs if inputs is None else inputs)
    lost = uncontrollable_speeds(model, wanted)
    v = np.atleast_1d(np.asarray(speeds, dtype=float))
    angles = modal_controllability(model, v)
    return ControlSummary(
        wanted,
        lost,
        v,
        modes(model, v).names,
        {name: angles[name] for name in wanted},
        {name: effort(model, v, name) for name in wanted} if efforts else {},
    )
