"""Steady turns: lean, steer, torque, forces, and eigenvalues named by the modes they come from."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from scipy.optimize import linear_sum_assignment

from singletrack.arrays import Array
from singletrack.errors import ModelError
from singletrack.linear import modes
from singletrack.multibody.bicycle.coefficients import coefficients
from singletrack.multibody.bicycle.model import bicycle_model
from singletrack.multibody.bicycle.turning import circle, held_turn, held_turns, turn_eigenvalues
from singletrack.multibody.engine.dynamics import loop_forces, wheel_forces
from singletrack.posture import require_records
from singletrack.public.bounds import within

if TYPE_CHECKING:
    from singletrack.multibody.engine.equilibrium import SteadyMotion
    from singletrack.multibody.engine.model import Model
    from singletrack.parameters import Bicycle, Rider
    from singletrack.posture import Options

__all__ = ["Turn", "TurnFamily", "turn", "turn_family"]

NEUTRAL = "speed"
"""Of the eigenvalue zero: under the same torque there is a neighbouring turn at another speed."""


@dataclass(frozen=True, eq=False)
class Turn:
    """A steady turn.

    Attributes
    ----------
    speed
        Radius of the rear wheel times its turning rate, m/s.
    lean, steer
        rad, positive to the right.
    hand_torque
        The steer torque that holds the turn, N m, positive to the right.
    path_speed, radius, lateral_acceleration
        Of the rear contact, m/s, m (infinite straight ahead) and m/s^2, positive to the right.
    yaw_rate
        rad/s.
    wheel_forces
        (longitudinal, lateral, normal) of the ground on each wheel, N.
    hand_forces
        Of each hand on the handlebar, (3,), N: forward, to the right, down in the frame of the heading.
    names, eigenvalues
        Of small motions about it, 1/s: each is named by the mode that it comes from, straight ahead at this speed;
        ``speed`` is the zero that leads to the neighbouring turn.
    """

    speed: float
    lean: float
    steer: float
    hand_torque: float
    path_speed: float
    radius: float
    lateral_acceleration: float
    yaw_rate: float
    wheel_forces: dict[str, Array]
    hand_forces: dict[str, Array]
    names: tuple[str, ...]
    eigenvalues: Array

    @property
    def stable(self) -> bool:
        """Whether all small motions die out, but for the change to the neighbouring turn."""
        rest = [value for name, value in zip(self.names, self.eigenvalues, strict=True) if name != NEUTRAL]
        return bool(np.all(np.real(rest) < 0.0))

    @property
    def friction(self) -> float:
        """The coefficient of friction that the turn demands: the largest horizontal over normal force of a wheel."""
        return max(float(np.hypot(*force[:2]) / abs(force[2])) for force in self.wheel_forces.values())

    def to_dict(self) -> dict[str, Any]:
        """Return everything as numbers, lists and names, for JSON; a radius that is infinite as None."""
        scalars = (
            "speed",
            "lean",
            "steer",
            "hand_torque",
            "path_speed",
            "lateral_acceleration",
            "yaw_rate",
            "friction",
        )
        return {
            **{name: float(getattr(self, name)) for name in scalars},
            "radius": self.radius if np.isfinite(self.radius) else None,
            "wheel_forces": {name: force.tolist() for name, force in self.wheel_forces.items()},
            "hand_forces": {name: force.tolist() for name, force in self.hand_forces.items()},
            "modes": list(self.names),
            "eigenvalues": [[float(value.real), float(value.imag)] for value in self.eigenvalues],
            "stable": self.stable,
        }


@dataclass(frozen=True, eq=False)
class TurnFamily:
    """The turns at one speed, from nearly straight running to where they end.

    Attributes
    ----------
    turns
        In the order of the family; the lean may have a greatest value.
    end
        Why it ends, such as "left hand at the end of its reach".
    """

    turns: tuple[Turn, ...]
    end: str

    @property
    def names(self) -> tuple[str, ...]:
        """The modes, in the order of the eigenvalues of every turn."""
        return self.turns[0].names

    @property
    def eigenvalues(self) -> Array:
        """Of all turns, (k, modes), 1/s."""
        return np.array([turn.eigenvalues for turn in self.turns])


def turn(
    bicycle: Bicycle,
    rider: Rider | None = None,
    options: Options | str = "rigid",
    *,
    speed: float,
    lean: float | None = None,
    radius: float | None = None,
) -> Turn:
    """Return the steady turn at a speed with a lean angle or a radius.

    Parameters
    ----------
    bicycle, rider
        One design; numbers, no arrays.
    options
        How the rider sits, or a posture's name.
    speed
        Radius of the rear wheel times its turning rate, m/s.
    lean, radius
        One of them: rad, or the radius of the rear contact's circle, m; positive to the right.

    Raises
    ------
    InputError
        Where neither or both are given, or a value is not allowed.
    ModelError
        Where there is no such turn: a hand would be at the end of its reach, a wheel off the ground.

    Examples
    --------
    >>> from singletrack import load_bicycle, load_rider
    >>> found = turn(load_bicycle("stratos"), load_rider("rider-a"), "leaned", speed=6.0, lean=0.2)
    >>> found.names
    ('weave', 'weave', 'capsize', 'castering', 'speed')
    >>> round(found.radius, 1), round(found.hand_torque, 2)
    (17.9, -0.29)
    """
    require_records(bicycle, rider)
    speed = within("speed", speed)
    lean = None if lean is None else within("lean", lean)
    radius = None if radius is None else within("radius", radius)
    model = bicycle_model(bicycle, rider, options)
    sought = held_turn(model, speed, lean=lean, radius=radius)
    way = sought.state["lean"]
    names, start = _straight(bicycle, rider, options, speed)

    def reached(motion: SteadyMotion) -> str:
        return "reached" if abs(motion.state["lean"]) >= abs(way) else ""

    if abs(way) < 1e-3:
        return _turn(model, sought, names, _matched(start, turn_eigenvalues(sought)))
    between = held_turns(model, speed, right=way > 0.0, until=reached).motions[:-1]
    for motion in (*between, sought):
        start = _matched(start, turn_eigenvalues(motion))
    return _turn(model, sought, names, start)


def turn_family(
    bicycle: Bicycle,
    rider: Rider | None = None,
    options: Options | str = "rigid",
    *,
    speed: float,
    right: bool = True,
) -> TurnFamily:
    """Return the turns at a speed, from nearly straight running to where a hand, a wheel or the ground ends them.

    Parameters
    ----------
    bicycle, rider, options
        As for :func:`turn`.
    speed
        Radius of the rear wheel times its turning rate, m/s.
    right
        Turns to the right, or to the left.

    Examples
    --------
    >>> from singletrack import load_bicycle, load_rider
    >>> family = turn_family(load_bicycle("browser"), load_rider("rider-a"), "upright", speed=5.0)
    >>> family.end
    'left hand at the end of its reach'
    """
    require_records(bicycle, rider)
    speed = within("speed", speed)
    model = bicycle_model(bicycle, rider, options)
    names, values = _straight(bicycle, rider, options, speed)
    family = held_turns(model, speed, right=right)
    found = []
    for motion in family.motions:
        values = _matched(values, turn_eigenvalues(motion))
        found.append(_turn(model, motion, names, values))
    return TurnFamily(tuple(found), family.end)


def _straight(
    bicycle: Bicycle, rider: Rider | None, options: Options | str, speed: float
) -> tuple[tuple[str, ...], Array]:
    """Return the names and eigenvalues of the modes straight ahead, the neutral one last."""
    found = modes(coefficients(bicycle, rider, options), speed)
    return (*found.names, NEUTRAL), np.append(np.reshape(found.eigenvalues, -1), 0.0)


def _matched(before: Array, values: Array) -> Array:
    """Return eigenvalues in the order of those of a neighbouring motion: the nearest, each once; the zero last."""
    if len(before) != len(values):
        raise ModelError(f"{len(values)} eigenvalues of a turn do not continue {len(before)} of straight running")
    neutral = int(np.argmin(abs(values)))
    others = np.delete(values, neutral)
    rows, columns = linear_sum_assignment(abs(before[:-1, None] - others[None, :]))
    return np.append(others[columns[np.argsort(rows)]], values[neutral])


def _turn(model: Model, motion: SteadyMotion, names: tuple[str, ...], values: Array) -> Turn:
    state, way = motion.state, circle(motion)
    c, s = np.cos(state["yaw"]), np.sin(state["yaw"])
    heading = np.array([[c, s, 0.0], [-s, c, 0.0], [0.0, 0.0, 1.0]])
    return Turn(
        speed=-model.system.parameters["rear radius"] * state.rate("rear wheel"),
        lean=state["lean"],
        steer=state["steer"],
        hand_torque=motion.inputs["steer torque"],
        path_speed=way.path_speed,
        radius=way.radius,
        lateral_acceleration=way.lateral_acceleration,
        yaw_rate=state.rate("yaw"),
        wheel_forces=wheel_forces(state, motion.inputs),
        hand_forces={name: heading @ force for name, force in loop_forces(state, motion.inputs).items()},
        names=names,
        eigenvalues=values,
    )
