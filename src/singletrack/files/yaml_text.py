"""YAML as the files of this field use it: mappings of names to numbers or text, with the line of each."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING

from singletrack.errors import InputError
from singletrack.files.named_values import NamedValues
from singletrack.files.uncertain import parse_number

if TYPE_CHECKING:
    from collections.abc import Iterable

    from yaml import Event, Node

    from singletrack.parameters.units import Quantity

__all__ = ["Item", "numbers", "read_mapping"]

# Parameter files are a page of text, and the parser is slow where it is not the compiled one.
_LONGEST = 30_000
_DEEPEST = 20


@dataclass(frozen=True)
class Item:
    """A value of a mapping: text, or a mapping again, and the line it starts on."""

    value: str | Mapping[str, Item]
    line: int


def read_mapping(text: str, where: str) -> dict[str, Item]:
    """Return the mapping that a YAML text is.

    Parameters
    ----------
    text : str
    where : str
        The file's name, for messages.

    Raises
    ------
    InputError
        With file and line, if it is no YAML, no mapping, has a name twice, lists, tags or references.
    """
    import yaml  # lazy: only needed for these files

    if len(text) > _LONGEST:
        raise InputError(f"{where}: has {len(text)} characters, must have at most {_LONGEST}")
    try:
        # A loader of its own for each file keeps the parser from nesting further than any parameter file does.
        _refuse_depth(yaml.parse(text, Loader=yaml.SafeLoader), where)
        root = yaml.compose(text, Loader=yaml.SafeLoader)
    except yaml.YAMLError as error:
        mark = getattr(error, "problem_mark", None)
        line = text.count("\n", 0, getattr(error, "position", 0)) if mark is None else mark.line
        place = f"{where}, line {line + 1}"
        reason = getattr(error, "problem", None) or getattr(error, "reason", None) or "unreadable character"
        raise InputError(f"{place}: is not valid YAML ({reason})") from None
    except InputError:
        raise
    except (RecursionError, ValueError, OverflowError):
        raise InputError(f"{where}: is not valid YAML") from None
    if root is None:
        raise InputError(f"{where}: is empty, must have lines such as c: 0.0686")
    return _mapping(root, where)


def _refuse_depth(events: Iterable[Event], where: str) -> None:
    import yaml  # lazy, as above

    depth = 0
    for event in events:
        depth += isinstance(event, yaml.CollectionStartEvent) - isinstance(event, yaml.CollectionEndEvent)
        if depth > _DEEPEST:
            raise InputError(f"{where}, line {event.start_mark.line + 1}: is nested more than {_DEEPEST} deep")
        if isinstance(event, yaml.AliasEvent) or getattr(event, "anchor", None):
            raise InputError(
                f"{where}, line {event.start_mark.line + 1}: has a YAML reference (& or *), must have none"
            )


def _mapping(node: Node, where: str) -> dict[str, Item]:
    import yaml  # lazy, as above

    if not isinstance(node, yaml.MappingNode):
        found = "a list" if isinstance(node, yaml.SequenceNode) else f"{str(node.value)[:60]!r}"
        raise InputError(
            f"{where}, line {node.start_mark.line + 1}: found {found}, must be lines such as c: 0.0686 "
            "(with a space after the colon)"
        )
    items: dict[str, Item] = {}
    for key, value in node.value:
        line = key.start_mark.line + 1
        if not isinstance(key, yaml.ScalarNode):
            raise InputError(f"{where}, line {line}: found a list or mapping as a name, must be a word")
        if key.value in items:
            raise InputError(
                f"{where}, line {line}: {key.value} is given twice (first on line {items[key.value].line})"
            )
        if isinstance(value, yaml.SequenceNode):
            raise InputError(f"{where}, line {line}: {key.value[:60]} is a list, must be one value")
        scalar = isinstance(value, yaml.ScalarNode)
        items[key.value] = Item(value.value if scalar else _mapping(value, where), line)
    return items


def numbers(items: Mapping[str, Item], where: str, name: str = "", description: str = "") -> NamedValues:
    """Return the values of a mapping as numbers.

    Parameters
    ----------
    items : mapping of str to Item
    where : str
        The file's name, for messages.
    name, description : str
        What the file calls itself.

    Raises
    ------
    InputError
        With file, line and name, for a value that is no number.
    """
    quantities: dict[str, Quantity] = {}
    for key, item in items.items():
        if not isinstance(item.value, str):
            raise InputError(f"{where}, line {item.line}: {key[:60]} is a mapping, must be a number")
        try:
            quantities[key] = parse_number(item.value)
        except InputError as error:
            raise InputError(f"{where}, line {item.line}: {key[:60]} {error}") from None
    return NamedValues(where, quantities, {key: item.line for key, item in items.items()}, name, description)
