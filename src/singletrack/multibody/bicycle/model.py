"""The bicycle of Meijaard et al. (2007), with or without a rider, as a machine of the multibody engine.

The drawing is the bicycle upright and straight ahead, the rear contact at the origin. Coordinates: ``x, y, z`` of the
point of the rear frame drawn at the rear contact, ``yaw``, ``lean``, ``pitch``, ``rear wheel``, ``steer`` (positive
to the right), ``front wheel``, and the angles of the rider's joints. The independent speeds are those of lean, steer
and the rear wheel, which turns by a negative angle when the bicycle goes forward. The generalised force on the rate of
lean, with the others held, is the lean torque of Meijaard et al.; so for the steer.
"""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np

from singletrack.body.oddities import warn_of_oddities
from singletrack.errors import InputError
from singletrack.mechanics import combine
from singletrack.multibody.bicycle.balance import holding_inputs
from singletrack.multibody.bicycle.limits import riding_limits
from singletrack.multibody.bicycle.parametrise import Numbers
from singletrack.multibody.bicycle.rider import frame_segments, preload_name, rider_elements
from singletrack.multibody.engine.assembly import assemble, move
from singletrack.multibody.engine.connections import CoordinateForce, Wheel
from singletrack.multibody.engine.elements import GROUND, Body
from singletrack.multibody.engine.joints import free, revolute
from singletrack.multibody.engine.model import Model, build
from singletrack.multibody.engine.system import System
from singletrack.parameters.bodies import bicycle_bodies
from singletrack.parameters.flexible import FORK_BENDING, FRAME_TORSION, soft_hinges
from singletrack.posture import STEER, Options, input_name, require_records, seat

if TYPE_CHECKING:
    from collections.abc import Mapping

    from singletrack.mechanics import RigidBody
    from singletrack.multibody.engine.elements import Joint, Scalar
    from singletrack.multibody.engine.model import State
    from singletrack.parameters import Bicycle, Rider
    from singletrack.parameters.flexible import SoftHinge
    from singletrack.posture import Posture

__all__ = ["bicycle_model", "ride"]

_MOST_DERIVED = 16
_DERIVED: dict[Any, Model] = {}


def _refuse_batches(*records: Bicycle | Rider | None) -> None:
    for record in records:
        for name, value in ({} if record is None else record.values()).items():
            if np.ndim(value):
                raise InputError(
                    f"{name}: an array of shape {np.shape(value)}; the multibody engine takes one design at a time, "
                    "a number is needed (the closed form takes batches)"
                )


def _refuse_skates(bicycle: Bicycle) -> None:
    for name in ("rear_wheel_radius", "front_wheel_radius"):
        if getattr(bicycle, name) == 0:
            raise InputError(
                f"{bicycle.name}: {name} = 0 m, must be greater than zero: the multibody engine rolls wheels "
                "(the closed form takes skates)",
                parameters=(name,),
            )


def _solid(numbers: Numbers, name: str, solid: RigidBody) -> Body:
    return Body(
        name,
        numbers.number(f"{name} mass", solid.mass),
        numbers.vector(f"{name} centre", solid.centre),
        numbers.inertia(f"{name} inertia", solid.inertia),
    )


def _wheel(bicycle: Bicycle, numbers: Numbers, end: str, hub: tuple[Scalar, ...]) -> Wheel:
    """Return a wheel, on a round tyre where the bicycle has one."""
    name, crown = f"{end} wheel", getattr(bicycle, f"{end}_tyre_radius")
    radius = numbers.always(f"{end} radius", getattr(bicycle, f"{end}_wheel_radius"))
    return Wheel(name, name, hub, radius, crown=0.0 if crown is None else numbers.number(f"{end} tyre radius", crown))


def _elements(bicycle: Bicycle, posture: Posture | None, options: Options, numbers: Numbers) -> dict[str, Any]:
    solids = {name: body.body() for name, body in bicycle_bodies(bicycle).items()}
    if posture is not None:
        solids["rear frame"] = combine([solids["rear frame"], *frame_segments(posture)])
    bodies = [_solid(numbers, name, solid) for name, solid in solids.items()]
    tilt = float(bicycle.steer_axis_tilt)
    foot = numbers.vector("steer axis foot", (float(bicycle.wheel_base) + float(bicycle.trail), 0.0, 0.0))
    axis = numbers.vector("steer axis", (np.sin(tilt), 0.0, np.cos(tilt)))
    hubs: dict[str, tuple[Scalar, ...]] = {
        end: numbers.vector(f"{end} hub", solids[f"{end} wheel"].centre) for end in ("rear", "front")
    }
    soft = {hinge.name: hinge for hinge in soft_hinges(bicycle)}
    head, fork = (
        ("head" if FRAME_TORSION in soft else "rear frame"),
        ("fork" if FORK_BENDING in soft else "front frame"),
    )
    joints = [
        free("frame", GROUND, "rear frame", coordinates=("x", "y", "z", "yaw", "lean", "pitch")),
        revolute("rear wheel", "rear frame", "rear wheel", hubs["rear"], (0, 1, 0)),
        *(_soft(numbers, soft[FRAME_TORSION], "rear frame", head) if FRAME_TORSION in soft else ()),
        revolute(
            "steer",
            head,
            "front frame",
            foot,
            axis,
            stiffness=numbers.number("steer stiffness", options.springs.get(STEER, 0.0)),
            damping=numbers.number("steer damping", options.dampers.get(STEER, 0.0)),
        ),
        *(_soft(numbers, soft[FORK_BENDING], "front frame", fork) if FORK_BENDING in soft else ()),
        revolute("front wheel", fork, "front wheel", hubs["front"], (0, 1, 0)),
    ]
    bodies += [Body(name) for name in (head, fork) if name not in {"rear frame", "front frame"}]
    wheels = [_wheel(bicycle, numbers, end, hub) for end, hub in hubs.items()]
    freedoms = (*(() if posture is None else posture.freedoms), *soft)
    inputs = [
        CoordinateForce("lean torque", "lean"),
        CoordinateForce("steer torque", "steer"),
        *(CoordinateForce(input_name(name), name) for name in freedoms),
        CoordinateForce("rear wheel torque", "rear wheel"),
    ]
    more = rider_elements(posture, numbers) if posture is not None else {"bodies": [], "joints": [], "closures": []}
    return {
        "bodies": bodies + more["bodies"],
        "joints": joints + more["joints"],
        "closures": more["closures"],
        "wheels": wheels,
        "inputs": inputs,
    }


