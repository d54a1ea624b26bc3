"""The pages of the project, and the blocks of code in them.

A block says its language; one that a reader can copy is run. What cannot be run says why in the line before it:
``<!-- not run: it needs a cluster -->``. Code cells (``{code-cell}``) are run when the site is built.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from pathlib import Path

__all__ = ["ROOT", "Block", "blocks_of", "commands_of", "page_paths"]

ROOT = Path(__file__).parents[1]
_NOT_PAGES = ("_build", "generated", "auto_gallery")
_FENCE = re.compile(r"^(?P<fence>`{3,})(?P<language>[^\n]*)\n(?P<text>.*?)^(?P=fence)$", re.DOTALL | re.MULTILINE)
_REASON = re.compile(r"<!-- not run: (.+?) -->\s*\Z")


@dataclass(frozen=True)
class Block:
    """A block of code on a page.

    Attributes
    ----------
    language : str
        As its fence says.
    text : str
    line : int
        Of its fence, from 1.
    reason : str
        Why it is not run; "" for one that is.
    """

    language: str
    text: str
    line: int
    reason: str


def page_paths() -> list[Path]:
    """Return all pages that are written by hand."""
    docs = sorted(ROOT.glob("docs/**/*.md"))
    own = [path for path in docs if not set(_NOT_PAGES) & set(path.parts)]
    return [ROOT / "README.md", ROOT / "CONTRIBUTING.md", ROOT / "benchmarks" / "README.md", *own]


def blocks_of(text: str) -> list[Block]:
    """Return the blocks of a page.

    Parameters
    ----------
    text : str
        Of the page.
    """
    return [
        Block(
            found["language"].strip(),
            found["text"],
            text.count("\n", 0, found.start()) + 1,
            reason[1] if (reason := _REASON.search(text[: found.start()])) else "",
        )
        for found in _FENCE.finditer(text)
    ]


def commands_of(block: Block) -> list[str]:
    """Return the commands of a block of the shell, each in one line, without comments.

    Parameters
    ----------
    block : Block
    """
    joined = block.text.replace("\\\n", " ")
    lines = (re.sub(r"(^|\s)#.*", "", line).strip() for line in joined.splitlines())
    return [line for line in lines if line]
