"""Solids, rigid-body arithmetic, the skeleton points of a seated rider and the rider's segments."""

from singletrack.body.rigid import Body, combine
from singletrack.body.segments import Segment, rider_segments
from singletrack.body.skeleton import Skeleton, skeleton

__all__ = ["Body", "Segment", "Skeleton", "combine", "rider_segments", "skeleton"]
