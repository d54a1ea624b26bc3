"""The terminal: names are data there, whatever they hold, and every text can be read on every terminal.

No markup is read from any text, control characters are shown and never sent, and where a terminal's encoding lacks a
character, a readable one stands in its place (:mod:`singletrack.present.readable`).
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from rich.console import Console, ConsoleDimensions
from rich.measure import Measurement

from singletrack.present.readable import open_streams, printable, readable, say

if TYPE_CHECKING:
    from rich.console import ConsoleOptions, RenderResult
    from rich.text import Text

__all__ = ["Terminal", "Words", "open_streams", "printable", "readable", "say"]

_WIDEST = 1000


class Words:
    """A text with a style, in a table or alone.

    Attributes
    ----------
    text : str
    style : str
        As rich writes it, e.g. "bold red".
    whole : bool
        Whether its words stay on one line.
    """

    def __init__(self, text: str, style: str = "", *, whole: bool = False) -> None:
        self.text, self.style, self.whole = text, style, whole

    def __rich_console__(self, console: Console, options: ConsoleOptions) -> RenderResult:
        yield console.render_str(self.text, style=self.style)

    def __rich_measure__(self, console: Console, options: ConsoleOptions) -> Measurement:
        found = Measurement.get(console, options, console.render_str(self.text))
        return Measurement(found.maximum, found.maximum) if self.whole else found


class Terminal(Console):
    """A rich console that reads no markup, sends no control character of a text, and cuts nothing off.

    What is wider than the terminal goes on behind its edge or in its next line, as the terminal has it: a number that
    is cut off reads as another number.

    Parameters
    ----------
    stderr : bool
        Write to standard error instead of standard output.
    **options
        As for :class:`rich.console.Console`.
    """

    def __init__(self, *, stderr: bool = False, **options: Any) -> None:
        self._needed = 0
        super().__init__(stderr=stderr, markup=False, emoji=False, highlight=False, **options)

    def render_str(self, text: str, **options: Any) -> Text:
        """Return a text as data: cleaned, readable here, without markup (arguments as rich's, of which ``style``)."""
        options |= {"markup": False, "emoji": False, "highlight": False}
        return super().render_str(readable(printable(text), self.encoding), **options)

    @property
    def size(self) -> ConsoleDimensions:
        """Columns and rows: those of the terminal, or what is printed needs."""
        found = super().size
        return ConsoleDimensions(max(found.width, self._needed), found.height)

    @size.setter
    def size(self, new: tuple[int, int]) -> None:
        """Set columns and rows to new ones."""
        self.width, self.height = new

    def print(self, *objects: Any, **options: Any) -> None:
        """Print texts and tables (arguments as rich's)."""
        roomy = self.options.update(width=_WIDEST)
        self._needed = max((Measurement.get(self, roomy, each).minimum for each in objects), default=0)
        texts = all(isinstance(each, str) for each in objects)
        try:
            super().print(*objects, **{"crop": False, "soft_wrap": texts, **options})
        finally:
            self._needed = 0

    def on_broken_pipe(self) -> None:
        """Leave it to the command line to end as others do when nobody reads any more."""
        raise BrokenPipeError
