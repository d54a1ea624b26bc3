"""Records as the text of a file, by its suffix."""

from __future__ import annotations

from typing import TYPE_CHECKING

from singletrack.errors import InputError
from singletrack.files.parameter_sets import write_parameter_set
from singletrack.files.text import write_bicycle_text
from singletrack.files.toml_write import write_toml
from singletrack.output import check_writable
from singletrack.parameters import Bicycle

if TYPE_CHECKING:
    from pathlib import Path

    from singletrack.parameters import Rider

__all__ = ["check_output", "is_parameter_set", "text_of"]

_SUFFIXES = (".toml", ".txt", ".yml", ".yaml")


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
    if output.suffix.lower() not in _SUFFIXES:
        raise InputError(f"{output}: unknown suffix {output.suffix!r}, must be one of {', '.join(_SUFFIXES)}")
    check_writable(output)


def is_parameter_set(output: Path) -> bool:
    """Tell whether a file is a parameter set, by its suffix."""
    return output.suffix.lower() in {".yml", ".yaml"}


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
        If the format holds no rider.
    """
    if output.suffix.lower() == ".toml":
        return write_toml(record)
    if not isinstance(record, Bicycle):
        raise InputError(f"{output}: the format holds no rider, must be .toml")
    return write_parameter_set(record, parameterization) if is_parameter_set(output) else write_bicycle_text(record)
