"""The linear model as a plain record: matrices, names, faults. Makers fill it, askers read it, nothing rides on it.

    M q'' + (C0 + v C1) q' + (S0 + g K0 + v² K2) q = B f

q are the coordinates (lean, steer and, with more freedoms, the rider's joints), f the inputs, v the forward speed.
C0 and S0 come from dampers and springs and are zero without any.
"""

from __future__ import annotations

import dataclasses
from dataclasses import dataclass, field
from math import prod
from typing import TYPE_CHECKING, Any, Self, cast

import numpy as np

from singletrack.arrays import Array, Fault, Number, is_concrete, namespace, valid_mask
from singletrack.errors import InputError
from singletrack.model.written import read_fields

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    import xarray

__all__ = ["COORDINATES", "GROUND_ACCELERATION", "INPUTS", "UNITS", "LinearModel", "concatenate"]

#: The coordinates that every bicycle has, and the torques that do work on them.
COORDINATES = ("lean", "steer")
INPUTS = ("lean torque", "steer torque")
#: The input of a ground that moves sideways, m/s² to the right.
GROUND_ACCELERATION = "ground acceleration"

#: Units of the matrices' entries, for angles in rad and torques in N m.
UNITS = {"M": "kg m^2", "C0": "N m s", "C1": "kg m", "S0": "N m", "K0": "kg m", "K2": "kg", "B": ""}
_SQUARE = ("M", "C1", "K0", "K2", "C0", "S0")


@dataclass(frozen=True, eq=False)
class LinearModel:
    """``M q'' + (C0 + v C1) q' + (S0 + g K0 + v^2 K2) q = B f``; SI units, radians.

    Attributes
    ----------
    M, C1, K0, K2 : array, shape (..., n, n)
        In kg m^2, kg m, kg m and kg. M and K0 are symmetric; K0 carries no g.
    gravity : array, shape broadcastable to (...)
        In m/s^2.
    faults : tuple of Fault
        What is wrong with designs of a batch; their matrices are not to be used.
    C0, S0 : array, shape (..., n, n)
        In N m s and N m, of dampers and springs; zero by default.
    B : array, shape (..., n, m)
        Of the m inputs; by default each works on its own coordinate.
    coordinates, inputs : tuple of str
        Names of the n coordinates (lean and steer first) and the m inputs.

    Raises
    ------
    InputError
        If a matrix does not fit the names.

    Examples
    --------
    >>> from singletrack import coefficients, load_bicycle
    >>> model = coefficients(load_bicycle("benchmark"))
    >>> model.coordinates, model.M.shape, model.C0.tolist()
    (('lean', 'steer'), (2, 2), [[0.0, 0.0], [0.0, 0.0]])
    """

    M: Array
    C1: Array
    K0: Array
    K2: Array
    gravity: Number
    faults: tuple[Fault, ...] = ()
    # None: zero, and B takes each input to the coordinate in its place.
    C0: Array = field(default=cast("Array", None), kw_only=True)
    S0: Array = field(default=cast("Array", None), kw_only=True)
    B: Array = field(default=cast("Array", None), kw_only=True)
    coordinates: tuple[str, ...] = field(default=COORDINATES, kw_only=True)
    inputs: tuple[str, ...] = field(default=INPUTS, kw_only=True)

    def __post_init__(self) -> None:
        n, m = len(self.coordinates), len(self.inputs)
        own, square = self.__dict__, (n, n)
        for name in ("C0", "S0"):
            if own[name] is None:
                own[name] = np.zeros(square)
        if own["B"] is None:
            own["B"] = np.eye(n, m)
        for name in (*_SQUARE, "B"):
            value, wanted = own[name], square if name != "B" else (n, m)
            found = value.shape if type(value) is np.ndarray else np.shape(value)
            if found[-2:] != wanted:
                raise InputError(f"{name}: has shape {found}, must be (..., {wanted[0]}, {wanted[1]}) for the names")

    @property
    def freedoms(self) -> int:
        """The number n of coordinates."""
        return len(self.coordinates)

    @property
    def matrices(self) -> tuple[Array, Array, Array, Array]:
        """M, C1, K0 and K2: what there is without springs and dampers."""
        return self.M, self.C1, self.K0, self.K2

    @property
    def is_undamped(self) -> bool:
        """Whether C0 and S0 are known to be zero: no springs, no dampers."""
        return all(is_concrete(matrix) and not np.any(np.asarray(matrix)) for matrix in (self.C0, self.S0))

    @property
    def shape(self) -> tuple[int, ...]:
        """Shape (...) of the batch of designs."""
        stacked = (np.shape(getattr(self, name))[:-2] for name in (*_SQUARE, "B"))
        return np.broadcast_shapes(np.shape(self.gravity), *stacked, *(np.shape(fault.bad) for fault in self.faults))

    @property
    def valid(self) -> np.ndarray:
        """True for the designs of the batch that nothing is wrong with, shape (...)."""
        return valid_mask(self.faults, self.shape)

    def damping(self, speed: Number) -> Array:
        """Return C0 + v C1, shape (..., n, n), in N m s, at speeds (...) in m/s."""
        moving = _matrixwise(speed, self.C1) * self.C1
        return moving if self.is_undamped else self.C0 + moving

    def stiffness(self, speed: Number) -> Array:
        """Return S0 + g K0 + v^2 K2, shape (..., n, n), in N m, at speeds (...) in m/s."""
        moving = _matrixwise(self.gravity, self.K0) * self.K0 + _matrixwise(speed, self.K2) ** 2 * self.K2
        return moving if self.is_undamped else self.S0 + moving

    def broadcast_to(self, shape: tuple[int, ...]) -> Self:
        """Return the model with matrices of the full shape ``(*shape, n, n)``, gravity ``(*shape,)``, in NumPy."""
        fields = {name: np.asarray(getattr(self, name)) for name in (*_SQUARE, "B")}
        full: dict[str, Any] = {name: np.broadcast_to(a, (*shape, *a.shape[-2:])) for name, a in fields.items()}
        full["gravity"] = np.broadcast_to(np.asarray(self.gravity, dtype=float), shape)
        full["faults"] = tuple(fault.broadcast_to(shape) for fault in self.faults)
        return dataclasses.replace(self, **full)

    def __getitem__(self, index: Any) -> Self:
        """Return some designs of a batch: an index, slice or mask of the batch's axes."""
        whole = self.broadcast_to(self.shape)
        of_batch = index if isinstance(index, tuple) else (index,)
        of_matrix = (*of_batch, slice(None), slice(None)) if any(i is Ellipsis for i in of_batch) else of_batch
        some: dict[str, Any] = {name: getattr(whole, name)[of_matrix] for name in (*_SQUARE, "B")}
        some["gravity"] = np.asarray(whole.gravity)[of_batch]
        return dataclasses.replace(whole, **some, faults=tuple(fault[index] for fault in whole.faults))

    def part(self, which: slice) -> Self:
        """Return some designs of a batch, on one axis, without their faults.

        M has an entry for each of them; what else is the same for all stays so.

        Parameters
        ----------
        which : slice
            Designs, as numbered along one axis.
        """
        batch = self.shape

        def some(value: Number, axes: int, *, always: bool = False) -> Array:
            value = np.asarray(value)
            if value.ndim == axes and not always:
                return value
            inner = value.shape[value.ndim - axes :]
            return np.broadcast_to(value, (*batch, *inner)).reshape(prod(batch), *inner)[which]

        fields: dict[str, Any] = {name: some(getattr(self, name), 2, always=name == "M") for name in (*_SQUARE, "B")}
        return dataclasses.replace(self, **fields, gravity=some(self.gravity, 0), faults=())

    def to_dict(self) -> dict[str, Any]:
        """Return names and matrices as nested lists, in full double precision (for JSON)."""

        def listed(*names: str) -> dict[str, Any]:
            return {name: np.asarray(getattr(self, name), dtype=float).tolist() for name in names}

        names = {"coordinates": list(self.coordinates), "inputs": list(self.inputs)}
        return listed("M", "C1", "K0", "K2", "gravity") | names | listed("C0", "S0", "B")

    @classmethod
    def from_dict(cls, data: Mapping[str, Any]) -> Self:
        """Return the model that :meth:`to_dict` wrote; ``C0, S0, B``, the names and gravity (9.81) may be left out.

        Parameters
        ----------
        data : mapping
            Matrices as lists, names as lists of str, by the names of the attributes.

        Raises
        ------
        InputError
            If matrices are missing, unknown, of another shape or not finite, M is not symmetric positive definite or
            K0 not symmetric; of a batch, such designs become its ``faults``.

        Examples
        --------
        >>> from singletrack import coefficients, load_bicycle
        >>> model = coefficients(load_bicycle("benchmark"))
        >>> LinearModel.from_dict(model.to_dict()).to_dict() == model.to_dict()
        True
        """
        return cls(**read_fields(data, COORDINATES, INPUTS))

    def to_xarray(self) -> xarray.Dataset:
        """Return the matrices labelled; batch dimensions are called design_0, design_1, ..."""
        import xarray as xr

        batch = [f"design_{i}" for i in range(len(self.shape))]
        whole = self.broadcast_to(self.shape)
        axes = {"B": ["equation", "input"]}
        data: dict[str, Any] = {
            name: ([*batch, *axes.get(name, ["equation", "coordinate"])], getattr(whole, name), {"units": unit})
            for name, unit in UNITS.items()
        }
        data["gravity"] = (batch, whole.gravity, {"units": "m/s^2"})
        names = list(self.coordinates)
        return xr.Dataset(data, coords={"equation": names, "coordinate": names, "input": list(self.inputs)})


