"""Lines ``name = value+/-deviation``, as the text files of the BicycleParameters package have them."""

from __future__ import annotations

import re
from pathlib import Path
from typing import TYPE_CHECKING

from singletrack.errors import InputError
from singletrack.files.named_values import NamedValues
from singletrack.files.source import lines_of
from singletrack.files.uncertain import parse_number

if TYPE_CHECKING:
    from singletrack.parameters.units import Quantity

__all__ = ["read_values"]

_SUFFIXES = ("Benchmark", "Measured", "Parameters")


def read_values(text: str, where: str) -> NamedValues:
    """Return what the lines ``name = value`` of a text say; blank lines and what follows a ``#`` mean nothing.

    Parameters
    ----------
    text : str
    where : str
        The file's name, for messages.

    Raises
    ------
    InputError
        With file and line, for a line without ``=``, a name given twice, a value that is no number.
    """
    quantities: dict[str, Quantity] = {}
    lines: dict[str, int] = {}
    for number, line in enumerate(lines_of(text), start=1):
        content = line.split("#", 1)[0].strip()
        if not content:
            continue
        place = f"{where}, line {number}"
        name, equals, value = (part.strip() for part in content.partition("="))
        if not equals or not re.fullmatch(r"[A-Za-z]\w{0,40}", name):
            raise InputError(f"{place}: found {content[:60]!r}, must be a line such as c = 0.0686+/-0.0017")
        if name in lines:
            raise InputError(f"{place}: {name} is given twice (first on line {lines[name]})")
        try:
            quantities[name] = parse_number(value)
        except InputError as error:
            raise InputError(f"{name} {error.reason}", parameters=(name,), place=place) from None
        lines[name] = number
    if not quantities:
        raise InputError(f"{where}: is empty, must have lines such as c = 0.0686+/-0.0017")
    return NamedValues(where, quantities, lines, name=_short_name(where))


def _short_name(where: str) -> str:
    stem = Path(where).stem
    for suffix in _SUFFIXES:
        stem = stem.removesuffix(suffix) or stem
    return stem.lower()
