"""The linearised equations of motion in closed form, and what follows from them."""

from singletrack.linear.coefficients import coefficients
from singletrack.linear.critical import CriticalSpeeds
from singletrack.linear.matrices import CoefficientMatrices
from singletrack.linear.modes import Modes

__all__ = ["CoefficientMatrices", "CriticalSpeeds", "Modes", "coefficients"]
