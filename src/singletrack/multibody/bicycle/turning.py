"""Steady turns of a bicycle with its rider that the hands hold: one of them, and families up to where they end."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from singletrack.errors import InputError, ModelError
from singletrack.multibody.engine.continuation import Family, follow
from singletrack.multibody.engine.equilibrium import SteadyMotion, steady_motion
from singletrack.multibody.engine.linearise import linearise

if TYPE_CHECKING:
    from collections.abc import Callable

    from singletrack.arrays import Array
    from singletrack.multibody.engine.model import Model

__all__ = ["SMALL", "STEP", "Circle", "circle", "held_turn", "held_turns", "resting", "turn_eigenvalues"]

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
    """Return the eigenvalues of small motions about a steady turn, 1/s; one is zero, of the neighbouring turn.

    Shape (m,), complex.

    Parameters
    ----------
    motion : SteadyMotion
        The turn.
    """
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
