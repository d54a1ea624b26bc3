"""Where a soft frame or fork bends: hinges with a spring, as both derivations of the equations read them."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from singletrack.arrays import Array, as_arrays, vector
from singletrack.arrays.faults import Fault
from singletrack.errors import InputError

if TYPE_CHECKING:
    from collections.abc import Iterator

    from singletrack.parameters.bicycle import Bicycle

__all__ = ["FORK_BENDING", "FRAME_TORSION", "SoftHinge", "hinge_faults", "soft_hinges"]

#: Names of the freedoms.
FRAME_TORSION, FORK_BENDING = "frame torsion", "fork bending"
_PARTS = {FRAME_TORSION: ("frame_torsion", "frame_hinge"), FORK_BENDING: ("fork_bending", "fork_hinge")}


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
    stiffness: Array
    damping: Array


def soft_hinges(bicycle: Bicycle) -> tuple[SoftHinge, ...]:
    """Return the hinges of a soft frame and fork, in this order; none where no stiffness is given.

    Parameters
    ----------
    bicycle : Bicycle
        A hinge without a tilt of its own is perpendicular to the steer axis.

    Examples
    --------
    >>> from singletrack import load_bicycle
    >>> soft = load_bicycle("benchmark").replace(fork_bending_stiffness=2e3, fork_hinge_x=1.0, fork_hinge_z=-0.7)
    >>> [hinge.name for hinge in soft_hinges(soft)], soft_hinges(load_bicycle("benchmark"))
    (['fork bending'], ())
    """
    hinges = []
    for name, (what, where) in _PARTS.items():
        stiffness = getattr(bicycle, f"{what}_stiffness")
        if stiffness is None:
            continue
        tilt = getattr(bicycle, f"{where}_tilt")
        xp, (angle,) = as_arrays(bicycle.steer_axis_tilt if tilt is None else tilt)
        point = vector(getattr(bicycle, f"{where}_x"), 0.0, getattr(bicycle, f"{where}_z"))
        damping = getattr(bicycle, f"{what}_damping")
        axis = vector(xp.cos(angle), 0.0, -xp.sin(angle))
        hinges.append(SoftHinge(name, point, axis, stiffness, 0.0 if damping is None else damping))
    return tuple(hinges)


def hinge_faults(bicycle: Bicycle) -> Iterator[Fault]:
    """Yield a fault for each stiffness without a place for its hinge.

    Parameters
    ----------
    bicycle : Bicycle
    """
    for what, where in _PARTS.values():
        for axis in "xz":
            if getattr(bicycle, f"{what}_stiffness") is not None and getattr(bicycle, f"{where}_{axis}") is None:
                import numpy as np

                text = f"{what}_stiffness needs {where}_x and {where}_z, a point of the hinge's axis"
                yield Fault(np.ones((), dtype=bool), text, {}, InputError, (f"{where}_{axis}",), "a finite number in m")
                break
