"""Parameter text files of the BicycleParameters package: one ``symbol = value+/-deviation`` a line, SI and radians."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from singletrack.files.format import Format
from singletrack.files.meijaard import bicycle_from_values, values_by_symbol
from singletrack.files.text_lines import read_values
from singletrack.files.uncertain import format_number

if TYPE_CHECKING:
    from singletrack.parameters.bicycle import Bicycle

__all__ = ["FORMAT", "read_bicycle_text", "write_bicycle_text"]


def read_bicycle_text(text: str, where: str) -> Bicycle:
    """Return the bicycle of a parameter text file (symbols of Meijaard et al. 2007).

    Parameters
    ----------
    text : str
    where : str
        The file's name, for messages.

    Raises
    ------
    InputError
        Names file, line, symbol, what was found and what is allowed.
    """
    return bicycle_from_values(read_values(text, where), source=f"parameter text file {Path(where).name}")


def write_bicycle_text(bicycle: Bicycle) -> str:
    """Return a bicycle as parameter text, sorted as its readers write it, with standard deviations where known.

    Parameters
    ----------
    bicycle : Bicycle
        A single design.

    Examples
    --------
    >>> from singletrack import load_bicycle
    >>> write_bicycle_text(load_bicycle("stratos")).splitlines()[0]
    'IBxx = 0.37287'
    """
    lines = [f"{symbol} = {format_number(*number)}" for symbol, number in values_by_symbol(bicycle).items()]
    return "\n".join(sorted(lines)) + "\n"


FORMAT = Format(
    name="text",
    description="a parameter text file of BicycleParameters",
    recognises=lambda _: True,
    suffixes=(".txt",),
    read_bicycle=read_bicycle_text,
    write_bicycle=write_bicycle_text,
)
