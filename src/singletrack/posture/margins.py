"""How far a seated rider is from all that would be wrong: what a program without faults of its own is judged by."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

from singletrack.arrays import Number, as_arrays
from singletrack.body.reach import reach
from singletrack.posture.bodies import slaved_mass
from singletrack.posture.inverses import squared_condition
from singletrack.posture.motion import loops_of
from singletrack.posture.residual import loop_residual

if TYPE_CHECKING:
    from singletrack.parameters import Bicycle, Rider
    from singletrack.posture.seated import Posture

__all__ = ["Margins", "margins"]


class Margins(NamedTuple):
    """What tells sound designs from others, each of shape (...).

    Attributes
    ----------
    arm, leg : array
        The distance that the limb spans as a fraction of its length: more than one does not reach.
    residual : array
        Of the loops' equations, in m per rad (:func:`~singletrack.posture.loop_residual`).
    condition : array
        Square of the condition of the loops' equations.
    inertia : array
        That of the free joint as a fraction of the whole rider's about the rear contact; one without free joints.
    """

    arm: Number
    leg: Number
    residual: Number
    condition: Number
    inertia: Number

    @property
    def shares(self) -> dict[str, Number]:
        """How far limbs are stretched, by limb, shape (...) each, as in :func:`singletrack.body.reach.reach`."""
        return {"arm": self.arm, "leg": self.leg}


def margins(posture: Posture, bicycle: Bicycle, rider: Rider) -> Margins:
    """Return how sound a seated rider is; of postures with one free joint at the most.

    Parameters
    ----------
    posture : Posture
    bicycle : Bicycle
    rider : Rider

    Examples
    --------
    >>> from singletrack import load_bicycle, load_rider
    >>> from singletrack.posture import seat
    >>> bicycle, rider = load_bicycle("browser"), load_rider("rider-a")
    >>> found = margins(seat(bicycle, rider, "upright"), bicycle, rider)
    >>> bool(found.arm < 1), bool(found.leg < 1), bool(found.residual < 1e-12), bool(found.condition < 1e3)
    (True, True, True, True)
    """
    shares = reach(posture.skeleton, rider)
    _, (one,) = as_arrays(0.0 * shares["arm"] + 1.0)
    if not posture.joints:
        return Margins(shares["arm"], shares["leg"], 0.0 * one, one, one)
    shape = posture.skeleton.points.shape[:-2]
    condition: Number = one
    inertia: Number = one
    if posture.loops:
        xp, _, loops, (spin, _) = loops_of(posture, bicycle, shape)
        condition = squared_condition(xp, posture, loops, spin).reshape(shape)
    if posture.freedoms:
        mass = slaved_mass(posture, bicycle)
        inertia = mass.inner[-1] / (mass.inertia_xx + mass.inertia_zz)
    return Margins(shares["arm"], shares["leg"], loop_residual(posture, bicycle), condition, inertia)
