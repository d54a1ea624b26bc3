"""Parameter text files of the BicycleParameters package: one ``symbol = value+/-deviation`` a line, SI and radians."""

from __future__ import annotations

import re
from pathlib import Path
from typing import TYPE_CHECKING

from singletrack.errors import InputError
from singletrack.files.entries import Entries, bicycle_from_entries, rigid_rider_from_entries
from singletrack.files.numbers import format_number, parse_number
from singletrack.parameters.symbols import SYMBOLS

if TYPE_CHECKING:
    from singletrack.mechanics.rigid import PlanarBody
    from singletrack.parameters.bicycle import Bicycle
    from singletrack.parameters.units import Quantity

__all__ = ["read_bicycle_text", "read_entries", "read_rigid_rider", "write_bicycle_text"]

_SUFFIXES = ("Benchmark", "Measured", "Parameters")


def read_entries(text: str, where: str) -> Entries:
    """Return what the lines ``name = value`` of a text say; blank lines and what follows a ``#`` mean nothing.

    Raises
    ------
    InputError
        With file and line, for a line without ``=``, a name given twice, a value that is no number.
    """
    quantities: dict[str, Quantity] = {}
    lines: dict[str, int] = {}
    # Only line feeds end a line: splitlines would count others (form feed, U+2028) that editors do not.
    for number, line in enumerate(text.replace("\r\n", "\n").replace("\r", "\n").split("\n"), start=1):
        content = line.split("#", 1)[0].strip()
        if not content:
            continue
        name, equals, value = (part.strip() for part in content.partition("="))
        if not equals or not re.fullmatch(r"[A-Za-z]\w{0,40}", name):
            raise InputError(
                f"{where}, line {number}: found {content[:60]!r}, must be a line such as c = 0.0686+/-0.0017"
            )
        if name in lines:
            raise InputError(f"{where}, line {number}: {name} is given twice (first on line {lines[name]})")
        try:
            quantities[name] = parse_number(value)
        except InputError as error:
            raise InputError(f"{where}, line {number}: {name} {error}") from None
        lines[name] = number
    if not quantities:
        raise InputError(f"{where}: is empty, must have lines such as c = 0.0686+/-0.0017")
    return Entries(where, quantities, lines, name=_short_name(where))


def _short_name(where: str) -> str:
    stem = Path(where).stem
    for suffix in _SUFFIXES:
        stem = stem.removesuffix(suffix) or stem
    return stem.lower()


def read_bicycle_text(text: str, where: str) -> Bicycle:
    """Return the bicycle of a parameter text file (symbols of Meijaard et al. 2007).

    Raises
    ------
    InputError
        Names file, line, symbol, what was found and what is allowed.
    """
    return bicycle_from_entries(read_entries(text, where), source=f"parameter text file {Path(where).name}")


def read_rigid_rider(text: str, where: str) -> PlanarBody:
    """Return the rigid rider of a parameter text file (``mB, xB, zB, IBxx, IByy, IBzz, IBxz`` alone).

    Raises
    ------
    InputError
        Names file, line, symbol, what was found and what is allowed.
    """
    return rigid_rider_from_entries(read_entries(text, where))


def write_bicycle_text(bicycle: Bicycle) -> str:
    """Return a bicycle as parameter text, sorted as its readers write it, with standard deviations where known.

    Examples
    --------
    >>> from singletrack import load_bicycle
    >>> write_bicycle_text(load_bicycle("stratos")).splitlines()[0]
    'IBxx = 0.37287'
    """
    lines = []
    deviations = bicycle.standard_deviations
    for name, value in bicycle.values().items():
        lines.append(f"{SYMBOLS[name]} = {format_number(value, deviations.get(name))}")
    lines += [f"{name} = {format_number(value)}" for name, value in bicycle.extras.items() if name == "v"]
    return "\n".join(sorted(lines)) + "\n"
