"""The equations at one speed as a first-order system, for control."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, ClassVar

import numpy as np

from singletrack.linear.eigenvalues import checked_speeds

if TYPE_CHECKING:
    from singletrack.linear.matrices import CoefficientMatrices

__all__ = ["StateSpace", "state_space"]


@dataclass(frozen=True, eq=False)
class StateSpace:
    """x' = A x + B u, y = C x + D u with x = y = (lean, steer, lean rate, steer rate), u = (lean, steer torque).

    Attributes
    ----------
    A : array, shape (..., 4, 4)
    B : array, shape (..., 4, 2)
    C : array, shape (4, 4)
    D : array, shape (4, 2)
        SI units: rad, rad/s, N m.
    speed : float
        In m/s.
    """

    A: np.ndarray
    B: np.ndarray
    C: np.ndarray
    D: np.ndarray
    speed: float

    states: ClassVar[tuple[str, ...]] = ("lean", "steer", "lean_rate", "steer_rate")
    inputs: ClassVar[tuple[str, ...]] = ("lean_torque", "steer_torque")

    def to_control(self) -> Any:
        """Return a single design as a ``control.StateSpace`` of the python-control library, with named signals."""
        import control  # lazy: heavy

        names = list(self.states)
        return control.ss(
            self.A, self.B, self.C, self.D, states=names, inputs=list(self.inputs), outputs=names, name="bicycle"
        )


def state_space(model: CoefficientMatrices, speed: float) -> StateSpace:
    """Return the first-order system at a forward speed in m/s.

    Examples
    --------
    >>> from singletrack import coefficients, load_bicycle
    >>> system = state_space(coefficients(load_bicycle("benchmark")), 5.0)
    >>> system.A.shape, system.B.shape
    ((4, 4), (4, 2))
    """
    v = float(checked_speeds(speed)[0])
    inverse = np.linalg.inv(np.asarray(model.M))
    shape = inverse.shape[:-2]
    zero, one = np.zeros((*shape, 2, 2)), np.broadcast_to(np.eye(2), (*shape, 2, 2))
    stiffness, damping = np.asarray(model.stiffness(v)), np.asarray(model.damping(v))
    upper = np.concatenate([zero, one], axis=-1)
    lower = -np.concatenate([inverse @ stiffness, inverse @ damping], axis=-1)
    A = np.concatenate([upper, lower], axis=-2)
    return StateSpace(A, np.concatenate([zero, inverse], axis=-2), np.eye(4), np.zeros((4, 2)), v)
