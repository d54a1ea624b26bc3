"""Which segments of the rider move with the steer, and how."""

from singletrack.posture.alike import shipped_alike
from singletrack.posture.arguments import require_bicycle, require_posture, require_records
from singletrack.posture.bodies import SlavedMass, slaved_mass
from singletrack.posture.cut import CutLoops, cut_loops
from singletrack.posture.margins import Margins, margins
from singletrack.posture.mechanism import HANDLEBAR, Mechanism
from singletrack.posture.options import ARMS, POSTURES, SHOULDERS, STEER, Options, input_name
from singletrack.posture.residual import loop_residual
from singletrack.posture.seated import Loop, Posture, SeatedJoint, seat, steer_axis
from singletrack.posture.segment_motion import SlavedBodies, slaved_bodies
from singletrack.posture.shipped import (
    TORSO_LEAN,
    file_of_posture,
    is_posture,
    load_posture,
    mechanism_of,
    named_posture,
)
from singletrack.posture.steered import lateral_work, moved_skeleton, steered_skeleton

__all__ = [
    "ARMS",
    "HANDLEBAR",
    "POSTURES",
    "SHOULDERS",
    "STEER",
    "TORSO_LEAN",
    "CutLoops",
    "Loop",
    "Margins",
    "Mechanism",
    "Options",
    "Posture",
    "SeatedJoint",
    "SlavedBodies",
    "SlavedMass",
    "cut_loops",
    "file_of_posture",
    "input_name",
    "is_posture",
    "lateral_work",
    "load_posture",
    "loop_residual",
    "margins",
    "mechanism_of",
    "moved_skeleton",
    "named_posture",
    "require_bicycle",
    "require_posture",
    "require_records",
    "seat",
    "shipped_alike",
    "slaved_bodies",
    "slaved_mass",
    "steer_axis",
    "steered_skeleton",
]
