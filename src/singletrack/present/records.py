"""Everything that follows from a bicycle or a rider, as tables for the terminal."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from singletrack.analysis.uncertainty import linear_uncertainty
from singletrack.closed_form import coefficients
from singletrack.files.toml_write import unit_text
from singletrack.linear import critical_speeds
from singletrack.parameters import Bicycle, Rider

if TYPE_CHECKING:
    from collections.abc import Iterator

    from singletrack.parameters.record import Record
    from singletrack.posture import Options

__all__ = ["Row", "derived", "parameter_rows", "uncertain_results"]


@dataclass(frozen=True)
class Row:
    """A quantity to read: heading, name, value with unit, standard deviation (or ""), meaning."""

    group: str
    name: str
    value: str
    deviation: str
    meaning: str


def _number(value: float, digits: int = 6) -> str:
    return f"{value:.{digits}g}"


def parameter_rows(record: Record) -> Iterator[Row]:
    """Yield the parameters of a record, angles in degrees.

    >>> from singletrack import load_bicycle
    >>> next(parameter_rows(load_bicycle("stratos"))).value
    '1.037 m'
    """
    values = record.values()
    for name, p in record.descriptions().items():
        if name not in values:
            continue
        factor = 180 / math.pi if p.unit == "rad" else 1.0
        deviation = record.standard_deviations.get(name)
        unit = f" {unit_text(p.unit)}" if p.unit else ""
        text = "" if deviation is None else f"± {_number(factor * float(deviation), 2)}"
        yield Row(p.group, name, _number(factor * float(values[name])) + unit, text, p.meaning)


def derived(record: Bicycle | Rider) -> Iterator[Row]:
    """Yield what follows from a record's parameters alone.

    >>> from singletrack import load_bicycle
    >>> [row.value for row in derived(load_bicycle("benchmark")) if row.name == "total mass"]
    ['94 kg']
    """
    if isinstance(record, Rider):
        yield from _derived_rider(record)
    else:
        yield from _derived_bicycle(record)


def _derived_bicycle(b: Bicycle) -> Iterator[Row]:
    tilt = float(b.steer_axis_tilt)
    offset = float(b.front_wheel_radius) * math.sin(tilt) - float(b.trail) * math.cos(tilt)
    masses = np.array([b.rear_wheel_mass, b.rear_frame_mass, b.front_frame_mass, b.front_wheel_mass], dtype=float)
    x = np.array([0.0, b.rear_frame_x, b.front_frame_x, b.wheel_base], dtype=float)
    z = np.array([-b.rear_wheel_radius, b.rear_frame_z, b.front_frame_z, -b.front_wheel_radius], dtype=float)
    total = masses.sum()
    centre_x, centre_z = (masses * x).sum() / total, (masses * z).sum() / total
    front = total * float(b.gravity) * centre_x / float(b.wheel_base)
    geometry = "derived geometry"
    yield Row(geometry, "head angle", f"{_number(90 - math.degrees(tilt))} deg", "", "steer axis from the ground")
    yield Row(geometry, "fork offset", f"{_number(offset)} m", "", "front hub ahead of the steer axis")
    yield Row(
        geometry, "mechanical trail", f"{_number(float(b.trail) * math.cos(tilt))} m", "", "normal to the steer axis"
    )
    whole = "whole bicycle"
    yield Row(whole, "total mass", f"{_number(total)} kg", "", "")
    yield Row(
        whole, "centre of mass", f"{_number(centre_x)} m, {_number(-centre_z)} m", "", "ahead of rear contact, up"
    )
    yield Row(
        whole, "load on wheels", f"{_number(total * float(b.gravity) - front)} N, {_number(front)} N", "", "rear, front"
    )
    for end in ("rear", "front"):
        xx, zz, xz = (float(getattr(b, f"{end}_frame_inertia_{axes}")) for axes in ("xx", "zz", "xz"))
        mean, half = (xx + zz) / 2, math.hypot((xx - zz) / 2, xz)
        angle = math.degrees(math.atan2(-2 * xz, xx - zz) / 2)
        text = f"{_number(mean + half)}, {_number(mean - half)} kg*m^2"
        yield Row("principal moments", f"{end} frame", text, "", f"in the x-z plane; the larger {angle:.1f} deg from x")


def _derived_rider(r: Rider) -> Iterator[Row]:
    group = "segments"
    yield Row(group, "torso", " x ".join(_number(float(size)) for size in r.torso_section) + " m", "", "wide, thick")
    for name in ("head", "torso", "upper_arm", "lower_arm", "upper_leg", "lower_leg"):
        mass = float(getattr(r, f"{name}_mass_fraction")) * float(r.rider_mass)
        yield Row(group, f"{name.replace('_', ' ')} mass", f"{_number(mass)} kg", "", "one side" if "_" in name else "")
    for bicycle, angle in r.forward_lean_angles.items():
        yield Row(group, f"lean on {bicycle}", f"{_number(math.degrees(angle))} deg", "", "torso from the horizontal")


def uncertain_results(bicycle: Bicycle, rider: Rider | None, options: Options) -> dict[str, Any]:
    """Return the matrices, critical speeds and, where parameters have any, their standard deviations.

    Returns
    -------
    dict
        ``matrices`` and ``matrix_deviations``: by name; ``weave``, ``capsize``: lists of (speed, deviation or None);
        ``stable_ranges``.
    """
    model = coefficients(bicycle, rider, options)
    critical = critical_speeds(model)
    found: dict[str, Any] = {
        "matrices": {"M": model.M, "C1": model.C1, "g K0": model.gravity * model.K0, "K2": model.K2},
        "matrix_deviations": {},
        "stable_ranges": critical.stable_ranges,
    }
    known = any(record is not None and record.standard_deviations for record in (bicycle, rider))
    for kind in ("weave", "capsize"):
        found[kind] = [(speed, None) for speed in getattr(critical, kind)]
    if known:
        spread = linear_uncertainty(bicycle, rider, options)
        speeds = spread.critical_speeds()
        for kind in ("weave", "capsize"):
            found[kind] = list(zip(getattr(speeds, kind), getattr(speeds, f"{kind}_deviation"), strict=True))
        found["matrix_deviations"] = spread.matrices()
    return found
