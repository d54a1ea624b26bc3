"""Coefficients of a batch of designs, stretch by stretch: the same bits and faults however it is cut."""

from __future__ import annotations

import dataclasses
from threading import Lock
from typing import TYPE_CHECKING, Any

import numpy as np

from singletrack.arrays import Fault, in_stretches, is_jax, valid_mask
from singletrack.parameters.part import part_of_record

if TYPE_CHECKING:
    from collections.abc import Callable

    from singletrack.model import LinearModel
    from singletrack.parameters import Bicycle, Rider
    from singletrack.posture import Options

__all__ = ["STRETCH", "batch_shape", "in_parts"]

#: Designs treated at a time, so that what is being worked on stays in the processor's cache.
STRETCH = 4096
_MATRICES = ("M", "C1", "K0", "K2", "C0", "S0")


def batch_shape(bicycle: Bicycle, rider: Rider | None, options: Options) -> tuple[int, ...] | None:
    """Return the shape of a batch that may be cut into stretches, None for a single design or arrays of JAX.

    Parameters
    ----------
    bicycle, rider, options
        As for :func:`singletrack.closed_form.coefficients`.
    """
    if bicycle.is_single and (rider is None or rider.is_single) and not (options.springs or options.dampers):
        return None
    varied: list[Any] = [*bicycle.values().values(), *options.springs.values(), *options.dampers.values()]
    varied += [] if options.fit is None else [options.fit]
    varied += [] if rider is None else [*rider.values().values(), *rider.forward_lean_angles.values()]
    if is_jax(*varied) or not (isinstance(options.posture, str) and (rider is None or not rider.shapes)):
        return None
    try:
        shape = np.broadcast_shapes(*(np.shape(value) for value in varied))
    except ValueError:  # said where they meet
        return None
    return shape or None


def in_parts(
    make: Callable[[Bicycle, Rider | None, Options], LinearModel],
    bicycle: Bicycle,
    rider: Rider | None,
    options: Options,
    shape: tuple[int, ...],
) -> LinearModel:
    """Return the model of a batch, made in stretches.

    Parameters
    ----------
    make : callable
        Makes the model of a batch on one axis from bicycle, rider and options; of its faults it keeps those that hit.
    bicycle, rider, options
        The batch.
    shape : tuple of int
        Its shape.
    """

    def made(which: slice | np.ndarray) -> LinearModel:
        of_rider = None if rider is None else part_of_record(rider, which, shape)
        return make(part_of_record(bicycle, which, shape), of_rider, options.part(which, shape))

    count = int(np.prod(shape))
    parts = _Parts(count)
    in_stretches(lambda piece: parts.take(piece, made(piece)), count, STRETCH)
    found = _in_order(_merged(parts.faults, count), made)
    standing = bicycle.standing_faults + (() if rider is None else rider.standing_faults)
    faults = standing + tuple(_shaped(fault, shape) for fault in found)
    parts.forget_signs(~valid_mask(faults, shape).ravel())
    return dataclasses.replace(parts.first(), **parts.matrices(shape), gravity=bicycle.gravity, faults=faults)


class _Parts:
    """The matrices of a batch as they come, the designs of each entry side by side in memory."""

    def __init__(self, count: int) -> None:
        self.count = count
        self.lock = Lock()
        self.models: dict[int, LinearModel] = {}
        self.faults: dict[int, tuple[slice, tuple[Fault, ...]]] = {}
        self.full: dict[str, np.ndarray] = {}

    def take(self, piece: slice, model: LinearModel) -> None:
        """Note the designs of a piece."""
        for name in _MATRICES:
            matrix = getattr(model, name)
            if matrix.ndim > 2:
                with self.lock:
                    if name not in self.full:
                        self.full[name] = np.empty((*matrix.shape[-2:], self.count), dtype=matrix.dtype)
                self.full[name][..., piece] = np.moveaxis(matrix, 0, -1)
        self.models[piece.start] = dataclasses.replace(model, **_without_designs(model), faults=(), gravity=1.0)
        self.faults[piece.start] = piece, model.faults

    def forget_signs(self, bad: np.ndarray) -> None:
        """Make all that is no number the same: its sign says how many designs were treated at a time."""
        if bad.any():
            for full in self.full.values():
                some = full[..., bad]
                full[..., bad] = np.where(np.isnan(some), np.nan, some)

    def first(self) -> LinearModel:
        """Return the model of the first piece, for its names."""
        return self.models[min(self.models)]

    def matrices(self, shape: tuple[int, ...]) -> dict[str, Any]:
        """Return the matrices, (*shape, n, n) each, or (n, n) where they are the same for all designs."""
        found = {name: getattr(self.first(), name) for name in _MATRICES}
        for name, full in self.full.items():
            found[name] = np.moveaxis(full.reshape(*full.shape[:2], *shape), (0, 1), (-2, -1))
        return found


def _without_designs(model: LinearModel) -> dict[str, Any]:
    """Return zeros for the matrices that have designs, which are kept elsewhere."""
    return {name: np.zeros(getattr(model, name).shape[-2:]) for name in _MATRICES if getattr(model, name).ndim > 2}


def _merged(found: dict[int, tuple[slice, tuple[Fault, ...]]], count: int) -> list[Fault]:
    """Return each fault once, with a mask and values over all designs; values of designs without it are zero."""
    kinds: dict[Any, list[tuple[slice, Fault]]] = {}
    for start in sorted(found):
        piece, faults = found[start]
        for fault in faults:
            kinds.setdefault((fault.text, fault.error, fault.parameters, fault.allowed), []).append((piece, fault))
    return [_whole(pieces, count) for pieces in kinds.values()]


def _whole(pieces: list[tuple[slice, Fault]], count: int) -> Fault:
    first = pieces[0][1]
    bad = np.zeros(count, dtype=bool)
    values = {}
    for name in first.values:
        kinds = [np.asarray(fault.values[name]).dtype for _, fault in pieces]
        values[name] = np.zeros(count, dtype=np.result_type(*kinds))
    for piece, fault in pieces:
        own = np.broadcast_to(np.asarray(fault.bad), bad[piece].shape)
        bad[piece] |= own
        for name, value in fault.values.items():
            values[name][piece][own] = np.broadcast_to(np.asarray(value), own.shape)[own]
    return dataclasses.replace(first, bad=bad, values=values)


def _in_order(faults: list[Fault], made: Callable[[np.ndarray], LinearModel]) -> list[Fault]:
    """Return faults in the order in which they are found in a batch that has them all, whatever stretch each was in."""
    if len(faults) < 2:
        return faults
    one_of_each = np.unique([int(np.argmax(fault.bad)) for fault in faults])
    texts = [fault.text for fault in made(one_of_each).faults]
    return sorted(faults, key=lambda fault: texts.index(fault.text))


def _shaped(fault: Fault, shape: tuple[int, ...]) -> Fault:
    values = {name: np.reshape(value, shape) for name, value in fault.values.items()}
    return dataclasses.replace(fault, bad=np.reshape(fault.bad, shape), values=values)
