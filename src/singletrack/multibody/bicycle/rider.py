"""The rider as bodies, hinges and hands on the handlebar, from the description of the posture."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from singletrack.mechanics import combine
from singletrack.multibody.engine.closures import Closure, close_point
from singletrack.multibody.engine.elements import Body
from singletrack.multibody.engine.joints import prismatic, revolute
from singletrack.posture import HANDLEBAR

if TYPE_CHECKING:
    from singletrack.body import Segment
    from singletrack.multibody.bicycle.parametrise import Numbers
    from singletrack.posture import Posture

__all__ = ["frame_segments", "preload_name", "rider_elements"]


def frame_segments(posture: Posture) -> list[Segment]:
    """Return the segments that stay with the rear frame.

    >>> from singletrack import load_bicycle, load_rider
    >>> from singletrack.posture import seat
    >>> len(frame_segments(seat(load_bicycle("browser"), load_rider("rider-a"), "upright")))
    6
    """
    carried = posture.carried_by or {}
    return [segment for name, segment in posture.segments.items() if not carried.get(name)]


def rider_elements(posture: Posture, numbers: Numbers) -> dict[str, list[Any]]:
    """Return the moving bodies, the joints and the closures of the hands of a seated rider.

    Each hinge of the posture carries one body, which unites the segments on it and may have no mass; each hand is a
    ball joint between the last body of an arm and the front frame, so that its force is that on the handlebar.

    Parameters
    ----------
    posture
        The seated rider.
    numbers
        Takes the rider's numbers as parameters.

    Examples
    --------
    >>> from singletrack import load_bicycle, load_rider
    >>> from singletrack.multibody.bicycle.parametrise import Numbers
    >>> from singletrack.posture import seat
    >>> posture = seat(load_bicycle("stratos"), load_rider("rider-a"), "leaned")
    >>> elements = rider_elements(posture, Numbers())
    >>> [joint.name for joint in elements["joints"]][:3]
    ['torso pitch', 'torso twist', 'right shoulder flexion']
    """
    bodies, joints, closures = [], [], []
    carried = posture.carried_by or {}
    for joint in posture.joints:
        own = [segment for name, segment in posture.segments.items() if carried.get(name) == joint.name]
        link = f"{joint.name} link"
        if own:
            solid = combine(own)
            bodies.append(
                Body(
                    link,
                    numbers.number(f"{link} mass", solid.mass),
                    numbers.vector(f"{link} centre", solid.centre),
                    numbers.inertia(f"{link} inertia", solid.inertia),
                )
            )
        else:
            bodies.append(Body(link))
        axis = numbers.vector(joint.name, joint.axis)
        law = {
            what: numbers.number(f"{joint.name} {what}", getattr(joint, what))
            for what in ("stiffness", "damping", "preload")
        }
        if joint.free:
            law["preload"] = numbers.always(preload_name(joint.name), 0.0)
        if joint.slides:
            joints.append(prismatic(joint.name, _body(joint.parent), link, axis, **law))
        else:
            point = numbers.vector(f"{joint.name} point", joint.point)
            joints.append(revolute(joint.name, _body(joint.parent), link, point, axis, **law))
    for loop in posture.loops:
        near, far = _body(loop.joint), _body(loop.to)
        if loop.directions is None:
            closures.append(close_point(loop.name, near, far, numbers.vector(f"{loop.name} grip", loop.point)))
        else:
            one, other = (numbers.vector(f"{loop.name} {k}", loop.directions[k]) for k in (0, 1))
            closures.append(Closure(loop.name, near, far, orthogonal=((one, other),)))
    return {"bodies": bodies, "joints": joints, "closures": closures}


def preload_name(joint: str) -> str:
    """Return the parameter that holds the preload of a free joint, with which it is in balance at rest."""
    return f"{joint} balance"


def _body(link: str) -> str:
    """Return the body that moves with a joint, with the handlebar, or with the frame ("")."""
    return {"": "rear frame", HANDLEBAR: "front frame"}.get(link, f"{link} link")
