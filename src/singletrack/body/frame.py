"""The points of a bicycle's frame, wheels and handlebar, from lengths and angles that a person can measure."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from singletrack.arrays import Array, as_arrays, is_concrete, namespace, vector
from singletrack.arrays.faults import Fault
from singletrack.errors import InputError

if TYPE_CHECKING:
    from singletrack.parameters import Bicycle

__all__ = ["frame_faults", "frame_points", "other_leg", "require_geometry"]


def require_geometry(bicycle: Bicycle) -> None:
    """Raise InputError if a bicycle has no frame geometry, with the names that are missing."""
    missing = bicycle.missing_geometry()
    if missing:
        raise InputError(
            f"{bicycle.name or 'bicycle'}: cannot seat a rider without frame geometry; missing: {', '.join(missing)}",
            parameters=missing,
        )


def frame_points(bicycle: Bicycle) -> dict[int, Array]:
    """Return points 1 to 12 and 16: wheels, frame, stem top.

    By number, each of shape (..., 3), in m, in the bicycle's frame.

    Parameters
    ----------
    bicycle : Bicycle
        With its frame geometry.
    """
    values = {name: value for name, value in bicycle.values().items() if "mass" not in name and "inertia" not in name}
    xp, arrays = as_arrays(*values.values())
    b: dict[str, Any] = dict(zip(values, arrays, strict=True))
    rear, front = b["rear_wheel_radius"], b["front_wheel_radius"]
    sin, cos = xp.sin(b["steer_axis_tilt"]), xp.cos(b["steer_axis_tilt"])
    seat_cos, seat_sin = xp.cos(b["seat_tube_angle"]), xp.sin(b["seat_tube_angle"])

    p: dict[int, Array] = {1: vector(0.0, 0.0, 0.0), 2: vector(0.0, 0.0, -rear)}
    p[3], p[4] = (p[2] + vector(0.0, side * b["rear_hub_width"] / 2, 0.0) for side in (1, -1))
    drop = rear - b["bottom_bracket_height"]
    p[5] = vector(other_leg(xp, b["chain_stay_length"], drop), 0.0, -b["bottom_bracket_height"])
    p[6] = vector(b["wheel_base"], 0.0, 0.0)
    p[7] = p[6] + vector(0.0, 0.0, -front)
    p[8], p[9] = (p[7] + vector(0.0, side * b["front_hub_width"] / 2, 0.0) for side in (1, -1))
    up_seat_tube = vector(-seat_cos, 0.0, -seat_sin)
    p[10] = p[5] + b["seat_tube_length"][..., None] * up_seat_tube
    # The head tube angle is 90 deg minus the steer axis tilt: its cosine is the tilt's sine.
    offset = front * sin - b["trail"] * cos
    along = other_leg(xp, b["fork_length"], offset)
    p[11] = p[7] + vector(-offset * cos - along * sin, 0.0, offset * sin - along * cos)
    p[12] = vector(p[11][..., 0] - (p[11][..., 2] - p[10][..., 2]) * sin / cos, 0.0, p[10][..., 2])
    p[13] = p[10] + b["seat_post_length"][..., None] * up_seat_tube
    p[16] = p[12] + vector(-b["stem_length"] * sin, 0.0, -b["stem_length"] * cos)
    # Still in the middle: how far apart the grips are may be the rider's matter.
    p[19] = p[16] + vector(-b["handlebar_length"], 0.0, b.get("handlebar_drop", 0.0))
    return p


def frame_faults(frame: dict[int, Array], bicycle: Bicycle) -> list[Fault]:
    """Return faults of frame geometry: tubes too short to span their distance.

    Parameters
    ----------
    frame : dict of int to array, shape (..., 3)
        As :func:`frame_points` makes them.
    bicycle : Bicycle
    """
    xp = namespace(frame[5], frame[11])
    drop = bicycle.rear_wheel_radius - bicycle.bottom_bracket_height
    return [
        Fault(
            xp.isnan(frame[5][..., 0]),
            "chain_stay_length = {chain_stay_length:.4f} m does not span the height {drop:.4f} m "
            "between rear hub and bottom bracket, must be more",
            {"chain_stay_length": bicycle.chain_stay_length, "drop": abs(drop)},
            InputError,
            ("chain_stay_length",),
            "more than the height between rear hub and bottom bracket",
        ),
        Fault(
            xp.isnan(frame[11][..., 0]),
            "fork_length = {fork_length:.4f} m is less than the offset of the front hub from the steer "
            "axis, must be more",
            {"fork_length": bicycle.fork_length},
            InputError,
            ("fork_length",),
            "more than the offset of the front hub from the steer axis",
        ),
    ]


def other_leg(xp: Any, hypotenuse: Array, leg: Array) -> Array:
    """Return the other leg of a right triangle, NaN where there is none.

    Parameters
    ----------
    xp : namespace
        Of the arrays.
    hypotenuse, leg : array, shape (...)
        In m.
    """
    square = hypotenuse**2 - leg**2
    return xp.sqrt(xp.where(xp.real(square) < 0, xp.nan, square) if is_concrete(square) else square)
