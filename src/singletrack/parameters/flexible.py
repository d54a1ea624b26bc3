"""Where a soft frame or fork bends: hinges with a spring, as both derivations of the equations read them."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from singletrack.arrays import Array, Number, as_arrays, vector
from singletrack.parameters.hinge_rules import FORK_BENDING, FRAME_TORSION, HINGE_PARAMETERS

if TYPE_CHECKING:
    from singletrack.parameters.bicycle import Bicycle

__all__ = ["FORK_BENDING", "FRAME_TORSION", "SoftHinge", "soft_hinges"]


@dataclass(frozen=True, eq=False)
class SoftHinge:
    """A hinge in the plane of the bicycle.

    Attributes
    ----------
    name : str
        Of its freedom: ``frame torsion`` lies between the rear frame and the steer axis, ``fork bending`` between the
        front frame and the front wheel.
    point, axis : array, shape (..., 3)
        A point of the axis in m, and its unit vector, forward, in the bicycle's frame.
    stiffness, damping : array, shape (...)
        In N m/rad and N m s/rad.
    """

    name: str
    point: Array
    axis: Array
    stiffness: Number
    damping: Number


def soft_hinges(bicycle: Bicycle) -> tuple[SoftHinge, ...]:
    """Return the hinges of a soft frame and fork, in this order; none where no stiffness is given.

    Parameters
    ----------
    bicycle : Bicycle
        A hinge without a place of its own goes through the steer axis at the fork's crown, a wheel's radius above the
        hub; one without a tilt of its own is perpendicular to the steer axis.

    Examples
    --------
    >>> from singletrack import load_bicycle
    >>> (hinge,) = soft_hinges(load_bicycle("benchmark").replace(fork_bending_stiffness=2e3))
    >>> hinge.name, hinge.point.round(3).tolist(), soft_hinges(load_bicycle("benchmark"))
    ('fork bending', [0.881, 0.0, -0.673], ())
    """
    hinges = []
    for name, (what, where) in HINGE_PARAMETERS.items():
        stiffness = getattr(bicycle, f"{what}_stiffness")
        if stiffness is None:
            continue
        tilt = getattr(bicycle, f"{where}_tilt")
        xp, (angle,) = as_arrays(bicycle.steer_axis_tilt if tilt is None else tilt)
        x, z = getattr(bicycle, f"{where}_x"), getattr(bicycle, f"{where}_z")
        point = _crown(bicycle) if x is None else vector(x, 0.0, z)
        damping = getattr(bicycle, f"{what}_damping")
        axis = vector(xp.cos(angle), 0.0, -xp.sin(angle))
        hinges.append(SoftHinge(name, point, axis, stiffness, 0.0 if damping is None else damping))
    return tuple(hinges)


def _crown(bicycle: Bicycle) -> Array:
    """Return the point of the steer axis that lies a wheel's radius above the point nearest to the front hub."""
    xp, (tilt, trail, radius) = as_arrays(bicycle.steer_axis_tilt, bicycle.trail, bicycle.front_wheel_radius)
    sin, cos = xp.sin(tilt), xp.cos(tilt)
    above = trail * sin + radius * cos + radius
    return vector(bicycle.wheel_base + trail - above * sin, 0.0, -above * cos)
