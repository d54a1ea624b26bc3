"""One self-contained file: the built page with bicycles and riders written into it."""

from __future__ import annotations

import html
import json
from dataclasses import dataclass
from importlib import resources
from pathlib import Path
from typing import TYPE_CHECKING

from singletrack.errors import InputError
from singletrack.output import write_whole
from singletrack.posture import require_records
from singletrack.webpage.records import page_records

if TYPE_CHECKING:
    from singletrack.parameters import Bicycle, Rider

__all__ = ["Page", "page"]

#: Where the built page takes its records.
_PLACE = '<script type="application/json" id="singletrack-data"></script>'


@dataclass(frozen=True)
class Page:
    """A page that opens with a click: no server, no network.

    Attributes
    ----------
    text : str
        The whole file.
    """

    text: str

    def save(self, path: str | Path) -> Path:
        """Write the page to a path and return it.

        Raises
        ------
        InputError
            If it cannot be written.
        """
        target = Path(path)
        write_whole(target, self.text)
        return target

    def __repr__(self) -> str:
        return f"<Page of {len(self.text)} characters>"

    def _repr_html_(self) -> str:
        """Show the page in a notebook, in a frame of its own."""
        return f'<iframe srcdoc="{html.escape(self.text)}" style="width:100%;height:900px;border:0"></iframe>'


def page(*bicycles: Bicycle, rider: Rider | None = None, posture: str | None = None) -> Page:
    """Return the page with bicycles, a rider and all that is shipped.

    Parameters
    ----------
    *bicycles : Bicycle
        Single designs; the page begins with the first.
    rider : Rider, optional
    posture : str, optional
        What the page begins with; ``leaned`` by default with a rider.

    Raises
    ------
    InputError
        For a batch of designs.

    Examples
    --------
    >>> from singletrack import load_bicycle
    >>> text = page(load_bicycle("benchmark")).text
    >>> text.startswith("<!doctype html>"), len(text) < 1_500_000
    (True, True)
    """
    built = (resources.files("singletrack") / "webpage" / "static" / "page.html").read_text(encoding="utf-8")
    if _PLACE not in built:
        raise InputError("the shipped page has no place for records; build it again with `make page`")
    # In a script element only "<" could end the data: written as an escape it stays text, whatever a name says.
    for bicycle in bicycles:
        require_records(bicycle, rider)
    data = json.dumps(page_records(bicycles, rider, posture), ensure_ascii=False).replace("<", "\\u003c")
    return Page(built.replace(_PLACE, _PLACE.replace("></script>", f">{data}</script>"), 1))
