"""All that follows from a bicycle or a rider, as data: derived quantities, results with deviations."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

import numpy as np

from singletrack.analysis.uncertainty import linear_uncertainty
from singletrack.linear import CriticalSpeeds, critical_speeds
from singletrack.mechanics.rigid import PlanarBody, combine, principal_in_plane
from singletrack.model import LinearModel
from singletrack.parameters import Bicycle, Rider
from singletrack.parameters.bodies import bicycle_bodies

if TYPE_CHECKING:
    from collections.abc import Iterator

    from singletrack.measuring.measurement import Measurement
    from singletrack.posture import Options

__all__ = ["Quantity", "Results", "derived", "measured_speeds", "results"]


@dataclass(frozen=True)
class Quantity:
    """A quantity that follows from parameters: one number, or several that belong together.

    Attributes
    ----------
    group, name : str
        Heading, and name under it.
    values : tuple of float
        SI, radians.
    unit : str
        As pint writes it, e.g. "kg*m**2".
    meaning : str
    """

    group: str
    name: str
    values: tuple[float, ...]
    unit: str
    meaning: str = ""


def derived(record: Bicycle | Rider) -> tuple[Quantity, ...]:
    """Return what follows from a record's parameters alone.

    Parameters
    ----------
    record : Bicycle or Rider
        A single design.

    Examples
    --------
    >>> from singletrack import load_bicycle
    >>> [quantity.values for quantity in derived(load_bicycle("benchmark")) if quantity.name == "total mass"]
    [(94.0,)]
    """
    return tuple(_of_rider(record) if isinstance(record, Rider) else _of_bicycle(record))


def _of_bicycle(b: Bicycle) -> Iterator[Quantity]:
    tilt, trail = float(b.steer_axis_tilt), float(b.trail)
    offset = float(b.front_wheel_radius) * np.sin(tilt) - trail * np.cos(tilt)
    geometry = "derived geometry"
    yield Quantity(geometry, "head angle", (np.pi / 2 - tilt,), "rad", "steer axis from the ground")
    yield Quantity(geometry, "fork offset", (float(offset),), "m", "front hub ahead of the steer axis")
    yield Quantity(geometry, "mechanical trail", (trail * float(np.cos(tilt)),), "m", "normal to the steer axis")
    bodies = bicycle_bodies(b)
    together = PlanarBody.of(combine([body.body() for body in bodies.values()]))
    mass, x, height = float(together.mass), float(together.x), -float(together.z)
    weight = mass * float(b.gravity)
    front = weight * x / float(b.wheel_base)
    whole = "whole bicycle"
    yield Quantity(whole, "total mass", (mass,), "kg")
    yield Quantity(whole, "centre of mass", (x, height), "m", "ahead of rear contact, up")
    yield Quantity(whole, "load on wheels", (weight - front, front), "N", "rear, front")
    for name in ("rear frame", "front frame"):
        larger, smaller, angle = principal_in_plane(bodies[name].xx, bodies[name].zz, bodies[name].xz)
        moments = "principal moments"
        yield Quantity(moments, name, (float(larger), float(smaller)), "kg*m**2", "in the x-z plane")
        yield Quantity(moments, f"{name} axis", (float(angle),), "rad", "of the larger one, from x upwards")


def _of_rider(r: Rider) -> Iterator[Quantity]:
    group = "segments"
    yield Quantity(group, "torso", tuple(float(size) for size in r.torso_section), "m", "wide, thick")
    for name in ("head", "torso", "upper_arm", "lower_arm", "upper_leg", "lower_leg"):
        mass = float(getattr(r, f"{name}_mass_fraction")) * float(r.rider_mass)
        yield Quantity(group, f"{name.replace('_', ' ')} mass", (mass,), "kg", "one side" if "_" in name else "")
    for bicycle, angle in r.forward_lean_angles.items():
        yield Quantity(group, f"lean on {bicycle}", (float(angle),), "rad", "torso from the horizontal")


@dataclass(frozen=True, eq=False)
class Results:
    """A single design's model and critical speeds, with standard deviations where its parameters have any.

    Attributes
    ----------
    model : LinearModel
    critical : CriticalSpeeds
    matrix_deviations : mapping of str to array, shape (n, n)
        Standard deviations of the matrices' entries, by matrix; empty without.
    speed_deviations : mapping of str to sequence of float
        Of all weave and capsize speeds, by mode; empty without.
    """

    model: LinearModel
    critical: CriticalSpeeds
    matrix_deviations: Mapping[str, np.ndarray] = field(default_factory=dict)
    speed_deviations: Mapping[str, Sequence[float]] = field(default_factory=dict)


def results(model: LinearModel, bicycle: Bicycle, rider: Rider | None, options: Options | str) -> Results:
    """Return the results of a model, and their standard deviations if parameters of its makers have any.

    Parameters
    ----------
    model : LinearModel
        Of a single design.
    bicycle, rider, options
        What it was made from.

    Raises
    ------
    SingletrackError
        If the design cannot be varied as its standard deviations say.
    """
    critical = critical_speeds(model)
    if not any(record is not None and record.standard_deviations for record in (bicycle, rider)):
        return Results(model, critical)
    spread = linear_uncertainty(bicycle, rider, options)
    found = spread.critical_speeds()
    deviations = {"weave": found.weave_deviation.tolist(), "capsize": found.capsize_deviation.tolist()}
    return Results(model, critical, spread.matrices(), deviations)


def measured_speeds(found: Measurement) -> Results:
    """Return model and critical speeds of a measured bicycle, with deviations from the measurement's covariance.

    Parameters
    ----------
    found : Measurement

    Raises
    ------
    SingletrackError
        If the bicycle cannot be varied as the covariance says.
    """
    spread = linear_uncertainty(found.bicycle, covariance=(found.names, found.covariance))
    speeds = spread.critical_speeds()
    deviations = {"weave": speeds.weave_deviation.tolist(), "capsize": speeds.capsize_deviation.tolist()}
    return Results(spread.model, critical_speeds(spread.model), spread.matrices(), deviations)
