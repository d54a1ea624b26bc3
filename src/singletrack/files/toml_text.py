"""TOML as a mapping, in reasonable time, or refused in a sentence: of records, studies, mechanisms."""

from __future__ import annotations

import re
import tomllib
from typing import TYPE_CHECKING, Self

from singletrack.errors import InputError
from singletrack.files.toml_keys import line_of_deep_key

if TYPE_CHECKING:
    from collections.abc import Callable

__all__ = ["WrittenFloat", "parse_toml"]


class WrittenFloat(float):
    """A double that knows how it was written."""

    text: str

    def __new__(cls, text: str) -> Self:
        """Return the double that a text of TOML says."""
        made = super().__new__(cls, text)
        made.text = text
        return made


def parse_toml(text: str, where: str, number: Callable[[str], float] = float) -> dict[str, object]:
    """Return what a TOML text says.

    Parameters
    ----------
    text : str
    where : str
        The file's name, for messages.
    number : callable
        What makes a number, as the file has it (no unit), of its digits.

    Raises
    ------
    InputError
        If it is not TOML, nested too deeply, or has a number of thousands of digits; names file and line.

    Examples
    --------
    >>> parse_toml("a.b = 1", "a.toml")
    {'a': {'b': 1}}
    """
    deep = line_of_deep_key(text)
    if deep is not None:
        raise InputError(f"{where}, line {deep}: is not valid TOML: nested too deeply (dots)")
    try:
        return tomllib.loads(text, parse_float=number)
    except tomllib.TOMLDecodeError as error:
        raise InputError(f"{where}: is not valid TOML: {error}") from None
    except RecursionError:
        raise InputError(f"{where}: is not valid TOML: nested too deeply") from None
    except ValueError:  # Python's limit on the digits of whole numbers
        longest = max(re.finditer(r"\d+", text), key=lambda found: len(found[0]))
        line = text.count("\n", 0, longest.start()) + 1
        raise InputError(f"{where}, line {line}: found a number of {len(longest[0])} digits, must be shorter") from None
