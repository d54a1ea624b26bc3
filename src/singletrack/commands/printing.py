"""What commands print and write: through one terminal, and files whole or not at all."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any

from singletrack.output import write_whole
from singletrack.present.terminal import Terminal

if TYPE_CHECKING:
    from pathlib import Path

__all__ = ["deliver", "print_json", "print_plain", "show"]


def show(*objects: Any) -> None:
    """Print texts and tables for people."""
    Terminal().print(*objects)


def print_plain(text: str) -> None:
    """Print a text for programs, as it is, ending with one line end."""
    print(text, end="" if text.endswith("\n") else "\n")  # noqa: T201  # to be piped into a file


def print_json(value: Any) -> None:
    """Print a value as JSON, numbers in full double precision."""
    print_plain(json.dumps(value, indent=1))


def deliver(content: str | bytes, output: Path | None, *, quiet: bool = False) -> None:
    """Write a file whole and say so, or print.

    Parameters
    ----------
    content : str or bytes
        Bytes need an output.
    output : path, optional
    quiet : bool
        Do not say so.

    Raises
    ------
    InputError
        If the file cannot be written.
    """
    if output is None:
        print_plain(str(content))
        return
    write_whole(output, content)
    if not quiet:
        show(f"wrote {output}")
