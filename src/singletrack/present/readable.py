"""Texts for any terminal: nothing in them is a command to it, and every character can be read there."""

from __future__ import annotations

import codecs
import sys
import unicodedata

__all__ = ["open_streams", "printable", "readable", "say"]

# What stands for a character that an encoding lacks.
_READABLE = {
    "²": "^2",
    "³": "^3",
    "±": "+/-",
    "·": "*",
    "×": "x",
    "°": " deg",
    "−": "-",
    "–": "-",
    "—": "-",
    "…": "...",
    "’": "'",
    "“": '"',
    "”": '"',
    "Δ": "d",
    "λ": "lambda",
    "π": "pi",
    "φ": "phi",
    "δ": "delta",
}
# Invisible characters that move or reorder what follows them.
_HIDDEN = {"Cc", "Cf", "Cs", "Zl", "Zp"}
_ERRORS = "singletrack.readable"


def printable(text: str) -> str:
    r"""Return a text with every control character but line ends and tabs shown, as Python would write it.

    >>> printable("a\x1b[31mb")
    'a\\x1b[31mb'
    """
    if text.isascii() and text.isprintable():
        return text
    return "".join(
        c if c in "\n\t" or unicodedata.category(c) not in _HIDDEN else c.encode("unicode_escape").decode()
        for c in text
    )


def readable(text: str, encoding: str) -> str:
    """Return a text that an encoding can hold, with readable characters for those that it lacks.

    >>> readable("kg m², 1 ± 2", "ascii")
    'kg m^2, 1 +/- 2'
    """
    try:
        text.encode(encoding)
    except UnicodeEncodeError:
        return "".join(_stand_in(c, encoding) for c in text)
    return text


def _stand_in(character: str, encoding: str) -> str:
    try:
        character.encode(encoding)
    except UnicodeEncodeError:
        if 0x2800 <= ord(character) <= 0x28FF:  # a braille drawing: as dark as the number of its dots
            return " ..::oo##"[(ord(character) - 0x2800).bit_count()]
        plain = unicodedata.normalize("NFKD", character).encode("ascii", "ignore").decode()
        return _READABLE.get(character) or plain or "?"
    return character


def _replace_unwritable(error: UnicodeError) -> tuple[str, int]:
    if not isinstance(error, UnicodeEncodeError):
        raise error
    part = error.object[error.start : error.end]
    return "".join(_stand_in(printable(c), error.encoding) for c in part), error.end


codecs.register_error(_ERRORS, _replace_unwritable)


def open_streams() -> None:
    """Let the standard streams write readable characters for those that their encoding lacks, instead of failing."""
    for stream in (sys.stdout, sys.stderr):
        reconfigure = getattr(stream, "reconfigure", None)
        if reconfigure is not None:
            reconfigure(errors=_ERRORS)


def say(text: str) -> None:
    """Write a text and a line end to standard error; nothing happens where nobody can read it."""
    try:
        print(printable(text), file=sys.stderr, flush=True)  # noqa: T201  # this is where lines are said
    except (OSError, ValueError):  # closed
        return
