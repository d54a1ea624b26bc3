"""Our own files, written so that every number reads back as the same double."""

from __future__ import annotations

import dataclasses
import itertools
import json
import math
import re
from typing import TYPE_CHECKING

from singletrack.errors import InputError
from singletrack.parameters.rider import Rider
from singletrack.parameters.units import parse_quantity

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    from singletrack.arrays import Number
    from singletrack.parameters.record import Parameter, Record

__all__ = ["quantity_text", "unit_text", "write_toml"]


def write_toml(record: Record, notes: Mapping[str, str] | None = None) -> str:
    """Return a bicycle or a rider as a TOML file with units, standard deviations and a comment for each parameter.

    Parameters
    ----------
    record : Bicycle or Rider
        A single design.
    notes : mapping of str to str, optional
        Where parameters come from, by name: their comments go on with it.

    Raises
    ------
    InputError
        If the record is a batch of designs.

    Examples
    --------
    >>> from singletrack import load_bicycle
    >>> print(write_toml(load_bicycle("stratos")).splitlines()[6])
    wheel_base = "1.037 m" # between the wheel contacts
    """
    if record.shape != ():
        raise InputError(f"{record.name or record.kind}: is a batch of shape {record.shape}, must be a single design")
    header = [f"kind = {_string(record.kind)}"]
    header += [f"{name} = {_string(getattr(record, name))}" for name in ("name", "description", "source")]
    return "\n".join([*header, *_parameters(record, notes or {}), *_tables(record)]) + "\n"


def _parameters(record: Record, notes: Mapping[str, str]) -> Iterator[str]:
    yield from ("", "[parameters]")
    values, deviations = record.values(), record.standard_deviations
    grouped = itertools.groupby(record.descriptions().items(), key=lambda item: item[1].group)
    for number, (group, members) in enumerate(grouped):
        lines = []
        for name, description in members:
            if name == "forward_lean_angle" and name not in values:
                lines += _lean_angles(record, description)
            elif name in values:
                text = quantity_text(float(values[name]), deviations.get(name), description.unit)
                lines.append(f"{name} = {text} # {description.meaning}{f'; {notes[name]}' if name in notes else ''}")
        if lines and number:
            yield from ("", f"# {group}")
        yield from lines


def _lean_angles(record: Record, description: Parameter) -> list[str]:
    angles = record.forward_lean_angles if isinstance(record, Rider) else {}
    if not angles:
        return []
    deviations = record.standard_deviations
    parts = [
        f"{_key(bicycle)} = {quantity_text(float(angle), deviations.get(f'forward_lean_angle on {bicycle}'), 'rad')}"
        for bicycle, angle in angles.items()
    ]
    return [f"forward_lean_angle = {{ {', '.join(parts)} }} # {description.meaning}"]


def _tables(record: Record) -> Iterator[str]:
    if record.extras:
        yield from ("", "[extras] # numbers of another format, kept for writing back")
        deviations = record.standard_deviations
        for name, value in record.extras.items():
            yield f"{_key(name)} = {quantity_text(float(value), deviations.get(name), '')}"
    for name, shape in getattr(record, "shapes", {}).items():
        yield from ("", f"[segments.{_key(name)}] # fractions of its length")
        yield from (f"{part} = {float(value)!r}" for part, value in dataclasses.asdict(shape).items())


def unit_text(unit: str) -> str:
    """Return a unit as people write it.

    >>> unit_text("kg*m**2"), unit_text("rad")
    ('kg*m^2', 'deg')
    """
    return "deg" if unit == "rad" else unit.replace("**", "^")


def quantity_text(value: float, deviation: Number | None, unit: str) -> str:
    """Return a number as TOML, with its unit; angles in degrees where that loses nothing.

    Parameters
    ----------
    value, deviation : float
    unit : str
        The SI unit, as pint writes it.

    Examples
    --------
    >>> quantity_text(0.0563, 0.0017, "m")
    '"0.0563 +/- 0.0017 m"'
    >>> quantity_text(0.3490658503988659, None, "rad"), quantity_text(0.068, None, "")
    ('"20 deg"', '0.068')
    """
    if not unit and deviation is None:
        return repr(value)
    numbers = [value] if deviation is None else [value, float(deviation)]
    texts, written = [repr(number) for number in numbers], unit
    if unit == "rad":
        degrees = [text for text in map(_degrees, numbers) if text is not None]
        texts, written = (degrees, "deg") if len(degrees) == len(numbers) else (texts, "rad")
    joined = " +/- ".join(texts)
    return f'"{joined} {written.replace("**", "^")}"' if unit else f'"{joined}"'


def _degrees(radians: float) -> str | None:
    """Return the shortest number of degrees that reads back as these radians, or None if there is none."""
    for digits in range(1, 18):
        text = f"{math.degrees(radians):.{digits}g}"
        text = f"{float(text):.0f}" if "e+" in text and abs(radians) < 1e3 else text  # 20, not 2e+01
        if parse_quantity(f"{text} deg", "rad").value == radians:
            return text
    return None


def _string(text: str) -> str:
    """Return a TOML basic string: JSON's, but for the one control character that JSON leaves as it is."""
    return json.dumps(text, ensure_ascii=False).replace("\x7f", "\\u007f")


def _key(name: str) -> str:
    return name if re.fullmatch(r"[A-Za-z0-9_-]+", name) else _string(name)
