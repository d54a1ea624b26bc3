"""One look for all figures, and files that are the same bytes every time."""

from __future__ import annotations

import io
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any

from singletrack.present.readable import printable

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from matplotlib.figure import Figure

__all__ = ["COLOURS", "LINES", "colour_of", "figure_bytes", "new_figure", "style"]

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

#: Colour and dashes of designs side by side: told apart in colour, by the colour-blind, and in grey by their dashes.
LINES: tuple[tuple[str, Any], ...] = (
    ("#000000", "-"),
    ("#D55E00", (0, (5, 1.5))),
    ("#0072B2", (0, (5, 1.5, 1, 1.5))),
    ("#009E73", (0, (1, 1))),
    ("#CC79A7", (0, (8, 2))),
    ("#E69F00", (0, (3, 1, 1, 1, 1, 1))),
    ("#56B4E9", (0, (2, 2))),
)

#: Of modes beyond weave, capsize and castering, such as torso lean.
_FURTHER = ("#CC79A7", "#E69F00", "#56B4E9", "#555555")

_PARAMETERS: Any = {
    "font.size": 9.0,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.linewidth": 0.8,
    "lines.linewidth": 1.6,
    "figure.dpi": 100,
    "savefig.dpi": 150,
    "svg.fonttype": "path",
    "pdf.fonttype": 42,  # whole fonts in the file: text stays text
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


def colour_of(mode: str, names: Sequence[str] = ()) -> str:
    """Return the colour of a mode; of modes with other names than weave, capsize and castering, by their order."""
    if mode in COLOURS:
        return COLOURS[mode]
    others = [name for name in dict.fromkeys(names) if name not in COLOURS]
    return _FURTHER[others.index(mode) % len(_FURTHER)] if mode in others else _FURTHER[0]


_METADATA: Any = {
    "svg": {"Date": None, "Creator": "singletrack"},
    "png": {"Software": "singletrack"},
    "pdf": {"CreationDate": None, "Creator": "singletrack", "Producer": "singletrack"},
}


def figure_bytes(figure: Figure, kind: str, dots: float | None = None) -> bytes:
    """Return a figure as the content of a file: no date, the same bytes each time.

    Parameters
    ----------
    figure : Figure
    kind : {"png", "svg", "pdf"}
    dots : float, optional
        Number of them per inch, of a png.
    """
    from matplotlib.text import Text  # lazy: heavy

    content = io.BytesIO()
    with style():
        for text in figure.findobj(Text):  # an svg with a control character in it is none
            if (shown := printable(text.get_text())) != text.get_text():
                text.set_text(shown)
        engine = figure.get_layout_engine()
        if engine is not None:
            engine.execute(figure)
            figure.set_layout_engine(None)  # laid out once, the same for every kind of file
        resolution: Any = {} if dots is None else {"dpi": dots}
        figure.savefig(content, format=kind, metadata=_METADATA[kind], **resolution)
    return content.getvalue()
