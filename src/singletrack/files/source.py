"""The text of a user's file, and where in it a name stands."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from singletrack.errors import InputError

if TYPE_CHECKING:
    from pathlib import Path

__all__ = ["place_of", "read_text"]

_LARGEST_FILE = 1_000_000


def read_text(path: Path) -> str:
    """Return the text of a user's file.

    Parameters
    ----------
    path : path

    Raises
    ------
    InputError
        If it is a directory, cannot be read, is too large or is not UTF-8 text.
    """
    if path.is_dir():
        raise InputError(f"{path}: is a directory; a file is needed")
    try:
        with path.open("rb") as file:
            content = file.read(_LARGEST_FILE + 1)
    except OSError as error:
        raise InputError(f"{path}: cannot be read ({error.strerror})") from None
    if len(content) > _LARGEST_FILE:
        raise InputError(f"{path}: is larger than {_LARGEST_FILE // 1000} kB; a parameter file is a page of text")
    try:
        return content.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        line = content[: error.start].count(b"\n") + 1
        raise InputError(f"{path}, line {line}: is not UTF-8 text (byte {content[error.start]:#04x})") from None


def place_of(where: str, text: str, name: str) -> str:
    """Return the file with the line on which a name is set.

    Parameters
    ----------
    where : str
        The file's name.
    text : str
        What it says.
    name : str
        Set as in TOML; the file alone is returned where it is not.
    """
    found = re.search(rf"^[^#\n]*?(?<![\w-])[\"']?{re.escape(name)}[\"']?\s*[=\].]", text, re.MULTILINE)
    return where if found is None else f"{where}, line {text.count(chr(10), 0, found.start()) + 1}"
