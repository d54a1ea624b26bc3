"""Can the rider control it, and how hard is it: controllability, effort, feedback, responses, measured weave."""

from singletrack.control.controllability import LostMode, uncontrollable_speeds
from singletrack.control.effort import Effort, Weights, effort, least_energy
from singletrack.control.feedback import closed_loop, lqr_schedule
from singletrack.control.identify import IdentifiedMode, combine_modes, identify_mode
from singletrack.control.measures import distance_to_uncontrollability, gramian, modal_controllability
from singletrack.control.responses import (
    discretised,
    frequency_response,
    impulse_response,
    response,
    save_mat,
    step_response,
)
from singletrack.control.signals import lateral_force, with_ground, with_inputs, with_path
from singletrack.control.summary import ControlSummary, control_summary

__all__ = [
    "ControlSummary",
    "Effort",
    "IdentifiedMode",
    "LostMode",
    "Weights",
    "closed_loop",
    "combine_modes",
    "control_summary",
    "discretised",
    "distance_to_uncontrollability",
    "effort",
    "frequency_response",
    "gramian",
    "identify_mode",
    "impulse_response",
    "lateral_force",
    "least_energy",
    "lqr_schedule",
    "modal_controllability",
    "response",
    "save_mat",
    "step_response",
    "uncontrollable_speeds",
    "with_ground",
    "with_inputs",
    "with_path",
]
