"""Random models of any number of freedoms: M symmetric positive definite, anything else anything."""

from __future__ import annotations

import numpy as np

from singletrack.model import LinearModel

NAMES = ("lean", "steer", "torso lean", "head lean")


def random_model(n: int, count: int, seed: int, *, damped: bool = True) -> LinearModel:
    """Return a batch (count,) of models with n freedoms, with or without springs and dampers."""
    rng = np.random.default_rng(seed)
    root, stiff = rng.normal(size=(2, count, n, n))
    C0, S0 = rng.normal(size=(2, count, n, n)) * damped
    return LinearModel(
        M=root @ np.swapaxes(root, 1, 2) + 0.3 * np.eye(n),
        C1=rng.normal(size=(count, n, n)),
        K0=stiff + np.swapaxes(stiff, 1, 2),
        K2=rng.normal(size=(count, n, n)),
        gravity=np.array(9.81),
        C0=C0,
        S0=S0,
        coordinates=NAMES[:n],
        inputs=tuple(f"{name} torque" for name in NAMES[:n]),
    )
