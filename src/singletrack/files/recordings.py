"""Recorded rates in files with several named columns, and published sets of measured eigenvalues."""

from __future__ import annotations

import csv
import json
import math
from typing import Any

import numpy as np

from singletrack.errors import InputError, unknown_name
from singletrack.files.signals import read_signal

__all__ = ["read_measured_set", "read_recording"]


def read_recording(
    text: str, where: str, column: str | None = None, time_column: str = "time"
) -> tuple[np.ndarray, np.ndarray]:
    """Return time in s and a signal of a text.

    Parameters
    ----------
    text : str
        Two columns, or comma-separated columns under a line of names.
    where : str
        The file's name, for messages.
    column : str, optional
        Name of the signal's column; without it the text has two columns.
    time_column : str

    Returns
    -------
    time, signal : array, shape (n,)

    Raises
    ------
    InputError
        With file and line, for a name that is not there, or a cell that is no finite number.
    """
    if column is None:
        return read_signal(text, where)
    lines = text.splitlines()
    rows = csv.reader(lines)
    names = [name.strip() for name in next(rows, [])]
    for name in (time_column, column):
        if name not in names:
            raise InputError(f"{where}, line 1: {unknown_name('column', name, [n for n in names if n])}")
    places = [names.index(time_column), names.index(column)]
    found: list[list[float]] = []
    for number, row in enumerate(rows, start=2):
        if not any(cell.strip() for cell in row):
            continue
        found.append([_number(row, place, f"{where}, line {number}", names[place]) for place in places])
    if not found:
        raise InputError(f"{where}: has no rows under its names")
    time, signal = np.array(found).T
    return time, signal


def _number(row: list[str], place: int, where: str, name: str) -> float:
    text = row[place].strip() if place < len(row) else ""
    try:
        value = float(text) if text.isascii() else math.nan
    except ValueError:
        value = math.nan
    if not math.isfinite(value):
        raise InputError(f"{where}: {name} is {text[:40]!r}, must be a finite number")
    return value


def read_measured_set(text: str, where: str) -> tuple[dict[str, float], np.ndarray]:
    """Return the bicycle's parameters (SI; angles whose names end in ``_deg`` are turned to rad) and the measured rows.

    The text is JSON: ``bicycle`` (parameters by name) and ``measured_weave`` with ``rows``: lowest and highest speed
    in m/s, real and imaginary part in 1/s, shape (n, 4).

    Raises
    ------
    InputError
        Names the file and what is not as it must be in text and where.
    """
    try:
        document: Any = json.loads(text)
    except (ValueError, RecursionError) as error:
        raise InputError(f"{where}: is not valid JSON: {error}") from None
    if not isinstance(document, dict) or not isinstance(document.get("bicycle"), dict):
        raise InputError(f"{where}: must have a 'bicycle' with parameters by name")
    measured = document.get("measured_weave")
    rows = measured.get("rows") if isinstance(measured, dict) else None
    values: dict[str, float] = {}
    for name, value in document["bicycle"].items():
        if isinstance(value, bool) or not isinstance(value, int | float) or not math.isfinite(value):
            raise InputError(f"{where}: bicycle {name} = {str(value)[:40]!r}, must be a finite number")
        degrees = name.endswith("_deg")
        values[name.removesuffix("_deg")] = math.radians(value) if degrees else float(value)
    try:
        table = np.array(rows, dtype=float)
    except (TypeError, ValueError):
        table = np.zeros(0)
    if table.ndim != 2 or table.shape[1] != 4 or not len(table) or not np.isfinite(table).all():
        raise InputError(
            f"{where}: measured_weave must have rows of four numbers: lowest and highest speed, real and imaginary part"
        )
    return values, table
