"""How hard it is to ride: least energy, quadratic cost, response to pushes and rough paths, largest torque."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
import scipy.linalg

from singletrack.control.measures import invariant_part
from singletrack.errors import InputError, unknown_name
from singletrack.linear import state_space

if TYPE_CHECKING:
    from singletrack.arrays import ArrayLike
    from singletrack.linear import StateSpace
    from singletrack.model import LinearModel

__all__ = ["Effort", "Weights", "effort", "feedback_gain", "least_energy"]


@dataclass(frozen=True)
class Weights:
    """What a torque is worth, in words a person can read.

    Attributes
    ----------
    angle : float
        Of lean and steer (and further coordinates), in rad, that costs as much as
    torque : float
        this torque, in N m.
    rate : float
        Rate in rad/s that costs as much.
    """

    angle: float = np.radians(1.0)
    torque: float = 1.0
    rate: float = np.radians(10.0)


@dataclass(frozen=True, eq=False)
class Effort:
    """What one input costs at k speeds.

    Attributes
    ----------
    input : str
    speeds : array, shape (k,)
        In m/s.
    least_energy : array, shape (k,)
        Least ∫ torque² dt in (N m)² s that brings the bicycle back from a push that starts it leaning at 0.1 rad/s;
        zero where it comes back by itself, infinite where the input cannot do it.
    cost : array, shape (k,)
        Quadratic cost of the best state feedback after the same push, in units of torque² s.
    push_norm : array, shape (k,)
        H2 norm from a unit impulse of lean torque to the input's torque under that feedback, in N m s^½ per N m s.
    largest_torque : array, shape (k,)
        Largest torque after the push under that feedback, in N m.
    """

    input: str
    speeds: np.ndarray
    least_energy: np.ndarray
    cost: np.ndarray
    push_norm: np.ndarray
    largest_torque: np.ndarray

    def to_dict(self) -> dict[str, Any]:
        """Return the figures for JSON; infinity as None."""
        names = ("least_energy", "cost", "push_norm", "largest_torque")
        return {name: [float(x) if np.isfinite(x) else None for x in getattr(self, name)] for name in names}


#: The push: the rate of lean, in rad/s, that it leaves the bicycle with.
PUSH = 0.1


def effort(
    model: LinearModel, speeds: ArrayLike, input_name: str = "steer torque", weights: Weights | None = None
) -> Effort:
    """Return what an input costs at speeds (k,) in m/s, for a single design.

    Parameters
    ----------
    model : LinearModel
    speeds : array, shape (k,)
    input_name : str
    weights : Weights, optional
        Of the quadratic cost.

    Raises
    ------
    InputError
        For a batch, or an input that the model does not have.

    Examples
    --------
    >>> from singletrack import coefficients, load_bicycle
    >>> found = effort(coefficients(load_bicycle("benchmark")), [3.0, 5.0])
    >>> bool(found.least_energy[0] > 0), float(found.least_energy[1])
    (True, 0.0)
    """
    if model.shape != ():
        raise InputError(f"models of shape {model.shape}: effort takes a single design")
    if input_name not in model.inputs:
        raise InputError(unknown_name("input", input_name, model.inputs))
    chosen = weights or Weights()
    v = np.atleast_1d(np.asarray(speeds, dtype=float))
    rows = np.array([_at_speed(state_space(model, float(speed)), input_name, chosen) for speed in v]).reshape(len(v), 4)
    return Effort(input_name, v, *rows.T)


def _push(system: StateSpace) -> np.ndarray:
    """Return the state (2 n,) that the push leaves: leaning at a rate."""
    state = np.zeros(len(system.states))
    state[system.states.index("lean rate")] = PUSH
    return state


def _at_speed(system: StateSpace, input_name: str, weights: Weights) -> tuple[float, float, float, float]:
    b = system.B[:, [system.inputs.index(input_name)]]
    start = _push(system)
    energy = least_energy(system.A, b, start)
    if not np.isfinite(energy):  # an unstable mode that the input does not reach: no feedback holds it
        return energy, np.inf, np.inf, np.inf
    try:
        gain, cost = feedback_gain(system.A, b, weights)
    except np.linalg.LinAlgError:
        return energy, np.inf, np.inf, np.inf
    closed = system.A - b @ gain
    lean = system.B[:, [0]]
    # ∫ |gain exp(closed t) lean|² dt, by the observability Gramian of the torque.
    seen = scipy.linalg.solve_continuous_lyapunov(closed.T, -gain.T @ gain)
    norm = float(np.sqrt(max((lean.T @ seen @ lean).item(), 0.0)))
    return energy, float(start @ cost @ start), norm, _largest(closed, gain, start)


def least_energy(A: np.ndarray, b: np.ndarray, start: np.ndarray) -> float:
    """Return the least ∫u² dt that brings a system back to rest from a state, in its units; infinite if it cannot be.

    Parameters
    ----------
    A : array, shape (N, N)
        In 1/s and whatever units the states have.
    b : array, shape (N, m)
        In units of the states for each of the input, 1/s.
    start : array, shape (N,)
        In units of the states.

    Notes
    -----
    The limit of the quadratic cost as all weight goes to the input: only unstable modes cost. On them, with A₊ and b₊,
    P A₊ᵀ + A₊ P = b₊ b₊ᵀ has a positive solution, and x₊ᵀ P⁻¹ x₊ is the energy (Kwakernaak and Sivan 1972, 3.8.3).

    Examples
    --------
    An unstable mode of rate one takes twice its square:

    >>> least_energy(np.array([[1.0]]), np.array([[1.0]]), np.array([3.0]))
    18.0
    """
    _, A_part, both = invariant_part(A, np.column_stack([b, start]), stable=False)
    if not A_part.size:
        return 0.0
    b_part, state = both[:, :-1], both[:, -1]
    P = scipy.linalg.solve_continuous_lyapunov(-A_part, -b_part @ b_part.T)
    least = np.linalg.eigvalsh((P + P.T) / 2)[0]
    if not least > 1e-14 * np.abs(P).max():
        return float("inf")
    return float(state @ np.linalg.solve(P, state))


def feedback_gain(A: np.ndarray, b: np.ndarray, weights: Weights) -> tuple[np.ndarray, np.ndarray]:
    """Return the gain (m, N) of the best state feedback u = -gain x, and the matrix (N, N) of its cost.

    Parameters
    ----------
    A : array, shape (N, N)
    b : array, shape (N, m)
    weights : Weights

    Raises
    ------
    LinAlgError
        If there is none: an unstable mode is not reached.
    """
    half = len(A) // 2
    Q = np.diag([weights.angle**-2.0] * half + [weights.rate**-2.0] * half) * weights.torque**2
    cost = scipy.linalg.solve_continuous_are(A, b, Q, np.eye(b.shape[1]))
    return b.T @ cost, cost


def _largest(closed: np.ndarray, gain: np.ndarray, start: np.ndarray) -> float:
    """Return the largest torque after the push: at its start, or where it turns, on a grid finer than any motion."""
    fastest, slowest = np.abs(np.linalg.eigvals(closed)), np.abs(np.linalg.eigvals(closed).real)
    step = 0.02 / fastest.max()
    steps = min(int(np.ceil(6.0 / slowest.min() / step)), 20_000)
    propagate = scipy.linalg.expm(closed * step)
    state, torques = start.copy(), np.empty(steps)
    for k in range(steps):
        torques[k] = (gain @ state).item() if gain.shape[0] == 1 else np.abs(gain @ state).max()
        state = propagate @ state
    return float(np.abs(torques).max())
