"""The gallery shows what the package returns: figures of no window system, which are not among pyplot's."""

from __future__ import annotations

from itertools import chain
from pathlib import Path
from typing import Any

from matplotlib.figure import Figure
from sphinx_gallery.scrapers import figure_rst

from singletrack.present.style import figure_bytes

_SHOWN = "_shown_in_gallery"


def returned_figures(block: Any, block_vars: dict[str, Any], gallery_conf: dict[str, Any]) -> str:
    """Write each new figure among a script's names as a picture, and return the lines that show it."""
    del block
    names = block_vars["example_globals"].values()
    values = chain.from_iterable(value if isinstance(value, list | tuple) else (value,) for value in names)
    # Those of pyplot have a number, and are shown already.
    new = [v for v in values if isinstance(v, Figure) and not hasattr(v, "number") and not hasattr(v, _SHOWN)]
    paths = []
    for figure in dict.fromkeys(new):
        setattr(figure, _SHOWN, True)
        paths.append(next(block_vars["image_path_iterator"]))
        Path(paths[-1]).write_bytes(figure_bytes(figure, "png", 130))
    return figure_rst(paths, gallery_conf["src_dir"]) if paths else ""


def _get_sg_image_scraper() -> Any:
    return returned_figures
