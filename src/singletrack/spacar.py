"""SPACAR's own files run: ``spacar.read(path)``."""

from singletrack.multibody.spacar import Motion, SmallMotions, Spacar, State, read, read_text

__all__ = ["Motion", "SmallMotions", "Spacar", "State", "read", "read_text"]
