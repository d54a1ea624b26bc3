"""The skeleton points of a seated rider and the rider's segments."""

from singletrack.body.segments import Segment, rider_segments
from singletrack.body.skeleton import POINT_NAMES, Skeleton, skeleton

__all__ = ["POINT_NAMES", "Segment", "Skeleton", "rider_segments", "skeleton"]
