"""The aim of least control effort, with its exact gradient."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
import scipy.linalg

from singletrack.control.effort import PUSH, Weights, feedback_gain
from singletrack.errors import InputError, unknown_name
from singletrack.linear import state_space
from singletrack.linear.eigenvalues import checked_speeds

if TYPE_CHECKING:
    from singletrack.analysis.derivatives import Derivatives

__all__ = ["LeastEffort"]


@dataclass(frozen=True)
class LeastEffort:
    """Least effort at speeds in m/s: the quadratic cost of the best feedback after a push, its mean over the speeds."""

    speeds: tuple[float, ...]
    input_name: str = "steer torque"

    def __post_init__(self) -> None:
        checked_speeds(self.speeds)

    @property
    def name(self) -> str:
        """What it is."""
        return f"cost of control by {self.input_name} at {', '.join(f'{v:g}' for v in self.speeds)} m/s"

    def __call__(self, slopes: Derivatives) -> tuple[np.ndarray, np.ndarray]:
        """Return one number (1,) and its gradient (1, k).

        Parameters
        ----------
        slopes : Derivatives

        Raises
        ------
        InputError
            If the model has no such input, or it cannot hold the bicycle up.

        Notes
        -----
        With P the cost, K the gain and X the Gramian of the closed loop from the push, the change of the cost is
        2 tr(P (dA - dB K) X): the Riccati equation differentiated, and its Lyapunov equation taken to the other side.
        """
        rows = [self._at(slopes, speed) for speed in self.speeds]
        value, gradient = sum(row[0] for row in rows), sum((row[1] for row in rows), np.zeros(len(slopes.names)))
        return np.array([value]) / len(rows), gradient[None] / len(rows)

    def _at(self, slopes: Derivatives, speed: float) -> tuple[float, np.ndarray]:
        model = slopes.model
        if self.input_name not in model.inputs:
            raise InputError(unknown_name("input", self.input_name, model.inputs))
        column = model.inputs.index(self.input_name)
        system = state_space(model, speed)
        A, b, n = system.A, system.B[:, [column]], model.freedoms
        try:
            gain, cost = feedback_gain(A, b, Weights())
        except np.linalg.LinAlgError:
            raise InputError(f"{self.input_name} at {speed:g} m/s: cannot hold the bicycle up") from None
        push = np.zeros((2 * n, 1))
        push[n, 0] = PUSH
        gramian = scipy.linalg.solve_continuous_lyapunov(A - b @ gain, -push @ push.T)
        d = slopes.matrices
        damping, stiffness = speed * d["C1"], speed**2 * d["K2"] + model.gravity * d["K0"]
        stiffness = stiffness + slopes.gravity[:, None, None] * np.asarray(model.K0)
        if "C0" in d:
            damping, stiffness = damping + d["C0"], stiffness + d["S0"]
        accelerations = np.concatenate([stiffness, damping], axis=-1) + d["M"] @ A[n:]  # M dA = -(dK, dC) - dM A
        lower = -np.linalg.solve(np.asarray(model.M), accelerations)
        push_down = np.linalg.solve(np.asarray(model.M), d["M"] @ b[n:])  # M db = -dM b
        change = np.concatenate([np.zeros_like(lower), lower + push_down @ gain], axis=1)
        row: np.ndarray = 2 * np.einsum("ij,kjl,li->k", cost, change, gramian)
        return float((push.T @ cost @ push).item()), row
