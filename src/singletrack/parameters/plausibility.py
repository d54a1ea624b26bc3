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

__all__ = ["USUAL", "Oddity", "oddities"]

#: Ranges, SI, that hold every bicycle and rider we know of, from children's to cargo and tandem.
USUAL = {
    "wheel_base": (0.5, 3.0),
    "trail": (0.0, 0.3),
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
    "head_mass_fraction": (0.03, 0.25),
    "torso_mass_fraction": (0.3, 0.65),
    "upper_arm_mass_fraction": (0.01, 0.06),
    "lower_arm_mass_fraction": (0.005, 0.05),
    "upper_leg_mass_fraction": (0.05, 0.2),
    "lower_leg_mass_fraction": (0.03, 0.12),
}
_SMALLEST_ANGLE = math.radians(2.0)
_LARGEST_TILT = math.radians(45.0)
_FRACTION_TOLERANCE = 0.005
#: Of slips in the unit: the factor, and what to ask.
_SLIPS = {
    "m": ((1e-3, "millimetres written as metres?"), (1e-2, "centimetres written as metres?")),
    "kg": ((1e-3, "grams written as kilograms?"),),
}


@dataclass(frozen=True)
class Oddity:
    """Something odd.

    Attributes
    ----------
    parameter : str
    text : str
        One sentence on what was found and what it might be.
    found : float
        In SI units.
    expected : str
        What is usual, in words.
    """

    parameter: str
    text: str
    found: float
    expected: str

    def __str__(self) -> str:
        return self.text


def oddities(record: Record, rider: Rider | None = None) -> tuple[Oddity, ...]:
    """Return what looks odd about a bicycle or a rider, or about a bicycle and its rider.

    Parameters
    ----------
    record : Bicycle or Rider
        A single design.
    rider : Rider, optional
        Seated on the bicycle.

    Raises
    ------
    InputError
        If it is a batch.

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
    for name, (low, high) in USUAL.items():
        value = getattr(record, name, None)
        if value is None or low <= value <= high or (value == 0 and "wheel" in name):  # a skate has no wheels
            continue
        unit = record.descriptions()[name].unit.replace("**", "^")
        expected = f"{low:g} to {high:g} {unit}".rstrip()
        found = f"{name} = {value:g} {unit}".rstrip()
        if name == "trail" and value < 0:
            text = f"{found} is negative: the front wheel touches the ground ahead of the steer axis"
        else:
            least = max(low, high / 20)  # a trail of 1.2 m is no slip in the unit: nobody has one of 1.2 mm
            slips = [ask for factor, ask in _SLIPS.get(unit, ()) if value > high and least <= value * factor <= high]
            text = "; ".join([f"{found} is outside what is usual, {expected}", *slips[:1]])
        yield Oddity(name, text, float(value), expected)


def _angles(record: Record) -> Iterator[Oddity]:
    for name in _ANGLES:
        value = getattr(record, name, None)
        if value is None:
            continue
        degrees = math.degrees(value)
        if value < 0:
            text = f"{name} = {degrees:g} deg is negative: the steer axis leans forward, top ahead"
            yield Oddity(name, text, float(value), "0 to 45 deg")
        elif 0 < value < _SMALLEST_ANGLE:
            text = f"{name} = {degrees:g} deg is hardly an angle: {degrees:g} radians ({math.degrees(degrees):.3g} deg)"
            yield Oddity(name, f"{text} written as degrees?", float(value), "more than 2 deg")
        elif name == "steer_axis_tilt" and value > _LARGEST_TILT:
            text = f"{name} = {degrees:g} deg is more than 45 deg: is it the head angle? The tilt is from the vertical"
            yield Oddity(name, f"{text}: 90 deg - head angle", float(value), "less than 45 deg")


_ANGLES = ("steer_axis_tilt", "seat_tube_angle", "forward_lean_angle")


#: Parameters of either sign, for which zero is a value like any other.
_AROUND_ZERO = ("rear_frame_inertia_xz", "front_frame_inertia_xz", "handlebar_length", "handlebar_drop")


def _deviations(record: Record) -> Iterator[Oddity]:
    for name, deviation in record.standard_deviations.items():
        value = getattr(record, name, None)
        if value is not None and name not in _AROUND_ZERO and deviation > 0.5 * abs(float(value)) > 0:
            text = f"{name} = {value:g} has a standard deviation of {deviation:g}, more than half of it"
            yield Oddity(name, text, float(deviation), "a standard deviation of less than half the value")


def _masses(b: Bicycle) -> Iterator[Oddity]:
    masses = [float(getattr(b, f"{body}_mass")) for body in ("rear_wheel", "rear_frame", "front_frame", "front_wheel")]
    places = [0.0, float(b.rear_frame_x), float(b.front_frame_x), float(b.wheel_base)]
    centre = sum(m * x for m, x in zip(masses, places, strict=True)) / sum(masses)
    x, between = float(b.rear_frame_x), "a centre of mass between the wheel contacts"
    if centre < 0:
        text = f"rear_frame_x = {x:g} m puts the bicycle's centre of mass {-centre:.3g} m behind the rear"
        yield Oddity("rear_frame_x", f"{text} contact: it would tip over backwards", x, between)
    elif b.rear_frame_x < 0:
        text = f"rear_frame_x = {x:g} m: the rear frame's centre of mass is behind the rear contact"
        yield Oddity("rear_frame_x", text, x, between)
    if centre > b.wheel_base:
        text = f"the bicycle's centre of mass is {centre - b.wheel_base:.3g} m ahead of the front contact"
        yield Oddity("rear_frame_x", f"{text}: it would tip over forwards", x, between)
    for end in ("rear", "front"):
        mass, radius = getattr(b, f"{end}_wheel_mass"), getattr(b, f"{end}_wheel_radius")
        inertia = float(getattr(b, f"{end}_wheel_inertia_yy"))
        if inertia > mass * radius**2:
            text = f"{end}_wheel_inertia_yy = {inertia:g} kg*m^2 is more than that of all mass at the tread"
            most = f"{mass * radius**2:.3g} kg*m^2"
            yield Oddity(f"{end}_wheel_inertia_yy", f"{text}, {most}", inertia, f"at most {most}")


def _fractions(rider: Rider) -> Iterator[Oddity]:
    total = sum(count * float(getattr(rider, name)) for name, count in MASS_FRACTIONS.items())
    if abs(total - 1) > _FRACTION_TOLERANCE:
        text = f"the mass fractions of all segments sum to {total:.4g}, not to 1: the segments weigh"
        text = f"{text} {total * rider.rider_mass:.4g} kg of {rider.rider_mass:g} kg"
        yield Oddity("head_mass_fraction", text, total, "fractions that sum to 1")
