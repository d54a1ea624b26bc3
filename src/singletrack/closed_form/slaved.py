"""What bodies slaved to the steer angle and to free joints add to the matrices (derived in docs/theory.md)."""

from __future__ import annotations

from typing import TYPE_CHECKING

from singletrack.arrays import Array, as_arrays, matvec, namespace, stack
from singletrack.closed_form.whipple import Matrices

if TYPE_CHECKING:
    from singletrack.parameters import Bicycle
    from singletrack.posture import SlavedBodies

__all__ = ["slaved_matrices"]


def slaved_matrices(bodies: SlavedBodies, bicycle: Bicycle) -> Matrices:
    """Return the sum of what bodies add to M, C1, K0 and K2 that move with the steer and free joints.

    Parameters
    ----------
    bodies : SlavedBodies
        Bodies with their motion relative to the rear frame along f freedoms, the steer first.
    bicycle : Bicycle
        Wheel base, trail and steer axis tilt.

    Returns
    -------
    Matrices
        Each of shape (..., 1 + f, 1 + f), SI units; coordinates lean, steer, free joints.

    Notes
    -----
    With μ = c cos λ / w_b and κ = cos λ / w_b, each body has a translation p and a rotation a for unit rates of lean,
    steer, free joints and yaw about the rear contact, paired as ⟨(p, a), (q, b)⟩ = m p·q + a·I b; y(p) is the lateral
    part of p:

        M_ij += ⟨i, j⟩            C1_iδ += κ ⟨i, ψ⟩ + μ m y(p_i)         K2_iδ += κ m y(p_i)
        K0_φφ += m z              K0_φi -= m y(p_i)                      K0_ij -= m H_ij,z;  K0_δδ -= m μ x sin λ

    Examples
    --------
    A body that stays with the rear frame adds to the lean entry of M its moment of inertia about the x axis:

    >>> import numpy as np
    >>> from singletrack import load_bicycle
    >>> from singletrack.posture import SlavedBodies
    >>> at, still = np.array([[0.3, 0.0, -1.0]]), np.zeros((1, 1, 3))
    >>> load = SlavedBodies(np.array([10.0]), at, np.zeros((1, 3, 3)), still, still, still)
    >>> float(slaved_matrices(load, load_bicycle("stratos")).M[0, 0])
    10.0
    """
    xp, (base, trail, tilt) = as_arrays(bicycle.wheel_base, bicycle.trail, bicycle.steer_axis_tilt)
    kappa = xp.cos(tilt) / base
    mu = trail * kappa
    mass = bodies.mass
    x, y, z = (bodies.centre[..., k] for k in range(3))
    moment_x, moment_z = _sum(mass * x), _sum(mass * z)
    lean_lean = _sum(mass * (y * y + z * z) + bodies.inertia[..., 0, 0])
    lean_yaw = _sum(bodies.inertia[..., 0, 2] - mass * x * z)
    yaw_yaw = _sum(mass * (x * x + y * y) + bodies.inertia[..., 2, 2])
    count = bodies.displacement.shape[-3]
    lean, yaw, lateral, inner, sinking = _relative(bodies, count)

    # The steer takes the frame along by μ of yaw.
    lean[0], lateral[0] = lean[0] + mu * lean_yaw, lateral[0] + mu * moment_x
    inner[0, 0] = inner[0, 0] + 2 * mu * yaw[0] + mu * mu * yaw_yaw
    for i in range(1, count):
        inner[0, i] = inner[0, i] + mu * yaw[i]
    yaw[0] = yaw[0] + mu * yaw_yaw
    sinking[0, 0] = sinking[0, 0] + mu * xp.sin(tilt) * moment_x
    by_yaw, by_lateral = [lean_yaw, *yaw], [-moment_z, *lateral]

    def symmetric(corner: Array, edge: list[Array], rest: dict[tuple[int, int], Array]) -> Array:
        inside = [[rest[min(i, j), max(i, j)] for j in range(count)] for i in range(count)]
        return _matrix([[corner, *edge], *([edge[i], *row] for i, row in enumerate(inside))])

    def steer_column(values: list[Array]) -> Array:
        return _matrix([[0.0, value, *([0.0] * (count - 1))] for value in values])

    return Matrices(
        symmetric(lean_lean, lean, inner),
        steer_column([kappa * a + mu * b for a, b in zip(by_yaw, by_lateral, strict=True)]),
        symmetric(moment_z, [-value for value in lateral], {pair: -value for pair, value in sinking.items()}),
        steer_column([kappa * b for b in by_lateral]),
    )


def _relative(
    bodies: SlavedBodies, count: int
) -> tuple[list[Array], list[Array], list[Array], dict[tuple[int, int], Array], dict[tuple[int, int], Array]]:
    """Return what the motion relative to the frame has of its own.

    By freedom: angular momenta about x and z, lateral momentum; by pair of freedoms: inertia, mass times sinking.
    """
    pairs = [(i, j) for i in range(count) for j in range(i, count)]
    if bodies.moving == ():
        nothing = [0.0] * count
        return nothing, nothing.copy(), nothing.copy(), dict.fromkeys(pairs, 0.0), dict.fromkeys(pairs, 0.0)
    chosen = slice(None) if bodies.moving is None else list(bodies.moving)
    mass, centre = bodies.mass[..., chosen], bodies.centre[..., chosen, :]
    turn, move = bodies.rotation[..., chosen, :], bodies.displacement[..., chosen, :]
    momentum = mass[..., None, :, None] * move
    spin = matvec(bodies.inertia[..., None, chosen, :, :], turn)
    x, y, z = (centre[..., None, :, k] for k in range(3))
    px, py, pz = (momentum[..., k] for k in range(3))
    lean = _sum(y * pz - z * py + spin[..., 0])
    yaw = _sum(x * py - y * px + spin[..., 2])
    lateral = _sum(py)
    sinking = _sum(mass[..., None, :] * bodies.curvature[..., chosen, 2])
    inner = {}
    for i, j in pairs:
        both = move[..., i, :, :] * momentum[..., j, :, :] + turn[..., i, :, :] * spin[..., j, :, :]
        inner[i, j] = _sum(both[..., 0] + both[..., 1] + both[..., 2])

    def listed(values: Array) -> list[Array]:
        return [values[..., i] for i in range(count)]

    return (
        listed(lean),
        listed(yaw),
        listed(lateral),
        inner,
        {pair: sinking[..., k] for k, pair in enumerate(pairs)},
    )


def _sum(values: Array) -> Array:
    return namespace(values).sum(values, axis=-1)


def _matrix(rows: list[list[Array]]) -> Array:
    """Return matrices (..., n, n) of their entries (...)."""
    flat = stack([entry for row in rows for entry in row], -1)
    return flat.reshape(*flat.shape[:-1], len(rows), len(rows))