def _soft(numbers: Numbers, hinge: SoftHinge, parent: str, child: str) -> tuple[Joint]:
    """Return the hinge of a soft frame or fork."""
    point, axis = (numbers.vector(f"{hinge.name} {what}", getattr(hinge, what)) for what in ("point", "axis"))
    law = {what: numbers.always(f"{hinge.name} {what}", getattr(hinge, what)) for what in ("stiffness", "damping")}
    return (revolute(hinge.name, parent, child, point, axis, **law),)


def bicycle_model(bicycle: Bicycle, rider: Rider | None = None, options: Options | str = "rigid") -> Model:
    """Return the full nonlinear model of a bicycle, with a rider in a posture.

    Designs of one kind share one derivation: only the first takes time.

    Parameters
    ----------
    bicycle, rider
        One design; numbers, no arrays.
    options
        How the rider sits, or a posture's name.

    Raises
    ------
    InputError
        For arrays, an unknown posture, a bicycle that cannot seat a rider, or a posture without a rider.
    PostureError
        If arms or legs do not reach.

    Examples
    --------
    >>> from singletrack import load_bicycle
    >>> bicycle_model(load_bicycle("benchmark")).system.independent
    ('lean', 'steer', 'rear wheel')
    """
    require_records(bicycle, rider)
    _refuse_batches(bicycle, rider)
    _refuse_skates(bicycle)
    warn_of_oddities(bicycle, rider)
    options = Options.of(options)
    if rider is None:
        options.require_rider()
    seated = None if rider is None else seat(bicycle, rider, options)
    numbers = Numbers()
    elements = _elements(bicycle, seated, options, numbers)
    freedoms = () if seated is None else seated.freedoms
    independent = ("lean", "steer", *freedoms, *(hinge.name for hinge in soft_hinges(bicycle)), "rear wheel")
    system = System(
        **elements,
        gravity=float(bicycle.gravity),
        independent=independent,
        limits=riding_limits(elements["joints"], elements["closures"], independent),
        parameters=numbers.values,
    )
    links = tuple((joint.name, joint.parent, joint.child, joint.coordinates) for joint in system.joints)
    loops = tuple((closure.name, closure.first, closure.second) for closure in system.closures)
    key = (numbers.key(), links, loops)
    if key not in _DERIVED:
        while len(_DERIVED) >= _MOST_DERIVED:
            _DERIVED.pop(next(iter(_DERIVED)))
        _DERIVED[key] = build(system)
    known = _DERIVED[key]
    return _balanced(Model(system, known.equations, known.cache), freedoms)


def _balanced(model: Model, freedoms: tuple[str, ...]) -> Model:
    """Return a model whose free joints have the preload that keeps them at rest, upright and straight ahead."""
    if not freedoms:
        return model
    forces = holding_inputs(assemble(model))
    preloads = {preload_name(name): forces[input_name(name)] for name in freedoms}
    system = replace(model.system, parameters=dict(model.system.parameters) | preloads)
    return Model(system, model.equations, model.cache)


def ride(
    model: Model,
    speed: float,
    coordinates: Mapping[str, float] | None = None,
    rates: Mapping[str, float] | None = None,
    *,
    guess: Mapping[str, float] | None = None,
) -> State:
    """Return a state of a bicycle on the road; loops and wheels are closed and put on the ground.

    Parameters
    ----------
    model
        From :func:`bicycle_model`.
    speed
        Radius of the rear wheel times its turning rate, m/s: the speed of an upright bicycle.
    coordinates, rates
        Coordinates (rad, m) and rates of lean and steer (rad/s); zero where not given.
    guess
        Where to start with the other coordinates, m or rad.

    Examples
    --------
    >>> from singletrack import load_bicycle
    >>> state = ride(bicycle_model(load_bicycle("benchmark")), 4.6, {"lean": 0.1}, {"lean": 0.5})
    >>> round(state.rate("x"), 3), state.rate("lean")
    (4.6, 0.5)
    """
    if not isinstance(model, Model):
        what, allowed = type(model).__name__, "a Model; type ride(bicycle_model(bicycle), speed)"
        raise InputError(f"model is a {what}, must be {allowed}", parameters=("model",), found=model, allowed=allowed)
    upright = {"x": 0.0, "y": 0.0, "yaw": 0.0, "lean": 0.0, "steer": 0.0, "rear wheel": 0.0, "front wheel": 0.0}
    state = assemble(model, upright | dict(coordinates or {}), guess=guess)
    return move(state, {"rear wheel": -speed / model.system.parameters["rear radius"]} | dict(rates or {}))
