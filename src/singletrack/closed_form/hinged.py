"""Bodies of a bicycle on hinges in its plane, and of its rider: their motions, products and spins."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

from singletrack.arrays import Array, Number, as_arrays, cross, matvec, stack, vector
from singletrack.parameters.flexible import FORK_BENDING, FRAME_TORSION, soft_hinges
from singletrack.posture import seat, slaved_bodies

if TYPE_CHECKING:
    from singletrack.parameters import Bicycle, Rider
    from singletrack.posture import Options, SlavedBodies

__all__ = [
    "Bodies",
    "Hinge",
    "Moving",
    "bicycle_bodies",
    "moving_bodies",
    "plane_hinges",
    "products",
    "rider_bodies",
    "total",
    "wheel_spins",
]

#: Bodies of the bicycle, and the freedoms that move them.
_BODIES = ("rear_wheel", "rear_frame", "front_frame", "front_wheel")
_MOVED_BY = {"front_frame": (FRAME_TORSION, "steer"), "front_wheel": (FRAME_TORSION, "steer", FORK_BENDING)}


class Hinge(NamedTuple):
    """A hinge in the plane: axis (x, z) and a point of it (x, z), each (...)."""

    ax: Array
    az: Array
    x: Number
    z: Number

    def lateral(self, x: Number, z: Number) -> Array:
        """Return how far a point of what it carries moves sideways, per unit angle.

        Parameters
        ----------
        x, z : array, shape (...)
            The point, in m, in the bicycle's frame.
        """
        return self.az * (x - self.x) - self.ax * (z - self.z)


class Bodies(NamedTuple):
    """n bodies with f freedoms.

    Mass (..., n), centre (..., n, 3), inertia (..., n, 3, 3), rotation and displacement (..., f, n, 3), and mass times
    sinking (..., f, f).
    """

    mass: Array
    centre: Array
    inertia: Array
    rotation: Array
    displacement: Array
    sinking: Array


class Moving(NamedTuple):
    """A bicycle that rolling does not take along, n bodies, f freedoms.

    Products of motions (..., f + 2, f + 2) in lean, freedoms, yaw; lateral momenta (..., f + 1) of lean and freedoms;
    total mass and its moment about the rear contact; the wheels' spins; sideways motion eta, heading and camber of the
    front wheel by freedom; the wheel base.
    """

    pairs: Array
    lateral: Array
    mass: Array
    moment_x: Array
    spins: list[tuple[Array, Array]]
    eta: list[Array]
    heading: list[Array]
    camber: list[Array]
    base: Array


def plane_hinges(bicycle: Bicycle) -> dict[str, Hinge]:
    """Return steer and soft hinges by name, the steer first.

    Parameters
    ----------
    bicycle : Bicycle
    """
    xp, (tilt,) = as_arrays(bicycle.steer_axis_tilt)
    reach = bicycle.wheel_base + bicycle.trail
    found = {"steer": Hinge(xp.sin(tilt), xp.cos(tilt), reach, 0.0 * reach)}
    for hinge in soft_hinges(bicycle):
        found[hinge.name] = Hinge(hinge.axis[..., 0], hinge.axis[..., 2], hinge.point[..., 0], hinge.point[..., 2])
    return found


def moving_bodies(bicycle: Bicycle, rider: Rider | None, options: Options | str, names: tuple[str, ...]) -> Moving:
    """Return how a bicycle's and rider's bodies move, for wheels that do not roll without slip.

    Parameters
    ----------
    bicycle, rider, options
        As for a model.
    names
        The freedoms beside lean, steer first.
    """
    hinges = plane_hinges(bicycle)
    _, (base,) = as_arrays(bicycle.wheel_base)
    zero = 0.0 * base
    still = [zero] * len(names)
    groups = [bicycle_bodies(bicycle, hinges, names)]
    if rider is not None:
        groups.append(rider_bodies(slaved_bodies(seat(bicycle, rider, options), bicycle), names))
    whole = [products(group, still) for group in groups]
    pairs, lateral, moments, _ = (total([part[k] for part in whole]) for k in range(4))
    return Moving(
        pairs,
        lateral,
        total([as_arrays(group.mass)[0].sum(group.mass, axis=-1) for group in groups]),
        moments[..., 0],
        wheel_spins(bicycle, hinges, names, still),
        [hinges[name].lateral(base, zero) if name in hinges else zero for name in names],
        [hinges[name].az if name in hinges else zero for name in names],
        [hinges[name].ax if name in hinges else zero for name in names],
        base,
    )


def bicycle_bodies(bicycle: Bicycle, hinges: dict[str, Hinge], names: tuple[str, ...]) -> Bodies:
    """Return the bicycle's four bodies and how the freedoms named move them.

    Parameters
    ----------
    bicycle : Bicycle
    hinges : dict
        Steer and soft hinges, of :func:`plane_hinges`.
    names : tuple of str
        The freedoms, the steer first.
    """
    masses, centres, inertias, rotations, displacements = [], [], [], [], []
    sinking: dict[tuple[str, str], Array] = {}
    for body in _BODIES:
        mass, x, z, tensor = _solid(bicycle, body)
        masses.append(mass)
        centres.append(vector(x, 0.0, z))
        inertias.append(tensor)
        own = [name for name in _MOVED_BY.get(body, ()) if name in hinges]
        lateral = {name: hinges[name].lateral(x, z) for name in own}
        rotations.append(
            [vector(hinges[n].ax, 0.0, hinges[n].az) if n in own else vector(0.0, 0.0, 0.0) for n in names]
        )
        displacements.append([vector(0.0, lateral[n], 0.0) if n in own else vector(0.0, 0.0, 0.0) for n in names])
        for k, first in enumerate(own):
            for second in own[k:]:
                sunk = mass * hinges[first].ax * lateral[second]
                for pair in {(first, second), (second, first)}:
                    sinking[pair] = sinking.get(pair, 0.0) + sunk
    return Bodies(
        stack(masses, -1),
        stack(centres, -2),
        stack(inertias, -3),
        stack([stack([one[i] for one in rotations], -2) for i in range(len(names))], -3),
        stack([stack([one[i] for one in displacements], -2) for i in range(len(names))], -3),
        stack([vector(*(sinking.get((a, b), 0.0) for b in names)) for a in names], -2),
    )


def _solid(bicycle: Bicycle, body: str) -> tuple[Array, Number, Array, Array]:
    """Return mass, centre's x and z, and inertia (..., 3, 3) of a body of the bicycle."""
    mass = getattr(bicycle, f"{body}_mass")
    xx, yy = (getattr(bicycle, f"{body}_inertia_{axes}") for axes in ("xx", "yy"))
    if body.endswith("wheel"):
        x = 0.0 * bicycle.wheel_base if body == "rear_wheel" else bicycle.wheel_base
        z, zz, xz = -getattr(bicycle, f"{body}_radius"), xx, 0.0 * xx
    else:
        x, z, zz, xz = (getattr(bicycle, f"{body}_{name}") for name in ("x", "z", "inertia_zz", "inertia_xz"))
    return mass, x, z, stack([vector(xx, 0.0, xz), vector(0.0, yy, 0.0), vector(xz, 0.0, zz)], -2)


