"""Steady turns of a bicycle with its rider: one of them, and families over the lean angle, through their folds."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from singletrack.errors import InputError, ModelError, unknown_name
from singletrack.multibody.engine.continuation import Family, follow
from singletrack.multibody.engine.equilibrium import SteadyMotion, steady_motion
from singletrack.multibody.engine.linearise import linearise

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    import xarray as xr

    from singletrack.arrays import Array
    from singletrack.multibody.engine.model import Model

__all__ = [
    "Circle",
    "circle",
    "free_turns",
    "hands_free_family",
    "held_turn",
    "held_turns",
    "resting",
    "turn_eigenvalues",
]

RESTING = ("lean", "steer")
SMALL = 1e-3
STEP = 0.05
CLOSE = 1e-10
STRAIGHT = 1e-12


@dataclass(frozen=True)
class Circle:
    """The circle that the rear contact goes round in a steady turn.

    Attributes
    ----------
    curvature
        1/m, positive to the right; zero straight ahead.
    path_speed
        Speed of the contact along it, m/s.
    lateral_acceleration
        Of the rear contact towards the centre, m/s^2, positive to the right.
    """

    curvature: float
    path_speed: float
    lateral_acceleration: float

    @property
    def radius(self) -> float:
        """Its radius, m, positive to the right; infinite straight ahead."""
        return 1.0 / self.curvature if abs(self.curvature) > STRAIGHT else np.inf


def resting(model: Model) -> tuple[str, ...]:
    """Return the names of the coordinates that matter in a turn: all freedoms but the rear wheel.

    >>> from singletrack import load_bicycle
    >>> from singletrack.multibody import bicycle_model
    >>> resting(bicycle_model(load_bicycle("benchmark")))
    ('lean', 'steer')
    """
    return tuple(name for name in model.system.independent or RESTING if name != "rear wheel")


def circle(motion: SteadyMotion) -> Circle:
    """Return the circle of a steady motion of a bicycle."""
    state = motion.state
    wheel = [wheel.name for wheel in state.model.system.wheels].index("rear wheel")
    contact = state.model.equations.contacts(state.q, state.parameters)[0].full()[:2, wheel]
    apart = contact - np.array([state["x"], state["y"]])
    yaw = state.rate("yaw")
    # the contact keeps its place in the frame: it moves as a point that turns with the yaw rate does
    velocity = np.array([state.rate("x"), state.rate("y")]) + yaw * np.array([-apart[1], apart[0]])
    speed = float(np.hypot(*velocity))
    return Circle(yaw / speed if speed else 0.0, speed, yaw * speed)


def turn_eigenvalues(motion: SteadyMotion) -> Array:
    """Return the eigenvalues of small motions about a steady turn, 1/s; one is zero, of the neighbouring turn."""
    return linearise(motion.state, motion.inputs, keep=resting(motion.state.model)).eigenvalues()


def held_turn(
    model: Model,
    speed: float,
    *,
    lean: float | None = None,
    radius: float | None = None,
    guess: SteadyMotion | None = None,
) -> SteadyMotion:
    """Return the turn at a speed with a lean angle or a radius, which the hands hold by a steer torque.

    Parameters
    ----------
    model
        From :func:`bicycle_model`.
    speed
        Radius of the rear wheel times its turning rate, m/s.
    lean, radius
        One of them: rad, or the radius of the rear contact's circle, m; positive to the right.
    guess
        A turn nearby.

    Raises
    ------
    InputError
        Where neither or both are given, or a value is not allowed.
    ModelError
        Where there is no such turn; what stands in the way is named.

    Examples
    --------
    >>> from singletrack import load_bicycle
    >>> from singletrack.multibody import bicycle_model
    >>> turn = held_turn(bicycle_model(load_bicycle("benchmark")), 6.0, radius=10.0)
    >>> round(circle(turn).radius, 9), round(float(np.degrees(turn.state["lean"])), 1)
    (10.0, 19.7)
    """
    if (lean is None) == (radius is None):
        raise InputError("turn: give either the lean or the radius")
    if not np.isfinite(speed) or speed <= 0.0:
        raise InputError(f"speed: {speed!r} m/s; a turn needs a speed above zero")
    if radius is not None and (np.isnan(radius) or radius == 0.0):
        raise InputError(f"radius: {radius!r} m; allowed: any but zero, positive to the right")
    sideways = float(lean if lean is not None else 1.0 / radius if radius else 0.0)
    if guess is None and abs(sideways) > SMALL:
        guess = _near(model, speed, lean, radius)
    if lean is not None:
        return _held(model, speed, lean, guess)
    angle = guess.state["lean"] if guess is not None else 0.0
    for _ in range(30):
        here = _held(model, speed, angle, guess)
        beside = _held(model, speed, angle + 1e-5, here)
        curve = circle(here).curvature
        change = (sideways - curve) * 1e-5 / (circle(beside).curvature - curve)
        if abs(change) < CLOSE * max(1.0, abs(angle)):
            return here
        angle, guess = angle + float(np.clip(change, -0.1, 0.1)), here
    raise ModelError(f"no turn of radius {radius:g} m at {speed:g} m/s was found")


def _held(model: Model, speed: float, lean: float, guess: SteadyMotion | None) -> SteadyMotion:
    rear = -speed / model.system.parameters["rear radius"]
    start = {} if guess is None else {name: guess.state[name] for name in model.system.coordinates}
    return steady_motion(
        model,
        {"lean": lean},
        {"rear wheel": rear},
        resting=resting(model),
        guess=start | {"lean": lean},
        adjust=["steer torque"],
        inputs=None if guess is None else guess.inputs,
    )


def _near(model: Model, speed: float, lean: float | None, radius: float | None) -> SteadyMotion:
    """Return a turn of the family near the one sought, reached from straight running."""
    right = (lean if lean is not None else radius or 0.0) > 0.0

    def reached(motion: SteadyMotion) -> str:
        if lean is not None:
            return "lean" if abs(motion.state["lean"]) >= abs(lean) else ""
        return "radius" if abs(circle(motion).radius) <= abs(radius or 0.0) else ""

    family = held_turns(model, speed, right=right, until=reached)
    if family.end in {"lean", "radius"}:
        return family.motions[-1]
    last, greatest = family.motions[-1], max(abs(m.state["lean"]) for m in family.motions)
    raise ModelError(
        f"no such turn at {speed:g} m/s: {family.end} (greatest lean {np.degrees(greatest):.1f} deg, smallest radius "
        f"{abs(circle(last).radius):.2f} m)"
    )


def held_turns(
    model: Model, speed: float, *, right: bool = True, until: Callable[[SteadyMotion], str] | None = None
) -> Family:
    """Return the turns at a speed, held by a steer torque, from nearly straight running to where they end.

    They end where a hand is at the end of its reach, a wheel would leave the ground, or the bicycle would lie down.

    Parameters
    ----------
    model
        From :func:`bicycle_model`.
    speed
        Radius of the rear wheel times its turning rate, m/s.
    right
        Turns to the right, or to the left.
    until
        Returns why the family ends with a turn, or nothing.
    """
    sign = 1.0 if right else -1.0
    start = _held(model, speed, sign * SMALL, None)
    return follow(
        start,
        resting(model),
        rates=["rear wheel"],
        adjust=["steer torque"],
        towards={"lean": sign},
        step=STEP,
        until=until,
    )


def hands_free_family(
    model: Model,
    speed: float,
    *,
    right: bool = True,
    guess: Mapping[str, float] | None = None,
    along: str = "lean",
    first: float = SMALL,
) -> Family:
    """Return the turns without torques, from nearly straight running at the capsize speed to where the bicycle stands.

    Parameters
    ----------
    model
        From :func:`bicycle_model`.
    speed
        Where to look for the first turn, m/s.
    right
        Turns to the right, or to the left.
    guess
        Coordinates to start with.
    along, first
        The angle that is given of the first turn, ``lean`` or ``steer``, and its size, rad.

    Examples
    --------
    >>> from singletrack import load_bicycle
    >>> from singletrack.multibody import bicycle_model
    >>> family = hands_free_family(bicycle_model(load_bicycle("benchmark")), 6.0)
    >>> family.end, round(max(motion.state["lean"] for motion in family.motions), 2)
    ('it stands still', 0.42)
    """
    sign = 1.0 if right else -1.0
    wheel = model.system.parameters["rear radius"]
    start = steady_motion(
        model,
        {along: sign * first},
        resting=resting(model),
        guess=guess,
        guess_rates={"rear wheel": -speed / wheel},
    )
    forward = np.sign(start.state.rate("rear wheel"))

    def stands(motion: SteadyMotion) -> str:
        return "it stands still" if motion.state.rate("rear wheel") * forward <= 0.0 else ""

    return follow(start, resting(model), towards={along: sign}, step=STEP, until=stands)


def free_turns(
    model: Model, values: Array, speed: float, *, along: str = "lean", guess: Mapping[str, float] | None = None
) -> xr.Dataset:
    """Return the steady turns without torques that continue each other from nearly straight running outwards.

    The family begins at straight running at the capsize speed, so ``speed`` should be near it. It is followed by the
    length of its arc, so that a fold is passed without a jump to another family.

    Parameters
    ----------
    model
        From :func:`bicycle_model`.
    values
        Lean or steer angles, rad, (k,), none of them zero; the smallest on each side should be small.
    speed
        Where to look for the first turn, m/s.
    along
        ``lean`` or ``steer``: which angle is given. The lean of a family may have a greatest value, beyond which
        only the steer goes on.
    guess
        Coordinates to start with, where not near straight running.

    Returns
    -------
    xarray.Dataset
        Over ``turn``: ``lean``, ``steer`` (rad), ``speed`` (m/s, radius times turning rate of the rear wheel),
        ``yaw_rate`` (rad/s), ``radius`` of the circle of the frame's point drawn at the rear contact (m) and
        ``growth``, the largest real part of an eigenvalue (1/s); negative where the turn is stable.

    Raises
    ------
    InputError
        For an unknown ``along``.
    ModelError
        Where no turn is found, as beyond the greatest lean.

    Examples
    --------
    >>> from singletrack import load_bicycle
    >>> from singletrack.multibody import bicycle_model
    >>> turns = free_turns(bicycle_model(load_bicycle("benchmark")), [1e-3, 0.1], speed=6.0)
    >>> turns.speed.round(3).values.tolist()
    [6.024, 5.998]
    """
    import xarray as xr  # slow to import

    if along not in RESTING:
        raise InputError(unknown_name("angle to go along", along, RESTING))
    values = np.asarray(values, dtype=float)
    found: dict[float, SteadyMotion] = {}
    for side in (values[values > 0.0], values[values < 0.0]):
        if len(side):
            found |= _of_family(model, sorted(side.tolist(), key=abs), speed, along, guess)
    turns = [found[value] for value in values.tolist()]
    wheel = model.system.parameters["rear radius"]
    states = [turn.state for turn in turns]
    columns = {
        "lean": [state["lean"] for state in states],
        "steer": [state["steer"] for state in states],
        "speed": [-wheel * state.rate("rear wheel") for state in states],
        "yaw_rate": [state.rate("yaw") for state in states],
        "radius": [np.hypot(state.rate("x"), state.rate("y")) / abs(state.rate("yaw")) for state in states],
        "growth": [_growth(turn) for turn in turns],
    }
    return xr.Dataset({name: ("turn", column) for name, column in columns.items()})


def _of_family(
    model: Model, values: list[float], speed: float, along: str, guess: Mapping[str, float] | None
) -> dict[float, SteadyMotion]:
    """Return the turns with some values of an angle, in the order in which the family comes to them."""
    names = model.system.coordinates
    right = values[0] > 0.0
    family = hands_free_family(model, speed, right=right, guess=guess, along=along, first=abs(values[0]))
    found = {values[0]: family.motions[0]}
    for value in values[1:]:
        near = next((m for m in family.motions if abs(m.state[along]) >= abs(value)), None)
        if near is None:
            greatest = max(abs(motion.state[along]) for motion in family.motions)
            raise ModelError(
                f"no steady motion found with {along} {value:g} rad: the greatest of this family is {greatest:.4g} rad"
            )
        found[value] = steady_motion(
            model,
            {along: value},
            resting=resting(model),
            guess={name: near.state[name] for name in names},
            guess_rates={"rear wheel": near.state.rate("rear wheel")},
        )
    return found


def _growth(turn: SteadyMotion) -> float:
    """Return the largest real part of the eigenvalues, but for the zero that leads to the neighbouring turn."""
    values = turn_eigenvalues(turn)
    return float(np.max(np.delete(values, np.argmin(abs(values))).real))
