"""Operations of JAX that only move entries about, done by NumPy on whatever the entries are.

JAX could do them itself, and does the rarer ones; but it compiles each for each shape, which takes longer than a trace.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Callable

__all__ = ["MOVES"]


def _broadcast(array: np.ndarray, *, shape: tuple[int, ...], broadcast_dimensions: tuple[int, ...], **_: Any) -> Any:
    spread = [1] * len(shape)
    for own, axis in enumerate(broadcast_dimensions):
        spread[axis] = array.shape[own]
    return np.broadcast_to(array.reshape(spread), shape)


def _slice(array: np.ndarray, *, start_indices: Any, limit_indices: Any, strides: Any) -> Any:
    steps = strides or [1] * array.ndim
    return array[tuple(map(slice, start_indices, limit_indices, steps))]


#: By the operation's name, on arrays of one kind and the operation's parameters.
MOVES: dict[str, Callable[..., Any]] = {
    "broadcast_in_dim": _broadcast,
    "reshape": lambda array, *, new_sizes, **_: array.reshape(new_sizes),
    "squeeze": lambda array, *, dimensions: np.squeeze(array, dimensions),
    "transpose": lambda array, *, permutation: array.transpose(permutation),
    "slice": _slice,
    "rev": lambda array, *, dimensions: np.flip(array, dimensions),
    "concatenate": lambda *arrays, dimension: np.concatenate(arrays, dimension),
}
