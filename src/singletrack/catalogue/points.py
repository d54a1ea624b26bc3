"""Where the components sit: points of the frame from its geometry."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from singletrack.arrays import vector

if TYPE_CHECKING:
    from collections.abc import Mapping

    from singletrack.catalogue.geometry import Geometry

__all__ = ["points_of"]

#: Share of a telescopic fork's offset that its crown has; the drop-outs have the rest.
_SLID = 0.8


def points_of(geometry: Geometry) -> dict[str, np.ndarray]:
    """Return the points that components hang on, by name, each of shape (n, 3), in m in the bicycle's frame.

    Those off the middle plane are the right ones of two.

    Parameters
    ----------
    geometry : Geometry
    """
    v, xp = geometry.values, geometry.xp
    rear, front, base = v["rear_wheel_radius"], v["front_wheel_radius"], v["wheel_base"]
    tilt, axis = v["steer_axis_tilt"], base + v["trail"]
    sin, cos, slope = xp.sin(tilt), xp.cos(tilt), xp.tan(tilt)
    angle, bracket, height = v["seat_tube_angle"], v["bracket x"], v["bottom_bracket_height"]

    def on_axis(up: np.ndarray, y: float = 0.0) -> np.ndarray:
        return _point(axis - up * slope, up, y)

    def on_seat_tube(length: np.ndarray) -> np.ndarray:
        return _point(bracket - length * xp.cos(angle), height + length * xp.sin(angle))

    tube, post = v["seat_tube_length"], v["seat_post_length"]
    crown = front - v["fork offset"] * sin + v["crown along"] * cos
    # A rear tyre's top and a mudguard's leave some 15 mm of room.
    return {
        "rear contact": _point(0.0 * rear, 0.0 * rear),
        "rear hub": _point(0.0 * rear, rear),
        "rear drop-out": _point(0.0 * rear, rear, v["rear_hub_width"] / 2),
        "rear tyre top": _point(0.0 * rear, 2 * rear + 0.03),
        "bottom bracket": _point(bracket, height),
        "bottom bracket sides": _point(bracket - 0.03, height, 0.03),
        "seat tube top": on_seat_tube(tube),
        "seat stay top": on_seat_tube(tube - 0.02) + np.array([0.0, 0.015, 0.0]),
        "seat tube middle": on_seat_tube(0.55 * tube),
        "seat post end": on_seat_tube(tube - 0.12),
        "saddle clamp": on_seat_tube(tube + post - 0.06),
        "saddle": on_seat_tube(tube + post),
        "head tube top": on_axis(v["head top"]),
        "head tube bottom": on_axis(crown + 0.02),
        "crown": on_axis(crown),
        "crown sides": on_axis(crown, 0.045),
        # What slides is parallel to the steer axis: legs of a telescopic fork are ahead of it up to the crown.
        "crown ahead": on_axis(crown, 0.065) + _SLID * _point(v["fork offset"] * cos, v["fork offset"] * sin),
        "front hub": _point(base, front),
        "front drop-out": _point(base, front, v["front_hub_width"] / 2),
        "front tyre top": on_axis(crown) + np.array([0.05, 0.0, 0.0]),
        "steerer top": on_axis(v["steerer"]),
        "quill end": on_axis(v["steerer"] - 0.13 * cos),
        **_of_handlebar(v),
    }


def _point(x: np.ndarray, up: np.ndarray, y: np.ndarray | float = 0.0) -> np.ndarray:
    return vector(x, y, -up)


def _of_handlebar(v: Mapping[str, np.ndarray]) -> dict[str, np.ndarray]:
    """Return the points of straight, city and drop bars."""
    bar, grip_x, grip = v["bar width"] / 2, v["grip x"], v["grip height"]
    clamp_x, clamp = v["clamp x"], v["clamp height"]
    return {
        "clamp": _point(clamp_x, clamp),
        "bar shoulder": _point(clamp_x + 0.01, clamp, bar - 0.03),
        "bar arm end": _point(grip_x - 0.06, grip, bar - 0.01),
        "bar arm": _point(grip_x, grip, bar - 0.02),
        "bar arm lever": _point(grip_x + 0.09, grip, bar - 0.06),
        "grip": _point(grip_x, grip, bar - 0.06),
        "lever": _point(0.75 * grip_x + 0.25 * clamp_x + 0.03, 0.75 * grip + 0.25 * clamp, bar - 0.12),
        "bar end": _point(grip_x, grip, bar),
    }
