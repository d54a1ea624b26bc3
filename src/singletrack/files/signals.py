"""Recorded signals: two columns of text, time and signal."""

from __future__ import annotations

import math
import re
from typing import TYPE_CHECKING

import numpy as np

from singletrack.errors import InputError
from singletrack.files.format import Format
from singletrack.files.source import lines_of

if TYPE_CHECKING:
    from singletrack.files.format import Clues

__all__ = ["FORMAT", "read_signal"]

_NUMBER = re.compile(r"[+-]?(?:[0-9]++\.?[0-9]*+|\.[0-9]++)(?:[eE][+-]?[0-9]++)?")

_MORE_COLUMNS = "; of more columns under names, `singletrack identify FILE --column NAME` takes one"


def _recognises(clues: Clues) -> bool:
    return clues.suffix == ".csv" and not clues.equals + clues.colons


FORMAT = Format(
    name="signal",
    description="a recorded signal",
    recognises=_recognises,
    used_by="`singletrack period FILE` fits an oscillation to it",
)


def read_signal(text: str, where: str) -> tuple[np.ndarray, np.ndarray]:
    """Return time in s and signal of a text with two columns, separated by comma, semicolon, tab or blanks.

    One heading line and lines that start with ``#`` are passed over.

    Parameters
    ----------
    text : str
    where : str
        The file's name, for messages.

    Returns
    -------
    time, signal : array, shape (n,)

    Raises
    ------
    InputError
        With file and line, for a line that is not two finite numbers.
    """
    rows: list[tuple[float, float]] = []
    heading = False
    for number, line in enumerate(lines_of(text), start=1):
        content = line.split("#", 1)[0].strip()
        if not content:
            continue
        pair = _two_numbers(content)
        if pair is None:
            if not rows and not heading and not _NUMBER.match(content):
                heading = True
                continue
            raise InputError(
                f"{where}, line {number}: found {content[:60]!r}, must be two finite numbers: time in s, signal"
                f"{_MORE_COLUMNS if heading else ''}"
            )
        rows.append(pair)
    if not rows:
        raise InputError(f"{where}: is empty, must have lines of two numbers: time in s, signal")
    table = np.array(rows)
    return table[:, 0], table[:, 1]


def _two_numbers(content: str) -> tuple[float, float] | None:
    cells = content.replace(",", " ").replace(";", " ").split()
    if len(cells) != 2 or not all(map(_NUMBER.fullmatch, cells)):
        return None
    first, second = map(float, cells)
    return (first, second) if math.isfinite(first) and math.isfinite(second) else None
