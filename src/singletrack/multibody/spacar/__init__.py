"""SPACAR's own files: nodes and elements whose deformations are functions of the nodes' coordinates."""

from singletrack.multibody.spacar.linearise import SmallMotions
from singletrack.multibody.spacar.model import Spacar, read, read_text
from singletrack.multibody.spacar.state import Motion, State

__all__ = ["Motion", "SmallMotions", "Spacar", "State", "read", "read_text"]
