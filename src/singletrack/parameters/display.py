"""How records look at a prompt and in a notebook: one line, and a table."""

from __future__ import annotations

from math import degrees
from typing import TYPE_CHECKING, Protocol

import numpy as np

from singletrack.arrays import Number, is_concrete
from singletrack.markup import table, told

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping, Sequence

    from singletrack.parameters.description import Parameter

__all__ = ["line_of", "table_of"]


class _Described(Protocol):
    """What is shown of a record."""

    @property
    def kind(self) -> str: ...
    @property
    def name(self) -> str: ...
    @property
    def description(self) -> str: ...
    @property
    def standard_deviations(self) -> Mapping[str, Number]: ...
    @property
    def shape(self) -> tuple[int, ...]: ...
    def descriptions(self) -> dict[str, Parameter]: ...
    def values(self) -> dict[str, Number]: ...


def line_of(record: _Described, names: Sequence[str]) -> str:
    """Return one line: what it is, its name, the batch's shape, and some of its parameters.

    Parameters
    ----------
    record : Record
    names : sequence of str
        The parameters to show.

    Examples
    --------
    >>> from singletrack import load_bicycle
    >>> line_of(load_bicycle("stratos"), ["wheel_base", "trail"])
    '<Bicycle stratos: wheel_base 1.037 m, trail 0.0563 m>'
    """
    descriptions, values = record.descriptions(), record.values()
    parts = [f"designs of shape {record.shape}"] if record.shape else []
    parts += [f"{name} {_value(values[name], descriptions[name].unit)}" for name in names if name in values]
    return f"<{type(record).__name__}{f' {record.name}' if record.name else ''}: {', '.join(parts)}>"


def table_of(record: _Described) -> str:
    """Return an HTML table of all parameters: name, symbol, value in SI (angles in degrees), deviation, meaning.

    Parameters
    ----------
    record : Record
    """
    shape = f", {' × '.join(map(str, record.shape))} designs" if record.shape else ""
    caption = f"{record.kind} {record.name}{shape}" + (f": {record.description}" if record.description else "")
    return table(_rows(record), ["parameter", "symbol", "value", "±", ""], caption)


def _rows(record: _Described) -> Iterator[list[str]]:
    group = ""
    for name, description in record.descriptions().items():
        value = getattr(record, name)
        if value is None:
            continue
        if description.group != group:
            group = description.group
            yield [group]
        deviation = record.standard_deviations.get(name)
        spread = "" if deviation is None else _value(deviation, description.unit)
        yield [name, description.symbol, _value(value, description.unit), spread, description.meaning]


def _value(value: Number, unit: str) -> str:
    """Return a value with its unit; a batch as its least and its greatest."""
    factor, unit = (degrees(1.0), "deg") if unit == "rad" else (1.0, unit.replace("**", "^"))
    if not is_concrete(value):
        return "traced"
    if isinstance(value, float):
        return f"{told(factor * value)} {unit}".rstrip()
    numbers = np.real(np.asarray(value, dtype=complex)) * factor
    finite = numbers[np.isfinite(numbers)]
    if not finite.size:
        return "none" if not numbers.size else "not finite"
    least, most = finite.min(), finite.max()
    between = told(least) if least == most else f"{told(least)} to {told(most)}"
    others = numbers.size - finite.size
    return f"{between} {unit}".rstrip() + (f" ({others} not finite)" if others else "")
