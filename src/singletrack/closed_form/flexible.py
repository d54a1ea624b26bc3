"""The bicycle whose frame or fork bends about a hinge, with or without rider (derived in docs/theory/closed-form.md).

Steer, frame torsion and fork bending are hinges in the bicycle's plane. Each moves the front contact sideways by eta_i
and turns the front wheel about the vertical by a_i,z, so that rolling takes the frame along by

    psi' = sum over i of  v kappa_i d_i + mu_i d_i',    kappa_i = a_i,z / w,  mu_i = -eta_i / w,

of which the steer's are the kappa and mu of the rigid bicycle. Everything else is as for slaved bodies, with kappa and
mu for each freedom.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from singletrack.arrays import Array, as_arrays, stack, vector
from singletrack.closed_form.hinged import bicycle_bodies, plane_hinges, products, rider_bodies, total, wheel_spins
from singletrack.closed_form.whipple import Matrices
from singletrack.parameters.flexible import FORK_BENDING, FRAME_TORSION, soft_hinges

if TYPE_CHECKING:
    from singletrack.closed_form.hinged import Hinge
    from singletrack.parameters import Bicycle
    from singletrack.posture import SlavedBodies

__all__ = ["flexible_matrices", "hinge_laws"]

#: Hinges in the order from the rear frame to the front wheel.
_DOWNSTREAM = (FRAME_TORSION, "steer", FORK_BENDING)


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
    hinges = plane_hinges(bicycle)
    names = ("steer", *freedoms, *(name for name in hinges if name != "steer" and name not in freedoms))
    _, (base,) = as_arrays(bicycle.wheel_base)
    zero = 0.0 * base
    # What a freedom does to the front wheel's contact: nothing, where it is not a hinge of the bicycle.
    eta = [hinges[name].lateral(base, zero) if name in hinges else zero for name in names]
    kappa = [hinges[name].az / base if name in hinges else zero for name in names]
    mu = [-value / base for value in eta]
    groups = [bicycle_bodies(bicycle, hinges, names)]
    if bodies is not None:
        groups.append(rider_bodies(bodies, names))
    whole = [products(group, mu) for group in groups]
    pairs, lateral, moments, sinking = (total([part[k] for part in whole]) for k in range(4))
    count = len(names)
    M = pairs[..., : count + 1, : count + 1]
    columns_1, columns_2 = [0.0 * lateral], [0.0 * lateral]
    for j in range(count):
        columns_1.append(kappa[j][..., None] * pairs[..., : count + 1, count + 1] + mu[j][..., None] * lateral)
        columns_2.append(kappa[j][..., None] * lateral)
    C1, K2 = stack(columns_1, -1), stack(columns_2, -1)
    for spin, turn in wheel_spins(bicycle, hinges, names, mu):
        x, z = turn[..., 0], turn[..., 2]
        C1 = C1 + spin[..., None, None] * (x[..., :, None] * z[..., None, :] - z[..., :, None] * x[..., None, :])
        K2 = K2 + spin[..., None, None] * x[..., :, None] * vector(0.0, *kappa)[..., None, :]
    sunk = [[_sunk_contact(hinges, eta, names, i, j) / base for j in range(count)] for i in range(count)]
    return Matrices(M, C1, _potential(lateral, moments, sinking, sunk), K2)


def _potential(lateral: Array, moments: Array, sinking: Array, sunk: list[list[Array]]) -> Array:
    """Return K0; ``sunk`` is how far the front wheel would sink over the wheel base: so much the bicycle pitches."""
    count = len(sunk)
    edge = [-lateral[..., 1 + i] for i in range(count)]
    inner = [[-sinking[..., i, j] + moments[..., 0] * sunk[i][j] for j in range(count)] for i in range(count)]
    return stack([stack([moments[..., 2], *edge], -1), *(stack([edge[i], *inner[i]], -1) for i in range(count))], -2)


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


def _sunk_contact(hinges: dict[str, Hinge], eta: list[Array], names: tuple[str, ...], i: int, j: int) -> Array:
    """Return the second derivative of how far the front wheel would sink into the ground."""
    if names[i] not in hinges or names[j] not in hinges:
        return 0.0 * eta[0]
    up, down = sorted((i, j), key=lambda k: _DOWNSTREAM.index(names[k]))
    return hinges[names[up]].ax * eta[down]
