"""A linear model that was written down, read back: matrices and names become a record, or one message what is wrong."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

from singletrack.arrays import Fault, refuse_single
from singletrack.errors import InputError

if TYPE_CHECKING:
    from collections.abc import Sequence

__all__ = ["read_fields"]

_NEEDED = ("M", "C1", "K0", "K2")
_OPTIONAL = ("C0", "S0", "B")
_EARTH = 9.81
#: Asymmetry of M and K0 that digits cut off when writing explain.
_SYMMETRY = 1e-6


def read_fields(data: Mapping[str, Any], coordinates: Sequence[str], inputs: Sequence[str]) -> dict[str, Any]:
    """Return the fields of a :class:`LinearModel` from what ``to_dict`` wrote, or from matrices alone.

    Parameters
    ----------
    data : mapping
        ``M, C1, K0, K2`` and, optionally, ``C0, S0, B, gravity`` (9.81 m/s² if not given), ``coordinates, inputs``.
    coordinates, inputs : sequence of str
        Names where the data have none.

    Raises
    ------
    InputError
        If a matrix is missing, unknown, of another shape or no numbers, M is not symmetric and positive definite or K0
        not symmetric, of a single design; of a batch, such designs become faults.
    """
    if not isinstance(data, Mapping):
        raise InputError(f"found {type(data).__name__}, must be names with matrices: {', '.join(_NEEDED)}")
    known = (*_NEEDED, *_OPTIONAL, "gravity", "coordinates", "inputs")
    for name in data:
        if name not in known:
            raise InputError(f"{name} is unknown (known: {', '.join(known)})", parameters=(str(name),), allowed=known)
    missing = [name for name in _NEEDED if name not in data]
    if missing:
        raise InputError(f"{', '.join(missing)}: missing", parameters=missing, allowed=_NEEDED)
    names = {
        key: _names(key, data.get(key, default)) for key, default in (("coordinates", coordinates), ("inputs", inputs))
    }
    n, m = len(names["coordinates"]), len(names["inputs"])
    shapes = {**dict.fromkeys((*_NEEDED, "C0", "S0"), (n, n)), "B": (n, m)}
    fields: dict[str, Any] = {name: _matrix(name, data[name], shapes[name]) for name in shapes if name in data}
    fields["gravity"] = _numbers("gravity", data.get("gravity", _EARTH))
    faults = refuse_single(_faults(fields))
    return {**fields, **names, "faults": faults}


def _names(key: str, names: Any) -> tuple[str, ...]:
    if not isinstance(names, list | tuple) or not names or not all(isinstance(name, str) and name for name in names):
        raise InputError(f"{key} = {names!r}, must be a list of names", parameters=(key,), found=names)
    if len(set(names)) < len(names):
        raise InputError(f"{key} = {list(names)!r}, must be different names", parameters=(key,), found=names)
    return tuple(names)


def _numbers(name: str, value: Any) -> np.ndarray:
    try:
        array = np.array(value)
    except ValueError:  # rows of different lengths
        array = np.array(None)
    if array.dtype.kind not in "iuf":
        raise InputError(f"{name} = {value!r:.60}, must be numbers", parameters=(name,), found=value)
    return array.astype(float)


def _matrix(name: str, value: Any, shape: tuple[int, int]) -> np.ndarray:
    array = _numbers(name, value)
    if array.shape[-2:] != shape:
        wanted = f"(..., {shape[0]}, {shape[1]})"
        raise InputError(
            f"{name}: has shape {array.shape}, must be {wanted} for the names", parameters=(name,), allowed=wanted
        )
    return array


def _faults(fields: Mapping[str, Any]) -> list[Fault]:
    """Return what is wrong with the numbers, design by design."""
    of_matrix = {name: value for name, value in fields.items() if name != "gravity"}
    faults = [
        Fault(~np.isfinite(value).all(axis=(-2, -1)), f"{name}: must be finite numbers", {}, InputError, (name,))
        for name, value in of_matrix.items()
    ]
    gravity = fields["gravity"]
    text = "gravity = {gravity:g} m/s^2, must be a finite number, zero or more"
    faults.append(Fault(~(np.isfinite(gravity) & (gravity >= 0)), text, {"gravity": gravity}, InputError, ("gravity",)))
    for name in ("M", "K0"):
        value = fields[name]
        size = np.abs(value).max(axis=(-2, -1))
        with np.errstate(invalid="ignore"):
            bad = np.abs(value - np.swapaxes(value, -2, -1)).max(axis=(-2, -1)) > _SYMMETRY * size
        faults.append(Fault(bad, f"{name}: must be symmetric", {}, InputError, (name,), "symmetric"))
    M = fields["M"]
    finite = np.isfinite(M).all(axis=(-2, -1))
    sound = np.where(finite[..., None, None], M, np.eye(M.shape[-1]))
    positive = np.linalg.eigvalsh((sound + np.swapaxes(sound, -2, -1)) / 2)[..., 0] > 0
    faults.append(Fault(~positive, "M: must be positive definite", {}, InputError, ("M",), "positive definite"))
    return faults
