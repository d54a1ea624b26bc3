"""The immutable description of a machine, checked as it is made."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, Any, TypeAlias

from singletrack.errors import ModelError, unknown_name
from singletrack.multibody.engine.checks import check_axis, check_number, is_number
from singletrack.multibody.engine.closures import Closure, Ratio
from singletrack.multibody.engine.connections import CoordinateForce, Force, Sensor, Spring, Torque, Wheel
from singletrack.multibody.engine.elements import GROUND, Body, Joint, Scalar, Vector
from singletrack.multibody.engine.limits import Limit, Reach

if TYPE_CHECKING:
    from collections.abc import Iterable


__all__ = ["System"]

Input: TypeAlias = Force | Torque | CoordinateForce


@dataclass(frozen=True, eq=False)
class System:
    """A machine: bodies on a tree of joints, closed loops, rolling wheels, springs, inputs and outputs.

    Parameters
    ----------
    bodies, joints
        The tree: every body but the ground has exactly one joint as whose child it hangs from the ground.
    closures, wheels, springs, inputs, sensors
        What else connects, drives and measures the bodies.
    gravity
        Strength of gravity, N/kg; it acts along ``down``.
    down
        Direction of gravity. Wheels roll on z = 0 whatever it is.
    independent
        Names of the coordinates whose rates shall be the independent speeds; found automatically where None.
    ratios
        Fixed ratios between coordinates: gears, chains.
    limits
        Where a simulation ends by itself: ranges of coordinates, and loops at the end of their reach.
    parameters
        Values of the parameters used in the elements, by name; what is missing must be given later.

    Raises
    ------
    ModelError
        For unknown bodies, two parents, bodies that hang from nothing, names used twice; the element is named.

    Examples
    --------
    >>> from singletrack.multibody import Body, revolute
    >>> pendulum = System([Body("bob", 1.0, (0, 0, 1))], [revolute("swing", "ground", "bob", (0, 0, 0), (0, 1, 0))])
    >>> pendulum.coordinates
    ('swing',)
    """

    bodies: Sequence[Body]
    joints: Sequence[Joint]
    closures: Sequence[Closure] = ()
    wheels: Sequence[Wheel] = ()
    springs: Sequence[Spring] = ()
    inputs: Sequence[Input] = ()
    sensors: Sequence[Sensor] = ()
    gravity: Scalar = 9.81
    down: Vector = (0.0, 0.0, 1.0)
    independent: tuple[str, ...] | None = None
    limits: Sequence[Limit | Reach] = ()
    ratios: Sequence[Ratio] = ()
    parameters: Mapping[str, float] = field(default_factory=dict)

    def __post_init__(self) -> None:
        for name in ("bodies", "joints", "closures", "wheels", "springs", "inputs", "sensors", "limits", "ratios"):
            object.__setattr__(self, name, tuple(getattr(self, name)))
        if not is_number(self.gravity):
            raise ModelError("system: gravity must be a number; to vary it, give the parameter `gravity` a value later")
        object.__setattr__(self, "gravity", check_number("system", "gravity", self.gravity))
        object.__setattr__(self, "down", check_axis("system", "down", self.down))
        if self.independent is not None:
            object.__setattr__(self, "independent", tuple(self.independent))
        _check_names(self)
        _check_tree(self)
        _check_connections(self)
        _check_ratios(self)
        _check_limits(self)

    def rows_of(self, loops: Iterable[str]) -> list[int]:
        """Return the places of the equations of some loops among the constraints."""
        own = {row for closure in self.closures if closure.name in loops for row in closure.rows}
        return [i for i, row in enumerate(self.holonomic_rows) if row in own]

    def replace(self, **changes: Any) -> System:
        """Return a copy with some fields changed, checked anew."""
        return replace(self, **changes)

    @property
    def coordinates(self) -> tuple[str, ...]:
        """Names of all joint coordinates, in the order of the joints."""
        return tuple(name for joint in self.joints for name in joint.coordinates)

    @property
    def holonomic_rows(self) -> tuple[str, ...]:
        """Names of the constraints on coordinates: loops, ratios, lengths of quaternions, heights of the wheels."""
        loops = [row for closure in self.closures for row in closure.rows]
        loops += [f"{ratio.name} (ratio)" for ratio in self.ratios]
        loops += [f"{joint.name} (quaternion)" for joint in self.joints if joint.quaternion]
        return tuple(loops + [f"{wheel.name} (height)" for wheel in self.wheels])

    @property
    def rolling_rows(self) -> tuple[str, ...]:
        """Names of the constraints on speeds: two for every wheel."""
        return tuple(f"{wheel.name} ({way})" for wheel in self.wheels for way in ("longitudinal", "lateral"))

    @property
    def rows(self) -> tuple[str, ...]:
        """Names of all constraints, as they stand in the constraint Jacobian."""
        return self.holonomic_rows + self.rolling_rows


def _check_names(system: System) -> None:
    kinds: dict[str, Iterable[str]] = {
        "body": [GROUND, *(body.name for body in system.bodies)],
        "joint": [joint.name for joint in system.joints],
        "coordinate": system.coordinates,
        "loop": [closure.name for closure in system.closures],
        "ratio": [ratio.name for ratio in system.ratios],
        "wheel": [wheel.name for wheel in system.wheels],
        "spring": [spring.name for spring in system.springs],
        "input": [given.name for given in system.inputs],
        "sensor": [sensor.name for sensor in system.sensors],
    }
    for kind, names in kinds.items():
        for name, count in Counter(names).items():
            if count > 1:
                raise ModelError(f"{kind} {name}: the name is used {count} times")
    for name in system.independent or ():
        if name not in system.coordinates:
            raise ModelError(unknown_name("independent coordinate", name, system.coordinates))


def _check_tree(system: System) -> None:
    known = [GROUND, *(body.name for body in system.bodies)]
    parents: dict[str, Joint] = {}
    for joint in system.joints:
        for body in (joint.parent, joint.child):
            if body not in known:
                raise ModelError(f"joint {joint.name}: " + unknown_name("body", body, known))
        if joint.child == GROUND:
            raise ModelError(f"joint {joint.name}: the ground cannot be a child; swap parent and child")
        if joint.child in parents:
            raise ModelError(
                f"body {joint.child}: two parents, by the joints {parents[joint.child].name} and {joint.name}; "
                "make one of them a loop closure"
            )
        parents[joint.child] = joint
    for body in known[1:]:
        if body not in parents:
            raise ModelError(f"body {body}: no joint hangs it from another body or the ground")
        above, seen = body, set[str]()
        while above != GROUND:
            if above in seen:
                raise ModelError(f"body {body}: its joints lead round in a circle ({', '.join(sorted(seen))})")
            seen.add(above)
            above = parents[above].parent


def _check_connections(system: System) -> None:
    known = [GROUND, *(body.name for body in system.bodies)]
    ends: list[tuple[str, str]] = [(f"wheel {w.name}", w.body) for w in system.wheels]
    ends += [(f"loop {c.name}", body) for c in system.closures for body in (c.first, c.second)]
    ends += [(f"spring {s.name}", body) for s in system.springs for body in (s.first, s.second)]
    ends += [(f"sensor {s.name}", s.body) for s in system.sensors]
    for given in system.inputs:
        if isinstance(given, CoordinateForce):
            if given.coordinate not in system.coordinates:
                message = unknown_name("coordinate", given.coordinate, system.coordinates)
                raise ModelError(f"input {given.name}: {message}")
            continue
        ends.append((f"input {given.name}", given.body))
        if isinstance(given, Torque):
            ends.append((f"input {given.name}", given.reaction))
    for element, body in ends:
        if body not in known:
            raise ModelError(f"{element}: " + unknown_name("body", body, known))
    for wheel in system.wheels:
        if wheel.body == GROUND:
            raise ModelError(f"wheel {wheel.name}: the ground does not roll on itself")


def _check_ratios(system: System) -> None:
    for ratio in system.ratios:
        for name in ratio.factors:
            if name not in system.coordinates:
                raise ModelError(f"ratio {ratio.name}: " + unknown_name("coordinate", name, system.coordinates))


def _check_limits(system: System) -> None:
    loops = [closure.name for closure in system.closures]
    for limit in system.limits:
        for name in (limit.coordinate,) if isinstance(limit, Limit) else limit.coordinates:
            if name not in system.coordinates:
                raise ModelError("limit: " + unknown_name("coordinate", name, system.coordinates))
        if isinstance(limit, Limit):
            continue
        for name in limit.loops:
            if name not in loops:
                raise ModelError("limit: " + unknown_name("loop", name, loops))
        count = len(system.rows_of(limit.loops))
        if count != len(limit.coordinates):
            raise ModelError(
                f"reach of {', '.join(limit.loops)}: {count} equations do not determine {len(limit.coordinates)} "
                "coordinates"
            )
