"""Speeds at which an input loses a mode, found as roots.

With the state matrix A(v) of degree two in the speed and an input b, a mode λ is lost where (A - λ, b) has no full
rank (Popov, Belevitch and Hautus): then no feedback b kᵀ moves λ. So A(v) and A(v) + b kᵀ share an eigenvalue there for
every k, and their Kronecker sum

    A(v) ⊗ 1 - 1 ⊗ (A(v) + b kᵀ)ᵀ

is singular: a polynomial eigenvalue problem in v. Its solutions hold all losses, and chance meetings for the k chosen;
each is refined by Newton's method on wᵀ (A(v) - λ) = 0, wᵀ b = 0, to which chance meetings do not converge.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
import scipy.linalg

from singletrack.errors import InputError, unknown_name
from singletrack.linear import modes

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from singletrack.model import LinearModel

__all__ = ["LostMode", "state_polynomial", "uncontrollable_speeds"]

#: Losses beyond this many m/s are no bicycle's; solutions at infinity end up there by rounding.
FASTEST = 1e3
_SAME = 1e-7
_REAL = 1e-9


@dataclass(frozen=True)
class LostMode:
    """A speed at which a mode cannot be reached by an input.

    Attributes
    ----------
    input : str
    speed : float
        In m/s.
    eigenvalue : complex
        Of the lost mode, in 1/s.
    eigenvector : tuple of complex
        The coordinates in the lost mode, of length one, the largest of them positive.
    mode : str
        Its name.
    """

    input: str
    speed: float
    eigenvalue: complex
    eigenvector: tuple[complex, ...]
    mode: str

    def to_dict(self) -> dict[str, Any]:
        """Return the loss for JSON, complex numbers as [re, im]."""
        vector = [[part.real, part.imag] for part in self.eigenvector]
        value = [self.eigenvalue.real, self.eigenvalue.imag]
        return {
            "input": self.input,
            "speed": self.speed,
            "eigenvalue": value,
            "eigenvector": vector,
            "mode": self.mode,
        }


def state_polynomial(model: LinearModel) -> tuple[np.ndarray, np.ndarray]:
    """Return the state matrix of a single design as a polynomial in the speed, and its inputs.

    Parameters
    ----------
    model : LinearModel
        Of n freedoms and m inputs.

    Returns
    -------
    A : array, shape (3, 2 n, 2 n)
        Coefficients of v⁰, v¹, v²; the state is the coordinates, then their rates.
    B : array, shape (2 n, m)

    Examples
    --------
    >>> from singletrack import coefficients, load_bicycle
    >>> A, B = state_polynomial(coefficients(load_bicycle("benchmark")))
    >>> A.shape, B.shape
    ((3, 4, 4), (4, 2))
    """
    if model.shape != ():
        raise InputError(f"models of shape {model.shape}: controllability takes a single design")
    n, m = model.freedoms, len(model.inputs)
    M, C0, C1, S0, K0, K2, B = (
        np.asarray(getattr(model, x), dtype=float) for x in ("M", "C0", "C1", "S0", "K0", "K2", "B")
    )
    inverse = np.linalg.inv(M)
    A = np.zeros((3, 2 * n, 2 * n))
    A[0, :n, n:] = np.eye(n)
    A[0, n:, :n] = -inverse @ (S0 + float(model.gravity) * K0)
    A[0, n:, n:], A[1, n:, n:] = -inverse @ C0, -inverse @ C1
    A[2, n:, :n] = -inverse @ K2
    return A, np.concatenate([np.zeros((n, m)), inverse @ B])


def uncontrollable_speeds(model: LinearModel, inputs: Sequence[str] | None = None) -> list[LostMode]:
    """Return every speed above zero at which a mode is lost to an input, by input, then speed.

    Parameters
    ----------
    model : LinearModel
        A single design.
    inputs : sequence of str, optional
        Names of inputs, each taken alone; by default all of the model.

    Raises
    ------
    InputError
        For a batch, or an input that the model does not have.

    Examples
    --------
    >>> from singletrack import coefficients, load_bicycle
    >>> lost = uncontrollable_speeds(coefficients(load_bicycle("benchmark")), ["steer torque"])
    >>> [(round(one.speed, 4), round(one.eigenvalue.real, 4)) for one in lost]
    [(0.0251, 3.1347), (1.411, -3.1347)]
    """
    A, B = state_polynomial(model)
    found = []
    for name in model.inputs if inputs is None else inputs:
        if name not in model.inputs:
            raise InputError(unknown_name("input", name, model.inputs))
        losses = [
            _lost(model, A, name, speed, root)
            for speed, root in _losses(A, B[:, model.inputs.index(name)])
            if 0 < speed < FASTEST
        ]
        found += sorted(losses, key=lambda loss: loss.speed)
    return found


def _losses(A: np.ndarray, b: np.ndarray) -> list[tuple[float, complex]]:
    """Return (speed, eigenvalue) of all losses to an input b (2 n,) at real speeds."""
    if not b.any():
        raise InputError("an input that works on nothing controls nothing")
    scaled, speed, rate = _scaled(A)
    found: list[tuple[float, complex]] = []
    for start in _meetings(scaled, b / np.linalg.norm(b)):
        for root, left in _common_roots(scaled, start, b):
            refined = _refine(scaled, b, start, root, left)
            if refined is None:
                continue
            v, eigenvalue = refined
            if v * speed > 0 and not any(_near((v * speed, eigenvalue * rate), other) for other in found):
                found.append((v * speed, eigenvalue * rate))
    return found


def _scaled(A: np.ndarray) -> tuple[np.ndarray, float, float]:
    """Return A in units of speed and time in which its parts are of order one, and these units' sizes."""
    n = A.shape[1] // 2
    rate = np.sqrt(max(np.abs(A[0, n:, :n]).max(), np.abs(A[0, n:, n:]).max() ** 2)) or 1.0
    parts = [np.abs(A[1, n:, n:]).max() / rate, np.sqrt(np.abs(A[2, n:, :n]).max()) / rate]
    speed = 1.0 / max(*parts, 1e-300) if max(parts) > 0 else 1.0
    scaled = A.copy()
    scaled[:, n:, :n] /= rate**2
    scaled[:, n:, n:] /= rate
    return scaled * (speed ** np.arange(3))[:, None, None], float(speed), float(rate)


