"""``singletrack schema``."""

from __future__ import annotations

import json
from typing import Annotated

import typer

from singletrack.commands.options import OutputFileOption, RecordKind
from singletrack.commands.printing import deliver
from singletrack.library.schema import schema

__all__ = ["run"]


def run(kind: Annotated[RecordKind, typer.Argument(help="bicycle or rider")], output: OutputFileOption = None) -> None:
    """Print (or write) the JSON schema of a bicycle's or a rider's TOML file."""
    deliver(json.dumps(schema(kind), indent=2, ensure_ascii=False) + "\n", output)
