"""What follows from a linear model: eigenvalues, modes, critical speeds, state space."""

from singletrack.linear.critical import CriticalSpeeds, critical_speeds
from singletrack.linear.eigenvalues import eigenmotions, eigenvalues
from singletrack.linear.instability import AlwaysUnstable, always_unstable
from singletrack.linear.modes import Modes, modes
from singletrack.linear.state_space import StateSpace, state_space

__all__ = [
    "AlwaysUnstable",
    "CriticalSpeeds",
    "Modes",
    "StateSpace",
    "always_unstable",
    "critical_speeds",
    "eigenmotions",
    "eigenvalues",
    "modes",
    "state_space",
]
