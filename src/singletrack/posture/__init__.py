"""Which segments of the rider move with the steer, and how."""

from singletrack.posture.motion import SlavedBodies, slaved_bodies, steered_skeleton
from singletrack.posture.postures import POSTURES, SHOULDERS, Joint, Loop, Posture, seat

__all__ = [
    "POSTURES",
    "SHOULDERS",
    "Joint",
    "Loop",
    "Posture",
    "SlavedBodies",
    "seat",
    "slaved_bodies",
    "steered_skeleton",
]
