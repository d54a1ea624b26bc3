"""Frozen, validated records of a bicycle, a rider and feedback; units."""

from singletrack.parameters.bicycle import Bicycle
from singletrack.parameters.feedback import Feedback
from singletrack.parameters.rider import Rider

__all__ = ["Bicycle", "Feedback", "Rider"]
