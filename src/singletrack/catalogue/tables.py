"""The tables of the catalogue: what a sheet may say, and what bicycles are put together from."""

from __future__ import annotations

import functools
from dataclasses import dataclass
from importlib import resources
from typing import Any

from singletrack.files.toml_text import parse_toml

__all__ = ["Component", "Entry", "bars", "components", "entries", "sources"]


@dataclass(frozen=True)
class Entry:
    """What one line of a sheet is.

    Attributes
    ----------
    group : {"geometry", "masses"}
    unit : str
        SI unit as pint reads it, "" for text.
    meaning : str
    typical : tuple of float, optional
        Mean and standard deviation where the sheet does not say, in the unit.
    source : str
        Of the typical value.
    """

    group: str
    unit: str
    meaning: str
    typical: tuple[float, float] | None = None
    source: str = ""


@dataclass(frozen=True)
class Component:
    """One kind of component, as data/catalogue/components.toml tells it.

    Attributes
    ----------
    name, assembly, part : str
        The assembly is ``rear frame``, ``front frame``, ``wheel`` (either), ``rear wheel`` or ``front wheel``; a part
        ("frame", "fork") is what several components are weighed as.
    mass : tuple of float
        Mean and standard deviation of its own in kg; of tubes None, which have a ``tube``.
    tube : tuple of float, optional
        Outer diameter and wall in m, density in kg/m^3.
    common : float
        Relative standard deviation that the components of a part share.
    choice, kind, probability
        A component of a choice is there where its kind is; one without, by its probability.
    fitted : float
        Probability that a component of a choice is there where its kind is.
    shape : {"lump", "rod", "arc", "hoop"}
    form : mapping
        What the shape needs: points, offsets, sizes.
    place : tuple of float
        Standard deviations of its place, forward and down, in m.
    """

    name: str
    assembly: str
    shape: str
    form: dict[str, Any]
    part: str = ""
    mass: tuple[float, float] | None = None
    tube: tuple[float, float, float] | None = None
    count: int = 1
    common: float = 0.0
    choice: str = ""
    kind: str = ""
    probability: float = 1.0
    fitted: float = 1.0
    place: tuple[float, float] = (0.0, 0.0)


_OWN = (
    "name",
    "assembly",
    "shape",
    "part",
    "mass",
    "tube",
    "count",
    "common",
    "choice",
    "kind",
    "probability",
    "fitted",
    "place",
)


def _table(name: str) -> dict[str, Any]:
    text = resources.files("singletrack").joinpath("data", "catalogue", name).read_text(encoding="utf-8")
    return parse_toml(text, name)


@functools.cache
def entries() -> dict[str, Entry]:
    """Return what a sheet may say, by name.

    >>> entries()["chain_stay_length"].typical
    (0.445, 0.018)
    """
    table = _table("sheet.toml")
    return {
        name: Entry(
            group,
            found["unit"],
            found["meaning"],
            tuple(found["typical"]) if "typical" in found else None,
            found.get("source", ""),
        )
        for group in ("geometry", "masses")
        for name, found in table[group].items()
    }


@functools.cache
def bars() -> dict[str, dict[str, tuple[float, float]]]:
    """Return means and standard deviations of width, rise and sweep in m, by kind of handlebar.

    >>> sorted(bars())
    ['any', 'city', 'drop', 'flat', 'riser']
    """
    return {
        kind: {name: tuple(pair) for name, pair in bar.items()} for kind, bar in _table("sheet.toml")["bars"].items()
    }


@functools.cache
def components() -> tuple[Component, ...]:
    """Return all components, those of a wheel once for either.

    >>> [component.name for component in components() if component.assembly == "rear wheel"][:5]
    ['tyre', 'tube', 'rim', 'steel rim', 'spokes']
    """
    found = []
    for row in _table("components.toml")["component"]:
        own = {key: tuple(value) if isinstance(value, list) else value for key, value in row.items() if key in _OWN}
        form = {key: value for key, value in row.items() if key not in _OWN}
        ends = ("rear wheel", "front wheel") if row["assembly"] == "wheel" else (row["assembly"],)
        found += [Component(**own | {"assembly": end, "form": form}) for end in ends]
    return tuple(found)


@functools.cache
def sources() -> dict[str, str]:
    """Return where the components' numbers come from, in words by key; the first word says of which kind a source is.

    >>> sources()["dt"].partition(":")[0]
    'published'
    """
    return dict(_table("components.toml")["sources"])
