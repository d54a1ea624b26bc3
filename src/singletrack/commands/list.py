"""``singletrack list``."""

from __future__ import annotations

from singletrack.commands.printing import show
from singletrack.library import load_bicycle, load_rider, shipped

__all__ = ["run"]


def run() -> None:
    """List what comes with the package."""
    for kind, load in (("bicycle", load_bicycle), ("rider", load_rider)):
        show(f"{kind}s")
        for name in shipped(kind):
            show(f"  {name:<12}{load(name).description}")
