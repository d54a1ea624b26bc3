"""Random rider mechanisms for tests: any tree of hinges and sliders, loops, freedoms, springs and dampers."""

from __future__ import annotations

import numpy as np

from singletrack import PostureError, load_bicycle, load_rider
from singletrack.posture import Mechanism, Options, seat
from singletrack.posture.mechanism import FRAME, HANDLEBAR, SEGMENTS, Direction, JointPlan, LoopPlan, Place
from singletrack.posture.motion import rider_motion

#: Loops of the mechanisms by their conditions: points (three each) and perpendicular directions (one each).
_LOOPS = (("point",), ("angle",), ("point", "angle"), ("point", "point"), ())


def direction(rng):
    return Direction(vector=tuple(rng.normal(size=3).tolist()))


def place(rng):
    """A point where a rider is, by coordinates or by the skeleton."""
    if rng.random() < 0.3:
        return Place(int(rng.choice([13, 15, 21, 22, 23, 24, 30, 31])))
    return Place(at=tuple((np.array([0.5, 0.0, -1.1]) + rng.uniform(-0.4, 0.4, 3)).tolist()))


def random_mechanism(seed):
    """Return a mechanism with loops that can move, well away from singular ones, on the Stratos with Rider A."""
    for attempt in range(200):
        rng = np.random.default_rng([seed, attempt])
        mechanism = _mechanism(rng)
        try:
            motion = rider_motion(
                seat(load_bicycle("stratos"), load_rider("rider-a"), Options(mechanism)), load_bicycle("stratos")
            )
        except PostureError:
            continue
        if np.abs(motion.rates).max() < 5 and np.abs(motion.bends).max() < 20:
            return mechanism
    raise AssertionError("no mechanism of this seed can move")


def _mechanism(rng):
    kinds = _LOOPS[rng.integers(len(_LOOPS))]
    conditions = sum(3 if kind == "point" else 1 for kind in kinds)
    freedoms = int(rng.integers(0 if kinds else 1, 3))
    names = [f"joint {k}" for k in range(conditions + freedoms)]
    free = set(rng.choice(len(names), freedoms, replace=False).tolist())
    joints = [_joint(rng, k, names, k in free) for k in range(len(names))]
    loops = [_loop(rng, k, kind, names) for k, kind in enumerate(kinds)]
    # Every free joint carries something, the others may.
    holders = [names[k] for k in free] + [str(rng.choice([FRAME, *names])) for _ in range(10)]
    segments = dict(zip(rng.permutation(SEGMENTS["bent"]).tolist(), holders[:10], strict=True))
    return Mechanism("random", tuple(joints), tuple(loops), segments)


def _joint(rng, k, names, free):
    laws = rng.random(3) < 0.4
    return JointPlan(
        names[k],
        names[k - 1] if k and rng.random() < 0.8 else FRAME,
        place(rng),
        direction(rng),
        slides=bool(rng.random() < 0.2),
        free=free,
        stiffness=float(laws[0] * rng.uniform(10, 200)),
        damping=float(laws[1] * rng.uniform(1, 20)),
        preload=0.0 if free else float(laws[2] * rng.uniform(-20, 20)),
    )


def _loop(rng, k, kind, names):
    joint = str(rng.choice(names[-2:]))
    others = [HANDLEBAR, HANDLEBAR, FRAME, *(name for name in names if name != joint)]
    to = str(rng.choice(others))
    if kind == "point":
        return LoopPlan(f"loop {k}", joint, to, place(rng))
    one, other = rng.normal(size=(2, 3))
    other -= (one @ other) / (one @ one) * one
    pair = tuple(Direction(vector=tuple(vector.tolist())) for vector in (one, other))
    return LoopPlan(f"loop {k}", joint, to, perpendicular=pair)
