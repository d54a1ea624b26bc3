"""Geometry of a measured bicycle: wheels, steer axis, handlebar, seat. Kernels; complex steps pass through."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Mapping

__all__ = ["HEIGHTS", "HUB_TO_HANDLEBAR", "handlebar_reference", "seat_geometry", "steer_geometry", "wheel_radius"]

#: Heights above a table and diameters, from which the steer axis follows where no wheel base was measured.
HEIGHTS = ("h1", "h2", "h3", "h4", "h5", "d1", "d2", "d3", "d4", "d")
#: The same for the place of a handlebar that was taken off its fork.
HUB_TO_HANDLEBAR = ("h6", "h7", "d5", "d6", "l")


def wheel_radius(m: Mapping[str, np.ndarray], wheel: str) -> np.ndarray:
    """Return the radius (k,) in m of wheel "R" or "F", from the distance it rolls; ``m`` are measurements (k,)."""
    return m[f"d{wheel}"] / (2 * math.pi * m[f"n{wheel}"])


def steer_geometry(
    m: Mapping[str, np.ndarray], rear: np.ndarray, front: np.ndarray
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return wheel base in m, steer axis tilt in rad and trail in m, each of shape (k,).

    Parameters
    ----------
    m : mapping of str to array, shape (k,)
        With ``w, gamma, f``; or, where there is no ``w``, with :data:`HEIGHTS`.
    rear, front : array, shape (k,)
        Radii of the wheels in m.

    Notes
    -----
    Without ``w``: the frame stands with its steer axis upright, the hubs at distances a behind and b ahead of it and c
    apart along it. Turned by the tilt, (a + b) sin(tilt) - c cos(tilt) is the difference of the radii. ``d`` is
    measured with the fork reversed, so that c follows from a - b (Moore 2012, chapter 3).
    """
    if "w" in m:
        tilt = math.pi / 2 - m["gamma"] * (math.pi / 180)
        base, offset = m["w"], m["f"]
    else:
        behind = m["h1"] + m["h2"] - m["h3"] + m["d1"] / 2 - m["d2"] / 2
        offset = m["h4"] - m["d3"] / 2 - m["h5"] + m["d4"] / 2
        apart = _root((m["d"] + (m["d2"] + m["d3"]) / 2) ** 2 - (behind - offset) ** 2)
        across = behind + offset
        sine = (front - rear) / np.sqrt(across**2 + apart**2)
        tilt = np.where(abs(sine.real) < 1, np.arcsin(sine), np.nan) + np.arctan(apart / across)
        base = across * np.cos(tilt) + apart * np.sin(tilt)
    return base, tilt, (front * np.sin(tilt) - offset) / np.cos(tilt)


def handlebar_reference(m: Mapping[str, np.ndarray], tilt: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return the handlebar's point of reference (x, z), each (k,), relative to the front hub, in m.

    Parameters
    ----------
    m : mapping of str to array, shape (k,)
        With :data:`HUB_TO_HANDLEBAR`, measured with the fork on a table.
    tilt : array, shape (k,)
        Of the steer axis in rad.
    """
    axle, bar = m["d5"] / 2, m["d6"] / 2
    across = m["h7"] - m["h6"] + axle - bar
    along = _root((m["l"] - axle - bar) ** 2 - across**2)
    return across * np.cos(tilt) - along * np.sin(tilt), -across * np.sin(tilt) - along * np.cos(tilt)


def seat_geometry(m: Mapping[str, np.ndarray], p: Mapping[str, Any]) -> dict[str, np.ndarray]:
    """Return the frame geometry that seats a rider, as far as it was measured, by symbol.

    Parameters
    ----------
    m : mapping of str to array, shape (k,)
        Measurements, in the units of :data:`singletrack.measuring.quantities.MEASURED_QUANTITIES`.
    p : mapping of str to array, shape (k,)
        ``w, c, lam, rR, rF`` as they follow from them, SI.
    """
    found = {name: m[name] for name in ("hbb", "lcs", "lsp", "lst", "lamst", "lf", "wfh", "wrh") if name in m}
    if any(name not in m for name in ("whb", "LhbR", "LhbF", "hbb", "lst", "lamst")):
        return found
    # The grip, in the x-z plane, is where two circles about the hubs cross, above the wheels.
    half = m["whb"] / 2
    rear_square, front_square = m["LhbR"] ** 2 - half**2, m["LhbF"] ** 2 - half**2
    dx, dz = p["w"], p["rR"] - p["rF"]
    span = np.sqrt(dx**2 + dz**2)
    along = (span**2 + rear_square - front_square) / (2 * span)
    up = _root(rear_square - along**2)
    x, z = (along * dx + up * dz) / span, -p["rR"] + (along * dz - up * dx) / span
    top = -m["hbb"] - m["lst"] * np.sin(m["lamst"])
    # The steer axis at the height of the seat tube's top, where the stem begins (point 12 of the skeleton).
    axis_x = p["w"] + p["c"] + top * np.tan(p["lam"])
    stem = (top - z) / np.cos(p["lam"])
    found["ls"] = stem
    found["lhb"] = axis_x - stem * np.sin(p["lam"]) - x
    return found


def _root(square: np.ndarray) -> np.ndarray:
    """Return the square root (k,), NaN for what has none: complex steps would make it imaginary."""
    return np.where(square.real >= 0, np.sqrt(square), np.nan)
