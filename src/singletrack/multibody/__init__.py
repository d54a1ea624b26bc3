"""A multibody engine: from bodies, joints, closed loops and rolling wheels to motion, and to its linearisation."""

from singletrack.multibody.assembly import assemble, move
from singletrack.multibody.bicycle import bicycle_model, ride
from singletrack.multibody.coefficients import Coefficients, coefficients
from singletrack.multibody.connections import (
    Closure,
    CoordinateForce,
    Force,
    Sensor,
    Spring,
    Torque,
    Wheel,
    close_distance,
    close_joint,
    close_point,
)
from singletrack.multibody.dynamics import Response, accelerations, loop_forces, wheel_forces
from singletrack.multibody.elements import (
    GROUND,
    Body,
    Joint,
    cylindrical,
    fixed,
    free,
    parameter,
    parameters,
    planar,
    prismatic,
    revolute,
    spherical,
    universal,
)
from singletrack.multibody.equilibrium import SteadyMotion, steady_motion
from singletrack.multibody.inputs import Constant, Function, Pulse, Sampled
from singletrack.multibody.linearise import Linearisation, SpeedPolynomials, linearise, speed_polynomials
from singletrack.multibody.model import Model, State, build
from singletrack.multibody.simulate import Event, simulate
from singletrack.multibody.system import System
from singletrack.multibody.turning import free_turns

__all__ = [
    "GROUND",
    "Body",
    "Closure",
    "Coefficients",
    "Constant",
    "CoordinateForce",
    "Event",
    "Force",
    "Function",
    "Joint",
    "Linearisation",
    "Model",
    "Pulse",
    "Response",
    "Sampled",
    "Sensor",
    "SpeedPolynomials",
    "Spring",
    "State",
    "SteadyMotion",
    "System",
    "Torque",
    "Wheel",
    "accelerations",
    "assemble",
    "bicycle_model",
    "build",
    "close_distance",
    "close_joint",
    "close_point",
    "coefficients",
    "cylindrical",
    "fixed",
    "free",
    "free_turns",
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
