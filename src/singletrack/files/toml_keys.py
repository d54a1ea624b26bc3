"""Where in a TOML text each name is set, for messages; and whether a parser can take the text in reasonable time."""

from __future__ import annotations

import functools
import json
import re
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping

__all__ = ["line_of_deep_key", "place_of", "place_of_any"]

#: Parts that a dotted key may have: our files need three, and parsers take the square of the number in steps.
_MOST_PARTS = 16
# Possessive throughout, so that no text is looked at twice.
_LONG_TEXT = r'"""(?:[^"\\]++|\\.|"(?!""))*+"""|' + r"'''(?:[^']++|'(?!''))*+'''"
_TEXT = r'"(?:[^"\\\n]++|\\.)*+"|' + r"'[^'\n]*+'"
_NOT_KEYS = re.compile(rf"{_LONG_TEXT}|{_TEXT}|#[^\n]*+", re.DOTALL)
_TOKEN = re.compile(
    rf"(?P<long>{_LONG_TEXT})|(?P<quoted>{_TEXT})|(?P<comment>#[^\n]*+)|(?P<word>[A-Za-z0-9_-]++)|(?P<line>\n)"
    r"|(?P<space>[ \t\r]++)|(?P<sign>.)",
    re.DOTALL,
)


def line_of_deep_key(text: str) -> int | None:
    r"""Return the line of the first key with more dots than any file of ours has, or None.

    Parameters
    ----------
    text : str
        TOML, perhaps.

    Examples
    --------
    >>> line_of_deep_key("a.b = 1.5"), line_of_deep_key("\n" + "a." * 20 + "a = 1")
    (None, 2)
    """
    bare = _NOT_KEYS.sub(lambda found: "\n" * found[0].count("\n") or "x", text)
    if not any(part.count(".") >= _MOST_PARTS for part in re.split(r"[,\n=]", bare)):
        return None
    lines = bare.split("\n")
    deep = (max(part.count(".") for part in re.split(r"[,=]", line)) >= _MOST_PARTS for line in lines)
    return next((number for number, found in enumerate(deep, start=1) if found), None)


def place_of(where: str, text: str, name: str) -> str:
    r"""Return the file with the line on which a name is set.

    Parameters
    ----------
    where : str
        The file's name.
    text : str
        What it says.
    name : str
        A key, a part of a dotted one, or a table's name; the file alone is returned where it is not set.

    Examples
    --------
    >>> place_of("a.toml", "[parameters]\ntrail = 1", "trail"), place_of("a.toml", "", "trail")
    ('a.toml, line 2', 'a.toml')
    """
    line = _lines_of_keys(text).get(name)
    return where if line is None else f"{where}, line {line}"


def place_of_any(where: str, text: str, names: Iterable[str]) -> str:
    """Return the place of the first of several names that is set at all (arguments as for :func:`place_of`)."""
    places = (place_of(where, text, name) for name in names)
    return next((place for place in places if place != where), where)


@functools.lru_cache(maxsize=1)  # of one file, many names may be asked for
def _lines_of_keys(text: str) -> Mapping[str, int]:
    """Return the first line on which each name stands before ``=``, before or after a dot, or in a table's heading."""
    found: dict[str, int] = {}
    number, candidate, heading, in_value, brackets = 1, None, False, False, ""
    for token in _TOKEN.finditer(text):
        kind, content = token.lastgroup, token[0]
        if kind in {"word", "quoted"}:
            candidate = content if kind == "word" else _unquoted(content)
        elif kind == "sign":
            ends_a_key = content == "=" or (content == "." and not in_value) or (content == "]" and heading)
            if candidate is not None and ends_a_key:
                found.setdefault(candidate, number)
            candidate = None
            heading = heading or (content == "[" and not in_value)
            brackets, in_value = _inside(content, brackets, in_value, heading)
        elif kind in {"line", "long"}:
            number += content.count("\n")
            candidate, heading = None, False
            in_value = in_value and bool(brackets)
    return found


def _inside(sign: str, brackets: str, in_value: bool, heading: bool) -> tuple[str, bool]:
    """Return the brackets that are open after a sign, and whether a value is next (1.5 has no key 1)."""
    if sign in "[{" and not heading:
        return brackets + sign, sign == "["
    if sign in "]}" and brackets:
        return brackets[:-1], True
    if sign == ",":
        return brackets, brackets.endswith("[")
    return brackets, in_value or sign == "="


def _unquoted(quoted: str) -> str:
    inner = quoted[1:-1]
    if quoted[0] == "'" or "\\" not in inner:
        return inner
    try:
        return str(json.loads(quoted))
    except ValueError:  # an escape of TOML that JSON has not
        return inner
