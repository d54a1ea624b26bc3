"""All file formats, in the order in which they are asked whether a text is theirs; reading and writing by them."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from singletrack.errors import InputError, unknown_name
from singletrack.files import measured, parameter_sets, posture, rigid_rider, signals, text, toml, yeadon
from singletrack.files.format import clues_of

if TYPE_CHECKING:
    from collections.abc import Callable

    from singletrack.files.format import Format
    from singletrack.parameters.bicycle import Bicycle
    from singletrack.parameters.rider import Rider

__all__ = ["FORMATS", "format_of", "read_any", "read_bicycle", "read_rider", "templates", "write_format"]

#: A new each is a module with a Format, and a line here. The last one takes what no other knows.
FORMATS: tuple[Format, ...] = (
    posture.FORMAT,
    toml.FORMAT,
    yeadon.FORMAT,
    yeadon.CONFIGURATION,
    measured.FORMAT,
    rigid_rider.FORMAT,
    signals.FORMAT,
    parameter_sets.PRINCIPAL,
    parameter_sets.BENCHMARK,
    text.FORMAT,
)


def format_of(text: str, where: str) -> Format:
    """Return the format of a text: by the file's suffix, else by what it says.

    Parameters
    ----------
    text : str
    where : str
        The file's name.

    Examples
    --------
    >>> [format_of(*file).name for file in [("w = 1.02", "a.txt"), ("TcB1 = 1.6", "a.txt"), ("", "a.toml")]]
    ['text', 'measured', 'toml']
    """
    clues = clues_of(text, where)
    return next(each for each in FORMATS if each.recognises(clues))


def read_bicycle(text: str, where: str) -> Bicycle:
    """Return the bicycle that a text in any of the formats describes.

    Parameters
    ----------
    text : str
    where : str
        The file's name, for messages.

    Raises
    ------
    InputError
        Names file, line, parameter, what was found and what is allowed.
    """
    found = format_of(text, where)
    _refuse_empty(text, where, "bicycle")
    if found.read_bicycle is None:
        raise _misplaced(found, where, "bicycle", [f for f in FORMATS if f.read_bicycle])
    return found.read_bicycle(text, where)


def read_rider(text: str, where: str) -> Rider:
    """Return the rider that a text in any of the formats describes (arguments as for :func:`read_bicycle`)."""
    found = format_of(text, where)
    _refuse_empty(text, where, "rider")
    if found.read_rider is None:
        raise _misplaced(found, where, "rider", [f for f in FORMATS if f.read_rider])
    return found.read_rider(text, where)


def read_any(text: str, where: str) -> Bicycle | Rider:
    """Return the bicycle or rider that a text describes, whichever it is (arguments as for :func:`read_bicycle`)."""
    clues = clues_of(text, where)
    found = next(each for each in FORMATS if each.recognises(clues))
    return read_rider(text, where) if found.is_for_rider(clues) else read_bicycle(text, where)


def write_format(path: str | Path, variant: str = "") -> Format:
    """Return the format in which a file of this name is written.

    Parameters
    ----------
    path : path
        Its suffix decides.
    variant : str
        Which of several formats with the same suffix; the first of them without.

    Raises
    ------
    InputError
        For a suffix that none has.

    Examples
    --------
    >>> write_format("a.txt").name, write_format("a.yml", "principal").name
    ('text', 'principal')
    """
    suffix = Path(path).suffix
    found = [each for each in _written() if suffix.lower() in each.suffixes]
    if not found:
        known = dict.fromkeys(suffix for each in _written() for suffix in each.suffixes)
        raise InputError(f"{path}: unknown suffix {suffix!r}, must be one of {', '.join(known)}")
    if variant and any(each.variant for each in found):
        variants = {each.variant: each for each in found}
        if variant not in variants:
            raise InputError(unknown_name("parameterization", variant, variants))
        return variants[variant]
    return found[0]


def _written() -> list[Format]:
    return [each for each in FORMATS if each.suffixes and (each.write_bicycle or each.write_rider)]


def templates() -> dict[str, Callable[[], str]]:
    """Return the texts to fill in, by what they are for.

    Examples
    --------
    >>> list(templates())
    ['posture', 'bicycle', 'rider', 'measurements']
    """
    return {name: text for each in FORMATS for name, text in each.templates.items()}


def _refuse_empty(text: str, where: str, kind: str) -> None:
    if not text.strip():
        raise InputError(f"{where}: is empty; `singletrack template {kind}` prints a file to fill in")


def _misplaced(found: Format, where: str, kind: str, allowed: list[Format]) -> InputError:
    descriptions = ", ".join(each.description for each in allowed)
    hint = f"; {found.used_by}" if found.used_by else ""
    return InputError(f"{where}: looks like {found.description}, must be a {kind}: {descriptions}{hint}")
