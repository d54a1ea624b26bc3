"""Rigid bodies and uniform solids."""

from singletrack.mechanics.rigid import Body, combine

__all__ = ["Body", "combine"]
