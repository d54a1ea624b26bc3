"""A rider's mechanism as data: joints in a tree, loops that close it, and which segment hangs on which joint.

A description only: points are those of a skeleton, axes lines between them, so that one mechanism fits every rider on
every bicycle. :func:`singletrack.posture.seat` puts a rider into it.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from singletrack.arrays import Number
from singletrack.errors import InputError, unknown_name

__all__ = ["FRAME", "HANDLEBAR", "SEGMENTS", "Direction", "JointPlan", "LoopPlan", "Mechanism", "Place"]

#: N m/rad, N m s/rad, N/m, N s/m: nothing that is ridden is stiffer by far; beyond, numbers overflow within.
STIFFEST = 1e12
#: What a joint or a loop may be fixed to beside other joints.
FRAME, HANDLEBAR = "frame", "handlebar"
_RESERVED = (FRAME, HANDLEBAR, "lean", "steer")
_TRUNK, _LEGS = ("head", "torso"), ("right_upper_leg", "right_lower_leg", "left_upper_leg", "left_lower_leg")
#: Names of a rider's segments by kind of arms.
SEGMENTS = {
    "bent": (*_TRUNK, "right_upper_arm", "left_upper_arm", "right_lower_arm", "left_lower_arm", *_LEGS),
    "straight": (*_TRUNK, "right_arm", "left_arm", *_LEGS),
}

Triple = tuple[float, float, float]


@dataclass(frozen=True)
class Place:
    """A point: of the skeleton, on the way from one of its points to another, or by coordinates.

    Attributes
    ----------
    number, towards : int
        Skeleton points, 1 to 31; 0 for none.
    share : float
        How far on the way from ``number`` to ``towards``.
    at : tuple of float, optional
        Coordinates in m in the bicycle's frame, instead.
    """

    number: int = 0
    towards: int = 0
    share: float = 0.0
    at: Triple | None = None


@dataclass(frozen=True)
class Direction:
    """A direction, in the bicycle's frame, upright and straight ahead.

    Attributes
    ----------
    vector : tuple of float, optional
        Its components.
    name : str
        ``steer`` (the steer axis, down), ``right elbow``, ``left elbow`` (normal to the plane of the arm, to the right
        where the arm is in a vertical plane).
    start, end : Place, optional
        Ends of the line along which it points.
    across : tuple of float, optional
        With a line: the normal to the line and to this vector, line x vector.
    """

    vector: Triple | None = None
    name: str = ""
    start: Place | None = None
    end: Place | None = None
    across: Triple | None = None


@dataclass(frozen=True, eq=False)
class JointPlan:
    """A joint: a hinge about an axis, or a slider along it.

    Attributes
    ----------
    name, parent : str
        The parent is another joint, whose link carries this one, or ``frame``.
    point : Place
        On the hinge's axis.
    axis : Direction
    slides : bool
        A slider instead of a hinge.
    free : bool
        Whether the joint is a coordinate of the model; others must follow from the loops.
    stiffness, damping, preload : array
        Of a spring and damper, N m/rad, N m s/rad, N m (N/m, N s/m, N for sliders). A free joint has the preload
        that balances rest.
    """

    name: str
    parent: str
    point: Place
    axis: Direction
    slides: bool = False
    free: bool = False
    stiffness: Number = 0.0
    damping: Number = 0.0
    preload: Number = 0.0


@dataclass(frozen=True, eq=False)
class LoopPlan:
    """A loop: a point of a joint's link stays at a point of something else, or two directions stay perpendicular.

    Attributes
    ----------
    name, joint : str
    to : str
        ``handlebar``, ``frame`` or another joint's name.
    point : Place, optional
        The point that both have in common (a ball joint).
    at : Place, optional
        The other's point, where it is given by itself; must be the same place at rest.
    perpendicular : (Direction, Direction), optional
        Instead: a direction of the joint's link and one of the other, which are perpendicular and stay so.
    stiffness, damping : array, optional
        Of a soft hand, N/m and N s/m: the point is held by springs alike in all directions. None: it is held fast.
    """

    name: str
    joint: str
    to: str = HANDLEBAR
    point: Place | None = None
    perpendicular: tuple[Direction, Direction] | None = None
    stiffness: Number | None = None
    damping: Number = 0.0
    at: Place | None = None


@dataclass(frozen=True, eq=False)
class Mechanism:
    """A rider's mechanism.

    Attributes
    ----------
    name, description, source : str
    joints : tuple of JointPlan
        Each after its parent.
    loops : tuple of LoopPlan
    segments : mapping of str to str
        The joint on whose link each segment hangs, or ``frame``.
    arms : {"bent", "straight"}
        Upper and lower arms, or each arm one straight segment.

    Raises
    ------
    InputError
        For names that are not known or used twice, a parent that comes later, a segment that hangs on nothing.

    Examples
    --------
    >>> hands_free = Mechanism("hands free", segments=dict.fromkeys(SEGMENTS["bent"], "frame"))
    >>> hands_free.freedoms, len(hands_free.segments)
    ((), 10)
    """

    name: str
    joints: tuple[JointPlan, ...] = ()
    loops: tuple[LoopPlan, ...] = ()
    segments: Mapping[str, str] = field(default_factory=dict)
    arms: str = "bent"
    description: str = ""
    source: str = ""

    def __post_init__(self) -> None:
        if self.arms not in SEGMENTS:
            raise InputError(f"posture {self.name}: {unknown_name('arms', self.arms, SEGMENTS)}")
        known = [FRAME]
        for joint in self.joints:
            if joint.name in known or joint.name in _RESERVED or not joint.name:
                raise InputError(f"posture {self.name}: two joints are called {joint.name!r}, or the name is reserved")
            self._require(f"joint {joint.name}: parent", joint.parent, known)
            known.append(joint.name)
        for loop in self.loops:
            self._require(f"loop {loop.name}: joint", loop.joint, known)
            self._require(f"loop {loop.name}: to", loop.to, [*known, HANDLEBAR])
            if loop.to == loop.joint:
                raise InputError(f"posture {self.name}: loop {loop.name}: joins {loop.joint} with itself")
        self._check_segments(known)

    def _check_segments(self, known: list[str]) -> None:
        allowed = SEGMENTS[self.arms]
        for segment, joint in self.segments.items():
            if segment not in allowed:
                raise InputError(f"posture {self.name}: segments: {unknown_name('segment', segment, allowed)}")
            self._require(f"segment {segment}: joint", joint, known)
        loose = [segment for segment in allowed if segment not in self.segments]
        if loose:
            raise InputError(
                f"posture {self.name}: segment {', '.join(loose)}: hangs on no joint; must be given in [segments], "
                f"on one of: {', '.join(known)}"
            )

    def _require(self, what: str, name: str, known: list[str]) -> None:
        if name not in known:
            raise InputError(f"posture {self.name}: {unknown_name(what, name, known)}")

    @property
    def freedoms(self) -> tuple[str, ...]:
        """Names of the joints that are free."""
        return tuple(joint.name for joint in self.joints if joint.free)
