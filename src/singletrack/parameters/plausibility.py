"""What looks odd about a record and why: allowed, but seldom meant."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

from singletrack.errors import InputError
from singletrack.parameters.rider import MASS_FRACTIONS, Rider

if TYPE_CHECKING:
    from collections.abc import Iterator

    from singletrack.parameters.bicycle import Bicycle
    from singletrack.parameters.record import Record

__all__ = ["Oddity", "oddities"]

# Ranges that hold every bicycle and rider we know of, from children's to cargo and tandem.
_USUAL = {
    "wheel_base": (0.5, 3.0),
    "rear_wheel_radius": (0.1, 0.5),
    "front_wheel_radius": (0.1, 0.5),
    "rear_wheel_mass": (0.3, 30.0),
    "front_wheel_mass": (0.3, 30.0),
    "rear_frame_mass": (1.0, 300.0),
    "front_frame_mass": (0.3, 50.0),
    "gravity": (9.76, 9.84),
    "bottom_bracket_height": (0.1, 0.6),
    "chain_stay_length": (0.25, 0.8),
    "fork_length": (0.2, 0.8),
    "seat_tube_length": (0.1, 0.9),
    "seat_post_length": (0.01, 0.7),
    "rider_mass": (10.0, 250.0),
    "torso_length": (0.2, 0.8),
    "upper_arm_length": (0.12, 0.5),
    "lower_arm_length": (0.12, 0.5),
    "upper_leg_length": (0.2, 0.7),
    "lower_leg_length": (0.2, 0.7),
    "head_circumference": (0.4, 0.75),
    "chest_circumference": (0.5, 1.8),
    "shoulder_to_shoulder": (0.2, 0.7),
}
_SMALLEST_ANGLE = math.radians(2.0)
_FRACTION_TOLERANCE = 0.005


@dataclass(frozen=True)
class Oddity:
    """Something odd: the parameter, and one sentence on what was found and what it might be."""

    parameter: str
    text: str

    def __str__(self) -> str:
        return self.text


def oddities(record: Record, rider: Rider | None = None) -> tuple[Oddity, ...]:
    """Return what looks odd about a bicycle or a rider, or about a rider on a bicycle.

    Parameters
    ----------
    record : Bicycle or Rider
        A single design.
    rider : Rider, optional
        Seated on the bicycle.

    Examples
    --------
    >>> from singletrack import load_bicycle
    >>> oddities(load_bicycle("stratos"))
    ()
    >>> print(oddities(load_bicycle("stratos").replace(trail=-0.05))[0])
    trail = -0.05 m is negative: the front wheel touches the ground ahead of the steer axis
    """
    for each in (record, rider):
        if each is not None and each.shape != ():
            raise InputError(f"{each.name or each.kind}: is a batch of shape {each.shape}, must be a single design")
    found = [*_ranges(record), *_angles(record), *_deviations(record)]
    if isinstance(record, Rider):
        found += _fractions(record)
    else:
        found += _masses(record)  # type: ignore[arg-type]  # the only other record is a bicycle
    if rider is not None:
        found += oddities(rider)
    return tuple(found)


def _ranges(record: Record) -> Iterator[Oddity]:
    values = record.values()
    for name, (low, high) in _USUAL.items():
        if name in values and not low <= float(values[name]) <= high:
            unit = record.descriptions()[name].unit.replace("**", "^")
            text = f"{name} = {values[name]:g} {unit} is outside what is usual, {low:g} to {high:g} {unit}"
            ratio = float(values[name]) / high
            hint = "; millimetres written as metres?" if unit == "m" and 100 < ratio < 10_000 else ""
            yield Oddity(name, text + hint)
    if "trail" in values and values["trail"] < 0:
        text = f"trail = {values['trail']:g} m is negative: the front wheel touches the ground ahead of the steer axis"
        yield Oddity("trail", text)
    elif "trail" in values and values["trail"] > 0.3:
        yield Oddity("trail", f"trail = {values['trail']:g} m is outside what is usual, 0 to 0.3 m")


def _angles(record: Record) -> Iterator[Oddity]:
    for name, description in record.descriptions().items():
        value = getattr(record, name)
        if description.unit != "rad" or value is None:
            continue
        degrees = math.degrees(value)
        if value < 0:
            yield Oddity(name, f"{name} = {degrees:g} deg is negative: the steer axis leans forward, top ahead")
        elif 0 < value < _SMALLEST_ANGLE:
            text = f"{name} = {degrees:g} deg is hardly an angle: {degrees:g} radians ({math.degrees(degrees):.3g} deg)"
            yield Oddity(name, f"{text} written as degrees?")
        elif name == "steer_axis_tilt" and degrees > 45:
            text = f"{name} = {degrees:g} deg is more than 45 deg: is it the head angle? The tilt is from the vertical"
            yield Oddity(name, text)


def _deviations(record: Record) -> Iterator[Oddity]:
    values = record.values()
    for name, deviation in record.standard_deviations.items():
        if name in values and deviation > 0.5 * abs(float(values[name])) > 0:
            text = f"{name} = {values[name]:g} has a standard deviation of {deviation:g}, more than half of it"
            yield Oddity(name, text)


def _masses(b: Bicycle) -> Iterator[Oddity]:
    masses = [float(getattr(b, f"{body}_mass")) for body in ("rear_wheel", "rear_frame", "front_frame", "front_wheel")]
    places = [0.0, float(b.rear_frame_x), float(b.front_frame_x), float(b.wheel_base)]
    centre = sum(m * x for m, x in zip(masses, places, strict=True)) / sum(masses)
    if centre < 0:
        text = f"rear_frame_x = {b.rear_frame_x:g} m puts the bicycle's centre of mass {-centre:.3g} m behind the rear"
        yield Oddity("rear_frame_x", f"{text} contact: it would tip over backwards")
    elif b.rear_frame_x < 0:
        text = f"rear_frame_x = {b.rear_frame_x:g} m: the rear frame's centre of mass is behind the rear contact"
        yield Oddity("rear_frame_x", text)
    if centre > b.wheel_base:
        text = f"the bicycle's centre of mass is {centre - b.wheel_base:.3g} m ahead of the front contact"
        yield Oddity("rear_frame_x", f"{text}: it would tip over forwards")
    for end in ("rear", "front"):
        mass, radius = getattr(b, f"{end}_wheel_mass"), getattr(b, f"{end}_wheel_radius")
        inertia = getattr(b, f"{end}_wheel_inertia_yy")
        if inertia > mass * radius**2:
            text = f"{end}_wheel_inertia_yy = {inertia:g} kg*m^2 is more than that of all mass at the tread"
            yield Oddity(f"{end}_wheel_inertia_yy", f"{text}, {mass * radius**2:.3g} kg*m^2")


def _fractions(rider: Rider) -> Iterator[Oddity]:
    total = sum(count * float(getattr(rider, name)) for name, count in MASS_FRACTIONS.items())
    if abs(total - 1) > _FRACTION_TOLERANCE:
        text = f"the mass fractions of all segments sum to {total:.4g}, not to 1: the segments weigh"
        yield Oddity("head_mass_fraction", f"{text} {total * rider.rider_mass:.4g} kg of {rider.rider_mass:g} kg")
