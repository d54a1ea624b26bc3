"""The text of a SPACAR file as statements: keyword, numbers, line; both dialects; and back to text.

A statement is a line: a keyword, then numbers. Case does not matter, ``*`` in the first column and ``%`` anywhere begin
a comment, ``END`` and ``HALT`` end a block, ``EOF`` ends the file.
"""

from __future__ import annotations

import math
import re
from dataclasses import dataclass

from singletrack.errors import InputError

__all__ = ["Source", "Statement", "parse", "write"]

MOST_CHARACTERS = 2_000_000
_NUMBER = re.compile(r"[+-]?(\d+\.?\d*|\.\d+)([EeDd][+-]?\d+)?")
_KEYWORD = re.compile(r"[A-Za-z][A-Za-z0-9_]*")
# What only the files of Twente have.
_TWENTE = {"HALT", "PINBODY", "XM", "EM", "XF"}
SEPARATORS = ("END", "HALT")


@dataclass(frozen=True)
class Statement:
    """One statement of a file.

    Attributes
    ----------
    keyword
        In capitals.
    numbers
        What follows it.
    line
        Where it stands, from 1; not part of what it says.
    block
        How many blocks ended before it.
    """

    keyword: str
    numbers: tuple[float, ...] = ()
    line: int = 0
    block: int = 0

    def says(self) -> tuple[str, tuple[float, ...], int]:
        """Return what the statement says, wherever it stands."""
        return self.keyword, self.numbers, self.block


@dataclass(frozen=True)
class Source:
    """A file as it was read.

    Attributes
    ----------
    where
        Name of the file.
    dialect
        ``delft`` or ``twente``; the words and comments of the file say which.
    statements
        In order.
    """

    where: str
    dialect: str
    statements: tuple[Statement, ...]

    def says(self) -> tuple[str, tuple[tuple[str, tuple[float, ...], int], ...]]:
        """Return what the file says, wherever it says it; two files that say the same are the same model."""
        return self.dialect, tuple(statement.says() for statement in self.statements)


def parse(text: str, where: str = "model") -> Source:
    r"""Return the statements of a file.

    Parameters
    ----------
    text : str
        Of either dialect.
    where : str
        Its name in messages.

    Raises
    ------
    InputError
        With file and line, for a line that is no statement, or a number that is none.

    Examples
    --------
    >>> source = parse("PLTRUSS 1 1 2\nX 2 1.0 0.0  % a node\nend")
    >>> source.dialect, source.statements[1].numbers
    ('twente', (2.0, 1.0, 0.0))
    """
    if len(text) > MOST_CHARACTERS:
        raise InputError(f"{where}: has {len(text)} characters; at most {MOST_CHARACTERS} are read")
    statements: list[Statement] = []
    block, twente = 0, False
    for line, content in enumerate(text.replace("\r\n", "\n").replace("\r", "\n").split("\n"), start=1):
        if content.startswith("*"):
            continue
        said, percent, _ = content.partition("%")
        twente = twente or bool(percent)
        words = said.replace(",", " ").replace("\t", " ").split()
        if not words:
            continue
        keyword = words[0].upper()
        if keyword == "EOF":
            break
        if not _KEYWORD.fullmatch(words[0]):
            raise InputError(f"{where}, line {line}: found {words[0][:40]!r}, must begin with a keyword such as PLBEAM")
        twente = twente or keyword in _TWENTE
        if keyword in SEPARATORS:
            if statements and statements[-1].block == block:
                block += 1
            continue
        numbers = tuple(_number(word, keyword, f"{where}, line {line}") for word in words[1:])
        statements.append(Statement(keyword, numbers, line, block))
    if not statements:
        raise InputError(f"{where}: is empty, must have statements such as PLBEAM 1 1 2 3 4")
    return Source(where, "twente" if twente else "delft", tuple(statements))


def _number(word: str, keyword: str, place: str) -> float:
    if not _NUMBER.fullmatch(word):
        raise InputError(f"{place}: {keyword}: found {word[:40]!r}, must be a number such as 0.15 or 1.5E-3")
    value = float(word.upper().replace("D", "E"))
    if not math.isfinite(value):
        raise InputError(f"{place}: {keyword}: {word[:40]} is too large a number")
    return value


def write(source: Source) -> str:
    r"""Return a file as text that :func:`parse` reads back to the same statements.

    Parameters
    ----------
    source : Source
        As it was read.

    Examples
    --------
    >>> print(write(parse("plhinge 1 2 3\nend\ngravity 0 -9.81")), end="")
    PLHINGE 1 2 3
    END
    GRAVITY 0 -9.81
    END
    EOF
    """
    lines = ["% singletrack"] if source.dialect == "twente" else []
    block = 0
    for statement in source.statements:
        if statement.block != block:
            lines.append("END")
            block = statement.block
        lines.append(" ".join([statement.keyword, *(_text(value) for value in statement.numbers)]))
    return "\n".join([*lines, "END", "EOF"]) + "\n"


def _text(value: float) -> str:
    return str(int(value)) if value == int(value) and abs(value) < 1e15 and math.copysign(1, value) > 0 else repr(value)
