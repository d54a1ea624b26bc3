"""Where riding ends: the bicycle has fallen, or a hand cannot follow the handlebar any further."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from singletrack.multibody.engine.limits import Limit, Reach
from singletrack.parameters.flexible import FORK_BENDING, FRAME_TORSION

if TYPE_CHECKING:
    from collections.abc import Sequence

    from singletrack.multibody.engine.closures import Closure
    from singletrack.multibody.engine.elements import Joint

__all__ = ["riding_limits"]

FALLEN = float(np.radians(80.0))


def riding_limits(
    joints: Sequence[Joint], closures: Sequence[Closure], independent: Sequence[str]
) -> tuple[Limit | Reach, ...]:
    """Return the limits of a bicycle with its rider.

    Beyond 80 degrees of lean it has fallen; where the hands on the grips cease to determine the joints of the rider, a
    hand is at the end of its reach.

    Parameters
    ----------
    joints, closures
        Of the whole machine.
    independent
        Names of the independent speeds, the rider's free joints among them.
    """
    limits: list[Limit | Reach] = [Limit("lean", -FALLEN, FALLEN, "fell to the left", "fell to the right")]
    bicycle = {"frame", "rear wheel", "steer", "front wheel", FRAME_TORSION, FORK_BENDING}
    own = [name for joint in joints if joint.name not in bicycle for name in joint.coordinates]
    determined = tuple(name for name in own if name not in independent)
    if closures and sum(len(closure.rows) for closure in closures) == len(determined):
        limits.append(Reach(tuple(closure.name for closure in closures), determined))
    return tuple(limits)
