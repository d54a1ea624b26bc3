"""Exact linearisation about a steady motion: matrices, state space, and polynomials in speed.

The derivation is in :mod:`singletrack.multibody.engine.variations`. Coordinates that matter to nothing (position,
heading, wheel angles) are found and left out, so that steady turning, where they grow without bound, has constant
coefficients too.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

import numpy as np

from singletrack.arrays import Array
from singletrack.errors import ModelError, unknown_name
from singletrack.multibody.engine.dynamics import accelerations, input_vector
from singletrack.multibody.engine.model import State
from singletrack.multibody.engine.observe import observe, observe_responses
from singletrack.multibody.engine.variations import vary

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from singletrack.multibody.engine.dynamics import Response
    from singletrack.multibody.engine.variations import Variations

__all__ = ["Linearisation", "linearise"]

LAST_DIGITS = 1e-13
TRIALS = 3
ABOVE = 10.0


@dataclass(frozen=True, eq=False)
class Linearisation:
    """Small motions about a steady motion: ``M du' + C du + K dq = B df``, ``dq' = N du + G dq``.

    Attributes
    ----------
    state
        The steady motion.
    coordinates
        Names of the coordinates q that matter, (k,).
    speeds
        Names of the independent speeds u, (m,).
    inputs, outputs
        Names of inputs (r,) and outputs (o,).
    M, C, K, B
        Mass (m, m), damping-like (m, m), stiffness-like (m, k) and input (m, r) matrices.
    A_matrix, B_matrix, C_matrix, D_matrix
        State space of (dq, du), shapes (k + m, k + m), (k + m, r), (o, k + m), (o, r).
    """

    state: State
    coordinates: tuple[str, ...]
    speeds: tuple[str, ...]
    inputs: tuple[str, ...]
    outputs: tuple[str, ...]
    M: Array
    C: Array
    K: Array
    B: Array
    A_matrix: Array
    B_matrix: Array
    C_matrix: Array
    D_matrix: Array

    def eigenvalues(self) -> Array:
        """Return the eigenvalues of the state space, 1/s, sorted by real, then imaginary part."""
        return np.sort_complex(np.linalg.eigvals(self.A_matrix))

    def to_control(self) -> Any:
        """Return the state space as a ``control.StateSpace`` with named states, inputs and outputs."""
        import control  # slow to import

        states = [*self.coordinates, *(f"{name}'" for name in self.speeds)]
        matrices = (self.A_matrix, self.B_matrix, self.C_matrix, self.D_matrix)
        return control.ss(*matrices, states=states, inputs=list(self.inputs), outputs=list(self.outputs))

    def select(self, names: Sequence[str]) -> tuple[Array, Array, Array, Array]:
        """Return M, C, K, B of some freedoms that move by themselves, such as lean and steer in straight running.

        M, C and K have the shape (k, k), B (k, inputs).

        Parameters
        ----------
        names : sequence of str
            Of the freedoms, k of them.

        Raises
        ------
        ModelError
            Where the freedoms are coupled to the others, or are not both coordinates and speeds here.
        """
        for name in names:
            for what, known in (("speed", self.speeds), ("coordinate", self.coordinates)):
                if name not in known:
                    raise ModelError(unknown_name(what, name, known))
        rows = [self.speeds.index(name) for name in names]
        columns = [self.coordinates.index(name) for name in names]
        others = [i for i in range(len(self.speeds)) if i not in rows]
        rest = [i for i in range(len(self.coordinates)) if i not in columns]
        for matrix, outside in ((self.M, others), (self.C, others), (self.K, rest)):
            if np.any(abs(matrix[np.ix_(rows, outside)]) > 1e-8 * np.max(abs(matrix), initial=1.0)):
                raise ModelError(f"{', '.join(names)}: not decoupled from the other freedoms in this motion")
        pick = np.ix_(rows, rows)
        return self.M[pick], self.C[pick], self.K[np.ix_(rows, columns)], self.B[rows]


def _essential(
    state: State,
    response: Response,
    f: Array,
    v: Variations,
    keep: Sequence[str] | None,
) -> list[int]:
    """Return which independent coordinates matter: those that change forces, or the rates of others that do.

    Each entry is judged by itself, whatever its unit and whatever else is stiff: an entry of K that is only rounding
    changes by as much as its own size where the state is disturbed in its last digits, one that matters does not.
    """
    names = [state.model.system.coordinates[i] for i in state.partition.independent_coordinates]
    if keep is not None:
        for name in keep:
            if name not in names:
                raise ModelError(unknown_name("independent coordinate", name, names))
        return [names.index(name) for name in keep]
    noise = np.zeros_like(v.K)
    rng = np.random.default_rng(0)
    for _ in range(TRIALS):
        disturbed, changed = (_disturbed(given, rng) for given in (state, response))
        noise = np.maximum(noise, abs(vary(disturbed, changed, f).K - v.K))
    return [i for i in range(v.K.shape[1]) if np.any(abs(v.K[:, i]) > ABOVE * noise[:, i])]


def _disturbed(given: Any, rng: np.random.Generator) -> Any:
    """Return a state or response with every number changed in its last digits."""
    names = ("q", "u") if isinstance(given, State) else ("a", "multipliers")
    changes = {}
    for name in names:
        values = getattr(given, name)
        size = np.maximum(abs(values), 1.0 if name == "q" else 0.0)
        changes[name] = values + LAST_DIGITS * size * rng.uniform(-1.0, 1.0, values.shape)
    return replace(given, **changes)


def linearise(
    state: State,
    inputs: Mapping[str, float] | None = None,
    *,
    keep: Sequence[str] | None = None,
    outputs: Sequence[str] | None = None,
) -> Linearisation:
    """Linearise the motion about a steady state, exactly.

    Parameters
    ----------
    state
        A steady motion: equilibrium, straight running, steady turning (see :func:`steady_motion`).
    inputs
        Constant inputs of the steady motion, by name (N, N m).
    keep
        Names of the coordinates to keep; found automatically where None.
    outputs
        Names of coordinates, rates (``"lean'"``), accelerations (``"lean''"``), sensors, or constraints, whose
        multipliers are forces (``"front wheel (lateral)"``, N); by default all coordinates and rates kept.

    Raises
    ------
    ModelError
        Where the state is no steady motion: an independent speed accelerates, or a coordinate that matters moves.

    Examples
    --------
    >>> from singletrack.multibody import Body, System, assemble, build, revolute
    >>> bob = Body("bob", 2.0, (0, 0, 0.5))
    >>> model = build(System([bob], [revolute("swing", "ground", "bob", (0, 0, 0), (0, 1, 0))]))
    >>> small = linearise(assemble(model))
    >>> small.M.tolist(), small.K.tolist()
    ([[0.5]], [[9.81]])
    """
    system = state.model.system
    response = accelerations(state, inputs)
    f = input_vector(system, inputs)
    v = vary(state, response, f)
    names = [system.coordinates[i] for i in state.partition.independent_coordinates]
    kept = _essential(state, response, f, v, keep)
    _refuse_unsteady(state, response, [names[i] for i in kept])
    drive = v.span.T @ state.model.equations.input_matrix(state.q, state.parameters).full()
    places = [state.partition.independent_coordinates[i] for i in kept]
    coordinates, speeds = tuple(names[i] for i in kept), state.freedoms
    K = v.K[:, kept]
    rate_of_speeds, rate_of_coordinates = v.span[places], v.speed_changes[np.ix_(places, kept)]
    solved = np.linalg.solve(v.M, np.hstack([-K, -v.C, drive]))
    k, m, r = len(kept), len(speeds), drive.shape[1]
    A = np.block([[rate_of_coordinates, rate_of_speeds], [solved[:, : k + m]]])
    B = np.vstack([np.zeros((k, r)), solved[:, k + m :]])
    observed = tuple(outputs) if outputs is not None else (*coordinates, *(f"{name}'" for name in speeds))
    directions = np.hstack([v.coordinate_directions[:, kept], np.zeros_like(v.span)])
    speed_directions = np.hstack([v.speed_changes[:, kept], v.span])
    seen = observe(state, observed, directions, speed_directions)
    through = np.zeros((len(observed), r))
    if any(name.endswith("''") or name in system.rows for name in observed):
        columns = [*kept, *range(v.K.shape[1], v.K.shape[1] + m)]
        observe_responses(state, observed, v, columns, solved, seen, through)
    return Linearisation(
        state,
        coordinates,
        speeds,
        tuple(given.name for given in system.inputs),
        observed,
        v.M,
        v.C,
        K,
        drive,
        A,
        B,
        seen,
        through,
    )


def _refuse_unsteady(state: State, response: Response, kept: Sequence[str]) -> None:
    scale = max(1.0, float(np.max(abs(state.u), initial=0.0)) ** 2)
    for i in state.partition.independent_speeds:
        if abs(response.a[i]) > 1e-7 * scale:
            raise ModelError(
                f"not a steady motion: {state.model.system.coordinates[i]} accelerates by {response.a[i]:.3g}; "
                "find one with steady_motion"
            )
    for name in kept:
        if abs(state.rate(name)) > 1e-9 * scale:
            raise ModelError(f"not a steady motion: {name} matters, and changes at the rate {state.rate(name):.3g}")
