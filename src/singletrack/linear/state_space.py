"""The equations at given speeds as first-order systems, for control."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from singletrack.errors import InputError
from singletrack.linear.eigenvalues import checked_speeds

if TYPE_CHECKING:
    from singletrack.arrays import ArrayLike
    from singletrack.model import LinearModel

__all__ = ["StateSpace", "state_space"]


@dataclass(frozen=True, eq=False)
class StateSpace:
    """x' = A x + B u, y = C x + D u; x = y are the n coordinates, then their rates, u the m inputs.

    Attributes
    ----------
    A : array, shape (..., 2 n, 2 n)
    B : array, shape (..., 2 n, m)
    C : array, shape (2 n, 2 n)
    D : array, shape (2 n, m)
        SI units: rad, rad/s, N m.
    speed : float or array, shape (k,)
        In m/s; of several speeds, the last axis of (...) is k.
    states, inputs : tuple of str
        Such as ``lean``, ``lean rate``, ``steer torque``.
    """

    A: np.ndarray
    B: np.ndarray
    C: np.ndarray
    D: np.ndarray
    speed: float | np.ndarray
    states: tuple[str, ...]
    inputs: tuple[str, ...]

    def to_control(self) -> Any:
        """Return a single design at a single speed as a ``control.StateSpace`` of python-control, with named signals.

        Raises
        ------
        InputError
            For several designs or speeds.
        """
        import control

        if self.A.ndim > 2:
            raise InputError(f"to_control: these are systems of shape {self.A.shape[:-2]}, must be a single one")
        names = list(self.states)
        return control.ss(
            self.A, self.B, self.C, self.D, states=names, inputs=list(self.inputs), outputs=names, name="bicycle"
        )


def state_space(model: LinearModel, speed: ArrayLike) -> StateSpace:
    """Return the first-order systems at a forward speed () or at several (k,) in m/s.

    Examples
    --------
    >>> from singletrack import coefficients, load_bicycle
    >>> model = coefficients(load_bicycle("benchmark"))
    >>> state_space(model, 5.0).A.shape, state_space(model, [4.0, 9.0]).A.shape
    ((4, 4), (2, 4, 4))
    """
    v = checked_speeds(speed)
    several = np.ndim(speed) > 0
    whole = model.broadcast_to(model.shape)
    if several:  # speeds on an axis of their own, after those of the batch
        whole = whole[..., None]
    speeds = v if several else v[0]
    M = np.where(whole.valid[..., None, None], whole.M, np.nan)  # faulty designs are NaN throughout
    inverse = np.linalg.inv(M)
    stiffness, damping = np.asarray(whole.stiffness(speeds)), np.asarray(whole.damping(speeds))
    n, m = model.freedoms, len(model.inputs)
    shape = np.broadcast_shapes(stiffness.shape[:-2], damping.shape[:-2])
    upper = np.broadcast_to(np.eye(n, 2 * n, n), (*shape, n, 2 * n))
    lower = -np.concatenate([np.broadcast_to(inverse @ part, (*shape, n, n)) for part in (stiffness, damping)], axis=-1)
    inputs = np.broadcast_to(inverse @ whole.B, (*shape, n, m))
    B = np.concatenate([np.zeros((*shape, n, m)), inputs], axis=-2)
    states = (*model.coordinates, *(f"{name} rate" for name in model.coordinates))
    A = np.concatenate([upper, lower], axis=-2)
    return StateSpace(A, B, np.eye(2 * n), np.zeros((2 * n, m)), v if several else float(v[0]), states, model.inputs)
