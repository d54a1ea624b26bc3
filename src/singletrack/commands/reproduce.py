"""``singletrack reproduce``."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from singletrack.commands.printing import show
from singletrack.reproduce import reproduce

__all__ = ["run"]


def run(
    output: Annotated[Path, typer.Option("--output", metavar="DIR", help="Where to write; made if needed.")] = Path(
        "singletrack-output"
    ),
) -> None:
    """Reproduce the paper."""
    show(f"report: {reproduce(output)}")