def rider_bodies(bodies: SlavedBodies, names: tuple[str, ...]) -> Bodies:
    """Return the rider's bodies with still columns for the freedoms that do not move them.

    Parameters
    ----------
    bodies : SlavedBodies
        The rider's, which move with the steer and with their own joints.
    names : tuple of str
        The model's freedoms, the steer first.
    """
    count = bodies.displacement.shape[-3]
    still = 0.0 * bodies.displacement[..., 0, :, :]
    more = [still] * (len(names) - count)
    displacement = stack([*(bodies.displacement[..., i, :, :] for i in range(count)), *more], -3)
    rotation = stack([*(bodies.rotation[..., i, :, :] for i in range(count)), *more], -3)
    xp, (curvature,) = as_arrays(bodies.curvature)
    sunk = xp.sum(bodies.mass[..., None, :] * curvature[..., 2], axis=-1)
    index: dict[tuple[int, int], int] = {}
    for i in range(count):
        for j in range(i, count):
            index[i, j] = index[j, i] = len(set(index.values()))
    rows = [
        vector(*(sunk[..., index[i, j]] if (i, j) in index else 0.0 for j in range(len(names))))
        for i in range(len(names))
    ]
    return Bodies(bodies.mass, bodies.centre, bodies.inertia, rotation, displacement, stack(rows, -2))


