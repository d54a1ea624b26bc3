"""Small motions about a motion, exactly, with inputs and outputs.

With x + dx along the configurations that keep the constraints, dx = Z dp, dv = T dq' + W dp and likewise for
accelerations, the equations of motion projected on T vary with the forces of constraints held, because T^T A^T = 0:

    M dq'' + C dq' + K dp = B df,    p = (q, k),    k' = N q' + G p,

where k are kinematic coordinates, which rolling wheels need beside the generalised coordinates q.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np
from scipy import linalg

from singletrack.arrays import Array
from singletrack.errors import ModelError
from singletrack.multibody.spacar.evaluate import inertia, strains, vary
from singletrack.multibody.spacar.rows import Rows, names, solver_at
from singletrack.multibody.spacar.springs import spring_tangent

if TYPE_CHECKING:
    from singletrack.multibody.spacar.description import Input, Output
    from singletrack.multibody.spacar.layout import Layout
    from singletrack.multibody.spacar.state import Motion

__all__ = ["SmallMotions", "small_motions"]


@dataclass(frozen=True, eq=False)
class SmallMotions:
    """Small motions about a motion.

    Attributes
    ----------
    coordinates
        Names of the generalised coordinates q, then of the kinematic ones k.
    inputs, outputs
        Names of inputs (r,) and outputs (o,).
    M, C
        Matrices (q, q).
    K
        Matrix (q, p), p = q + k.
    B
        Matrix (q, r).
    N, G
        Rates of the kinematic coordinates, (k, q) and (k, p).
    A_matrix, B_matrix, C_matrix, D_matrix
        State space of (p, q').
    """

    coordinates: tuple[str, ...]
    inputs: tuple[str, ...]
    outputs: tuple[str, ...]
    M: Array
    C: Array
    K: Array
    B: Array
    N: Array
    G: Array
    A_matrix: Array
    B_matrix: Array
    C_matrix: Array
    D_matrix: Array

    def eigenvalues(self) -> Array:
        """Return the eigenvalues of the state space, 1/s, sorted by real, then imaginary part."""
        return np.sort_complex(np.linalg.eigvals(self.A_matrix))

    def to_control(self) -> object:
        """Return the state space as a ``control.StateSpace`` with named states, inputs and outputs."""
        import control  # slow to import

        generalised = self.coordinates[: len(self.M)]
        states = [*self.coordinates, *(f"{name}'" for name in generalised)]
        matrices = (self.A_matrix, self.B_matrix, self.C_matrix, self.D_matrix)
        return control.ss(*matrices, states=states, inputs=list(self.inputs), outputs=list(self.outputs))


def _configurations(rows: Rows, matrix: Array) -> tuple[Array, Array, tuple[str, ...]]:
    """Return Z (n, p), the rows of the kinematic coordinates (k, n), and their names."""
    layout = rows.layout
    n = matrix.shape[1]
    unit = np.eye(n)
    holonomic = rows.constraints[layout.holonomic[rows.constraints]]
    bound = [matrix[holonomic], matrix[rows.prescribed_e[layout.holonomic[rows.prescribed_e]]], unit[rows.prescribed_x]]
    moving = [unit[rows.dynamic_x], matrix[rows.dynamic_e]]
    kin_x, kin_e = np.flatnonzero(layout.x_is == "kinematic"), np.flatnonzero(layout.e_is == "kinematic")
    kinematic = np.concatenate([unit[kin_x], matrix[kin_e]])
    known = names(layout, kin_x, kin_e)
    size = sum(map(len, bound))
    square = np.concatenate([*bound, *moving, kinematic])[:, rows.free]
    lacking = len(rows.free) - len(square)
    if lacking > 0:
        rest = linalg.null_space(square) if square.size else np.eye(len(rows.free))
        more = np.zeros((rest.shape[1], n))
        more[:, rows.free] = rest.T
        kinematic = np.concatenate([kinematic, more])
        square = np.concatenate([square, rest.T])
        known = (*known, *(f"k {i + 1}" for i in range(len(more))))
    if square.shape[0] != square.shape[1] or (square.size and np.linalg.cond(square) > 1e13):
        raise ModelError(
            f"{layout.description.where}: the kinematic coordinates {', '.join(known)} do not go with the dynamic ones:"
            f" the constraints leave {len(rows.free) - size} of both together"
        )
    z = np.zeros((n, len(square) - size))
    if square.size:
        z[rows.free] = np.linalg.solve(square, np.eye(len(square))[:, size:])
    return z, kinematic, known


def _freed(rows: Rows) -> Rows:
    """Return the rows with what LINE names as generalised coordinates."""
    d = rows.layout.description
    more = [rows.layout.e_index[key] for key in d.more_freedoms]
    more = [i for i in more if rows.layout.e_is[i] in {"fixed", "prescribed"}]
    if not more:
        return rows
    for i in more:
        if i not in rows.constraints and i not in rows.prescribed_e:
            raise ModelError(
                f"{d.where}: LINE: deformation {names(rows.layout, np.zeros(0, int), np.array([i]))[0]} cannot move"
            )
    e_is = rows.layout.e_is.copy()
    e_is[more] = "dynamic"
    layout: Layout = replace(rows.layout, e_is=e_is)
    return replace(
        rows,
        layout=layout,
        constraints=np.setdiff1d(rows.constraints, more),
        prescribed_e=np.setdiff1d(rows.prescribed_e, more),
        dynamic_e=np.flatnonzero(e_is == "dynamic"),
    )


def small_motions(rows: Rows, motion: Motion, factor: float = 1.0, *, massless: bool = False) -> SmallMotions:
    """Linearise about a motion, exactly.

    Parameters
    ----------
    rows
        The chosen rows.
    motion
        From :func:`accelerate`.
    factor
        Of the given loads; as the motion's.
    massless
        Whether freedoms without mass are allowed; then there is no state space.

    Raises
    ------
    ModelError
        Where the kinematic coordinates do not fit, or a freedom moves no mass.
    """
    rows = _freed(rows)
    layout, state = rows.layout, motion.state
    _, matrix = strains(layout, state.x)
    solver = solver_at(rows, matrix)
    rows = solver.rows
    transfer = solver.transfer()
    z, kinematic, known = _configurations(rows, matrix)
    mass, _ = inertia(layout, state.x, state.v)
    v = vary(layout, state.x, state.v, motion.a, motion.stresses, factor)
    none = np.zeros_like(mass)
    w = -solver.solve(rows.stack(v.rates @ z, none @ z))
    a_q = -solver.solve(rows.stack(v.accelerations_v @ transfer, none @ transfer))
    a_p = -solver.solve(rows.stack(v.accelerations_x @ z + v.accelerations_v @ w, none @ z))
    springs, dampers = matrix.T @ spring_tangent(layout, state.e), matrix.T @ layout.viscous
    e_rates_p = matrix @ w + v.rates @ z
    M = transfer.T @ mass @ transfer
    C = transfer.T @ (mass @ a_q + v.forces_v @ transfer + dampers @ matrix @ transfer)
    K = transfer.T @ (mass @ a_p + v.forces_x @ z + v.forces_v @ w + springs @ matrix @ z + dampers @ e_rates_p)
    kin_e = np.flatnonzero(layout.e_is == "kinematic")
    varied = np.zeros((len(kinematic), len(state.x)))
    first = int(np.sum(layout.x_is == "kinematic"))
    varied[first : first + len(kin_e)] = v.rates[kin_e]
    N, G = kinematic @ transfer, kinematic @ w + varied @ z
    unit = np.eye(len(state.x))
    inputs = sorted(layout.description.inputs, key=lambda port: port.number)
    B = np.stack([transfer.T @ _row(layout, matrix, unit, port) for port in inputs], axis=1) if inputs else M[:, :0]
    at_rest = np.zeros((len(state.x) + len(matrix), len(M)))
    places = np.concatenate([np.concatenate([z, matrix @ z]), at_rest], axis=1)
    moving = np.concatenate([np.concatenate([w, e_rates_p]), np.concatenate([transfer, matrix @ transfer])], axis=1)
    outputs = sorted(layout.description.outputs, key=lambda port: port.number)
    C_matrix = _outputs(layout, outputs, places, moving)
    A_matrix, B_matrix = (M[:0], B[:0]) if massless else _state_space(rows, M, C, K, B, N, G)
    return SmallMotions(
        (*rows.names(), *known),
        tuple(
            f"{port.number}: {'force on ' * (port.what == 'x')}{port.what} {port.key[0]} {port.key[1]}"
            for port in inputs
        ),
        tuple(f"{port.number}: {port.what} {port.key[0]} {port.key[1]}" for port in outputs),
        *(M, C, K, B, N, G, A_matrix, B_matrix, C_matrix),
        np.zeros((len(outputs), len(inputs))),
    )


def _row(layout: Layout, matrix: Array, unit: Array, port: Input) -> Array:
    return matrix[layout.e_index[port.key]] if port.what == "e" else unit[layout.x_index[port.key]]


def _outputs(layout: Layout, outputs: list[Output], places: Array, moving: Array) -> Array:
    """Return the output matrix; ``places`` and ``moving`` say how coordinates, then deformations, and rates vary."""
    n = len(layout.x_index)
    index = {"x": layout.x_index, "e": layout.e_index}
    rows = [
        (moving if port.what.endswith("d") else places)[index[port.what[0]][port.key] + n * (port.what[0] == "e")]
        for port in outputs
    ]
    return np.array(rows).reshape(len(rows), places.shape[1])


def _state_space(rows: Rows, M: Array, C: Array, K: Array, B: Array, N: Array, G: Array) -> tuple[Array, Array]:
    q, p = len(M), K.shape[1]
    A = np.zeros((p + q, p + q))
    A[:q, p:] = np.eye(q)
    A[q:p, p:], A[q:p, :p] = N, G
    inputs = np.zeros((p + q, B.shape[1]))
    if q:
        try:
            factors = linalg.cho_factor(M)
        except linalg.LinAlgError:
            raise ModelError(f"{rows.layout.description.where}: a freedom moves no mass") from None
        A[p:, :p], A[p:, p:] = -linalg.cho_solve(factors, K), -linalg.cho_solve(factors, C)
        inputs[p:] = linalg.cho_solve(factors, B)
    return A, inputs
