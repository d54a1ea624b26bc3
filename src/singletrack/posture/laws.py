"""What springs, dampers and preloads of a rider's joints add to the equations."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from singletrack.arrays import Array, Number, as_arrays, is_concrete

if TYPE_CHECKING:
    from singletrack.posture.seated import Posture
    from singletrack.posture.twists import Motion

__all__ = ["laws_of"]


def laws_of(posture: Posture, motion: Motion) -> tuple[Array | None, Array | None]:
    """Return what dampers and springs of the joints add to C0 and S0, (..., f, f) each; None without any.

    Parameters
    ----------
    posture : Posture
    motion : Motion

    Notes
    -----
    The potential of a joint's spring is k s^2 / 2 - p s, with s = sum U_i d_i + sum U_ij d_i d_j / 2.
    """
    tree = posture.tree
    found: list[Array | None] = []
    count = 1 + len(posture.freedoms)
    for law in ("damping", "stiffness"):
        added = None
        for k, joint in enumerate(posture.joints):
            value = getattr(joint, law)
            if _is_nothing(value) and _is_nothing(joint.preload):
                continue
            if not is_concrete(value) or np.any(np.asarray(value)):
                rates = _by_design(motion, motion.rates[k])
                term = as_arrays(value)[1][0][..., None, None] * rates[..., :, None] * rates[..., None, :]
                added = term if added is None else added + term
            if law == "stiffness" and not joint.free and np.any(np.asarray(joint.preload)):
                bends = _by_design(motion, motion.bends[k])
                square = np.zeros((count, count), dtype=int)
                square[tree.first, tree.second] = square[tree.second, tree.first] = range(len(tree.first))
                term = -as_arrays(joint.preload)[1][0][..., None, None] * bends[..., square]
                added = term if added is None else added + term
        found.append(added)
    return found[0], found[1]


def _is_nothing(value: Number) -> bool:
    return type(value) is float and value == 0.0


def _by_design(motion: Motion, values: Array) -> Array:
    """Return values (k, N) of one joint as (..., k)."""
    xp, (values,) = as_arrays(values)
    return xp.moveaxis(values.reshape(values.shape[0], *motion.shape), 0, -1)
