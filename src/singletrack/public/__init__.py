"""What a program asks for: a model of a bicycle with its rider, and everything that can be asked of it."""

from singletrack.body.oddities import warn_of_oddities
from singletrack.public.model import CoefficientMatrices, coefficients
from singletrack.public.origin import Origin

__all__ = ["CoefficientMatrices", "Origin", "coefficients", "warn_of_oddities"]
