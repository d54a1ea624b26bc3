"""The entries of a study's [vary]: values, ranges and distributions, with units."""

from __future__ import annotations

from typing import Any

import numpy as np

from singletrack.errors import InputError, nearest, unknown_name
from singletrack.parameters import Bicycle, Rider
from singletrack.parameters.units import parse_quantity
from singletrack.sweep.designs import Variation

__all__ = ["parse_variation"]

_ENTRIES = {"range": ("from", "to", "count"), "uniform": ("from", "to"), "normal": ("mean", "deviation")}
_SHAPES = (
    'a list of values, { from, to, count }, { from, to } (uniform) or { distribution = "normal", mean, deviation }'
)
_MOST = 1_000_000


def parse_variation(name: str, found: Any, place: str, *, with_rider: bool) -> Variation:
    """Return one entry of [vary] in SI units.

    Parameters
    ----------
    name : str
        A parameter of a bicycle or a rider.
    found : list or dict
        What the file says.
    place : str
        File and line, for messages.
    with_rider : bool
        Whether the study has a rider.

    Raises
    ------
    InputError
        With the entry, what was found and what is allowed.

    Examples
    --------
    >>> parse_variation("trail", {"from": "20 mm", "to": "60 mm", "count": 2}, "study.toml", with_rider=False).numbers
    (0.02, 0.06)
    """
    owner, unit = _owner(name, place, with_rider=with_rider)
    if isinstance(found, list) and found:
        values = tuple(_number(f"vary.{name}[{i}]", value, unit, place) for i, value in enumerate(found))
        return Variation(name, owner, unit, "values", values)
    if not isinstance(found, dict):
        raise InputError(f"{place}: vary.{name} = {found!r}, must be {_SHAPES}")
    kind = _kind(name, found, place)
    low, high = (_number(f"vary.{name}.{entry}", found[entry], unit, place) for entry in _ENTRIES[kind][:2])
    if (kind == "normal" and high <= 0) or (kind != "normal" and low >= high):
        rule = "a deviation greater than zero" if kind == "normal" else "from less than to"
        raise InputError(f"{place}: vary.{name} = {found}, must have {rule}")
    if kind != "range":
        return Variation(name, owner, unit, kind, (low, high))
    count = found["count"]
    if isinstance(count, bool) or not isinstance(count, int) or not 2 <= count <= _MOST:
        raise InputError(f"{place}: vary.{name}.count = {count!r}, must be a whole number from 2 to {_MOST}")
    return Variation(name, owner, unit, "values", tuple(np.linspace(low, high, count).tolist()))


def _owner(name: str, place: str, *, with_rider: bool) -> tuple[str, str]:
    known = {"bicycle": Bicycle.descriptions(), "rider": Rider.descriptions()}
    for owner, descriptions in known.items():
        if name in descriptions:
            if owner == "rider" and not with_rider:
                raise InputError(f"{place}: vary.{name} is a rider's parameter, but the study has no rider")
            return owner, descriptions[name].unit
    names = [*known["bicycle"], *known["rider"]]
    raise InputError(f"{place}: vary: unknown parameter {name!r}{nearest(name, names)}; must be a bicycle's or rider's")


def _number(entry: str, found: object, unit: str, place: str) -> float:
    try:
        value = parse_quantity(found, unit).value
    except InputError as error:
        raise error.of(entry).at(place) from None
    if not np.isfinite(value):
        raise InputError(f"{place}: {entry} = {found!r}, must be a finite number")
    return value


def _kind(name: str, found: dict[str, Any], place: str) -> str:
    """Return the kind of range or distribution, all entries being there and no others."""
    kind = str(found.get("distribution", "range" if "count" in found else "uniform"))
    if (kind == "range" and "distribution" in found) or kind not in _ENTRIES:
        raise InputError(f"{place}: vary.{name}: {unknown_name('distribution', kind, ('uniform', 'normal'))}")
    wanted = _ENTRIES[kind]
    for entry in found:
        if entry not in (*wanted, "distribution"):
            raise InputError(f"{place}: vary.{name}: {unknown_name('entry', entry, wanted)}; must be {_SHAPES}")
    missing = [entry for entry in wanted if entry not in found]
    if missing:
        raise InputError(f"{place}: vary.{name} lacks {', '.join(missing)}; must be {_SHAPES}")
    return kind
