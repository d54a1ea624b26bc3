"""Rigid bodies and uniform solids."""

from singletrack.mechanics.rigid import Body, PlanarBody, combine

__all__ = ["Body", "PlanarBody", "combine"]
