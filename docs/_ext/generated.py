"""Pages that are written from the program before the site is read: the API, the commands, the schemas, the proof.

A page is written again only where its text has changed, so that the next build does nothing about the others.
"""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import api_pages
import command_pages
import proof_pages
import schema_pages

if TYPE_CHECKING:
    from sphinx.application import Sphinx

FOLDER = "generated"  # ignored by git; beside the section it belongs to


def write(app: Sphinx) -> None:
    """Write all generated pages, and remove those of an earlier build that are generated no more."""
    source = Path(app.srcdir)
    sections = {
        "reference": {**api_pages.pages(), **command_pages.pages(), **schema_pages.pages()},
        "proof": proof_pages.pages(),
    }
    for section, pages in sections.items():
        folder = source / section / FOLDER
        folder.mkdir(parents=True, exist_ok=True)
        for old in folder.iterdir():
            if old.name not in pages:
                old.unlink()
        for name, text in pages.items():
            page = folder / name
            if not page.exists() or page.read_text(encoding="utf-8") != text:
                page.write_text(text, encoding="utf-8")


def setup(app: Sphinx) -> dict[str, bool]:
    """Register with Sphinx."""
    app.connect("builder-inited", write)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
