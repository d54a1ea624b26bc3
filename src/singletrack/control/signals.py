"""Inputs beside the torques: a lateral force at a point, a ground that moves sideways; the path as further states."""

from __future__ import annotations

import dataclasses
from typing import TYPE_CHECKING, TypeVar

import numpy as np

from singletrack.errors import InputError
from singletrack.linear import StateSpace
from singletrack.model import GROUND_ACCELERATION, LinearModel
from singletrack.posture import Options, lateral_work, seat

if TYPE_CHECKING:
    from collections.abc import Mapping

    from singletrack.arrays import Array
    from singletrack.parameters import Bicycle, Rider

__all__ = ["GROUND_ACCELERATION", "lateral_force", "with_ground", "with_inputs", "with_path"]

Model = TypeVar("Model", bound=LinearModel)

_PATH = ("yaw", "rear contact y", "front contact y")


def with_inputs(model: Model, columns: Mapping[str, Array]) -> Model:
    """Return a model with further inputs.

    Parameters
    ----------
    model : LinearModel
    columns : mapping of str to array, shape (..., n)
        What a unit of each input does on the right side of each equation.

    Raises
    ------
    InputError
        For an input that is there already, or a column of another length.

    Examples
    --------
    >>> from singletrack import coefficients, load_bicycle
    >>> model = with_inputs(coefficients(load_bicycle("benchmark")), {"push": [0.9, 0.0]})
    >>> model.inputs, model.B.shape
    (('lean torque', 'steer torque', 'push'), (2, 3))
    """
    n = model.freedoms
    parts = [np.asarray(model.B, dtype=float)]
    for name, column in columns.items():
        found = np.asarray(column, dtype=float)
        if name in model.inputs:
            raise InputError(f"input {name!r}: is there already")
        if found.shape[-1:] != (n,):
            raise InputError(f"input {name!r}: a column of shape {found.shape}, must be (..., {n})")
        parts.append(found[..., None])
    shape = np.broadcast_shapes(*(part.shape[:-1] for part in parts))
    B = np.concatenate([np.broadcast_to(part, (*shape, part.shape[-1])) for part in parts], axis=-1)
    return dataclasses.replace(model, B=B, inputs=(*model.inputs, *columns))


def with_ground(model: Model) -> Model:
    """Return a model with the lateral acceleration of the ground, in m/s² to the right, as a further input.

    Notes
    -----
    Seen from the ground each mass feels a force -m a. Its lateral translation with lean and every other coordinate is
    what makes K0's first row, -Σ m yᵢ: so the input's column is that row. A lateral step of the ground by y metres is
    the second derivative of a step: an impulse of its velocity, and back.

    Examples
    --------
    >>> from singletrack import coefficients, load_bicycle
    >>> with_ground(coefficients(load_bicycle("benchmark"))).B[:, 2].round(2).tolist()
    [-80.95, -2.6]
    """
    K0 = np.asarray(model.K0, dtype=float)
    return with_inputs(model, {GROUND_ACCELERATION: K0[..., 0, :]})


def lateral_force(
    bicycle: Bicycle,
    point: str | tuple[float, float],
    rider: Rider | None = None,
    options: Options | str = "rigid",
    freedoms: int | None = None,
) -> np.ndarray:
    """Return the input column (n,) of a lateral force, to the right, in N, at a point of a single design.

    Parameters
    ----------
    bicycle : Bicycle
    point : str or (float, float)
        A point of the skeleton (``hip centre`` is the saddle, ``right shoulder``, ``rear hub``, ...), which moves with
        its segment; or x and z in m of a point of the rear frame.
    rider : Rider, optional
        Needed for points of the skeleton.
    options : Options or str
        How the rider sits.
    freedoms : int, optional
        Of the model without rider: 2.

    Notes
    -----
    The work of the force on the variations of the coordinates: the lateral displacement of the point per unit of lean
    (-z), of steer (the frame's yaw about the rear contact by mu = c cos λ / w, and the point's own motion), of a joint.

    Raises
    ------
    InputError
        For an unknown point, or a point of the skeleton without a rider.

    Examples
    --------
    >>> from singletrack import load_bicycle, load_rider
    >>> lateral_force(load_bicycle("stratos"), "hip centre", load_rider("rider-a"), "leaned").round(3).tolist()
    [0.942, 0.014]
    """
    mu = float(bicycle.trail) * np.cos(float(bicycle.steer_axis_tilt)) / float(bicycle.wheel_base)
    if not isinstance(point, str):
        x, z = (float(value) for value in point)
        return np.array([-z, mu * x, *[0.0] * ((freedoms or 2) - 2)])
    if rider is None:
        raise InputError(f"point {point!r}: needs a rider; x and z of a point of the rear frame need none")
    seated = seat(bicycle, rider, Options.of(options))
    return np.asarray(lateral_work(seated, bicycle, point), dtype=float)


def with_path(system: StateSpace, bicycle: Bicycle) -> StateSpace:
    """Return a single system with yaw and the rear contact's lateral place as states, the front one's as output.

    Parameters
    ----------
    system : StateSpace
        At one speed.
    bicycle : Bicycle
        Whose wheel base, trail and steer axis tilt it has.

    Notes
    -----
    yaw' = (v δ + c δ') cos λ / w, y' = v yaw; the front contact lies at y + w yaw - c cos λ δ.

    Raises
    ------
    InputError
        For several systems.

    Examples
    --------
    >>> from singletrack import coefficients, load_bicycle
    >>> bicycle = load_bicycle("benchmark")
    >>> with_path(coefficients(bicycle).state_space(5.0), bicycle).states[-2:]
    ('yaw', 'rear contact y')
    """
    if system.A.ndim != 2 or np.ndim(system.speed):
        raise InputError(f"systems of shape {system.A.shape[:-2]}: a path is that of a single one")
    v, size, m = float(system.speed), len(system.states), len(system.inputs)
    base, trail = float(bicycle.wheel_base), float(bicycle.trail)
    cosine = float(np.cos(float(bicycle.steer_axis_tilt)))
    steer, rate = system.states.index("steer"), system.states.index("steer rate")
    A = np.zeros((size + 2, size + 2))
    A[:size, :size] = system.A
    A[size, steer], A[size, rate], A[size + 1, size] = v * cosine / base, trail * cosine / base, v
    front = np.zeros((1, size + 2))
    front[0, size + 1], front[0, size], front[0, steer] = 1.0, base, -trail * cosine
    seen = len(system.outputs)
    C = np.concatenate([np.eye(seen + 2, size + 2, size - seen), front])
    C[:seen, :size], C[:seen, size:] = system.C, 0.0
    B, D = np.concatenate([system.B, np.zeros((2, m))]), np.concatenate([system.D, np.zeros((3, m))])
    states, outputs = (*system.states, *_PATH[:2]), (*system.outputs, *_PATH)
    return StateSpace(A, B, C, D, system.speed, states, system.inputs, outputs)
