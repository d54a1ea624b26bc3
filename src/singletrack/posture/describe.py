"""A mechanism in words: its tree of joints with what hangs on them, its loops, and where a rider puts them."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from singletrack.body import POINT_NAMES
from singletrack.posture.mechanism import FRAME

if TYPE_CHECKING:
    from collections.abc import Iterator

    from singletrack.posture.mechanism import Direction, JointPlan, Mechanism, Place
    from singletrack.posture.seated import Posture

__all__ = ["mechanism_lines"]

_AXES = {(1.0, 0.0, 0.0): "x", (0.0, 1.0, 0.0): "y", (0.0, 0.0, 1.0): "z"}


def mechanism_lines(mechanism: Mechanism, seated: Posture | None = None) -> Iterator[str]:
    """Yield lines that say what a mechanism is made of.

    Parameters
    ----------
    mechanism : Mechanism
    seated : Posture, optional
        A rider in it, for the numbers of points and axes.

    Examples
    --------
    >>> from singletrack.posture import load_posture
    >>> for line in list(mechanism_lines(load_posture("upright")))[3:7]:
    ...     print(line)
    frame: torso, head, right upper leg, right lower leg, left upper leg, left lower leg
      right shoulder flexion: hinge about y at right shoulder
        right shoulder rotation: hinge about right shoulder - right elbow at right shoulder; right upper arm
          right elbow: hinge about the normal to the right arm at right elbow; right lower arm
    """
    yield f"posture {mechanism.name}"
    yield mechanism.description
    yield f"source: {mechanism.source}" if mechanism.source else ""
    yield f"frame: {_segments(mechanism, FRAME)}"
    depth = {FRAME: 0}
    numbers = {} if seated is None else {joint.name: joint for joint in seated.joints}
    for plan in _in_tree_order(mechanism):
        depth[plan.name] = depth[plan.parent] + 1
        carried = _segments(mechanism, plan.name)
        line = f"{'  ' * depth[plan.name]}{plan.name}: {_joint_words(plan)}{f'; {carried}' if carried else ''}"
        if plan.name in numbers:
            joint = numbers[plan.name]
            line += f"  [at {_numbers(joint.point)} m, axis {_numbers(joint.axis)}]"
        yield line
    for loop in mechanism.loops:
        if loop.point is not None:
            held = "is held to" if loop.stiffness is None else f"is held by {loop.stiffness:g} N/m to"
            yield f"loop {loop.name}: {_place_words(loop.point)} on the link of {loop.joint} {held} the {loop.to}"
        elif loop.perpendicular is not None:
            one, other = (_direction_words(direction) for direction in loop.perpendicular)
            yield f"loop {loop.name}: {one} of {loop.joint} stays perpendicular to {other} of the {loop.to}"
    yield f"freedoms beside lean and steer: {', '.join(mechanism.freedoms) or 'none'}"


def _in_tree_order(mechanism: Mechanism, parent: str = FRAME) -> Iterator[JointPlan]:
    for plan in mechanism.joints:
        if plan.parent == parent:
            yield plan
            yield from _in_tree_order(mechanism, plan.name)


def _segments(mechanism: Mechanism, joint: str) -> str:
    found = [segment.replace("_", " ") for segment, holder in mechanism.segments.items() if holder == joint]
    return ", ".join(sorted(found, key=lambda name: ("leg" in name, "arm" in name)))


def _joint_words(plan: JointPlan) -> str:
    words = "slides along " if plan.slides else "hinge about "
    words += _direction_words(plan.axis) + ("" if plan.slides else f" at {_place_words(plan.point)}")
    unit = "N/m" if plan.slides else "N m/rad"
    if np.any(plan.stiffness):
        words += f", stiffness {plan.stiffness:g} {unit}"
    if np.any(plan.damping):
        words += f", damping {plan.damping:g} {'N s/m' if plan.slides else 'N m s/rad'}"
    if np.any(plan.preload):
        words += f", preload {plan.preload:g} {'N' if plan.slides else 'N m'}"
    return words + (", free" if plan.free else "")


def _place_words(place: Place) -> str:
    if place.at is not None:
        return f"{_numbers(place.at)} m"
    start = POINT_NAMES[place.number - 1]
    return f"{place.share:.3g} from {start} to {POINT_NAMES[place.towards - 1]}" if place.towards else start


def _direction_words(direction: Direction) -> str:
    if direction.vector is not None:
        return _AXES.get(direction.vector, _numbers(direction.vector))
    if direction.start is None or direction.end is None:
        return "the steer axis" if direction.name == "steer" else f"the normal to the {direction.name.split()[0]} arm"
    line = f"{_place_words(direction.start)} - {_place_words(direction.end)}"
    if direction.across is None:
        return line
    return f"the normal to {line} and {_AXES.get(direction.across, _numbers(direction.across))}"


def _numbers(values: object) -> str:
    return f"({', '.join(f'{float(value):.4g}' for value in np.asarray(values))})"
