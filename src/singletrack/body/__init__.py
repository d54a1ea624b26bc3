"""The skeleton points of a seated rider and the rider's segments."""

from singletrack.body.segments import Segment, rider_segments
from singletrack.body.skeleton import Skeleton, skeleton

__all__ = ["Segment", "Skeleton", "rider_segments", "skeleton"]
