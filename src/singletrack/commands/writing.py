"""Records as the text of a file, by its suffix."""

from __future__ import annotations

from typing import TYPE_CHECKING

from singletrack.errors import InputError
from singletrack.files.registry import FORMATS, write_format
from singletrack.output import check_writable
from singletrack.parameters import Bicycle

if TYPE_CHECKING:
    from pathlib import Path

    from singletrack.parameters import Rider

__all__ = ["check_output", "losses_of", "text_of"]


def check_output(output: Path) -> None:
    """Make sure, before anything is read or computed, that a record can be written to a file.

    Parameters
    ----------
    output : path

    Raises
    ------
    InputError
        If its suffix names no format, or it cannot be written.
    """
    write_format(output)
    check_writable(output)


def text_of(record: Bicycle | Rider, output: Path, parameterization: str = "benchmark") -> str:
    """Return a record as the text of a file of the output's suffix.

    Parameters
    ----------
    record : Bicycle or Rider
    output : path
    parameterization : {"benchmark", "principal"}
        Of a parameter set.

    Raises
    ------
    InputError
        If the format cannot hold the record.
    """
    text = write_format(output, parameterization).write(record)
    if text is None:
        kind = "bicycle" if isinstance(record, Bicycle) else "rider"
        able = {suffix: None for each in FORMATS if each.can_write(kind) for suffix in each.suffixes}
        raise InputError(f"{output}: the format holds no {kind}, must be {', '.join(able)}")
    return text


def losses_of(record: Bicycle | Rider, output: Path, parameterization: str = "benchmark") -> tuple[str, ...]:
    """Return what the format of the output's suffix does not hold, in sentences (arguments as for :func:`text_of`)."""
    return write_format(output, parameterization).losses(record)
