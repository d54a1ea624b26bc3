"""``singletrack template``."""

from __future__ import annotations

from typing import Annotated

import typer

from singletrack.commands.options import OutputFileOption, TemplateKind
from singletrack.commands.printing import deliver
from singletrack.library.template import template

__all__ = ["run"]


def run(
    kind: Annotated[TemplateKind, typer.Argument(help="What to fill in.")], output: OutputFileOption = None
) -> None:
    """Print (or write) a commented file to fill in."""
    deliver(template(kind), output)