def products(bodies: Bodies, mu: list[Array]) -> tuple[Array, Array, Array, Array]:
    """Return products of motions (..., f + 2, f + 2), lateral momenta (..., f + 1), moments of mass and sinking.

    Motions are those of a unit rate of lean, of each freedom (which takes the frame along), and of yaw.

    Parameters
    ----------
    bodies : Bodies
        All of them.
    mu : list of array, shape (...)
        Yaw per unit of each freedom with the wheels' contacts at rest.
    """
    ex, ez = vector(1.0, 0.0, 0.0), vector(0.0, 0.0, 1.0)
    lean, yaw = cross(ex, bodies.centre), cross(ez, bodies.centre)
    moves, turns = [lean], [ex + 0.0 * lean]
    for i, share in enumerate(mu):
        moves.append(bodies.displacement[..., i, :, :] + share[..., None, None] * yaw)
        turns.append(bodies.rotation[..., i, :, :] + share[..., None, None] * ez)
    move, turn = stack([*moves, yaw], -3), stack([*turns, ez + 0.0 * yaw], -3)
    xp, (move, turn) = as_arrays(move, turn)
    momentum, spin = bodies.mass[..., None, :, None] * move, matvec(bodies.inertia[..., None, :, :, :], turn)

    def flat(values: Array) -> Array:
        return values.reshape(*values.shape[:-2], -1)

    def across(values: Array) -> Array:
        return xp.moveaxis(flat(values), -1, -2)

    pairs = xp.matmul(flat(momentum), across(move)) + xp.matmul(flat(spin), across(turn))
    moments = xp.sum(bodies.mass[..., None] * bodies.centre, axis=-2)
    return pairs, xp.sum(momentum[..., :-1, :, 1], axis=-1), moments, bodies.sinking


def wheel_spins(
    bicycle: Bicycle, hinges: dict[str, Hinge], names: tuple[str, ...], mu: list[Array]
) -> list[tuple[Array, Array]]:
    """Return for each wheel its angular momentum over the speed, and its turns (..., 1 + f, 3), lean first.

    Parameters
    ----------
    bicycle : Bicycle
    hinges : dict
        Steer and soft hinges by name.
    names : tuple of str
        The freedoms, the steer first.
    mu : list of array, shape (...)
        Yaw per unit of each freedom.
    """
    found = []
    for wheel in ("rear_wheel", "front_wheel"):
        xp, (inertia, radius) = as_arrays(getattr(bicycle, f"{wheel}_inertia_yy"), getattr(bicycle, f"{wheel}_radius"))
        turns = [vector(1.0, 0.0, 0.0)]
        for name, share in zip(names, mu, strict=True):
            own = hinges[name] if name in _MOVED_BY.get(wheel, ()) and name in hinges else None
            turns.append(vector(0.0, 0.0, share) if own is None else vector(own.ax, 0.0, own.az + share))
        found.append((inertia / xp.where(radius == 0, 1.0, radius), stack(turns, -2)))
    return found


def total(values: list[Array]) -> Array:
    """Return the sum of arrays that broadcast.

    Parameters
    ----------
    values : list of array, shape (...)
    """
    whole = values[0]
    for value in values[1:]:
        whole = whole + value
    return whole
