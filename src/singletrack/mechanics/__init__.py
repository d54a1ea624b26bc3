"""Rigid bodies and uniform solids."""

from singletrack.mechanics.rigid import PlanarBody, RigidBody, combine

__all__ = ["PlanarBody", "RigidBody", "combine"]
