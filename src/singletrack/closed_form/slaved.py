"""What bodies slaved to the steer angle and to free joints add to the matrices (docs/theory/closed-form.md)."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from singletrack.arrays import Array, Number, as_arrays, stack
from singletrack.closed_form.whipple import Matrices

if TYPE_CHECKING:
    from collections.abc import Sequence

    from singletrack.parameters import Bicycle
    from singletrack.posture import SlavedMass

__all__ = ["slaved_matrices"]


def slaved_matrices(bodies: SlavedMass, bicycle: Bicycle) -> Matrices:
    """Return what bodies add to M, C1, K0 and K2 that move with the steer and free joints.

    Parameters
    ----------
    bodies : SlavedMass
        Sums over the bodies, of their motion relative to the rear frame along f freedoms, the steer first.
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
    part of p. The steer takes the frame along by μ of yaw.

        M_ij += ⟨i, j⟩            C1_iδ += κ ⟨i, ψ⟩ + μ m y(p_i)         K2_iδ += κ m y(p_i)
        K0_φφ += m z              K0_φi -= m y(p_i)                      K0_ij -= m H_ij,z;  K0_δδ -= m μ x sin λ

    Examples
    --------
    A body that stays with the rear frame adds to the lean entry of M its moment of inertia about the x axis:

    >>> from singletrack import load_bicycle
    >>> from singletrack.posture import SlavedMass
    >>> load = SlavedMass(3.0, -10.0, 10.0, 3.0, 0.9)
    >>> float(slaved_matrices(load, load_bicycle("stratos")).M[0, 0])
    10.0
    """
    xp, (base, trail, tilt) = as_arrays(bicycle.wheel_base, bicycle.trail, bicycle.steer_axis_tilt)
    kappa = xp.cos(tilt) / base
    mu = trail * kappa
    count = len(bodies.lateral)
    pairs = [(i, j) for i in range(count) for j in range(i, count)]
    inner, sinking = (dict(zip(pairs, values, strict=True)) for values in (bodies.inner, bodies.sinking))
    lean, yaw, lateral = list(bodies.spin_x), list(bodies.spin_z), list(bodies.lateral)

    inner[0, 0] = inner[0, 0] + 2 * mu * yaw[0] + mu * mu * bodies.inertia_zz
    for i in range(1, count):
        inner[0, i] = inner[0, i] + mu * yaw[i]
    lean[0], lateral[0] = lean[0] + mu * bodies.inertia_xz, lateral[0] + mu * bodies.moment_x
    yaw[0] = yaw[0] + mu * bodies.inertia_zz
    sinking[0, 0] = sinking[0, 0] + mu * xp.sin(tilt) * bodies.moment_x
    by_yaw, by_lateral = [bodies.inertia_xz, *yaw], [-bodies.moment_z, *lateral]

    def symmetric(corner: Number, edge: Sequence[Number], rest: dict[tuple[int, int], Any]) -> Array:
        inside = [[rest[min(i, j), max(i, j)] for j in range(count)] for i in range(count)]
        return _matrix([[corner, *edge], *([edge[i], *row] for i, row in enumerate(inside))])

    def steer_column(values: Sequence[Number]) -> Array:
        return _matrix([[0.0, value, *([0.0] * (count - 1))] for value in values])

    return Matrices(
        symmetric(bodies.inertia_xx, lean, inner),
        steer_column([kappa * a + mu * b for a, b in zip(by_yaw, by_lateral, strict=True)]),
        symmetric(bodies.moment_z, [-value for value in lateral], {pair: -value for pair, value in sinking.items()}),
        steer_column([kappa * b for b in by_lateral]),
    )


def _matrix(rows: list[list[Number]]) -> Array:
    """Return matrices (..., n, n) of their entries (...)."""
    flat = stack([entry for row in rows for entry in row], -1)
    return flat.reshape(*flat.shape[:-1], len(rows), len(rows))
