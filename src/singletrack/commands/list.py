"""``singletrack list``."""

from __future__ import annotations

from singletrack.commands.printing import show
from singletrack.files import registry
from singletrack.library import load_bicycle, load_rider, shipped
from singletrack.posture import load_posture

__all__ = ["run"]


def run() -> None:
    """List what comes with the package, and the formats of files."""
    for kind, load in (("bicycle", load_bicycle), ("rider", load_rider), ("posture", load_posture)):
        show(f"{kind}s")
        width = max(16, *(len(name) + 2 for name in shipped(kind)))
        for name in shipped(kind):
            show(f"  {name:<{width}}{load(name).description}")
    show("formats")
    for each in registry.FORMATS:
        show(f"  {each.name:<16}{each.summary()}")
