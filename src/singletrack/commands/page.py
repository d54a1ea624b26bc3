"""``singletrack page``."""

from __future__ import annotations

import sys
import webbrowser
from pathlib import Path
from typing import Annotated

import typer

from singletrack.commands.printing import deliver
from singletrack.commands.sheets import bicycle_named
from singletrack.library import load_rider
from singletrack.webpage import page

__all__ = ["run"]


def run(
    bicycles: Annotated[
        list[str] | None,
        typer.Argument(metavar="[BICYCLE]...", help="Shipped names or files; the first is shown first."),
    ] = None,
    rider: Annotated[str | None, typer.Option("--rider", metavar="RIDER", help="A shipped name or a file.")] = None,
    posture: Annotated[str | None, typer.Option("--posture", metavar="NAME", help="What the page begins with.")] = None,
    output: Annotated[Path, typer.Option("--output", "-o", metavar="FILE", help="Where to write the page.")] = Path(
        "singletrack.html"
    ),
    show: Annotated[
        bool | None, typer.Option("--open/--no-open", help="Open it in the browser; by default in a terminal only.")
    ] = None,
) -> None:
    """Write the page and open it."""
    made = page(
        *(bicycle_named(name) for name in bicycles or []),
        rider=None if rider is None else load_rider(rider),
        posture=posture,
    )
    deliver(made.text, output)
    if show or (show is None and sys.stdout.isatty()):
        webbrowser.open(output.resolve().as_uri())
