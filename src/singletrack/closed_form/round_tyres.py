"""Tyres with a round cross-section: what leaning on them adds to the linear model (docs/theory/closed-form.md).

A wheel of outer radius r and crown radius c (of the tyre's cross-section) that leans by a stands with its hub at the
height ``(r - c) cos a + c``: higher than a knife edge by ``c a^2 / 2``. To second order that lifts the load N on the
wheel; nothing else changes to first order, for rolling, spin and contact are those of the knife edge. With n_i the lean
of the wheel for each freedom alone,

    g K0  gains  N c n n^T.

For the rear wheel n is one for the lean alone; for the front wheel one for the lean and the forward component of the
axis of each hinge between it and the rear frame, sin(lambda) for the steer.
"""

from __future__ import annotations

import dataclasses
from typing import TYPE_CHECKING

from singletrack.arrays import Number, as_arrays, stack
from singletrack.parameters.bodies import bicycle_bodies
from singletrack.parameters.flexible import soft_hinges

if TYPE_CHECKING:
    from singletrack.model import LinearModel
    from singletrack.parameters import Bicycle
    from singletrack.posture import Posture

__all__ = ["has_round_tyres", "load_of_rider", "on_round_tyres"]


def on_round_tyres(model: LinearModel, bicycle: Bicycle, rider_load: tuple[Number, Number] | None) -> LinearModel:
    """Return the model of a bicycle on its round tyres, where it has a tyre radius.

    Parameters
    ----------
    model : LinearModel
        On knife edges.
    bicycle : Bicycle
    rider_load : (array, array), shape (...) each, optional
        Of the seated rider, who loads the wheels too (:func:`load_of_rider`).

    Examples
    --------
    >>> from singletrack import coefficients, load_bicycle
    >>> bicycle = load_bicycle("benchmark")
    >>> knife, round_ = (coefficients(b) for b in (bicycle, bicycle.replace(front_tyre_radius=0.02)))
    >>> round(float(round_.critical_speeds().capsize[0] - knife.critical_speeds().capsize[0]), 3) != 0.0
    True
    """
    if not has_round_tyres(bicycle):
        return model
    xp, (tilt, base) = as_arrays(bicycle.steer_axis_tilt, bicycle.wheel_base)
    front, rear = _loads(bicycle, rider_load)
    zero = 0.0 * tilt * base
    leans = {"lean": zero + 1.0, "steer": zero + xp.sin(tilt)}
    leans |= {hinge.name: zero + hinge.axis[..., 0] for hinge in soft_hinges(bicycle)}
    of_front = stack([leans.get(name, zero) for name in model.coordinates], -1)
    of_rear = stack([zero + float(name == "lean") for name in model.coordinates], -1)
    K0 = model.K0
    for radius, load, lean in ((bicycle.rear_tyre_radius, rear, of_rear), (bicycle.front_tyre_radius, front, of_front)):
        if radius is not None:
            _, (weight,) = as_arrays(radius * load)
            K0 = K0 + weight[..., None, None] * lean[..., :, None] * lean[..., None, :]
    return dataclasses.replace(model, K0=K0)


def has_round_tyres(bicycle: Bicycle) -> bool:
    """Tell whether the tyres of a bicycle are round: whether a rider's load matters.

    Parameters
    ----------
    bicycle : Bicycle
    """
    return bicycle.rear_tyre_radius is not None or bicycle.front_tyre_radius is not None


def load_of_rider(posture: Posture) -> tuple[Number, Number]:
    """Return a seated rider's mass in kg and its first moment about the rear contact along x in kg m, (...) each.

    Parameters
    ----------
    posture : Posture
    """
    segments = posture.segments.values()
    return sum(part.mass for part in segments), sum(part.mass * part.centre[..., 0] for part in segments)


def _loads(bicycle: Bicycle, rider_load: tuple[Number, Number] | None) -> tuple[Number, Number]:
    """Return the masses that rest on the front and on the rear wheel, kg, (...)."""
    own = bicycle_bodies(bicycle).values()
    mass = sum(body.mass for body in own)
    moment = sum(body.mass * body.x for body in own)
    if rider_load is not None:
        mass, moment = mass + rider_load[0], moment + rider_load[1]
    front = moment / bicycle.wheel_base
    return front, mass - front
