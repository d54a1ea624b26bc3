"""Some designs of a batch as a record of their own."""

from __future__ import annotations

from math import prod
from typing import TYPE_CHECKING, TypeVar

import numpy as np

from singletrack.arrays import part_of
from singletrack.parameters.record import Record
from singletrack.parameters.values import FrozenDict

if TYPE_CHECKING:
    from singletrack.arrays import Array

__all__ = ["part_of_record"]

_Record = TypeVar("_Record", bound=Record)


def part_of_record(record: _Record, which: slice | Array, shape: tuple[int, ...]) -> _Record:
    """Return some designs of a batch as a record, on one axis, without their faults.

    Nothing is checked again; what does not vary stays a number.

    Parameters
    ----------
    record : Record
    which : slice or array of int, shape (k,)
        Indices of designs, as numbered along one axis.
    shape : tuple of int
        Of a batch to which the parameters broadcast.

    Examples
    --------
    >>> from singletrack import load_bicycle
    >>> bicycle = load_bicycle("benchmark").replace(trail=[0.05, 0.06, 0.07])
    >>> part_of_record(bicycle, slice(1, 3), (3,)).trail.tolist()
    [0.06, 0.07]
    """
    other = object.__new__(type(record))
    own = dict(record.__dict__)
    for name, value in own.items():
        if isinstance(value, np.ndarray):
            own[name] = part_of(value, which, shape)
        elif isinstance(value, FrozenDict):
            own[name] = FrozenDict({key: part_of(one, which, shape) for key, one in value.items()})
    count = len(range(prod(shape))[which]) if isinstance(which, slice) else len(which)
    own["_standing"], own["_shape"] = (), (count,) if record.shape else ()
    other.__dict__.update(own)
    return other
