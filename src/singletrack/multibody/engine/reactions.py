"""What joints carry, what drives must give for a motion, and the load under which a machine buckles."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from scipy.linalg import eig

from singletrack.arrays import Array
from singletrack.errors import ModelError, unknown_name
from singletrack.multibody.engine.assembly import assemble, move, span_of
from singletrack.multibody.engine.dynamics import accelerations, input_vector
from singletrack.multibody.engine.variations import vary

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    import xarray as xr

    from singletrack.multibody.engine.dynamics import Response
    from singletrack.multibody.engine.model import Model, State

__all__ = ["Buckling", "Reaction", "buckling_load", "driving_forces", "inverse_dynamics", "joint_reactions"]


@dataclass(frozen=True, eq=False)
class Reaction:
    """What the parent does to the child of a joint, in the ground's frame: force (3,), N, moment (3,), N m.

    The moment is about the joint's point, slid along. Springs, dampers and drives of the joint are part of it.
    """

    force: Array
    moment: Array


def joint_reactions(state: State, inputs: Mapping[str, float] | None = None) -> dict[str, Reaction]:
    """Return the reaction of every joint of the tree, under constant inputs.

    Parameters
    ----------
    state : State
        Whose accelerations decide the reactions.
    inputs : mapping, optional
        Values of inputs by name, N or N m; those not given are zero.

    Examples
    --------
    A bob at rest hangs from its hinge:

    >>> from singletrack.multibody import Body, System, assemble, build, revolute
    >>> bob = Body("bob", 2.0, (0, 0, 1))
    >>> model = build(System([bob], [revolute("swing", "ground", "bob", (0, 0, 0), (0, 1, 0))]))
    >>> joint_reactions(assemble(model))["swing"].force.round(2).tolist()
    [0.0, 0.0, -19.62]
    """
    return reactions_of(state, accelerations(state, inputs), input_vector(state.model.system, inputs))


def reactions_of(state: State, response: Response, f: Array) -> dict[str, Reaction]:
    """Return the reactions for known accelerations and multipliers."""
    found = state.model.equations.reactions(state.q, state.u, response.a, response.multipliers, f, state.parameters)
    forces, moments = (part.full().T + 0.0 for part in found)  # no negative zeros
    names = [joint.name for joint in state.model.system.joints]
    return {name: Reaction(*pair) for name, *pair in zip(names, forces, moments, strict=True)}


def driving_forces(
    state: State, wanted: Mapping[str, float], inputs: Mapping[str, float] | None = None
) -> dict[str, float]:
    """Return the forces on independent coordinates that give them the accelerations wanted (N or N m).

    The other independent coordinates are free and respond. The force on a coordinate is that of a drive in its joint.

    Parameters
    ----------
    state
        Positions and rates.
    wanted
        Accelerations of independent coordinates, by name.
    inputs
        Constant inputs besides.

    Raises
    ------
    ModelError
        For a coordinate that is not independent.

    Examples
    --------
    >>> from singletrack.multibody import Body, System, assemble, build, revolute
    >>> bob = Body("bob", 2.0, (0, 0, 1))
    >>> model = build(System([bob], [revolute("swing", "ground", "bob", (0, 0, 0), (0, 1, 0))], gravity=0.0))
    >>> driving_forces(assemble(model), {"swing": 3.0})
    {'swing': 6.0}
    """
    for name in wanted:
        if name not in state.freedoms:
            raise ModelError(unknown_name("independent coordinate", name, state.freedoms))
    jacobian, mass = state.model.kinetics(state.q, state.parameters)
    span = span_of(state.partition, jacobian)
    reduced = span.T @ mass @ span
    own = accelerations(state, inputs).a[list(state.partition.independent_speeds)]
    driven = [state.freedoms.index(name) for name in wanted]
    # forces on the driven ones alone change the accelerations by the inverse of the reduced mass matrix
    mobility = np.linalg.inv(reduced)[np.ix_(driven, driven)]
    change = np.array([wanted[name] for name in wanted]) - own[driven]
    return dict(zip(wanted, np.linalg.solve(mobility, change).tolist(), strict=True))


def inverse_dynamics(
    model: Model, motion: Mapping[str, Callable[[float], tuple[float, float, float]]], times: Array, **given: Any
) -> xr.Dataset:
    """Return the forces that make a machine move as prescribed, and what its joints carry.

    Parameters
    ----------
    model
        A machine without rolling wheels.
    motion
        For each degree of freedom its coordinate, rate and acceleration as functions of time (s).
    times
        Times, s, (k,).
    given
        ``guess`` (coordinates to start with) and ``parameters``, as for :func:`assemble`.

    Returns
    -------
    xarray.Dataset
        Over ``time``: ``drive`` (dimension ``coordinate``; N or N m), ``q`` (dimension ``joint_coordinate``),
        ``force`` and ``moment`` of every ``joint``.

    Raises
    ------
    ModelError
        Where the motion does not determine the machine.
    """
    import xarray as xr  # slow to import

    names, guess = list(motion), dict(given.pop("guess", None) or {})
    drives, places, forces, moments = [], [], [], []
    for t in np.asarray(times, dtype=float):
        values = {name: motion[name](float(t)) for name in names}
        state = assemble(model, {n: v[0] for n, v in values.items()}, guess=guess, independent=names, **given)
        state = move(state, {name: value[1] for name, value in values.items()})
        guess = {name: state[name] for name in model.system.coordinates}
        needed = driving_forces(state, {name: value[2] for name, value in values.items()})
        drives.append([needed[name] for name in names])
        places.append(state.q)
        carried = _driven(state, needed)
        forces.append([reaction.force for reaction in carried])
        moments.append([reaction.moment for reaction in carried])
    joints = [joint.name for joint in model.system.joints]
    axes = ("time", "joint", "axis")
    return xr.Dataset(
        {
            "drive": (("time", "coordinate"), np.array(drives)),
            "q": (("time", "joint_coordinate"), np.array(places)),
            "force": (axes, np.array(forces)),
            "moment": (axes, np.array(moments)),
        },
        coords={
            "time": np.asarray(times, dtype=float),
            "coordinate": names,
            "joint_coordinate": list(model.system.coordinates),
            "joint": joints,
            "axis": ["x", "y", "z"],
        },
    )


def _driven(state: State, drives: Mapping[str, float]) -> list[Reaction]:
    """Return the reactions of all joints under forces on coordinates."""
    response = accelerations(state)
    jacobian, mass = state.model.kinetics(state.q, state.parameters)
    parts = state.partition
    span = span_of(parts, jacobian)
    pushed = np.zeros(len(state.q))
    for name, force in drives.items():
        pushed[state.model.system.coordinates.index(name)] += force
    changed = span @ np.linalg.solve(span.T @ mass @ span, span.T @ pushed)
    multipliers = response.multipliers.copy()
    rows, dependent = list(parts.rows), list(parts.dependent_speeds)
    if rows:
        own = jacobian[np.ix_(rows, dependent)]
        multipliers[rows] += np.linalg.solve(own.T, (mass @ changed - pushed)[dependent])
    moved = type(response)(response.a + changed, multipliers)
    return list(reactions_of(state, moved, input_vector(state.model.system, None)).values())


@dataclass(frozen=True, eq=False)
class Buckling:
    """Loads under which an equilibrium ceases to be stable, smallest first, and its shapes.

    Attributes
    ----------
    loads
        Multiples of the input, (k,), positive.
    shapes
        How the independent coordinates move, (coordinates, k), greatest entry one.
    coordinates
        Their names.
    """

    loads: Array
    shapes: Array
    coordinates: tuple[str, ...]


def buckling_load(state: State, load: str, inputs: Mapping[str, float] | None = None) -> Buckling:
    """Return the values of an input at which an equilibrium buckles: ``(K_0 + load K_1) x = 0``.

    The equilibrium must not change with the load, as that of a straight column; the stiffness is then linear in it.

    Parameters
    ----------
    state
        The machine at rest.
    load
        Name of the input.
    inputs
        Others, constant (N, N m).

    Raises
    ------
    ModelError
        For an unknown input, or where the load moves the machine.
    """
    f = input_vector(state.model.system, {**(inputs or {}), load: 1.0})
    stiffness = []
    for size in (0.0, 1.0):
        chosen = {**(inputs or {}), load: size}
        response = accelerations(state, chosen)
        moves = float(np.max(abs(response.a), initial=0.0))
        if moves > 1e-7 * max(1.0, float(np.max(abs(f)))):
            raise ModelError(
                f"buckling: {load} = {size:g} does not leave the machine at rest (accelerations of {moves:.3g})"
            )
        stiffness.append(vary(state, response, input_vector(state.model.system, chosen)).K)
    values, shapes = eig(stiffness[0], stiffness[0] - stiffness[1])
    real = np.isfinite(values) & (abs(values.imag) <= 1e-9 * abs(values)) & (values.real > 0.0)
    order = np.argsort(values.real[real])
    chosen_shapes = shapes[:, real].real[:, order]
    chosen_shapes = chosen_shapes / np.max(abs(chosen_shapes), axis=0, initial=1e-300)
    names = tuple(state.model.system.coordinates[i] for i in state.partition.independent_coordinates)
    return Buckling(values.real[real][order], chosen_shapes, names)
