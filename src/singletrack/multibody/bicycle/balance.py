"""The inputs that hold a machine in the motion it is in: what a rider's muscles give at rest."""

from __future__ import annotations

from typing import TYPE_CHECKING

from singletrack.multibody.engine.assembly import span_of
from singletrack.multibody.engine.connections import CoordinateForce
from singletrack.multibody.engine.dynamics import accelerations

if TYPE_CHECKING:
    from singletrack.multibody.engine.model import State

__all__ = ["holding_inputs"]


def holding_inputs(state: State) -> dict[str, float]:
    """Return the inputs under which no independent speed changes, by name; those of other coordinates are zero.

    Parameters
    ----------
    state
        A state of a machine in which every independent speed has an input of its own.

    Examples
    --------
    >>> from singletrack import load_bicycle
    >>> from singletrack.multibody import bicycle_model, ride
    >>> forces = holding_inputs(ride(bicycle_model(load_bicycle("benchmark")), 5.0))
    >>> bool(max(abs(force) for force in forces.values()) < 1e-9)
    True
    """
    jacobian, mass = state.model.kinetics(state.q, state.parameters)
    span = span_of(state.partition, jacobian)
    free = list(state.partition.independent_speeds)
    missing = -(span.T @ mass @ span) @ accelerations(state).a[free]
    names = {given.coordinate: given.name for given in state.model.system.inputs if isinstance(given, CoordinateForce)}
    return {
        names[coordinate]: float(force)
        for coordinate, force in zip(state.freedoms, missing, strict=True)
        if coordinate in names
    }
