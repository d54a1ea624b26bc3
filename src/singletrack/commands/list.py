"""``singletrack list``."""

from __future__ import annotations

from singletrack.commands.printing import show
from singletrack.library.listing import listing

__all__ = ["run"]


def run() -> None:
    """List what comes with the package, and the formats of files."""
    for line in listing():
        show(line)
