"""A rider seated on a bicycle: a mechanism with its points, axes and segments in numbers.

A description only, which both derivations of the equations read.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from math import pi
from typing import TYPE_CHECKING, Any

from singletrack.arrays import (
    Array,
    Fault,
    Number,
    as_arrays,
    cross,
    dot,
    is_concrete,
    refuse_single,
    unit_vector,
    vector,
)
from singletrack.body import Segment, Skeleton, rider_segments, skeleton
from singletrack.body.fit import fitted
from singletrack.errors import PostureError
from singletrack.parameters import Bicycle
from singletrack.posture.mechanism import FRAME, HANDLEBAR, Direction, LoopPlan, Mechanism, Place
from singletrack.posture.options import Options
from singletrack.posture.shipped import mechanism_of
from singletrack.posture.tree import Tree, make_tree

if TYPE_CHECKING:
    from collections.abc import Iterator

    from singletrack.parameters import Rider

__all__ = ["Loop", "Posture", "SeatedJoint", "seat", "steer_axis"]

#: Points further apart (m) and cosines larger than this are not closed.
_CLOSED = 1e-9


@dataclass(frozen=True, eq=False)
class SeatedJoint:
    """A hinge of the rider, or a slider.

    Attributes
    ----------
    name : str
    parent : str
        Name of the joint whose link carries this one, "" for the rear frame.
    point, axis : array, shape (..., 3)
        A point on the axis, in m, and the axis' unit vector, in the bicycle's frame, upright and straight ahead.
    slides, free : bool
        A slider along the axis; a coordinate of the model.
    stiffness, damping, preload : array, shape (...)
        N m/rad, N m s/rad, N m (sliders: N/m, N s/m, N). The preload of a free joint follows from balance at rest.
    """

    name: str
    parent: str
    point: Array
    axis: Array
    slides: bool = False
    free: bool = False
    stiffness: Number = 0.0
    damping: Number = 0.0
    preload: Number = 0.0


@dataclass(frozen=True, eq=False)
class Loop:
    """A loop, such as a hand on the handlebar: a point of a link that stays at a point of something else.

    Attributes
    ----------
    name : str
    joint : str
        Name of the joint whose link carries the hand.
    point : array, shape (..., 3), or None
        The grip, in m.
    to : str
        What holds the point: ``handlebar``, ``""`` for the rear frame, or a joint.
    directions : (array, array), each of shape (..., 3), optional
        Instead of a point: a direction of the joint's link and one of the other that stay perpendicular.
    """

    name: str
    joint: str
    point: Any  # an array, or None
    to: str = HANDLEBAR
    directions: tuple[Array, Array] | None = None


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
    joints : tuple of SeatedJoint
        Each after its parent.
    loops : tuple of Loop
    carried_by : dict of str to str
        Name of the joint whose link a segment belongs to; segments that are not named stay with the rear frame.
    faults : tuple of Fault
        Designs of a batch in which a loop is not closed at rest.
    """

    name: str
    shoulder: str
    skeleton: Skeleton
    segments: dict[str, Segment]
    joints: tuple[SeatedJoint, ...] = ()
    loops: tuple[Loop, ...] = ()
    carried_by: dict[str, str] | None = None
    faults: tuple[Fault, ...] = ()

    def chain(self, joint: str) -> tuple[SeatedJoint, ...]:
        """Return the joints from the rear frame out to ``joint``, in order ("" gives none)."""
        by_name = {j.name: j for j in self.joints}
        chain: list[SeatedJoint] = []
        while joint:
            chain.insert(0, by_name[joint])
            joint = by_name[joint].parent
        return tuple(chain)

    @property
    def freedoms(self) -> tuple[str, ...]:
        """Names of the joints that are coordinates of the model beside lean and steer."""
        return tuple(joint.name for joint in self.joints if joint.free)

    @cached_property
    def tree(self) -> Tree:
        """What the equations need of the structure."""
        carried = self.carried_by or {}
        return make_tree(
            self.name,
            tuple((joint.name, joint.parent, joint.slides, joint.free) for joint in self.joints),
            tuple((loop.name, loop.joint, loop.to, loop.directions is None) for loop in self.loops),
            tuple(carried.get(name, "") for name in self.segments),
        )


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
        If arms or legs do not reach, or a loop is not closed at rest.

    Examples
    --------
    >>> from singletrack import load_bicycle, load_rider
    >>> [joint.name for joint in seat(load_bicycle("browser"), load_rider("rider-a"), "upright").joints][:3]
    ['right shoulder flexion', 'right shoulder rotation', 'right elbow']
    """
    options = Options.of(options)
    mechanism = mechanism_of(options)
    unfitted: tuple[Fault, ...] = ()
    if options.fit is not None:
        rider, unfitted = fitted(bicycle, rider, options.fit)
    points = skeleton(bicycle, rider)
    resolve = _Resolver(points, bicycle)
    joints = tuple(
        SeatedJoint(
            plan.name,
            _link(plan.parent),
            resolve.place(plan.point),
            resolve.direction(plan.axis),
            plan.slides,
            plan.free,
            plan.stiffness,
            plan.damping,
            plan.preload,
        )
        for plan in mechanism.joints
    )
    loops = tuple(
        Loop(
            plan.name,
            _link(plan.joint),
            None if plan.point is None else resolve.place(plan.point),
            _link(plan.to),
            None if plan.perpendicular is None else resolve.pair(plan.perpendicular),
        )
        for plan in mechanism.loops
    )
    gaps = [fault for plan, loop in zip(mechanism.loops, loops, strict=True) for fault in resolve.gap(plan, loop)]
    return Posture(
        mechanism.name,
        _shoulder(mechanism),
        points,
        rider_segments(rider, points, mechanism.arms),
        joints,
        loops,
        {segment: _link(joint) for segment, joint in mechanism.segments.items() if joint != FRAME},
        refuse_single(gaps, f"posture {mechanism.name}") + unfitted,
    )


def steer_axis(bicycle: Bicycle) -> tuple[Array, Array]:
    """Return a point (..., 3) on the steer axis, at the ground, in m, and its unit vector (..., 3), pointing down.

    >>> from singletrack import load_bicycle
    >>> point, axis = steer_axis(load_bicycle("benchmark"))
    >>> point.round(6).tolist(), axis.round(6).tolist()
    ([1.1, 0.0, 0.0], [0.309017, 0.0, 0.951057])
    """
    xp, (reach, tilt) = as_arrays(bicycle.wheel_base + bicycle.trail, bicycle.steer_axis_tilt)
    return vector(reach, 0.0, 0.0), vector(xp.sin(tilt), 0.0, xp.cos(tilt))


def _link(name: str) -> str:
    return "" if name == FRAME else name


def _shoulder(mechanism: Mechanism) -> str:
    """Return what the shoulder does about its second axis, as the shipped postures call their joints."""
    names = {joint.name for joint in mechanism.joints}
    kinds = {"abduction": "right shoulder abduction", "axial": "right shoulder rotation"}
    return next((kind for kind, joint in kinds.items() if joint in names), "")


@dataclass(frozen=True, eq=False)
class _Resolver:
    """Points and directions of a mechanism in the numbers of a skeleton."""

    points: Skeleton
    bicycle: Bicycle

    def place(self, place: Place) -> Array:
        if place.at is not None:
            return vector(*place.at)
        start = self.points[place.number]
        return start + place.share * (self.points[place.towards] - start) if place.towards else start

    def direction(self, direction: Direction) -> Array:
        if direction.vector is not None:
            return unit_vector(vector(*direction.vector))
        if direction.name == "steer":
            return steer_axis(self.bicycle)[1]
        if direction.name:
            return self.points.elbow_axis(direction.name.split()[0])
        assert direction.start is not None  # noqa: S101  # the reader takes care of it
        assert direction.end is not None  # noqa: S101
        line = self.place(direction.end) - self.place(direction.start)
        return unit_vector(line if direction.across is None else cross(line, vector(*direction.across)))

    def gap(self, plan: LoopPlan, loop: Loop) -> Iterator[Fault]:
        """Yield the fault of a loop that cannot close: its points are apart, or its directions not perpendicular."""
        if loop.directions is not None:
            near, far = loop.directions
            xp, (cosine,) = as_arrays(dot(near, far))
            if is_concrete(cosine):
                found = {"angle": xp.acos(xp.clip(xp.real(cosine), -1.0, 1.0)) * (180 / pi)}
                text = f"loop {plan.name} cannot close: its directions are {{angle:.4g}} deg apart, must be 90 deg"
                yield Fault(xp.abs(cosine) > _CLOSED, text, found, PostureError)
        elif plan.at is not None:
            xp, (apart,) = as_arrays(self.place(plan.at) - loop.point)
            if is_concrete(apart):
                distance = xp.sqrt(xp.real(dot(apart, apart)))
                text = f"loop {plan.name} cannot close: its two points are {{apart:.4g}} m apart at rest"
                yield Fault(distance > _CLOSED, text, {"apart": distance}, PostureError)

    def pair(self, directions: tuple[Direction, Direction]) -> tuple[Array, Array]:
        return self.direction(directions[0]), self.direction(directions[1])