def concatenate(models: Sequence[LinearModel]) -> LinearModel:
    """Return batches of designs (k,) one after the other, as one batch; all of the same coordinates and inputs.

    Parameters
    ----------
    models : sequence of LinearModel
        Each a batch of shape (k,), k its own.

    Raises
    ------
    InputError
        If there is none, or they differ in their names.

    Examples
    --------
    >>> import numpy as np
    >>> from singletrack import coefficients, load_bicycle
    >>> bicycle = load_bicycle("benchmark")
    >>> some = [coefficients(bicycle.replace(trail=np.array(trails))) for trails in ([0.04], [0.06, 0.08])]
    >>> concatenate(some).shape
    (3,)
    """
    if not models:
        raise InputError("concatenate: got no models, needs at least one")
    first = models[0]
    for other in models[1:]:
        if (other.coordinates, other.inputs) != (first.coordinates, first.inputs):
            raise InputError(f"models of coordinates {first.coordinates} and {other.coordinates} do not concatenate")
    whole = [model.broadcast_to(model.shape or (1,)) for model in models]
    joined: dict[str, Any] = {
        name: np.concatenate([getattr(model, name) for model in whole]) for name in (*_SQUARE, "B", "gravity")
    }
    lengths = [model.shape[0] for model in whole]
    faults = []
    for k, model in enumerate(whole):
        before, after = sum(lengths[:k]), sum(lengths[k + 1 :])
        faults += [fault.padded(before, after) for fault in model.faults]
    return dataclasses.replace(first, **joined, faults=tuple(faults))


def _matrixwise(factor: Number, matrix: Array) -> Array:
    return namespace(factor, matrix).asarray(factor)[..., None, None]
