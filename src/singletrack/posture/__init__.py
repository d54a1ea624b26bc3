"""Which segments of the rider move with the steer, and how."""

from singletrack.posture.bodies import SlavedBodies, slaved_bodies
from singletrack.posture.mechanism import Mechanism
from singletrack.posture.options import ARMS, POSTURES, SHOULDERS, Options
from singletrack.posture.seated import Joint, Loop, Posture, seat, steer_axis
from singletrack.posture.shipped import TORSO_LEAN, load_posture
from singletrack.posture.steered import steered_skeleton

__all__ = [
    "ARMS",
    "POSTURES",
    "SHOULDERS",
    "TORSO_LEAN",
    "Joint",
    "Loop",
    "Mechanism",
    "Options",
    "Posture",
    "SlavedBodies",
    "load_posture",
    "seat",
    "slaved_bodies",
    "steer_axis",
    "steered_skeleton",
]
