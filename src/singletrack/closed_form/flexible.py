"""The bicycle whose frame or fork bends about a hinge, with or without rider (derived in docs/theory.md).

Steer, frame torsion and fork bending are hinges in the bicycle's plane. Each moves the front contact sideways by eta_i
and turns the front wheel about the vertical by a_i,z, so that rolling takes the frame along by

    psi' = sum over i of  v kappa_i d_i + mu_i d_i',    kappa_i = a_i,z / w,  mu_i = -eta_i / w,

of which the steer's are the kappa and mu of the rigid bicycle. Everything else is as for slaved bodies, with kappa and
mu for each freedom.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

from singletrack.arrays import Array, as_arrays, cross, matvec, stack, vector
from singletrack.closed_form.whipple import Matrices
from singletrack.parameters.flexible import FORK_BENDING, FRAME_TORSION, soft_hinges
from singletrack.posture import seat, slaved_bodies

if TYPE_CHECKING:
    from singletrack.parameters import Bicycle, Rider
    from singletrack.posture import Options, SlavedBodies

__all__ = ["Moving", "flexible_matrices", "hinge_laws", "moving_bodies"]

#: Bodies of the bicycle, and the freedoms that move them.
_BODIES = ("rear_wheel", "rear_frame", "front_frame", "front_wheel")
_MOVED_BY = {"front_frame": (FRAME_TORSION, "steer"), "front_wheel": (FRAME_TORSION, "steer", FORK_BENDING)}
_DOWNSTREAM = (FRAME_TORSION, "steer", FORK_BENDING)


class _Hinge(NamedTuple):
    """A hinge in the plane: axis (x, z) and a point of it (x, z), each (...)."""

    ax: Array
    az: Array
    x: Array
    z: Array

    def lateral(self, x: Array, z: Array) -> Array:
        """Return how far a point of what it carries moves sideways, per unit angle."""
        return self.az * (x - self.x) - self.ax * (z - self.z)


class _Bodies(NamedTuple):
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


def _hinges(bicycle: Bicycle) -> dict[str, _Hinge]:
    """Return steer and soft hinges by name, the steer first."""
    xp, (tilt,) = as_arrays(bicycle.steer_axis_tilt)
    reach = bicycle.wheel_base + bicycle.trail
    found = {"steer": _Hinge(xp.sin(tilt), xp.cos(tilt), reach, 0.0 * reach)}
    for hinge in soft_hinges(bicycle):
        found[hinge.name] = _Hinge(hinge.axis[..., 0], hinge.axis[..., 2], hinge.point[..., 0], hinge.point[..., 2])
    return found


def flexible_matrices(bicycle: Bicycle, bodies: SlavedBodies | None, freedoms: tuple[str, ...] = ()) -> Matrices:
    """Return the matrices of a bicycle with soft hinges and the rider's bodies.

    Parameters
    ----------
    bicycle : Bicycle
        With a stiffness of frame or fork.
    bodies : SlavedBodies, optional
        The rider's; they move with the steer and his own freedoms, and with the frame torsion where it is among these.
    freedoms : tuple of str
        The rider's free joints.

    Returns
    -------
    Matrices
        Each of shape (..., n, n); coordinates lean, steer, the rider's, frame torsion, fork bending.

    Examples
    --------
    Without motion of the hinge the rigid bicycle is left:

    >>> from singletrack import load_bicycle
    >>> from singletrack.closed_form.whipple import whipple_matrices
    >>> bicycle = load_bicycle("benchmark")
    >>> soft = bicycle.replace(frame_torsion_stiffness=5e3, frame_hinge_x=0.9, frame_hinge_z=-0.6)
    >>> bool(abs(flexible_matrices(soft, None).K2[:2, :2] - whipple_matrices(bicycle).K2).max() < 1e-12)
    True
    """
    hinges = _hinges(bicycle)
    names = ("steer", *freedoms, *(name for name in hinges if name != "steer" and name not in freedoms))
    _, (base,) = as_arrays(bicycle.wheel_base)
    zero = 0.0 * base
    # What a freedom does to the front wheel's contact: nothing, where it is not a hinge of the bicycle.
    eta = [hinges[name].lateral(base, zero) if name in hinges else zero for name in names]
    kappa = [hinges[name].az / base if name in hinges else zero for name in names]
    mu = [-value / base for value in eta]
    groups = [_bicycle_bodies(bicycle, hinges, names)]
    if bodies is not None:
        groups.append(_rider_bodies(bodies, names))
    whole = [_of_bodies(group, mu) for group in groups]
    pairs, lateral, moments, sinking = (_sum([part[k] for part in whole]) for k in range(4))
    moment_x, moment_z = moments[..., 0], moments[..., 2]
    count = len(names)
    pitch = [[_sunk_contact(hinges, eta, names, i, j) for j in range(count)] for i in range(count)]
    spins = _spins(bicycle, hinges, names, mu)
    M = pairs[..., : count + 1, : count + 1]
    columns_1, columns_2 = [0.0 * lateral], [0.0 * lateral]
    for j in range(count):
        columns_1.append(kappa[j][..., None] * pairs[..., : count + 1, count + 1] + mu[j][..., None] * lateral)
        columns_2.append(kappa[j][..., None] * lateral)
    C1, K2 = stack(columns_1, -1), stack(columns_2, -1)
    for spin, turn in spins:
        x, z = turn[..., 0], turn[..., 2]
        C1 = C1 + spin[..., None, None] * (x[..., :, None] * z[..., None, :] - z[..., :, None] * x[..., None, :])
        K2 = K2 + spin[..., None, None] * x[..., :, None] * vector(0.0, *kappa)[..., None, :]
    edge = [-lateral[..., 1 + i] for i in range(count)]
    inner = [[-sinking[..., i, j] + moment_x * pitch[i][j] / base for j in range(count)] for i in range(count)]
    K0 = stack([stack([moment_z, *edge], -1), *(stack([edge[i], *inner[i]], -1) for i in range(count))], -2)
    return Matrices(M, C1, K0, K2)


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


def moving_bodies(bicycle: Bicycle, rider: Rider | None, options: Options | str, names: tuple[str, ...]) -> Moving:
    """Return how a bicycle's and rider's bodies move, for wheels that do not roll without slip.

    Parameters
    ----------
    bicycle, rider, options
        As for a model.
    names
        The freedoms beside lean, steer first.
    """
    hinges = _hinges(bicycle)
    _, (base,) = as_arrays(bicycle.wheel_base)
    zero = 0.0 * base
    still = [zero] * len(names)
    groups = [_bicycle_bodies(bicycle, hinges, names)]
    if rider is not None:
        groups.append(_rider_bodies(slaved_bodies(seat(bicycle, rider, options), bicycle), names))
    whole = [_of_bodies(group, still) for group in groups]
    pairs, lateral, moments, _ = (_sum([part[k] for part in whole]) for k in range(4))
    return Moving(
        pairs,
        lateral,
        _sum([as_arrays(group.mass)[0].sum(group.mass, axis=-1) for group in groups]),
        moments[..., 0],
        _spins(bicycle, hinges, names, still),
        [hinges[name].lateral(base, zero) if name in hinges else zero for name in names],
        [hinges[name].az if name in hinges else zero for name in names],
        [hinges[name].ax if name in hinges else zero for name in names],
        base,
    )


def hinge_laws(bicycle: Bicycle, places: tuple[str, ...]) -> tuple[Array, Array]:
    """Return C0 and S0 (..., n, n) of the soft hinges' dampers and springs, for the coordinates named.

    >>> from singletrack import load_bicycle
    >>> soft = load_bicycle("benchmark").replace(fork_bending_stiffness=2e3, fork_hinge_x=1.0, fork_hinge_z=-0.7)
    >>> hinge_laws(soft, ("lean", "steer", "fork bending"))[1].diagonal().tolist()
    [0.0, 0.0, 2000.0]
    """
    by_name = {hinge.name: hinge for hinge in soft_hinges(bicycle)}

    def diagonal(what: str) -> Array:
        values = [getattr(by_name[name], what) if name in by_name else 0.0 for name in places]
        rows = [vector(*(value if i == j else 0.0 for j in range(len(places)))) for i, value in enumerate(values)]
        return stack(rows, -2)

    return diagonal("damping"), diagonal("stiffness")


def _bicycle_bodies(bicycle: Bicycle, hinges: dict[str, _Hinge], names: tuple[str, ...]) -> _Bodies:
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
    return _Bodies(
        stack(masses, -1),
        stack(centres, -2),
        stack(inertias, -3),
        stack([stack([one[i] for one in rotations], -2) for i in range(len(names))], -3),
        stack([stack([one[i] for one in displacements], -2) for i in range(len(names))], -3),
        stack([vector(*(sinking.get((a, b), 0.0) for b in names)) for a in names], -2),
    )


def _solid(bicycle: Bicycle, body: str) -> tuple[Array, Array, Array, Array]:
    """Return mass, centre's x and z, and inertia (..., 3, 3) of a body of the bicycle."""
    mass = getattr(bicycle, f"{body}_mass")
    xx, yy = (getattr(bicycle, f"{body}_inertia_{axes}") for axes in ("xx", "yy"))
    if body.endswith("wheel"):
        x = 0.0 * bicycle.wheel_base if body == "rear_wheel" else bicycle.wheel_base
        z, zz, xz = -getattr(bicycle, f"{body}_radius"), xx, 0.0 * xx
    else:
        x, z, zz, xz = (getattr(bicycle, f"{body}_{name}") for name in ("x", "z", "inertia_zz", "inertia_xz"))
    return mass, x, z, stack([vector(xx, 0.0, xz), vector(0.0, yy, 0.0), vector(xz, 0.0, zz)], -2)


