"""Rigid bodies symmetric about the x-z plane, lumped together: a rigid rider on a rear frame."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Sequence

    from singletrack.parameters.bicycle import Bicycle

__all__ = ["PlanarBody", "combine_planar", "with_rigid_rider"]


@dataclass(frozen=True)
class PlanarBody:
    """A rigid body symmetric about the x-z plane, SI, in the bicycle's frame (x forward, z down).

    Attributes
    ----------
    mass : float
        In kg.
    x, z : float
        Centre of mass in m.
    xx, yy, zz, xz : float
        Entries of the inertia tensor about the centre of mass in kg m^2.
    """

    mass: float
    x: float
    z: float
    xx: float
    yy: float
    zz: float
    xz: float


def combine_planar(bodies: Sequence[PlanarBody]) -> PlanarBody:
    """Return several bodies as one.

    >>> halves = [PlanarBody(1.0, x, 0.0, 0.0, 0.0, 0.0, 0.0) for x in (-1.0, 1.0)]
    >>> combine_planar(halves)
    PlanarBody(mass=2.0, x=0.0, z=0.0, xx=0.0, yy=2.0, zz=2.0, xz=0.0)
    """
    mass = sum(body.mass for body in bodies)
    x = sum(body.mass * body.x for body in bodies) / mass
    z = sum(body.mass * body.z for body in bodies) / mass
    arms = [(body, body.x - x, body.z - z) for body in bodies]
    return PlanarBody(
        mass=mass,
        x=x,
        z=z,
        xx=sum(body.xx + body.mass * dz * dz for body, _, dz in arms),
        yy=sum(body.yy + body.mass * (dx * dx + dz * dz) for body, dx, dz in arms),
        zz=sum(body.zz + body.mass * dx * dx for body, dx, _ in arms),
        xz=sum(body.xz - body.mass * dx * dz for body, dx, dz in arms),
    )


def with_rigid_rider(bicycle: Bicycle, rider: PlanarBody) -> Bicycle:
    """Return a bicycle with a rigid rider lumped into its rear frame (a rider given as one body, hands free)."""
    parts = {"mass": "mass", "x": "x", "z": "z"} | {f"inertia_{axes}": axes for axes in ("xx", "yy", "zz", "xz")}
    frame = PlanarBody(**{own: getattr(bicycle, f"rear_frame_{part}") for part, own in parts.items()})
    both = combine_planar([frame, rider])
    changes = {f"rear_frame_{part}": getattr(both, own) for part, own in parts.items()}
    # The frame's standard deviations are not those of frame and rider.
    kept = {name: sd for name, sd in bicycle.standard_deviations.items() if name not in changes}
    return bicycle.replace(**changes, standard_deviations=kept)
