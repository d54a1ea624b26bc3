"""A rider who adapts: the forward lean with which the hands reach the grips at a wanted elbow angle."""

from __future__ import annotations

from math import pi
from typing import TYPE_CHECKING, Any

import numpy as np

from singletrack.arrays import Array, Fault, Number, as_arrays, is_concrete, refuse_single, vector
from singletrack.body.skeleton import frame_points, require_geometry, skeleton
from singletrack.errors import InputError, PostureError

if TYPE_CHECKING:
    from singletrack.parameters import Bicycle, Rider

__all__ = ["elbow_angle", "fit", "fitted"]

# The lean angle lies between 0 and 90 deg by more than this (rad).
_LEAST = 1e-3


def fit(bicycle: Bicycle, rider: Rider, elbow: Number = 150 * pi / 180) -> Rider:
    """Return a rider with the forward lean angle at which the hands reach the grips with a wanted elbow angle.

    Parameters
    ----------
    bicycle : Bicycle
        With frame geometry.
    rider : Rider
        Any forward lean angle that he has is replaced.
    elbow : array, shape (...)
        Angle between upper and lower arm in rad; pi: stretched.

    Returns
    -------
    Rider
        The elbow angle follows from the lean. Designs of a batch that cannot be fitted have a lean angle of NaN.

    Raises
    ------
    InputError
        For a bicycle without frame geometry, an elbow angle that is none.
    PostureError
        If the hands of a single design cannot reach so at any lean between 0 and 90 deg; says by how much.

    Examples
    --------
    A bar further forward bends the rider forward:

    >>> from math import degrees, radians
    >>> from singletrack import load_bicycle, load_rider
    >>> bicycle, rider = load_bicycle("stratos"), load_rider("rider-a")
    >>> further = bicycle.replace(handlebar_length=-0.15)
    >>> [round(degrees(fit(each, rider, radians(168)).forward_lean_angle), 1) for each in (bicycle, further)]
    [63.9, 58.6]
    """
    found, faults = fitted(bicycle, rider, elbow)
    if not faults:
        return found
    bad = np.zeros(found.shape, dtype=bool)
    for fault in faults:
        bad = bad | np.asarray(fault.bad)
    return found.replace(forward_lean_angle=np.where(bad, np.nan, found.forward_lean_angle))


def elbow_angle(bicycle: Bicycle, rider: Rider) -> Array:
    """Return the angle (...) in rad between upper and lower arm of a rider on a bicycle.

    Parameters
    ----------
    bicycle : Bicycle
    rider : Rider

    Examples
    --------
    >>> from math import degrees
    >>> from singletrack import load_bicycle, load_rider
    >>> round(degrees(elbow_angle(load_bicycle("stratos"), load_rider("rider-a"))), 1)
    168.0
    """
    points = skeleton(bicycle, rider)
    xp, (across, upper, lower) = as_arrays(points[19] - points[21], rider.upper_arm_length, rider.lower_arm_length)
    square = xp.sum(across**2, axis=-1)
    return xp.acos((upper**2 + lower**2 - square) / (2 * upper * lower))


def fitted(bicycle: Bicycle, rider: Rider, elbow: Number) -> tuple[Rider, tuple[Fault, ...]]:
    """Return the rider of :func:`fit`, with the faults of designs of a batch that cannot be fitted.

    Their lean is that which comes nearest.

    Parameters
    ----------
    bicycle : Bicycle
    rider : Rider
    elbow : array, shape (...)
        In rad.
    """
    require_geometry(bicycle)
    hip, shoulders, grip = _places(bicycle, rider)
    if is_concrete(elbow) and np.asarray(elbow).dtype.kind not in "iufc":  # True is no angle either
        raise InputError(f"elbow angle: found {elbow!r}, must be a number in rad (pi: stretched)")
    xp, (across, elbow, length) = as_arrays(grip - hip - shoulders, elbow, rider.torso_length)
    if is_concrete(elbow) and not bool(xp.all((xp.real(elbow) > 0) & (xp.real(elbow) <= pi))):
        raise InputError(f"elbow angle: found {elbow} rad, must be more than 0 and at most pi (180 deg: stretched)")
    _, (upper, lower) = as_arrays(rider.upper_arm_length, rider.lower_arm_length)
    reach = xp.sqrt(upper**2 + lower**2 - 2 * upper * lower * xp.cos(elbow))
    ahead, up = across[..., 0], -across[..., 2]
    far = xp.sqrt(ahead**2 + up**2)
    # |across - torso|² = reach², with the torso at the lean angle: a cosine of the angle to the line hip-grips.
    share = (xp.sum(across**2, axis=-1) + length**2 - reach**2) / (2 * length * far)
    inside = xp.where(xp.abs(share) < 1, share, 0.0 * share)
    towards = _angle(xp, up, ahead)
    lean = towards + xp.acos(inside)
    possible = (xp.real(share) < 1) & (xp.real(share) > -1) & (xp.real(lean) > 0) & (xp.real(lean) < pi / 2)
    if not is_concrete(lean):
        return rider.replace(forward_lean_angle=lean), ()
    best = xp.where(xp.real(share) >= 1, xp.real(towards), xp.where(xp.real(share) <= -1, pi / 2, xp.real(lean)))
    nearest = xp.clip(best, _LEAST, pi / 2 - _LEAST)
    faults = refuse_single(_faults(possible, nearest, across, length, reach, elbow), rider.name)
    return rider.replace(forward_lean_angle=xp.where(possible, lean, nearest + 0.0 * lean)), faults


def _places(bicycle: Bicycle, rider: Rider) -> tuple[Array, Array, Array]:
    """Return hip centre, right shoulder from the shoulder centre, and right grip, (..., 3) each."""
    points = frame_points(bicycle)
    half = rider.shoulder_to_shoulder / 2
    width = half if bicycle.handlebar_width is None else bicycle.handlebar_width / 2
    return points[13], vector(0.0, half, 0.0), points[19] + vector(0.0, width, 0.0)


def _angle(xp: Any, up: Array, ahead: Array) -> Array:
    """Return atan2(up, ahead), also of complex steps."""
    if up.dtype.kind != "c" and ahead.dtype.kind != "c":
        return xp.atan2(up, ahead)
    angle = xp.atan2(xp.real(up), xp.real(ahead))
    turned = xp.real(ahead) * xp.imag(up) - xp.real(up) * xp.imag(ahead)
    return angle + 1j * turned / (xp.real(up) ** 2 + xp.real(ahead) ** 2)


def _faults(possible: Array, lean: Array, across: Array, length: Array, reach: Array, elbow: Array) -> list[Fault]:
    torso = np.stack(np.broadcast_arrays(np.cos(lean), 0.0 * lean, -np.sin(lean)), axis=-1) * np.real(length)[..., None]
    distance = np.linalg.norm(np.real(across) - torso, axis=-1)
    found = {
        "elbow": np.degrees(np.real(elbow)),
        "lean": np.degrees(lean),
        "distance": distance,
        "reach": np.real(reach),
        "off": np.abs(distance - np.real(reach)),
    }
    text = (
        "the hands cannot reach the grips with an elbow angle of {elbow:.4g} deg: at the forward lean that comes "
        "nearest, {lean:.3g} deg, the grips are {distance:.4f} m from the shoulders and the arms span {reach:.4f} m: "
        "{off:.4f} m "
    )
    far = distance > np.real(reach)
    return [
        Fault(~np.asarray(possible) & far, text + "too far", found, PostureError),
        Fault(~np.asarray(possible) & ~far, text + "too near", found, PostureError),
    ]
