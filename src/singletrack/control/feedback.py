"""State feedback on a linear model: a model again, whose eigenvalues and critical speeds are asked like any other's."""

from __future__ import annotations

import dataclasses
from typing import TYPE_CHECKING, Any

import numpy as np

from singletrack.control.effort import Weights, feedback_gain
from singletrack.errors import InputError, unknown_name
from singletrack.linear import state_space

if TYPE_CHECKING:
    from collections.abc import Sequence

    from singletrack.arrays import ArrayLike
    from singletrack.model import LinearModel
    from singletrack.parameters.feedback import Gains

__all__ = ["closed_loop", "lqr_schedule"]


def closed_loop(model: LinearModel, gains: Gains) -> LinearModel:
    """Return a model with feedback: input = sum of gain times signal, added to what else the input does.

    Parameters
    ----------
    model : LinearModel
    gains : mapping of (str, str) to float or sequence of float
        By (input, signal), such as ``("steer torque", "lean rate")``: signals are coordinates and their rates, gains in
        N m/rad and N m s/rad. A sequence holds the coefficients of 1, v and v²: of a rate at most v, of a coordinate v⁰
        and v².

    Raises
    ------
    InputError
        For an input or a signal that the model does not have, or a dependence on the speed that no matrix holds.

    Examples
    --------
    Steer into the fall: the riderless benchmark bicycle is then stable from a lower speed on.

    >>> from singletrack import coefficients, load_bicycle
    >>> from singletrack.linear import critical_speeds
    >>> model = coefficients(load_bicycle("benchmark"))
    >>> helped = closed_loop(model, {("steer torque", "lean rate"): 10.0})
    >>> critical_speeds(helped).weave[0] < critical_speeds(model).weave[0]
    True
    """
    parts: dict[str, Any] = {name: np.array(getattr(model, name), dtype=float) for name in ("C0", "C1", "S0", "K2")}
    places = {name: (i, False) for i, name in enumerate(model.coordinates)}
    places |= {f"{name} rate": (i, True) for i, name in enumerate(model.coordinates)}
    B = np.asarray(model.B, dtype=float)
    for (target, signal), gain in gains.items():
        if target not in model.inputs:
            raise InputError(unknown_name("input", target, model.inputs))
        if signal not in places:
            raise InputError(unknown_name("signal", signal, places))
        column, is_rate = places[signal]
        powers = _powers(gain, target, signal, is_rate=is_rate)
        for name, factor in zip(("C0", "C1") if is_rate else ("S0", "K2"), powers, strict=True):
            parts[name] = _subtracted(parts[name], B[..., model.inputs.index(target)] * factor, column)
    return dataclasses.replace(model, **parts)


def _powers(gain: float | Sequence[float], target: str, signal: str, *, is_rate: bool) -> tuple[float, float]:
    """Return the gain's part that is constant, and the one that grows with v (of a rate) or v² (of a coordinate)."""
    values = [float(x) for x in np.atleast_1d(np.asarray(gain, dtype=float))] + [0.0, 0.0, 0.0]
    constant, linear, square, *more = values
    useless, word = (square, "1 and v") if is_rate else (linear, "1 and v²")
    if useless or any(more) or not np.isfinite(values).all():
        raise InputError(f"gain from {signal} to {target} = {gain!r}, must be finite and have parts in {word} alone")
    return constant, linear if is_rate else square


def _subtracted(matrix: np.ndarray, column: np.ndarray, place: int) -> np.ndarray:
    """Return a matrix (..., n, n) with a column (..., n) taken off at a place: the torque stands on the other side."""
    full = np.broadcast_to(matrix, np.broadcast_shapes(matrix.shape, (*column.shape, matrix.shape[-1]))).copy()
    full[..., place] -= column
    return full


def lqr_schedule(
    model: LinearModel, speeds: ArrayLike, input_name: str = "steer torque", weights: Weights | None = None
) -> np.ndarray:
    """Return the gains (k, 2 n) of the best state feedback at speeds (k,), input = -gain state, by one input.

    Parameters
    ----------
    model : LinearModel
        A single design.
    speeds : array, shape (k,)
        In m/s.
    input_name : str
        The input that is fed back.
    weights : Weights, optional
        Of states and input in the cost; by default those of :class:`Weights`.

    Raises
    ------
    InputError
        For a batch, an input that the model does not have, or a speed at which an unstable mode is not reached.

    Examples
    --------
    >>> from singletrack import coefficients, load_bicycle
    >>> lqr_schedule(coefficients(load_bicycle("benchmark")), [3.0, 6.0]).shape
    (2, 4)
    """
    if model.shape != ():
        raise InputError(f"models of shape {model.shape}: a schedule takes a single design")
    if input_name not in model.inputs:
        raise InputError(unknown_name("input", input_name, model.inputs))
    rows = []
    for speed in np.atleast_1d(np.asarray(speeds, dtype=float)):
        system = state_space(model, float(speed))
        try:
            gain, _ = feedback_gain(system.A, system.B[:, [system.inputs.index(input_name)]], weights or Weights())
        except np.linalg.LinAlgError:
            raise InputError(f"{input_name} does not reach an unstable mode at {speed:g} m/s") from None
        rows.append(gain[0])
    return np.array(rows)
