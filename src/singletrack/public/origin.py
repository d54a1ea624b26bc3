"""What a model was made from, so that more than its matrices can be asked: the rider's joints and hands."""

from __future__ import annotations

import dataclasses
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Self

from singletrack import closed_form
from singletrack.linear import state_space
from singletrack.model import Outputs
from singletrack.parameters import Bicycle, Rider
from singletrack.posture import Options

if TYPE_CHECKING:
    from collections.abc import Sequence

    from singletrack.arrays import ArrayLike
    from singletrack.linear import StateSpace
    from singletrack.model import LinearModel

__all__ = ["Origin", "observed"]


@dataclass(frozen=True, eq=False)
class Origin:
    """Bicycle, rider and posture of a model, and which designs of the batch were picked, one after the other.

    Attributes
    ----------
    bicycle : Bicycle
    rider : Rider
    options : Options
    picked : tuple
        Indices.
    """

    bicycle: Bicycle
    rider: Rider
    options: Options
    picked: tuple[Any, ...] = ()

    def at(self, index: Any) -> Self:
        """Return the origin of some designs of the batch.

        Parameters
        ----------
        index : int, slice, mask or tuple of these
            Of the batch's axes.
        """
        return dataclasses.replace(self, picked=(*self.picked, index))

    def outputs(self) -> Outputs:
        """Return angles of the rider's joints and forces of the hands."""
        found = closed_form.rider_outputs(self.bicycle, self.rider, self.options)
        for index in self.picked:
            found = found[index]
        return found


def observed(
    model: LinearModel, speed: ArrayLike, outputs: Sequence[str] | Outputs | None, origin: Origin | None
) -> StateSpace:
    """Return first-order systems with the outputs asked for, by name or as a record.

    Parameters
    ----------
    model : LinearModel
    speed : array, shape () or (k,)
        In m/s.
    outputs : sequence of str or Outputs, optional
    origin : Origin, optional
        What joints and hands there are.
    """
    if isinstance(outputs, Outputs):
        return state_space(model, speed, None, outputs)
    plain = [f"{name}{kind}" for name in model.coordinates for kind in ("", " rate", " acceleration")]
    if outputs is None or isinstance(outputs, str) or origin is None or all(name in plain for name in outputs):
        return state_space(model, speed, outputs)
    return state_space(model, speed, outputs, origin.outputs())
