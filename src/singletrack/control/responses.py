"""Responses in time and frequency: exactly discretised, for models in batches, labelled."""

from __future__ import annotations

import io
from typing import TYPE_CHECKING, Any

import numpy as np
import scipy.linalg

from singletrack.errors import InputError, unknown_name
from singletrack.output import write_whole

if TYPE_CHECKING:
    from pathlib import Path

    import xarray

    from singletrack.arrays import Array, ArrayLike
    from singletrack.linear import StateSpace

__all__ = ["discretised", "frequency_response", "impulse_response", "response", "save_mat", "step_response"]


def discretised(system: StateSpace, step: float, *, hold: str = "zero") -> tuple[np.ndarray, ...]:
    """Return the exact sampled equations x[k+1] = F x[k] + G0 u[k] + G1 u[k+1] of systems (...).

    Parameters
    ----------
    system : StateSpace
        A of shape (..., N, N), B of shape (..., N, m).
    step : float
        In s.
    hold : {"zero", "first"}
        Inputs constant over a step (then G1 is zero), or straight between samples.

    Returns
    -------
    F, G0, G1 : arrays, shape (..., N, N), (..., N, m), (..., N, m)

    Notes
    -----
    Blocks of one matrix exponential (Van Loan 1978, IEEE Transactions on Automatic Control 23:395-404).

    Raises
    ------
    InputError
        For a step that is not positive, or an unknown hold.

    Examples
    --------
    >>> from singletrack import coefficients, load_bicycle
    >>> F, G0, G1 = discretised(coefficients(load_bicycle("benchmark")).state_space([4.0, 5.0]), 0.01)
    >>> F.shape, G0.shape, bool((G1 == 0).all())
    ((2, 4, 4), (2, 4, 2), True)
    """
    if hold not in ("zero", "first"):
        raise InputError(unknown_name("hold", hold, ("zero", "first")))
    if not (np.isfinite(step) and step > 0):
        raise InputError(f"step = {step!r} s, must be greater than zero")
    size, m = system.B.shape[-2:]
    shape = np.broadcast_shapes(system.A.shape[:-2], system.B.shape[:-2])
    block = np.zeros((*shape, size + 2 * m, size + 2 * m))
    block[..., :size, :size], block[..., :size, size : size + m] = system.A * step, system.B * step
    block[..., size : size + m, size + m :] = np.eye(m)
    exponential = scipy.linalg.expm(block)
    F, held, ramp = (
        exponential[..., :size, :size],
        exponential[..., :size, size : size + m],
        exponential[..., :size, size + m :],
    )
    return (F, held, 0.0 * held) if hold == "zero" else (F, held - ramp, ramp)


def response(
    system: StateSpace, time: Array, inputs: Array | None = None, start: Array | None = None, *, hold: str = "first"
) -> xarray.Dataset:
    """Return outputs over evenly spaced times (k,) for input series and a start, exact as ``hold`` says.

    Parameters
    ----------
    system : StateSpace
        One or many, (...).
    time : array, shape (k,)
        In s, evenly spaced.
    inputs : array, shape (k, m), optional
        In N m (or N); none by default.
    start : array, shape (N,), optional
        At rest by default.
    hold : {"zero", "first"}
        As for :func:`discretised`.

    Returns
    -------
    xarray.Dataset
        One variable for each output, by default the states, dimensions (..., time).

    Raises
    ------
    InputError
        For times that are not evenly spaced, or inputs and starts of another shape.

    Examples
    --------
    >>> import numpy as np
    >>> from singletrack import coefficients, load_bicycle
    >>> system = coefficients(load_bicycle("benchmark")).state_space(5.0)
    >>> response(system, np.linspace(0, 2, 201), start=[0, 0, 0.5, 0])["lean"].dims
    ('time',)
    """
    import xarray as xr

    t = _even(time)
    size, m = system.B.shape[-2:]
    u = np.zeros((len(t), m)) if inputs is None else np.asarray(inputs, dtype=float)
    x = np.zeros(size) if start is None else np.asarray(start, dtype=float)
    if u.shape != (len(t), m) or x.shape != (size,):
        raise InputError(f"inputs {u.shape} and start {x.shape}, must be ({len(t)}, {m}) and ({size},)")
    F, G0, G1 = discretised(system, float(t[1] - t[0]), hold=hold)
    shape = F.shape[:-2]
    states = np.empty((*shape, len(t), size))
    states[..., 0, :] = x
    for k in range(len(t) - 1):  # over time, not over systems
        now = F @ states[..., k, :, None] + (G0 @ u[k])[..., None] + (G1 @ u[k + 1])[..., None]
        states[..., k + 1, :] = now[..., 0]
    seen = states @ np.swapaxes(system.C, -1, -2) + u @ np.swapaxes(system.D, -1, -2)
    dims = [*_batch_dims(system, shape), "time"]
    coords: dict[str, Any] = {"time": ("time", t, {"units": "s"})}
    if np.ndim(system.speed):
        coords["speed"] = ("speed", np.asarray(system.speed), {"units": "m/s"})
    data = {name: (dims, seen[..., i]) for i, name in enumerate(system.outputs)}
    return xr.Dataset(data, coords=coords)


