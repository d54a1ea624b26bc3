"""Springs and dampers put into a mechanism: at joints, and at hands, which then are held softly."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from singletrack.errors import InputError, unknown_name
from singletrack.posture.mechanism import Direction, JointPlan, LoopPlan, Mechanism
from singletrack.posture.options import STEER

if TYPE_CHECKING:
    from collections.abc import Mapping

    from singletrack.arrays import Number

__all__ = ["sprung", "with_sliders"]

_HANDS = "hands"


def sprung(mechanism: Mechanism, springs: Mapping[str, Number], dampers: Mapping[str, Number]) -> Mechanism:
    """Return a mechanism with springs and dampers at joints and hands by name, in place of its own.

    Parameters
    ----------
    mechanism : Mechanism
    springs, dampers : mapping of str to array, shape (...)
        As :class:`~singletrack.posture.Options` has them, N m/rad and N m s/rad; at hands N/m and N s/m.

    Raises
    ------
    InputError
        For a name that is no joint and no hand of the mechanism.
    """
    joints = {joint.name: joint for joint in mechanism.joints}
    loops = {loop.name: loop for loop in mechanism.loops if loop.point is not None}
    known = [*joints, *loops, *([_HANDS] if loops else []), STEER]
    for what, values in (("stiffness", springs), ("damping", dampers)):
        for name, value in values.items():
            if name not in known:
                at = "spring" if what == "stiffness" else "damper"
                raise InputError(f"posture {mechanism.name}: {unknown_name(f'joint of a {at}', name, known)}")
            if name in joints:
                plan = joints[name]
                joints[name] = replace(plan, stiffness=value) if what == "stiffness" else replace(plan, damping=value)
            for loop in loops if name == _HANDS else [name] if name in loops else []:
                soft = replace(loops[loop], stiffness=0.0 if loops[loop].stiffness is None else loops[loop].stiffness)
                loops[loop] = replace(soft, stiffness=value) if what == "stiffness" else replace(soft, damping=value)
    softened = tuple(loops.get(loop.name, loop) for loop in mechanism.loops)
    return replace(mechanism, joints=_freed(tuple(joints.values()), mechanism.loops, softened), loops=softened)


def _freed(
    joints: tuple[JointPlan, ...], before: tuple[LoopPlan, ...], after: tuple[LoopPlan, ...]
) -> tuple[JointPlan, ...]:
    """Return the joints with those free that only hands determined that are soft now."""
    parents = {joint.name: joint.parent for joint in joints}

    def touched(loops: list[LoopPlan]) -> set[str]:
        found = set()
        for loop in loops:
            for end in (loop.joint, loop.to):
                while end in parents:
                    found.add(end)
                    end = parents[end]  # noqa: PLW2901  # up the tree
        return found

    newly = [
        loop for loop, old in zip(after, before, strict=True) if loop.stiffness is not None and old.stiffness is None
    ]
    loose = touched(newly) - touched([loop for loop in after if loop.stiffness is None])
    return tuple(replace(joint, free=True) if joint.name in loose else joint for joint in joints)


def with_sliders(mechanism: Mechanism) -> Mechanism:
    """Return a mechanism whose soft hands are sliders with springs, in three directions, between arm and grip.

    Parameters
    ----------
    mechanism : Mechanism
    """
    joints, loops = list(mechanism.joints), []
    for loop in mechanism.loops:
        if loop.stiffness is None or loop.point is None:
            loops.append(loop)
            continue
        parent = loop.joint
        for k, axis in enumerate("xyz"):
            unit = tuple(float(i == k) for i in range(3))
            name = f"{loop.name} {axis}"
            joints.append(
                JointPlan(
                    name,
                    parent,
                    loop.point,
                    Direction(vector=(unit[0], unit[1], unit[2])),
                    slides=True,
                    stiffness=loop.stiffness,
                    damping=loop.damping,
                )
            )
            parent = name
        loops.append(replace(loop, joint=parent, stiffness=None, damping=0.0))
    return replace(mechanism, joints=tuple(joints), loops=tuple(loops))
