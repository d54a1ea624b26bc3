"""How the mass of a rider's segment is spread along and about its axis, where it is known better than by a cylinder."""

from __future__ import annotations

import math
from dataclasses import dataclass, fields

from singletrack.errors import InputError, unknown_name
from singletrack.parameters.units import parse_quantity

__all__ = ["SEGMENTS", "SegmentShape", "segment_shape"]

#: Segments of a rider; arms and legs are alike on both sides.
SEGMENTS = ("head", "torso", "upper_arm", "lower_arm", "upper_leg", "lower_leg")


@dataclass(frozen=True)
class SegmentShape:
    """A segment's centre of mass and radii of gyration, as fractions of its length.

    The length is that of the record (``torso_length``, ``upper_arm_length``, ...; for the head its radius,
    ``head_circumference / 2 pi``), so that shapes scale with the rider.

    Attributes
    ----------
    centre : float
        From the inner joint (hip, shoulder, elbow, knee; for the head the shoulder) along the axis.
    gyration_along, gyration_sideways, gyration_across : float
        About the segment's axis, about the bicycle's y, about the normal to both, through the centre of mass.

    Raises
    ------
    InputError
        If a number is not finite, a radius is not positive, or no body can have such radii.
    """

    centre: float
    gyration_along: float
    gyration_sideways: float
    gyration_across: float

    def __post_init__(self) -> None:
        radii = (self.gyration_along, self.gyration_sideways, self.gyration_across)
        if not all(map(math.isfinite, (self.centre, *radii))) or min(radii) <= 0 or max(radii) > 100:
            raise InputError(f"centre and radii {self.centre, *radii} must be finite, and the radii greater than zero")
        squares = sorted(radius**2 for radius in radii)
        if squares[2] > (squares[0] + squares[1]) * (1 + 1e-9):
            raise InputError(f"radii of gyration {radii} are no body's: no square may exceed the sum of the other two")


def segment_shape(name: str, values: object) -> SegmentShape:
    """Return the shape that a file gives for a segment.

    Parameters
    ----------
    name : str
        Of the segment, for messages.
    values : mapping
        What the file says: centre and radii of gyration as fractions of the segment's length.

    Examples
    --------
    >>> segment_shape("torso", {"centre": 0.4, "gyration_along": 0.2, "gyration_sideways": 0.3, "gyration_across": 0.3})
    SegmentShape(centre=0.4, gyration_along=0.2, gyration_sideways=0.3, gyration_across=0.3)
    """
    if name not in SEGMENTS:
        raise InputError(unknown_name("segment", name, SEGMENTS))
    wanted = [field.name for field in fields(SegmentShape)]
    if not isinstance(values, dict):
        raise InputError(f"segments.{name} must be a table with {', '.join(wanted)}")
    for found in values:
        if found not in wanted:
            raise InputError(f"segments.{name}: {unknown_name('entry', found, wanted)}")
    missing = [field for field in wanted if field not in values]
    if missing:
        raise InputError(f"segments.{name} lacks {', '.join(missing)}")
    try:
        return SegmentShape(**{field: parse_quantity(values[field], "").value for field in wanted})
    except InputError as error:
        reason = f"segments.{name}: {error.reason}"
        raise InputError(reason, parameters=(f"segments.{name}",), found=error.found, allowed=error.allowed) from None