def _rider_bodies(bodies: SlavedBodies, names: tuple[str, ...]) -> _Bodies:
    """Return the rider's bodies with still columns for the freedoms that do not move them."""
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
    return _Bodies(bodies.mass, bodies.centre, bodies.inertia, rotation, displacement, stack(rows, -2))


def _of_bodies(bodies: _Bodies, mu: list[Array]) -> tuple[Array, Array, Array, Array]:
    """Return products of motions (..., f + 2, f + 2), lateral momenta (..., f + 1), moments of mass and sinking.

    Motions are those of a unit rate of lean, of each freedom (which takes the frame along), and of yaw.
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


def _sunk_contact(hinges: dict[str, _Hinge], eta: list[Array], names: tuple[str, ...], i: int, j: int) -> Array:
    """Return the second derivative of how far the front wheel would sink into the ground."""
    if names[i] not in hinges or names[j] not in hinges:
        return 0.0 * eta[0]
    up, down = sorted((i, j), key=lambda k: _DOWNSTREAM.index(names[k]))
    return hinges[names[up]].ax * eta[down]


def _spins(
    bicycle: Bicycle, hinges: dict[str, _Hinge], names: tuple[str, ...], mu: list[Array]
) -> list[tuple[Array, Array]]:
    """Return for each wheel its angular momentum over the speed, and its turns (..., 1 + f, 3), lean first."""
    found = []
    for wheel in ("rear_wheel", "front_wheel"):
        xp, (inertia, radius) = as_arrays(getattr(bicycle, f"{wheel}_inertia_yy"), getattr(bicycle, f"{wheel}_radius"))
        turns = [vector(1.0, 0.0, 0.0)]
        for name, share in zip(names, mu, strict=True):
            own = hinges[name] if name in _MOVED_BY.get(wheel, ()) and name in hinges else None
            turns.append(vector(0.0, 0.0, share) if own is None else vector(own.ax, 0.0, own.az + share))
        found.append((inertia / xp.where(radius == 0, 1.0, radius), stack(turns, -2)))
    return found


def _sum(values: list[Array]) -> Array:
    total = values[0]
    for value in values[1:]:
        total = total + value
    return total
