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
    chain : array of int, shape (loops, k)
        The joints that part the two ends of each, filled up where there are fewer.
    signs : array, shape (loops, k)
        1 for those that move the near end, -1 for those that move the far one, 0 where filled up.
    places : array, shape (loops, n, k)
        Puts a chain's joints into their places among all joints, of those that are not filled up.
    own : array of int, shape (loops, 3), or None
        Where each loop has just three joints that are not free, all its own: their places in its chain.
    """

    index: tuple[int, ...]
    near: np.ndarray
    far: np.ndarray
    bar: np.ndarray
    chain: np.ndarray
    signs: np.ndarray
    places: np.ndarray
    own: np.ndarray | None


@dataclass(frozen=True, eq=False)
class Tree:
    """Structure of a mechanism with n joints.

    Attributes
    ----------
    within : array, shape (n, n)
        One where joint j moves link i.
    halfway : array, shape (n, n)
        The same with one half for a link's own joint.
    turns : array, shape (n,)
        One for a hinge, zero for a slider.
    free, dependent : array of int
        Joints that are coordinates, and those that follow from the loops.
    points, angles : LoopEnds
        Loops that hold a point, loops that hold two directions perpendicular.
    carries : array, shape (segments, n)
        One where joint j moves a segment.
    moving : array of int
        The segments that any joint moves.
    first, second : array of int
        The pairs of freedoms (steer first), each once.
    """

    within: np.ndarray
    halfway: np.ndarray
    turns: np.ndarray
    free: np.ndarray
    dependent: np.ndarray
    points: LoopEnds
    angles: LoopEnds
    carries: np.ndarray
    moving: np.ndarray
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
        far_ends = [FRAME_TORSION if loops[k][2] == "handlebar" else loops[k][2] for k in index]
        near, far = rows([loops[k][1] for k in index]), rows(far_ends)
        return LoopEnds(index, near, far, bar, *_chains(near - far, [joint[3] for joint in joints]))

    points, angles = ends(points=True), ends(points=False)
    free = np.array([i for i in range(n) if joints[i][3]], dtype=int)
    dependent = np.array([i for i in range(n) if not joints[i][3]], dtype=int)
    touched = np.abs(points.near - points.far).sum(axis=0) + np.abs(angles.near - angles.far).sum(axis=0)
    _check_counts(name, [joints[i][0] for i in dependent], touched[dependent], [(loop[0], loop[3]) for loop in loops])
    first, second = np.array(list(combinations_with_replacement(range(1 + len(free)), 2))).T
    turns = np.array([0.0 if joint[2] else 1.0 for joint in joints])
    carries = rows(segments)
    moving = np.flatnonzero(carries.any(axis=1))
    halfway = within - np.eye(n) / 2
    return Tree(within, halfway, turns, free, dependent, points, angles, carries, moving, first, second)


def _chains(signs: np.ndarray, free: list[bool]) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray | None]:
    """Return chains, signs, places and own joints of loops (see :class:`LoopEnds`) from near less far, (loops, n)."""
    lists = [np.flatnonzero(row).tolist() for row in signs]
    length = max((len(joints) for joints in lists), default=0)
    chain = np.array([joints + [0] * (length - len(joints)) for joints in lists], dtype=int).reshape(len(lists), length)
    used = np.array([[k < len(joints) for k in range(length)] for joints in lists]).reshape(len(lists), length)
    of_chain = np.where(used, np.take_along_axis(signs, chain, axis=1), 0.0) if length else np.zeros(chain.shape)
    places = np.zeros((len(lists), signs.shape[1], length))
    for row, joints in enumerate(lists):
        places[row, joints, range(len(joints))] = 1.0
    bound = [[k for k, joint in enumerate(joints) if not free[joint]] for joints in lists]
    flat = [joints[k] for joints, ks in zip(lists, bound, strict=True) for k in ks]
    private = bool(lists) and all(len(ks) == 3 for ks in bound) and flat == sorted(set(flat))
    return chain, of_chain, places, np.array(bound) if private else None


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
