"""How well inputs reach modes: angles, distance to uncontrollability, Gramians."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
import scipy.linalg
import scipy.optimize

from singletrack.errors import InputError, unknown_name
from singletrack.linear import modes, state_space

if TYPE_CHECKING:
    from singletrack.arrays import ArrayLike
    from singletrack.linear import StateSpace
    from singletrack.model import LinearModel

__all__ = ["distance_to_uncontrollability", "gramian", "modal_controllability"]


def modal_controllability(model: LinearModel, speeds: ArrayLike) -> dict[str, np.ndarray]:
    """Return the angles between inputs and modes at speeds (k,), by input, shape (k, 2 n), in rad.

    The columns are the model's modes, in the order of their names; 90 deg: the mode is not reached.

    Notes
    -----
    ``cos β = |vᵢ* bⱼ| / (|vᵢ| |bⱼ|)`` with the left eigenvector vᵢ of the state matrix and the column bⱼ of its inputs
    (Hamdan and Nayfeh 1989, Journal of Guidance, Control, and Dynamics 12:421-428). The state is the coordinates in
    rad, then their rates in rad/s: the angle depends on these units.

    Raises
    ------
    InputError
        For a batch of designs.

    Examples
    --------
    >>> from singletrack import coefficients, load_bicycle
    >>> angles = modal_controllability(coefficients(load_bicycle("benchmark")), [5.0])
    >>> angles["steer torque"].shape
    (1, 4)
    """
    if model.shape != ():
        raise InputError(f"models of shape {model.shape}: modal controllability takes a single design")
    named = modes(model, speeds)
    system = state_space(model, named.speeds)
    values, left = _left_eigenvectors(system.A)
    order = _assigned(values, named.eigenvalues)
    left = np.take_along_axis(left, order[:, None, :], axis=-1)
    length = np.linalg.norm(left, axis=-2)
    angles = {}
    for j, name in enumerate(model.inputs):
        column = system.B[..., j]
        cosine = (
            np.abs(np.einsum("kij,ki->kj", left.conj(), column)) / length / np.linalg.norm(column, axis=-1)[:, None]
        )
        angles[name] = np.arccos(np.clip(cosine, 0.0, 1.0))
    return angles


def _left_eigenvectors(A: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return eigenvalues (k, N) and left eigenvectors (k, N, N), as columns v with v* A = λ v*."""
    values, vectors = np.linalg.eig(np.swapaxes(A, -1, -2))
    return values, vectors.conj()


def _assigned(values: np.ndarray, named: np.ndarray) -> np.ndarray:
    """Return, for named roots (k, N), the places of the same roots among values (k, N), each used once."""
    order = np.empty(named.shape, dtype=np.intp)
    for k, (own, wanted) in enumerate(zip(values, named, strict=True)):  # a few speeds at a time, small matrices
        order[k] = scipy.optimize.linear_sum_assignment(np.abs(wanted[:, None] - own[None, :]))[1]
    return order


def distance_to_uncontrollability(system: StateSpace, input_name: str) -> float:
    """Return how far (A, b) of a single system is from a pair that is not controllable (2-norm, in its units).

    Parameters
    ----------
    system : StateSpace
        At one speed.
    input_name : str
        The one input that acts.

    Notes
    -----
    The least singular value of (A - s, b) over all complex s (Eising 1984, Systems and Control Letters 4:263-264), from
    starts at all eigenvalues and between.

    Raises
    ------
    InputError
        For several systems.

    Examples
    --------
    >>> from singletrack import coefficients, load_bicycle
    >>> from singletrack.control import uncontrollable_speeds
    >>> model = coefficients(load_bicycle("benchmark"))
    >>> lost = uncontrollable_speeds(model, ["steer torque"])[0].speed
    >>> distance_to_uncontrollability(model.state_space(lost), "steer torque") < 1e-6
    True
    """
    if system.A.ndim != 2:
        raise InputError(f"systems of shape {system.A.shape[:-2]}: the distance takes a single one")
    b = system.B[:, _place(system, input_name)]

    def least(s: np.ndarray) -> float:
        shifted = system.A - (s[0] + 1j * s[1]) * np.eye(len(b))
        return float(np.linalg.svd(np.column_stack([shifted, b]), compute_uv=False)[-1])

    roots = np.linalg.eigvals(system.A)
    roots = roots[roots.imag >= 0]
    starts = [*roots, *((roots[:, None] + roots[None, :]) / 2).ravel()]
    found = [
        scipy.optimize.minimize(
            least, [s.real, s.imag], method="Nelder-Mead", options={"xatol": 1e-9, "fatol": 1e-12}
        ).fun
        for s in starts
    ]
    return float(min(found))


def gramian(system: StateSpace, input_name: str) -> np.ndarray:
    """Return the controllability Gramian (N, N) of a single system by one input, stable or not.

    Parameters
    ----------
    system : StateSpace
        At one speed.
    input_name : str
        The one input that acts.

    Notes
    -----
    W with x₀ᵀ W⁻¹ x₀ the least energy ∫u² that leads from rest to x₀ on the stable modes, and from x₀ to rest on the
    unstable ones (Zhou, Salomon and Wu 1999, International Journal of Robust and Nonlinear Control 9:183-198): the
    Gramians of both parts, each along its own invariant subspace.

    Raises
    ------
    InputError
        For several systems, or roots on the imaginary axis, whose Gramian is endless.

    Examples
    --------
    >>> from singletrack import coefficients, load_bicycle
    >>> gramian(coefficients(load_bicycle("benchmark")).state_space(5.0), "steer torque").shape
    (4, 4)
    """
    if system.A.ndim != 2:
        raise InputError(f"systems of shape {system.A.shape[:-2]}: the Gramian takes a single one")
    b = system.B[:, [_place(system, input_name)]]
    roots = np.linalg.eigvals(system.A)
    if (np.abs(roots.real) <= 1e-10 * np.abs(roots).max()).any():
        raise InputError("a root lies on the imaginary axis: the Gramian is endless")
    parts = []
    for stable in (True, False):
        basis, A_part, b_part = invariant_part(system.A, b, stable=stable)
        if A_part.size:
            sign = 1.0 if stable else -1.0
            own = scipy.linalg.solve_continuous_lyapunov(sign * A_part, -b_part @ b_part.T)
            parts.append(basis @ own @ basis.T)
    total: np.ndarray = sum(parts, np.zeros_like(system.A))
    return total


def invariant_part(A: np.ndarray, b: np.ndarray, *, stable: bool) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return the basis (N, r) of the stable or unstable modes, A (r, r) on it, and the part of b (N, m) on it (r, m).

    Modes on the imaginary axis (to rounding) count as stable: what little it takes to calm them has no lower bound.
    """
    edge = 1e-10 * np.abs(np.linalg.eigvals(A)).max()

    def wanted(root: complex) -> bool:
        return bool((root.real <= edge) == stable)

    form, basis, count = scipy.linalg.schur(A, output="real", sort=lambda x, y=0.0: wanted(complex(x, y)))
    # The part of b on the subspace, along the other subspace: by the left basis that annihilates the other.
    _, left_basis, _ = scipy.linalg.schur(A.T, output="real", sort=lambda x, y=0.0: wanted(complex(x, y)))
    own, left = basis[:, :count], left_basis[:, :count]
    on = np.linalg.solve(left.T @ own, left.T @ b)
    return own, form[:count, :count], on


def _place(system: StateSpace, input_name: str) -> int:
    if input_name not in system.inputs:
        raise InputError(unknown_name("input", input_name, system.inputs))
    return system.inputs.index(input_name)
