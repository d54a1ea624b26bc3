"""Tables of Markdown whose cells are plain text."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Collection, Iterable, Sequence


def escaped(text: str) -> str:
    """Return plain text as Markdown that shows it as it is."""
    return re.sub(r"([\\`*_|<>\[\]#$~])", r"\\\1", " ".join(text.split()))


def table(header: Sequence[str], rows: Iterable[Sequence[str]], raw: Collection[int] = ()) -> list[str]:
    """Return the lines of a table; cells of the columns `raw` are Markdown, all others plain text."""
    lines = ["| " + " | ".join(header) + " |", "|" + " --- |" * len(header)]
    for row in rows:
        cells = [cell if place in raw else escaped(cell) for place, cell in enumerate(row)]
        lines.append("| " + " | ".join(cells) + " |")
    return lines
