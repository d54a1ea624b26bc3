"""One look for all figures, and files that are the same bytes every time."""

from __future__ import annotations

import io
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Iterator

    from matplotlib.figure import Figure

__all__ = ["COLOURS", "figure_bytes", "mode_colour", "new_figure", "style"]

#: Colour of each mode and part, distinguishable with all common kinds of colour blindness (Okabe and Ito).
COLOURS = {
    "weave": "#0072B2",
    "capsize": "#D55E00",
    "castering": "#009E73",
    "stable": "#DDEFD9",
    "frame": "#555555",
    "front": "#CC79A7",
    "rider": "#E69F00",
    "moved": "#56B4E9",
}

#: Colours of further modes, in the order of their coordinates.
_FURTHER = ("#CC79A7", "#E69F00", "#56B4E9")


def mode_colour(names: tuple[str, ...], column: int) -> str:
    """Return the colour of a mode among the columns of all, told apart from the others."""
    name = names[column]
    return COLOURS[name] if name in COLOURS else _FURTHER[(column // 2 - 2) % len(_FURTHER)]


_PARAMETERS: Any = {
    "font.size": 9.0,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.linewidth": 0.8,
    "lines.linewidth": 1.6,
    "figure.dpi": 100,
    "savefig.dpi": 150,
    "svg.fonttype": "path",
    "svg.hashsalt": "singletrack",  # identifiers in the file depend on its content only
    "path.simplify": True,
}


@contextmanager
def style() -> Iterator[None]:
    """Draw with the package's look inside this context, without touching the user's settings."""
    import matplotlib as mpl  # lazy: heavy

    with mpl.rc_context(_PARAMETERS):
        yield


def new_figure(width: float, height: float) -> Figure:
    """Return an empty figure, width by height in inches, independent of any window system; notebooks show it."""
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    class Shown(Figure):
        """A figure that shows itself in notebooks, without pyplot."""

        def _repr_png_(self) -> bytes:
            content = io.BytesIO()
            self.savefig(content, format="png")
            return content.getvalue()

    figure = Shown(figsize=(width, height), layout="constrained")
    FigureCanvasAgg(figure)
    return figure


_METADATA: Any = {
    "svg": {"Date": None, "Creator": "singletrack"},
    "png": {"Software": "singletrack"},
    "pdf": {"CreationDate": None, "Creator": "singletrack", "Producer": "singletrack"},
}


def figure_bytes(figure: Figure, kind: str) -> bytes:
    """Return a figure as the content of a file, ``kind`` "png", "svg" or "pdf": no date, the same bytes each time."""
    content = io.BytesIO()
    with style():
        engine = figure.get_layout_engine()
        if engine is not None:
            engine.execute(figure)
            figure.set_layout_engine(None)  # laid out once, the same for every kind of file
        figure.savefig(content, format=kind, metadata=_METADATA[kind])
    return content.getvalue()