def _even(time: Array) -> np.ndarray:
    t = np.asarray(time, dtype=float)
    if t.ndim != 1 or len(t) < 2 or not np.isfinite(t).all():
        raise InputError(f"time: found an array of shape {t.shape}, must be finite times (k,), two or more")
    steps = np.diff(t)
    if not (steps[0] > 0 and np.allclose(steps, steps[0], rtol=1e-6)):
        raise InputError("time: must be evenly spaced and ascending")
    return t


def _batch_dims(system: StateSpace, shape: tuple[int, ...]) -> list[str]:
    names = [f"design_{i}" for i in range(len(shape))]
    if np.ndim(system.speed) and names:
        names[-1] = "speed"
    return names


def step_response(system: StateSpace, time: Array, input_name: str, size: float = 1.0) -> xarray.Dataset:
    """Return the response over times (k,) to an input that jumps from zero to a size (as :func:`response` gives it).

    Parameters
    ----------
    system : StateSpace
        Of one design at one speed.
    time : array, shape (k,)
        In s, ascending from zero.
    input_name : str
        Which input jumps.
    size : float
        To what value, in the input's unit.
    """
    inputs = np.zeros((len(np.atleast_1d(time)), len(system.inputs)))
    inputs[:, _place(system, input_name)] = size
    return response(system, time, inputs, hold="zero")


def impulse_response(system: StateSpace, time: Array, input_name: str, size: float = 1.0) -> xarray.Dataset:
    """Return the response of a single system over times (k,) to an impulse of a size in N m s (as :func:`response`).

    Parameters
    ----------
    system : StateSpace
        Of one design at one speed.
    time : array, shape (k,)
        In s, ascending from zero.
    input_name : str
        Which input acts.
    size : float
        The integral of the input over time, N m s for a torque.

    Notes
    -----
    What an input does to an output at once (D) is an impulse itself, which is over before the first sample.
    """
    return response(system, time, start=system.B[..., _place(system, input_name)] * size)


def _place(system: StateSpace, input_name: str) -> int:
    if input_name not in system.inputs:
        raise InputError(unknown_name("input", input_name, system.inputs))
    return system.inputs.index(input_name)


def frequency_response(system: StateSpace, frequencies: ArrayLike) -> xarray.DataArray:
    """Return the complex response at frequencies (k,) in rad/s: dimensions (..., frequency, output, input).

    Examples
    --------
    >>> from singletrack import coefficients, load_bicycle
    >>> system = coefficients(load_bicycle("benchmark")).state_space(5.0)
    >>> frequency_response(system, [0.1, 1.0]).dims
    ('frequency', 'output', 'input')
    """
    import xarray as xr

    w = np.atleast_1d(np.asarray(frequencies, dtype=float))
    shifted = 1j * w[:, None, None] * np.eye(system.A.shape[-1]) - system.A[..., None, :, :]
    values = system.C[..., None, :, :] @ np.linalg.solve(shifted, system.B[..., None, :, :]) + system.D[..., None, :, :]
    dims = [*_batch_dims(system, values.shape[:-3]), "frequency", "output", "input"]
    coords: dict[str, Any] = {
        "frequency": ("frequency", w, {"units": "rad/s"}),
        "output": list(system.outputs),
        "input": list(system.inputs),
    }
    if np.ndim(system.speed):
        coords["speed"] = ("speed", np.asarray(system.speed), {"units": "m/s"})
    return xr.DataArray(values, dims=dims, coords=coords)


def save_mat(system: StateSpace, path: str | Path) -> None:
    """Write systems as a MAT-file (level 5): A, B, C, D of shapes (..., N, N) and so on, speed, names.

    Matlab keeps further dimensions last: they are moved there.

    Parameters
    ----------
    system : StateSpace
        Of any batch (...) of designs and speeds.
    path : str or Path
        Of the file; it is replaced as a whole.

    Raises
    ------
    InputError
        If the file cannot be written.
    """
    import scipy.io

    content = io.BytesIO()
    matrices = {name: np.moveaxis(np.asarray(getattr(system, name)), (-2, -1), (0, 1)) for name in "ABCD"}
    names = {key: np.array(list(getattr(system, key)), dtype=object) for key in ("states", "inputs", "outputs")}
    scipy.io.savemat(content, {**matrices, "speed": np.asarray(system.speed), **names}, oned_as="column")
    write_whole(path, content.getvalue())
