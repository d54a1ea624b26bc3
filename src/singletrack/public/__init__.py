"""What a program asks for: a model of a bicycle with its rider, and everything that can be asked of it."""

from singletrack.public.model import CoefficientMatrices, coefficients

__all__ = ["CoefficientMatrices", "coefficients"]
