"""The text of a user's file, and what can be had from any file without understanding it."""

from __future__ import annotations

import os
import select
import stat
import time
from typing import TYPE_CHECKING

from singletrack.errors import InputError

if TYPE_CHECKING:
    from pathlib import Path

__all__ = ["LARGEST", "LARGEST_PARAMETERS", "is_there", "lines_of", "read_text"]

#: Bytes. Signals and studies may be long; parameter files are a page of text.
LARGEST, LARGEST_PARAMETERS = 1_000_000, 200_000
#: Pipes and devices that say nothing for this long, in s, are given up.
_PATIENCE = 1.0
_PIECE = 1 << 16


def is_there(path: Path) -> bool:
    """Tell whether a path leads to something, whatever it is.

    Parameters
    ----------
    path : path
    """
    try:
        return path.exists()
    except (OSError, ValueError):  # a name too long, or with a NUL
        return False


def read_text(path: Path, largest: int = LARGEST) -> str:
    """Return the text of a user's file.

    Parameters
    ----------
    path : path
        A file; a pipe or a device if it has something to say within a second.
    largest : int
        How many bytes it may have.

    Raises
    ------
    InputError
        If it is a directory, cannot be read, is too large or is not UTF-8 text.
    """
    try:
        # Without waiting: a pipe that nobody writes to would block for ever.
        number = os.open(path, os.O_RDONLY | getattr(os, "O_NONBLOCK", 0) | getattr(os, "O_NOCTTY", 0))
        try:
            content = _content(number, path, largest)
        finally:
            os.close(number)
    except InputError:
        raise
    except (OSError, ValueError) as error:
        reason = getattr(error, "strerror", None) or "no such name"
        raise InputError(f"{path}: cannot be read ({reason})") from None
    if len(content) > largest:
        raise InputError(f"{path}: is larger than {largest // 1000} kB; a parameter file is a page of text")
    try:
        return content.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        line = content[: error.start].count(b"\n") + 1
        raise InputError(f"{path}, line {line}: is not UTF-8 text (byte {content[error.start]:#04x})") from None


def _content(number: int, path: Path, largest: int) -> bytes:
    """Return what an open file has to say, up to one byte more than it may."""
    mode = os.fstat(number).st_mode
    if stat.S_ISDIR(mode):
        raise InputError(f"{path}: is a directory; a file is needed")
    content = bytearray()
    heard = time.monotonic()
    while len(content) <= largest:
        try:
            piece = os.read(number, min(_PIECE, largest + 1 - len(content)))
        except BlockingIOError:  # someone holds the other end, and says nothing yet
            select.select([number], [], [], 0.05)
            piece = None
        if piece:
            content += piece
            heard = time.monotonic()
        elif stat.S_ISREG(mode) or (piece == b"" and content):
            break
        elif time.monotonic() - heard > _PATIENCE:
            if piece == b"":  # the end, and nothing before
                break
            raise InputError(f"{path}: says nothing for {_PATIENCE:g} s; a file is needed")
        elif piece == b"":  # a pipe that nobody writes to yet
            time.sleep(0.02)
    return bytes(content)


def lines_of(text: str) -> list[str]:
    r"""Return the lines of a text.

    Only line feeds and carriage returns end a line: ``splitlines`` counts others (form feed, U+2028), editors do not.

    Parameters
    ----------
    text : str

    Examples
    --------
    >>> lines_of("a\r\nb\u2028c")
    ['a', 'b\u2028c']
    """
    return text.replace("\r\n", "\n").replace("\r", "\n").split("\n")
