"""Frozen, validated records of a bicycle and a rider; files and units."""

from singletrack.parameters.bicycle import Bicycle
from singletrack.parameters.files import load_bicycle, load_rider, shipped
from singletrack.parameters.rider import Rider

__all__ = ["Bicycle", "Rider", "load_bicycle", "load_rider", "shipped"]
