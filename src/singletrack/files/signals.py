"""Recorded signals: two columns of text, time and signal."""

from __future__ import annotations

import math
import re
from typing import TYPE_CHECKING

from singletrack.errors import InputError

if TYPE_CHECKING:
    import numpy as np

__all__ = ["read_signal"]


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
    import numpy as np

    rows: list[tuple[float, float]] = []
    heading = False
    for number, line in enumerate(text.replace("\r\n", "\n").replace("\r", "\n").split("\n"), start=1):
        content = line.split("#", 1)[0].strip()
        if not content:
            continue
        pair = _two_numbers(content)
        if pair is None:
            if not rows and not heading and not re.match(r"[+-]?[\d.]", content):
                heading = True
                continue
            raise InputError(
                f"{where}, line {number}: found {content[:60]!r}, must be two finite numbers: time in s, signal"
            )
        rows.append(pair)
    if not rows:
        raise InputError(f"{where}: is empty, must have lines of two numbers: time in s, signal")
    table = np.array(rows)
    return table[:, 0], table[:, 1]


def _two_numbers(content: str) -> tuple[float, float] | None:
    cells = [cell for cell in re.split(r"[,;\s]+", content) if cell]
    try:
        first, second = (float(cell) for cell in cells)
    except ValueError:
        return None
    return (first, second) if math.isfinite(first) and math.isfinite(second) else None
