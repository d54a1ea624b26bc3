"""The equations at given speeds as first-order systems, for control."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

import numpy as np

from singletrack.errors import InputError, unknown_name
from singletrack.linear.eigenvalues import checked_speeds

if TYPE_CHECKING:
    from collections.abc import Sequence

    from singletrack.arrays import ArrayLike
    from singletrack.model import LinearModel, Outputs

__all__ = ["StateSpace", "state_space"]


@dataclass(frozen=True, eq=False)
class StateSpace:
    """x' = A x + B u, y = C x + D u; x are the n coordinates, then their rates, u the m inputs, y the o outputs.

    Attributes
    ----------
    A : array, shape (..., 2 n, 2 n)
    B : array, shape (..., 2 n, m)
    C : array, shape (o, 2 n) or (..., o, 2 n)
    D : array, shape (o, m) or (..., o, m)
        SI units: rad, rad/s, N m.
    speed : float or array, shape (k,)
        In m/s; of several speeds, the last axis of (...) is k.
    states, inputs : tuple of str
        Such as ``lean``, ``lean rate``, ``steer torque``.
    outputs : tuple of str
        The states, unless others were asked for.
    """

    A: np.ndarray
    B: np.ndarray
    C: np.ndarray
    D: np.ndarray
    speed: float | np.ndarray
    states: tuple[str, ...]
    inputs: tuple[str, ...]
    outputs: tuple[str, ...] = ()

    def __post_init__(self) -> None:
        if not self.outputs and self.C.shape[-2] == len(self.states):
            object.__setattr__(self, "outputs", self.states)
        if self.C.shape[-2] != len(self.outputs):
            raise InputError(f"C has {self.C.shape[-2]} rows, must have one for each of {len(self.outputs)} outputs")

    def to_dict(self) -> dict[str, Any]:
        """Return names, and matrices as nested lists in full double precision (for JSON)."""
        names = {key: list(getattr(self, key)) for key in ("states", "outputs")}
        return names | {key: np.asarray(getattr(self, key)).tolist() for key in "ABCD"}

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
        names = {"states": list(self.states), "inputs": list(self.inputs), "outputs": list(self.outputs)}
        return control.ss(self.A, self.B, self.C, self.D, **names, name="bicycle")


def state_space(
    model: LinearModel, speed: ArrayLike, outputs: Sequence[str] | None = None, seen: Outputs | None = None
) -> StateSpace:
    """Return the first-order systems at a forward speed () or at several (k,) in m/s.

    Parameters
    ----------
    model : LinearModel
    speed : array, shape () or (k,)
    outputs : sequence of str, optional
        Names of states, of accelerations (``lean acceleration``) and of what else is seen; by default all but
        accelerations.
    seen : Outputs, optional
        What is seen beside.

    Raises
    ------
    InputError
        For an unknown name, outputs of other coordinates, an input of which they know nothing.

    Examples
    --------
    >>> from singletrack import coefficients, load_bicycle
    >>> model = coefficients(load_bicycle("benchmark"))
    >>> state_space(model, 5.0).A.shape, state_space(model, [4.0, 9.0]).A.shape
    ((4, 4), (2, 4, 4))
    >>> state_space(model, 5.0, ["lean", "lean acceleration"]).D.round(4).tolist()
    [[0.0, 0.0], [0.0159, -0.1241]]
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
    system = StateSpace(A, B, np.eye(2 * n), np.zeros((2 * n, m)), v if several else float(v[0]), states, model.inputs)
    return system if outputs is None and seen is None else _observed(system, model, outputs, seen)


def _observed(system: StateSpace, model: LinearModel, names: Sequence[str] | None, seen: Outputs | None) -> StateSpace:
    """Return a system of which the outputs named are seen: states, accelerations, and what else there is."""
    n = model.freedoms
    batch, accelerations = system.A.shape[:-2], tuple(f"{name} acceleration" for name in model.coordinates)
    known = [*system.states, *accelerations]
    C, D = [np.eye(2 * n), system.A[..., n:, :]], [np.zeros((2 * n, len(model.inputs))), system.B[..., n:, :]]
    if isinstance(names, str):
        raise InputError(f"outputs = {names!r}, must be a list of names")
    every = known if seen is None else [*known, *seen.names]
    for name in names or ():
        if name not in every:
            raise InputError(unknown_name("output", name, every))
    if seen is not None:
        seen = seen if names is None else seen.select([name for name in seen.names if name in names])
        own = _rows(system, model, seen)
        known, C, D = [*known, *seen.names], [*C, own[0]], [*D, own[1]]
    if names is None:
        names = [name for name in known if name not in accelerations]
    places = [known.index(name) for name in names]
    whole = [np.concatenate([np.broadcast_to(r, (*batch, *r.shape[-2:])) for r in rows], axis=-2) for rows in (C, D)]
    return replace(system, C=whole[0][..., places, :], D=whole[1][..., places, :], outputs=tuple(names))


def _rows(system: StateSpace, model: LinearModel, seen: Outputs) -> tuple[np.ndarray, np.ndarray]:
    """Return C and D of what is seen, the accelerations put into it."""
    if seen.coordinates != model.coordinates:
        raise InputError(f"outputs of {seen.coordinates}, must be of the model's {model.coordinates}")
    n, B = model.freedoms, seen.inputs_of(model.inputs)
    rows = {name: np.asarray(getattr(seen, name)) for name in ("M", "C0", "C1", "S0", "K0", "K2")}
    rows["K0"] = np.asarray(seen.gravity, dtype=float)[..., None, None] * rows["K0"]
    if np.ndim(system.speed):  # speeds on an axis of their own
        rows, B = {name: row[..., None, :, :] for name, row in rows.items()}, B[..., None, :, :]
    speed = np.asarray(system.speed)[..., None, None]
    still = np.broadcast_arrays(rows["S0"] + rows["K0"] + speed**2 * rows["K2"], rows["C0"] + speed * rows["C1"])
    return np.concatenate(still, axis=-1) + rows["M"] @ system.A[..., n:, :], B + rows["M"] @ system.B[..., n:, :]
