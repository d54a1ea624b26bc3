"""The postures as joints and loops: a description only, which both derivations of the equations read.

``rigid``
    Hands free; all segments stay with the frame (Whipple's rider).
``upright``
    Torso and head stay with the frame. Shoulder: flexion about y, then rotation about the upper arm's own axis.
    Elbow: hinge about y. Hand: ball joint at the grip. (``shoulder="abduction"``: as in ``leaned``.)
``leaned``
    Torso and head pitch about y through the hips, then twist about the hip-shoulder line. Elbows are locked.
    Shoulder: flexion about y, then abduction about the axis normal to y and to the shoulder-grip line
    (``shoulder="axial"``: rotation about the upper arm's axis instead). Hand: ball joint at the grip.

No posture adds a degree of freedom: the arms close loops that leave the steer angle to say where everything is.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from singletrack.arrays import Array, unit_vector, vector
from singletrack.body import Segment, Skeleton, rider_segments, skeleton
from singletrack.posture.options import Options

if TYPE_CHECKING:
    from singletrack.parameters import Bicycle, Rider

__all__ = ["Joint", "Loop", "Posture", "seat"]

_DEFAULT_SHOULDER = {"leaned": "abduction", "upright": "axial"}
# Skeleton points of each arm.
_ARMS = {"right": {"shoulder": 21, "elbow": 23, "grip": 19}, "left": {"shoulder": 22, "elbow": 24, "grip": 20}}


@dataclass(frozen=True, eq=False)
class Joint:
    """A hinge of the rider.

    Attributes
    ----------
    name : str
    parent : str
        Name of the joint whose link carries this one, "" for the rear frame.
    point, axis : array, shape (..., 3)
        A point on the axis, in m, and the axis' unit vector, in the bicycle's frame, upright and straight ahead.
    """

    name: str
    parent: str
    point: Array
    axis: Array


@dataclass(frozen=True, eq=False)
class Loop:
    """A hand on the handlebar: a point of the last link that stays at a point of the front frame.

    Attributes
    ----------
    name : str
    joint : str
        Name of the joint whose link carries the hand.
    point : array, shape (..., 3)
        The grip, in m.
    """

    name: str
    joint: str
    point: Array


@dataclass(frozen=True, eq=False)
class Posture:
    """A rider seated on a bicycle.

    Attributes
    ----------
    name, shoulder : str
        The posture; the shoulder's second axis ("" without hands on the bar).
    skeleton : Skeleton
    segments : dict of str to Segment
        The rider's bodies by name.
    joints : tuple of Joint
        Each after its parent.
    loops : tuple of Loop
    carried_by : dict of str to str
        Name of the joint whose link a segment belongs to; segments that are not named stay with the rear frame.
    """

    name: str
    shoulder: str
    skeleton: Skeleton
    segments: dict[str, Segment]
    joints: tuple[Joint, ...] = ()
    loops: tuple[Loop, ...] = ()
    carried_by: dict[str, str] | None = None

    def chain(self, joint: str) -> tuple[Joint, ...]:
        """Return the joints from the rear frame out to ``joint``, in order ("" gives none)."""
        by_name = {j.name: j for j in self.joints}
        chain: list[Joint] = []
        while joint:
            chain.insert(0, by_name[joint])
            joint = by_name[joint].parent
        return tuple(chain)


def seat(bicycle: Bicycle, rider: Rider, options: Options | str = "rigid") -> Posture:
    """Seat a rider on a bicycle in a posture.

    Parameters
    ----------
    bicycle : Bicycle
    rider : Rider
    options : Options or str
        How the rider sits, or a posture's name.

    Raises
    ------
    InputError
        For an unknown name, a bicycle without frame geometry, a rider without forward lean angle.
    PostureError
        If arms or legs do not reach.

    Examples
    --------
    >>> from singletrack import load_bicycle, load_rider
    >>> [joint.name for joint in seat(load_bicycle("browser"), load_rider("rider-a"), "upright").joints][:3]
    ['right shoulder flexion', 'right shoulder rotation', 'right elbow']
    """
    options = Options.of(options)
    posture = options.posture
    points = skeleton(bicycle, rider)
    segments = rider_segments(rider, points)
    chosen = options.shoulder or _DEFAULT_SHOULDER.get(posture, "")
    if posture == "upright":
        return _upright(points, segments, chosen)
    if posture == "leaned":
        return _leaned(points, segments, chosen)
    return Posture("rigid", "", points, segments, carried_by={})


def _y() -> Array:
    return vector(0.0, 1.0, 0.0)


def _second_axis(kind: str, shoulder: Array, elbow: Array, grip: Array) -> tuple[str, Array]:
    """Return what the shoulder does about its second axis, and that axis' unit vector (..., 3)."""
    if kind == "axial":
        return "rotation", unit_vector(elbow - shoulder)
    along = unit_vector(grip - shoulder)
    return "abduction", vector(-along[..., 2], 0.0, along[..., 0])


def _upright(points: Skeleton, segments: dict[str, Segment], shoulder_kind: str) -> Posture:
    joints: list[Joint] = []
    loops: list[Loop] = []
    carried: dict[str, str] = {}
    for side, arm in _ARMS.items():
        shoulder, elbow, grip = (points[arm[place]] for place in ("shoulder", "elbow", "grip"))
        second, axis = _second_axis(shoulder_kind, shoulder, elbow, grip)
        flexion, turning, hinge = f"{side} shoulder flexion", f"{side} shoulder {second}", f"{side} elbow"
        joints += [
            Joint(flexion, "", shoulder, _y()),
            Joint(turning, flexion, shoulder, axis),
            Joint(hinge, turning, elbow, _y()),
        ]
        loops.append(Loop(f"{side} hand", hinge, grip))
        carried |= {f"{side}_upper_arm": turning, f"{side}_lower_arm": hinge}
    return Posture("upright", shoulder_kind, points, segments, tuple(joints), tuple(loops), carried)


def _leaned(points: Skeleton, segments: dict[str, Segment], shoulder_kind: str) -> Posture:
    pitch = Joint("torso pitch", "", points[13], _y())
    twist = Joint("torso twist", "torso pitch", points[13], unit_vector(points[15] - points[13]))
    joints, loops = [pitch, twist], []
    carried = {"torso": twist.name, "head": twist.name}
    for side, arm in _ARMS.items():
        shoulder, elbow, grip = (points[arm[place]] for place in ("shoulder", "elbow", "grip"))
        second, axis = _second_axis(shoulder_kind, shoulder, elbow, grip)
        flexion = Joint(f"{side} shoulder flexion", twist.name, shoulder, _y())
        joints += [flexion, Joint(f"{side} shoulder {second}", flexion.name, shoulder, axis)]
        loops.append(Loop(f"{side} hand", joints[-1].name, grip))
        carried |= {f"{side}_upper_arm": joints[-1].name, f"{side}_lower_arm": joints[-1].name}
    return Posture("leaned", shoulder_kind, points, segments, tuple(joints), tuple(loops), carried)
