"""Frozen, validated records of a bicycle and a rider; units."""

from singletrack.parameters.bicycle import Bicycle
from singletrack.parameters.rider import Rider

__all__ = ["Bicycle", "Rider"]
