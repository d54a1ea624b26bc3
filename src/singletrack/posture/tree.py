"""What the equations of a mechanism need of its structure alone, worked out once for each structure."""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from itertools import combinations_with_replacement
from typing import TYPE_CHECKING

import numpy as np

from singletrack.errors import PostureError
from singletrack.parameters.flexible import FRAME_TORSION

if TYPE_CHECKING:
    from collections.abc import Sequence

__all__ = ["LoopEnds", "Tree", "make_tree"]


@dataclass(frozen=True, eq=False)
class LoopEnds:
    """Loops of one kind: what moves their two ends.

    Attributes
    ----------
    index : tuple of int
        Which loops of the mechanism.
    near, far : array, shape (loops, joints)
        One where a joint moves the link of the loop's joint, and that of what it is bound to.
    bar : array, shape (loops,)
        One where it is bound to the handlebar.
    """

    index: tuple[int, ...]
    near: np.ndarray
    far: np.ndarray
    bar: np.ndarray


@dataclass(frozen=True, eq=False)
class Tree:
    """Structure of a mechanism with n joints.

    Attributes
    ----------
    within, above : array, shape (n, n)
        One where joint j moves link i; ``above`` leaves out the link's own joint.
    turns : array, shape (n,)
        One for a hinge, zero for a slider.
    free, dependent : array of int
        Joints that are coordinates, and those that follow from the loops.
    points, angles : LoopEnds
        Loops that hold a point, loops that hold two directions perpendicular.
    carries : array, shape (segments, n)
        One where joint j moves a segment.
    first, second : array of int
        The pairs of freedoms (steer first), each once.
    """

    within: np.ndarray
    above: np.ndarray
    turns: np.ndarray
    free: np.ndarray
    dependent: np.ndarray
    points: LoopEnds
    angles: LoopEnds
    carries: np.ndarray
    first: np.ndarray
    second: np.ndarray


@lru_cache(maxsize=256)
def make_tree(
    name: str,
    joints: tuple[tuple[str, str, bool, bool], ...],
    loops: tuple[tuple[str, str, str, bool], ...],
    segments: tuple[str, ...],
) -> Tree:
    """Return the structure of a mechanism.

    Parameters
    ----------
    name : str
        Of the posture, for messages.
    joints : tuple of (name, parent, slides, free)
    loops : tuple of (name, joint, to, holds a point)
    segments : tuple of str
        The joint that each segment hangs on.

    Raises
    ------
    PostureError
        If loops and joints that follow from them are not as many, naming joints or loops.
    """
    place = {joint[0]: i for i, joint in enumerate(joints)}
    n = len(joints)
    within = np.eye(n)
    for i, (_, parent, _, _) in enumerate(joints):
        if parent in place:
            within[i] += within[place[parent]]

    def rows(links: Sequence[str]) -> np.ndarray:
        return np.array([within[place[link]] if link in place else np.zeros(n) for link in links]).reshape(-1, n)

    def ends(*, points: bool) -> LoopEnds:
        index = tuple(k for k, loop in enumerate(loops) if loop[3] == points)
        bar = np.array([float(loops[k][2] == "handlebar") for k in index])
        # What carries the handlebar, where the frame is soft: a joint of this name.
        far = [FRAME_TORSION if loops[k][2] == "handlebar" else loops[k][2] for k in index]
        return LoopEnds(index, rows([loops[k][1] for k in index]), rows(far), bar)

    points, angles = ends(points=True), ends(points=False)
    free = np.array([i for i in range(n) if joints[i][3]], dtype=int)
    dependent = np.array([i for i in range(n) if not joints[i][3]], dtype=int)
    touched = np.abs(points.near - points.far).sum(axis=0) + np.abs(angles.near - angles.far).sum(axis=0)
    _check_counts(name, [joints[i][0] for i in dependent], touched[dependent], [(loop[0], loop[3]) for loop in loops])
    first, second = np.array(list(combinations_with_replacement(range(1 + len(free)), 2))).T
    turns = np.array([0.0 if joint[2] else 1.0 for joint in joints])
    return Tree(within, within - np.eye(n), turns, free, dependent, points, angles, rows(segments), first, second)


def _check_counts(name: str, dependent: list[str], touched: np.ndarray, loops: list[tuple[str, bool]]) -> None:
    """Refuse joints that nothing determines, and loops that ask for more than the joints can give."""
    loose = [joint for joint, loop in zip(dependent, touched, strict=True) if not loop]
    if loose:
        raise PostureError(
            f"posture {name}: joint {', '.join(loose)}: no loop determines it, and it is not declared free"
        )
    conditions = sum(3 if point else 1 for _, point in loops)
    held = ", ".join(loop for loop, _ in loops)
    if conditions < len(dependent):
        raise PostureError(
            f"posture {name}: the loops ({held}) give {conditions} conditions for {len(dependent)} joints that are not "
            f"free: nothing determines all of joint {', '.join(dependent)}; declare {len(dependent) - conditions} free"
        )
    if conditions > len(dependent):
        raise PostureError(
            f"posture {name}: loop {held}: cannot stay closed when steering: {conditions} conditions for "
            f"{len(dependent)} joints that are not free ({', '.join(dependent) or 'none'})"
        )
