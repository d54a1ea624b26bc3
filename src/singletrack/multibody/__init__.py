"""A multibody engine: from bodies, joints, closed loops and rolling wheels to motion, and to its linearisation."""

from singletrack.multibody.bicycle.coefficients import coefficients
from singletrack.multibody.bicycle.hands_free import free_turns, hands_free_family
from singletrack.multibody.bicycle.model import bicycle_model, ride
from singletrack.multibody.bicycle.turning import circle, held_turn, held_turns
from singletrack.multibody.engine.assembly import assemble, move
from singletrack.multibody.engine.closures import (
    Closure,
    Ratio,
    close_direction,
    close_distance,
    close_joint,
    close_point,
)
from singletrack.multibody.engine.connections import CoordinateForce, Force, Sensor, Spring, Torque, Wheel
from singletrack.multibody.engine.dynamics import Response, accelerations, loop_forces, wheel_forces
from singletrack.multibody.engine.elements import GROUND, Body, Joint, Motion, parameter, parameters
from singletrack.multibody.engine.equilibrium import SteadyMotion, steady_motion
from singletrack.multibody.engine.inputs import Constant, Function, Pulse, Sampled
from singletrack.multibody.engine.joints import (
    cylindrical,
    fixed,
    free,
    planar,
    prismatic,
    revolute,
    spherical,
    universal,
)
from singletrack.multibody.engine.kept import compile_equations
from singletrack.multibody.engine.limits import Limit, Reach
from singletrack.multibody.engine.linearise import Linearisation, linearise
from singletrack.multibody.engine.model import Model, State, build
from singletrack.multibody.engine.prescribed import Prescribed
from singletrack.multibody.engine.reactions import (
    Buckling,
    Reaction,
    buckling_load,
    driving_forces,
    inverse_dynamics,
    joint_reactions,
)
from singletrack.multibody.engine.simulate import Event, simulate
from singletrack.multibody.engine.straight import speed_polynomials
from singletrack.multibody.engine.system import System

__all__ = [
    "GROUND",
    "Body",
    "Buckling",
    "Closure",
    "Constant",
    "CoordinateForce",
    "Event",
    "Force",
    "Function",
    "Joint",
    "Limit",
    "Linearisation",
    "Model",
    "Motion",
    "Prescribed",
    "Pulse",
    "Ratio",
    "Reach",
    "Reaction",
    "Response",
    "Sampled",
    "Sensor",
    "Spring",
    "State",
    "SteadyMotion",
    "System",
    "Torque",
    "Wheel",
    "accelerations",
    "assemble",
    "bicycle_model",
    "buckling_load",
    "build",
    "circle",
    "close_direction",
    "close_distance",
    "close_joint",
    "close_point",
    "coefficients",
    "compile_equations",
    "cylindrical",
    "driving_forces",
    "fixed",
    "free",
    "free_turns",
    "hands_free_family",
    "held_turn",
    "held_turns",
    "inverse_dynamics",
    "joint_reactions",
    "linearise",
    "loop_forces",
    "move",
    "parameter",
    "parameters",
    "planar",
    "prismatic",
    "revolute",
    "ride",
    "simulate",
    "speed_polynomials",
    "spherical",
    "steady_motion",
    "universal",
    "wheel_forces",
]