def _meetings(A: np.ndarray, b: np.ndarray) -> Iterator[float]:
    """Yield the speeds (real to some digits) at which A(v) and A(v) + b kᵀ share an eigenvalue."""
    size = len(b)
    k = np.random.default_rng(20080319).standard_normal(size)  # any will do; fixed, so that results are the same
    one = np.eye(size)
    parts = [np.kron(part, one) - np.kron(one, part.T) for part in A]
    parts[0] = parts[0] - np.kron(one, np.outer(k, b))
    order = size**2
    left, right = np.eye(2 * order), np.eye(2 * order)
    left[:order, :order], left[:order, order:] = 0.0, np.eye(order)
    left[order:, :order], left[order:, order:] = -parts[0], -parts[1]
    right[order:, order:] = parts[2]
    values = scipy.linalg.eigvals(left, right)
    finite = values[np.isfinite(values)]
    near = finite[(finite.real > 0) & (np.abs(finite.imag) < 1e-3 * (np.abs(finite) + 1e-6))]
    yield from (float(v) for v in np.unique(near.real))


def _at(A: np.ndarray, v: float) -> np.ndarray:
    matrix: np.ndarray = A[0] + v * (A[1] + v * A[2])
    return matrix


def _common_roots(A: np.ndarray, v: float, b: np.ndarray) -> Iterator[tuple[complex, np.ndarray]]:
    """Yield the eigenvalues, with left eigenvectors, that an input hardly reaches at a speed, best candidates first."""
    values, left = scipy.linalg.eig(_at(A, v), left=True, right=False)
    reached = np.abs(left.conj().T @ b) / np.linalg.norm(b)
    for k in np.argsort(reached)[:2]:
        yield complex(values[k]), left[:, k].conj()


#: Scaled speeds and eigenvalues are of order one; beyond this nothing is sought.
_FAR = 1e12


def _refine(A: np.ndarray, b: np.ndarray, v: float, root: complex, left: np.ndarray) -> tuple[float, complex] | None:
    """Return speed and eigenvalue with wᵀ (A - λ) = 0, wᵀ b = 0, by Newton's method, or None if there is none near."""
    size = len(b)
    w, b, start = left / np.linalg.norm(left), b / np.linalg.norm(b), left.conj() / np.linalg.norm(left)
    speed: complex = v
    for _ in range(30):
        if not abs(speed) + abs(root) < _FAR:  # gone astray
            return None
        matrix, slope = A[0] + speed * (A[1] + speed * A[2]), A[1] + 2 * speed * A[2]
        residual = np.concatenate([w @ matrix - root * w, [w @ b, w @ start - 1.0]])
        jacobian = np.zeros((size + 2, size + 2), dtype=complex)
        jacobian[:size, :size] = matrix.T - root * np.eye(size)
        jacobian[:size, size], jacobian[:size, size + 1] = -w, w @ slope
        jacobian[size, :size], jacobian[size + 1, :size] = b, start
        try:
            step = np.linalg.solve(jacobian, -residual)
        except np.linalg.LinAlgError:
            return None
        w, root, speed = w + step[:size], root + step[size], speed + step[size + 1]
        if np.abs(step[size:]).max() <= 1e-15 * (abs(root) + abs(speed)):
            break
    else:
        if np.abs(step[size:]).max() > 1e-12 * (abs(root) + abs(speed) + 1e-12):
            return None
    if abs(speed.imag) > _REAL * (abs(speed) + 1e-3) or not np.isfinite(speed):
        return None
    if abs(root.imag) <= _REAL * abs(root):
        root = complex(root.real)
    return float(speed.real), complex(root)


def _near(one: tuple[float, complex], other: tuple[float, complex]) -> bool:
    same_speed = abs(one[0] - other[0]) <= _SAME * max(one[0], other[0])
    return same_speed and abs(one[1] - other[1]) <= _SAME * (abs(one[1]) + abs(other[1]) + 1e-3)


def _lost(model: LinearModel, A: np.ndarray, name: str, speed: float, root: complex) -> LostMode:
    n = model.freedoms
    values, vectors = np.linalg.eig(_at(A, speed))
    vector = vectors[:n, np.argmin(np.abs(values - root))]
    largest = vector[np.argmax(np.abs(vector))]
    vector = vector * abs(largest) / largest / np.linalg.norm(vector)
    named = modes(model, speed)
    column = int(np.argmin(np.abs(named.eigenvalues[0] - root)))
    return LostMode(name, speed, root, tuple(complex(part) for part in vector), named.names[column])
