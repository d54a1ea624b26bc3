"""What is seen of a linear model beside its coordinates: a plain record of rows, as the model is one of equations.

    y = M q'' + (C0 + v C1) q' + (S0 + g K0 + v² K2) q + B f

with the model's coordinates q and inputs f; y are changes from the values at rest, straight ahead.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any, Self

import numpy as np

from singletrack.arrays import Array, Number
from singletrack.errors import InputError, unknown_name

if TYPE_CHECKING:
    from collections.abc import Sequence

__all__ = ["Outputs"]

_ROWS = ("M", "C0", "C1", "S0", "K0", "K2", "B")


@dataclass(frozen=True, eq=False)
class Outputs:
    """``y = M q'' + (C0 + v C1) q' + (S0 + g K0 + v^2 K2) q + B f``, o outputs of a model; SI units, radians.

    Attributes
    ----------
    names : tuple of str
        Of the o outputs.
    M, C0, C1, S0, K0, K2 : array, shape (..., o, n)
        By the coordinates' accelerations, rates and values.
    B : array, shape (..., o, m)
        What the inputs do at once.
    gravity : array, shape broadcastable to (...)
        In m/s^2.
    coordinates, inputs : tuple of str
        Names of the n coordinates and m inputs, as in the model.
    rest : array, shape (..., o)
        Values at rest, to which y is to be added.
    """

    names: tuple[str, ...]
    M: Array
    C0: Array
    C1: Array
    S0: Array
    K0: Array
    K2: Array
    B: Array
    gravity: Number
    coordinates: tuple[str, ...]
    inputs: tuple[str, ...]
    rest: Array

    def __post_init__(self) -> None:
        for name in _ROWS:
            wanted = (len(self.names), len(self.inputs if name == "B" else self.coordinates))
            if np.shape(getattr(self, name))[-2:] != wanted:
                found = np.shape(getattr(self, name))
                raise InputError(f"outputs: {name} has shape {found}, must be (..., {wanted[0]}, {wanted[1]})")

    def select(self, names: Sequence[str]) -> Self:
        """Return some of the outputs, in the order asked for.

        Parameters
        ----------
        names : sequence of str

        Raises
        ------
        InputError
            For an unknown name.
        """
        for name in names:
            if name not in self.names:
                raise InputError(unknown_name("output", name, self.names))
        places = [self.names.index(name) for name in names]
        some: dict[str, Any] = {name: np.asarray(getattr(self, name))[..., places, :] for name in _ROWS}
        return replace(self, names=tuple(names), rest=np.asarray(self.rest)[..., places], **some)

    def __getitem__(self, index: Any) -> Self:
        """Return the outputs of some designs of a batch: an index, slice or mask of the batch's axes."""
        shapes = [np.shape(getattr(self, name))[:-2] for name in _ROWS]
        shape = np.broadcast_shapes(np.shape(self.gravity), np.shape(self.rest)[:-1], *shapes)
        of_batch = index if isinstance(index, tuple) else (index,)
        some: dict[str, Any] = {"gravity": np.broadcast_to(np.asarray(self.gravity), shape)[of_batch]}
        for name in (*_ROWS, "rest"):
            own = np.asarray(getattr(self, name))
            tail = own.shape[-1:] if name == "rest" else own.shape[-2:]
            full = (slice(None),) * len(tail) if any(i is Ellipsis for i in of_batch) else ()
            some[name] = np.broadcast_to(own, (*shape, *tail))[(*of_batch, *full)]
        return replace(self, **some)

    def inputs_of(self, names: Sequence[str]) -> np.ndarray:
        """Return B (..., o, m) of the inputs named.

        Parameters
        ----------
        names : sequence of str
            Of m inputs.

        Raises
        ------
        InputError
            For an input of which it is not known what it does to forces at once. What does not vary with accelerations,
            such as an angle, no input changes at once.
        """
        known = [self.inputs.index(name) if name in self.inputs else -1 for name in names]
        if -1 in known and np.any(np.asarray(self.M)):
            name = names[known.index(-1)]
            raise InputError(
                f"input {name!r}: what it does at once to a hand is not known: ask with outputs = "
                f"rider_outputs(..., forces={{{name!r}: POINT}}), which is told where it acts"
            )
        B = np.concatenate([np.asarray(self.B), np.zeros((*np.shape(self.B)[:-1], 1))], axis=-1)
        return B[..., known]
