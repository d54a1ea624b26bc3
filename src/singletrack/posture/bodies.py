"""The rider's mass as it moves with the steer and the free joints: sums over all segments, to second order.

A joint's momentum (p, h) is that of all it carries for its unit rate, about the rear contact: p = M v + w x S and
h = I w + S x v, with the mass M, first moment S and inertia I of the segments beyond it. Everything the equations need
follows from it (docs/theory/closed-form.md, with X as in :mod:`singletrack.posture.twists` and Y the same sum of v):

    momenta along a freedom      sum of  p U_i,  h U_i
    inertia of two freedoms      sum of  (X_i . h + Y_i . p) U_j + (X_j . h + Y_j . p) U_i
    second derivatives of S      sum of  (X_i U_j + X_j U_i) x p + p U_ij
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

import numpy as np

from singletrack.arrays import Array, Number, as_arrays, is_concrete, stack
from singletrack.arrays.faults import Fault, refuse_single
from singletrack.errors import PostureError
from singletrack.posture.laws import laws_of
from singletrack.posture.motion import rider_motion
from singletrack.posture.segment_motion import carried_by_soft_frame
from singletrack.posture.twists import Motion, cross3, designs_last, dot3, summed

if TYPE_CHECKING:
    from singletrack.body import Segment
    from singletrack.parameters import Bicycle
    from singletrack.posture.seated import Posture

__all__ = ["SlavedMass", "slaved_mass"]

#: A free joint whose inertia is less than this share of what its segments have about the rear contact moves no mass.
_STILL = 1e-12


@dataclass(frozen=True, eq=False)
class SlavedMass:
    """Bodies that move relative to the rear frame with f freedoms: the steer angle first, then free joints.

    Moments are about the rear contact. Of two freedoms there is one entry for each of the p pairs (0, 0), (0, 1), ...,
    (1, 1), ...

    Attributes
    ----------
    moment_x, moment_z : array, shape (...)
        Sums of m x and m z, in kg m.
    inertia_xx, inertia_xz, inertia_zz : array, shape (...)
        Entries of the inertia tensor, in kg m^2.
    spin_x, spin_z, lateral : sequence of f arrays, shape (...)
        Angular momentum about x and z, in kg m^2, and lateral momentum, in kg m, for a unit rate of each freedom.
    inner : sequence of p arrays, shape (...)
        Inertia of the motion relative to the frame, in kg m^2.
    sinking : sequence of p arrays, shape (...)
        Second derivatives of the sum of m z, in kg m.
    freedoms : tuple of str
        Names of the free joints.
    damping, stiffness : array, shape (..., f, f), or None
        Of dampers and springs at the rider's joints, in N m s and N m per rad; None without any.
    faults : tuple of Fault
        Designs of a batch that cannot sit or steer.
    """

    moment_x: Number
    moment_z: Number
    inertia_xx: Number
    inertia_xz: Number
    inertia_zz: Number
    spin_x: Sequence[Number] = (0.0,)
    spin_z: Sequence[Number] = (0.0,)
    lateral: Sequence[Number] = (0.0,)
    inner: Sequence[Number] = (0.0,)
    sinking: Sequence[Number] = (0.0,)
    freedoms: tuple[str, ...] = ()
    damping: Array | None = None
    stiffness: Array | None = None
    faults: tuple[Fault, ...] = ()


def slaved_mass(posture: Posture, bicycle: Bicycle, *, massless: bool = False) -> SlavedMass:
    """Return how the mass of a seated rider moves with the steer and the free joints.

    Parameters
    ----------
    posture : Posture
    bicycle : Bicycle
    massless : bool
        Let free joints move no mass.

    Raises
    ------
    PostureError
        As in :func:`singletrack.posture.motion.rider_motion`; for a free joint that moves no mass.

    Examples
    --------
    >>> from singletrack import load_bicycle, load_rider
    >>> from singletrack.posture import seat
    >>> bicycle = load_bicycle("browser")
    >>> mass = slaved_mass(seat(bicycle, load_rider("rider-a"), "upright"), bicycle)
    >>> len(mass.inner), bool(mass.inner[0] > 0), abs(float(mass.moment_x - 72 * 0.2) / 72) < 0.2  # steer alone
    (1, True, True)
    """
    segments = list(posture.segments.values())
    shape = _batch(posture)
    xp, rows = _about_contact(segments, shape, _ALL if posture.joints else _IN_PLANE)
    places = _ALL if posture.joints else _IN_PLANE
    whole = {name: xp.sum(rows[places.index(row)], axis=0).reshape(shape) for row, name in _TOTALS.items()}
    faults = posture.skeleton.faults + posture.faults
    if not posture.joints:
        return SlavedMass(**whole, faults=faults)
    posture = carried_by_soft_frame(posture, bicycle)
    motion, tree = rider_motion(posture, bicycle, shape), posture.tree
    moving = tree.moving
    beyond = summed(tree.carries[moving].T, rows[:, moving])
    momentum, spin = _momenta(motion, beyond)
    rates, i, j = motion.rates, tree.first, tree.second

    def along(values: Array, weights: Array) -> list[Array]:
        return [xp.sum(values * weights[:, k], axis=0).reshape(shape) for k in range(weights.shape[1])]

    shares = dot3(motion.carried_spin, spin[:, :, None]) + dot3(motion.carried_twist, momentum[:, :, None])
    inner = [xp.sum(shares[:, a] * rates[:, b] + shares[:, b] * rates[:, a], axis=0) for a, b in zip(i, j, strict=True)]
    turning = motion.turning
    lifted = turning[0] * momentum[1][:, None] - turning[1] * momentum[0][:, None] + momentum[2][:, None] * motion.bends
    inner = [value.reshape(shape) for value in inner]
    damping, stiffness = laws_of(posture, motion)
    mass = SlavedMass(
        **whole,
        spin_x=along(spin[0], rates),
        spin_z=along(spin[2], rates),
        lateral=along(momentum[1], rates),
        inner=inner,
        sinking=[value.reshape(shape) for value in xp.sum(lifted, axis=0)],
        freedoms=posture.freedoms,
        damping=damping,
        stiffness=stiffness,
        faults=faults + motion.faults,
    )
    if massless:
        return mass
    light = _massless(posture, inner, whole["inertia_xx"] + whole["inertia_zz"])
    return replace(mass, faults=mass.faults + light)


def _batch(posture: Posture) -> tuple[int, ...]:
    """Return the shape of the batch that skeleton, masses and inertias make together."""
    shapes = {np.shape(body.mass) for body in posture.segments.values()}
    shapes |= {np.shape(body.inertia)[:-2] for body in posture.segments.values()}
    return np.broadcast_shapes(posture.skeleton.points.shape[:-2], *shapes)


#: What mass there is: mass itself, first moments, inertia; and what of it is asked for of all segments together.
_ALL = ("m", "x", "y", "z", "xx", "yy", "zz", "xy", "xz", "yz")
_IN_PLANE = ("x", "z", "xx", "xz", "zz")
_TOTALS = {"x": "moment_x", "z": "moment_z", "xx": "inertia_xx", "xz": "inertia_xz", "zz": "inertia_zz"}


def _about_contact(segments: list[Segment], shape: tuple[int, ...], wanted: tuple[str, ...]) -> tuple[Any, Array]:
    """Return the wanted of mass, first moments and inertia about the rear contact, (wanted, segments, N)."""
    centre, inertia = stack([body.centre for body in segments], -2), stack([body.inertia for body in segments], -3)
    xp, (at, *columns) = designs_last([centre, *(inertia[..., k] for k in range(3))], shape)
    mass = stack([body.mass for body in segments], -1)
    _, (mass,) = as_arrays(xp.broadcast_to(mass, (*shape, mass.shape[-1])))
    mass = xp.moveaxis(mass, -1, 0).reshape(len(segments), -1)
    at_xyz = dict(zip("xyz", at, strict=True))
    inertia_of = {a + b: columns["xyz".index(b)]["xyz".index(a)] for a, b in ("xx", "yy", "zz", "xy", "xz", "yz")}
    rows = []
    for name in wanted:
        if name == "m":
            rows.append(mass)
        elif len(name) == 1:
            rows.append(mass * at_xyz[name])
        elif name[0] == name[1]:
            one, other = (at_xyz[axis] for axis in "xyz" if axis != name[0])
            rows.append(inertia_of[name] + mass * (one * one + other * other))
        else:
            rows.append(inertia_of[name] - mass * at_xyz[name[0]] * at_xyz[name[1]])
    return xp, stack(rows, -3)


def _momenta(motion: Motion, beyond: Array) -> tuple[Array, Array]:
    """Return p and h (3, n, N) of the joints, from what is beyond each, rows as in :func:`_about_contact`."""
    spin, twist = motion.spin, motion.twist
    mass, moment = beyond[0], beyond[1:4]
    xx, yy, zz, xy, xz, yz = (beyond[k] for k in range(4, 10))
    turned = stack(
        [
            xx * spin[0] + xy * spin[1] + xz * spin[2],
            xy * spin[0] + yy * spin[1] + yz * spin[2],
            xz * spin[0] + yz * spin[1] + zz * spin[2],
        ],
        -3,
    )
    return mass * twist + cross3(spin, moment), turned + cross3(moment, twist)


def _massless(posture: Posture, inner: list[Array], scale: Array) -> tuple[Fault, ...]:
    """Return a fault for each free joint that moves no mass."""
    if not posture.freedoms or not is_concrete(inner[-1]):
        return ()
    text = "posture {posture}: joint {joint} is free and moves no mass: hang a segment on it, or take free away"
    tree = posture.tree
    own = {int(a): np.real(inner[k]) for k, (a, b) in enumerate(zip(tree.first, tree.second, strict=True)) if a == b}
    return refuse_single(
        Fault(own[i] <= _STILL * np.real(scale), text.format(posture=posture.name, joint=name), {}, PostureError)
        for i, name in enumerate(posture.freedoms, start=1)
    )
