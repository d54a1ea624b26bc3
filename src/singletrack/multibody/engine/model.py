"""A machine whose equations are derived, and states of it."""

from __future__ import annotations

import pickle
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import casadi as ca
import numpy as np

from singletrack.arrays import Array
from singletrack.errors import ModelError, unknown_name
from singletrack.multibody.engine.equations import Equations, derive
from singletrack.multibody.engine.partition import Partition
from singletrack.multibody.engine.system import System

if TYPE_CHECKING:
    from collections.abc import Mapping


__all__ = ["Model", "State", "build", "finite", "index_of"]


@dataclass(frozen=True, eq=False)
class Model:
    """A machine with its derived equations of motion; made by :func:`build`."""

    system: System = field(repr=False)
    equations: Equations = field(repr=False)
    cache: dict[Any, Any] = field(default_factory=dict, repr=False)

    def parameters(self, values: Mapping[str, float] | None = None) -> Array:
        """Return the parameters p (gravity first) from the system's values and those given.

        Shape (p,), in the order of the equations' parameter names.

        Parameters
        ----------
        values : mapping, optional
            By name, SI; they go before those of the system.

        Raises
        ------
        ModelError
            For parameters that are unknown or have no value.
        """
        known = self.equations.parameter_names
        chosen = {"gravity": self.system.gravity, **self.system.parameters, **(values or {})}
        for name in values or {}:
            if name not in known:
                raise ModelError(unknown_name("parameter", name, known))
        for name, value in chosen.items():
            if not np.isfinite(float(value)):
                raise ModelError(f"parameter {name}: {value!r}; allowed: a finite number")
        missing = [name for name in known if name not in chosen]
        if missing:
            raise ModelError(f"no value for the parameters {', '.join(missing)}")
        return np.array([float(chosen[name]) for name in known])

    def vector(self, values: Mapping[str, float] | None, what: str = "coordinate") -> Array:
        """Return the joint coordinates (n,) for some given by name; the others are zero.

        Parameters
        ----------
        values : mapping, optional
            By name, m or rad (per s for speeds).
        what : str
            What they are called in a message.
        """
        names = self.system.coordinates
        vector = np.zeros(len(names))
        for name, value in (values or {}).items():
            if name not in names:
                raise ModelError(unknown_name(what, name, names))
            vector[names.index(name)] = finite(what, name, value)
        return vector

    def __reduce__(self) -> tuple[Any, ...]:
        with ca.global_pickle_context():
            system = pickle.dumps(self.system)
        return _restored, (system, self.equations)

    def holonomic(self, q: Array, p: Array) -> tuple[Array, Array]:
        """Return the residual phi (rows,) of the holonomic constraints and its gradient (rows, n).

        Parameters
        ----------
        q : array, shape (n,)
            Joint coordinates, m or rad.
        p : array, shape (parameters,)
            Values of the parameters, gravity (m/s²) first.
        """
        phi, gradient = self.equations.holonomic(q, p)
        return phi.full().ravel(), gradient.full()

    def kinetics(self, q: Array, p: Array) -> tuple[Array, Array]:
        """Return the constraint Jacobian C (rows, n) and the mass matrix M (n, n).

        Parameters
        ----------
        q : array, shape (n,)
            Joint coordinates, m or rad.
        p : array, shape (parameters,)
            Values of the parameters, gravity (m/s²) first.
        """
        jacobian, mass = self.equations.kinetics(q, p)
        return jacobian.full(), mass.full()


@dataclass(frozen=True, eq=False)
class State:
    """Coordinates and speeds of a machine that satisfy its constraints, for one choice of parameters.

    ``state["lean"]`` is a coordinate, ``state.rate("lean")`` its rate.
    """

    model: Model = field(repr=False)
    parameters: Array = field(repr=False)
    partition: Partition
    q: Array
    u: Array

    def __getitem__(self, name: str) -> float:
        return float(self.q[index_of(self.model.system, name)])

    def rate(self, name: str) -> float:
        """Return the rate of a coordinate.

        Parameters
        ----------
        name : str
            Of the coordinate; m/s or rad/s.
        """
        return float(self.u[index_of(self.model.system, name)])

    @property
    def freedoms(self) -> tuple[str, ...]:
        """Names of the coordinates whose rates are the independent speeds."""
        return tuple(self.model.system.coordinates[i] for i in self.partition.independent_speeds)

    def summary(self) -> str:
        """Return in words which speeds are independent and which constraints say nothing new.

        >>> from singletrack.multibody import Body, System, assemble, build, revolute
        >>> bob = Body("bob", 1.0, (0, 0, 1))
        >>> model = build(System([bob], [revolute("swing", "ground", "bob", (0, 0, 0), (0, 1, 0))]))
        >>> print(assemble(model).summary())
        1 coordinates, 0 constraints, 1 degrees of freedom: swing
        redundant constraints: none
        """
        system, redundant = self.model.system, self.partition.redundant
        return (
            f"{len(system.coordinates)} coordinates, {len(system.rows)} constraints, {len(self.freedoms)} degrees of "
            f"freedom: {', '.join(self.freedoms) or 'none'}\nredundant constraints: {', '.join(redundant) or 'none'}"
        )


def _restored(system: bytes, equations: Equations) -> Model:
    """Return a model from its pickled system; symbols live in a context of their own."""
    with ca.global_unpickle_context():
        return Model(pickle.loads(system), equations)  # noqa: S301  # part of what is being unpickled


def finite(what: str, name: str, value: float) -> float:
    """Return a value given for a name; refuse what is no finite number."""
    try:
        number = float(value)
    except (TypeError, ValueError):
        number = np.nan
    if not np.isfinite(number):
        raise ModelError(f"{what} {name}: {value!r}; allowed: a finite number")
    return number


def index_of(system: System, name: str) -> int:
    """Return the place of a coordinate by its name.

    Parameters
    ----------
    system : System
        The machine.
    name : str
        Of the coordinate.
    """
    if name not in system.coordinates:
        raise ModelError(unknown_name("coordinate", name, system.coordinates))
    return system.coordinates.index(name)


def build(system: System) -> Model:
    """Derive the equations of motion of a machine.

    Parameters
    ----------
    system : System
        Bodies, joints, loops, wheels, forces.

    Examples
    --------
    >>> from singletrack.multibody import Body, System, revolute
    >>> bob = Body("bob", 1.0, (0, 0, 1))
    >>> model = build(System([bob], [revolute("swing", "ground", "bob", (0, 0, 0), (0, 1, 0))]))
    >>> model.equations.parameter_names
    ('gravity',)
    """
    if not system.coordinates:
        raise ModelError("system: nothing can move; add a joint that has a coordinate")
    return Model(system, derive(system))
