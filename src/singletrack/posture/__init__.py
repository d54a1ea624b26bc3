"""Which segments of the rider move with the steer, and how."""

from singletrack.posture.motion import SlavedBodies, slaved_bodies, steered_skeleton
from singletrack.posture.options import ARMS, POSTURES, SHOULDERS, Options
from singletrack.posture.postures import Joint, Loop, Posture, seat

__all__ = [
    "ARMS",
    "POSTURES",
    "SHOULDERS",
    "Joint",
    "Loop",
    "Options",
    "Posture",
    "SlavedBodies",
    "seat",
    "slaved_bodies",
    "steered_skeleton",
]
