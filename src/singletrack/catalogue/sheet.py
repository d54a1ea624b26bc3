"""What somebody said of a bicycle, checked and in SI: the sheet."""

from __future__ import annotations

import re
from dataclasses import dataclass, field
from math import pi
from typing import TYPE_CHECKING, Any

from singletrack.catalogue.tables import bars, components, entries
from singletrack.errors import InputError, shown, unknown, unknown_name
from singletrack.parameters.units import Quantity, parse_quantity

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Mapping

__all__ = ["Load", "Sheet", "tyre_size"]

_TEXTS = ("wheel_size", "rear_wheel_size", "front_wheel_size", "bar")
_LOAD = {"mass": "kg", "x": "m", "z": "m", "length": "m", "width": "m", "height": "m"}
#: Entries that may be negative, and others that may be zero.
_SIGNED = ("bar_rise", "bar_sweep", "saddle_setback", "stem_angle", "fork_offset", "trail", "steer_axis_tilt")
_ZERO = ("spacers", "bottom_bracket_drop", "grip_x", "stem_length")
_MOST = 1000
#: The largest standard deviations, by unit: beyond, the designs of a sample are no bicycles.
_WIDEST = {"m": (0.1, "0.1 m"), "rad": (0.1, "5.7 deg"), "kg": (10.0, "10 kg"), "m/s**2": (0.1, "0.1 m/s^2")}
#: What places and sizes of a load must be.
_PLACES: dict[str, tuple[Callable[[float], bool], str]] = {
    "x": (lambda x: abs(x) <= _FAR, "within 5 m of the rear contact"),
    "z": (lambda z: -_FAR <= z <= 0, "zero or less, at most 5 m up (z points down, heights are negative)"),
    **dict.fromkeys(("length", "width", "height"), (lambda size: 0 <= size <= _FAR, "from 0 to 5 m")),
}
_FAR = 5.0
_FRAMES = ("rear frame", "front frame")


@dataclass(frozen=True)
class Load:
    """Something that is mounted: motor, battery, luggage, instruments.

    Attributes
    ----------
    name : str
    on : {"rear frame", "front frame"}
    mass, x, z : Quantity
        In kg and m, in the bicycle's frame: forward of the rear contact, and down (heights are negative).
    size : tuple of float
        Length, width and height of the box that it fills, in m.
    """

    name: str
    on: str
    mass: Quantity
    x: Quantity
    z: Quantity
    size: tuple[float, float, float] = (0.1, 0.1, 0.1)


@dataclass(frozen=True)
class Sheet:
    """A geometry sheet, in SI.

    Attributes
    ----------
    name : str
    values : dict of str to Quantity
        Lengths, angles and masses by name, with standard deviations where given.
    texts : dict of str to str
        Wheel sizes and the kind of handlebar.
    parts : dict of str to Quantity
        Masses in kg of single components or parts ("saddle", "frame", "fork", "rear hub").
    loads : tuple of Load
    fitted : dict of str to bool
        Components and kinds that are there, or not.
    """

    name: str = ""
    values: dict[str, Quantity] = field(default_factory=dict)
    texts: dict[str, str] = field(default_factory=dict)
    parts: dict[str, Quantity] = field(default_factory=dict)
    loads: tuple[Load, ...] = ()
    fitted: dict[str, bool] = field(default_factory=dict)

    @classmethod
    def of(cls, given: Mapping[str, Any]) -> Sheet:
        """Return the sheet that entries by name make.

        Parameters
        ----------
        given : mapping of str to object
            Entries as :func:`~singletrack.catalogue.bicycle` takes them; None counts as not given.

        Raises
        ------
        InputError
            Of all entries that are unknown or no such quantity, at once.

        Examples
        --------
        >>> Sheet.of({"head_angle": "72 deg"}).values["head_angle"].value
        1.2566370614359172
        """
        own = {"name", "parts", "loads", "with_parts", "without_parts"}
        wrong, values, texts = [], {}, {}
        for name, found in given.items():
            if found is None or name in own:
                continue
            try:
                if name in _TEXTS:
                    texts[name] = _text(name, found)
                elif name in entries():
                    values[name] = _quantity(name, found)
                else:
                    raise unknown("entry", name, [*entries(), *own])
            except InputError as error:
                wrong.append(error)
        if wrong:
            raise InputError.of_all(wrong)
        parts = {part: _mass_of_part(part, mass) for part, mass in dict(given.get("parts") or {}).items()}
        loads = tuple(_load(load) for load in given.get("loads") or ())
        fitted = _fitted(given.get("with_parts") or (), given.get("without_parts") or ())
        return cls(str(given.get("name") or ""), values, texts, parts, loads, fitted)


def tyre_size(text: str) -> tuple[float, float]:
    """Return a tyre's width and its bead's diameter in m.

    Parameters
    ----------
    text : str
        By ETRTO: width and bead diameter in mm.

    Raises
    ------
    InputError
        If it is no such text.

    Examples
    --------
    >>> tyre_size("37-622")
    (0.037, 0.622)
    """
    match = re.fullmatch(r"\s*([0-9]{2,3})\s*-\s*([0-9]{3})\s*", text)
    width, bead = (int(match[1]), int(match[2])) if match else (0, 0)
    if not (15 <= width <= 130 and 150 <= bead <= 700):
        allowed = "width and bead diameter in mm by ETRTO, as 37-622 (on the tyre's side)"
        raise InputError(f"{text!r} is no tyre size; allowed: {allowed}", found=text, allowed=allowed)
    return width / 1000, bead / 1000


def _text(name: str, found: object) -> str:
    if not isinstance(found, str):
        raise InputError(f"{name} = {shown(found)}, must be text", parameters=[name], found=found)
    if name == "bar" and found not in bars():
        raise InputError(f"{name} = {unknown_name('kind of bar', found, bars())}", parameters=[name], found=found)
    if name != "bar":
        try:
            tyre_size(found)
        except InputError as error:
            raise error.of(name) from None
    return found


def _quantity(name: str, found: object) -> Quantity:
    entry = entries()[name]
    try:
        quantity = parse_quantity(found, entry.unit)
    except InputError as error:
        raise error.of(name) from None
    value, allowed = quantity.value, ""
    if not abs(value) < _MOST:
        allowed = f"a finite number, less than {_MOST}"
    elif value < 0 and name not in _SIGNED:
        allowed = "zero or more" if name in _ZERO else "greater than zero"
    elif value == 0 and name not in (*_SIGNED, *_ZERO):
        allowed = "greater than zero"
    elif entry.unit == "rad" and abs(value) > pi / 2:
        allowed = "at most 90 deg (a bare number is in radians)"
    elif (quantity.deviation or 0.0) > _WIDEST[entry.unit][0]:
        allowed = f"known better: a standard deviation of at most {_WIDEST[entry.unit][1]}"
    if allowed:
        raise InputError(f"{name} = {shown(found)}, must be {allowed}", parameters=[name], found=found, allowed=allowed)
    return quantity


def _mass_of_part(part: str, found: object) -> Quantity:
    known = {name for component in components() for name in (component.name, component.part) if name}
    if part not in known:
        raise unknown("part", part, sorted(known))
    return _positive(f"mass of {part}", found)


def _positive(name: str, found: object) -> Quantity:
    try:
        mass = parse_quantity(found, "kg")
    except InputError as error:
        raise error.of(name) from None
    if not 0 < mass.value < _MOST:
        raise InputError(f"{name} = {shown(found)}, must be greater than zero and less than {_MOST} kg", found=found)
    return mass


def _load(found: Mapping[str, object]) -> Load:
    name = str(found.get("name", "load"))
    for key in found:
        if key not in (*_LOAD, "name", "on"):
            raise unknown(f"entry of load {name}", key, [*_LOAD, "name", "on"])
    missing = [key for key in ("mass", "x", "z") if key not in found]
    if missing:
        raise InputError(f"load {name}: lacks {', '.join(missing)}", parameters=missing)
    on = found.get("on", "rear frame")
    if on not in _FRAMES:
        raise unknown("assembly", str(on), _FRAMES, f"load {name}")
    numbers = {}
    for key, unit in _LOAD.items():
        try:
            numbers[key] = parse_quantity(found.get(key, 0.1), unit)
        except InputError as error:
            raise error.of(key).at(f"load {name}") from None
    _positive(f"load {name}: mass", found["mass"])
    for key, (fits, words) in _PLACES.items():
        quantity = numbers[key]
        if not fits(quantity.value) or (quantity.deviation or 0.0) > 1:
            reason = f"load {name}: {key} = {shown(found[key])}, must be {words}, known to a metre at least"
            raise InputError(reason, parameters=[key], found=found[key], allowed=words)
    size = (numbers["length"].value, numbers["width"].value, numbers["height"].value)
    return Load(name, str(on), numbers["mass"], numbers["x"], numbers["z"], size)


def _fitted(present: Iterable[str], absent: Iterable[str]) -> dict[str, bool]:
    known = {name for part in components() for name in (part.name, part.kind) if name}
    fitted: dict[str, bool] = {}
    for names, there in ((present, True), (absent, False)):
        for name in names:
            if name not in known:
                raise unknown("part", name, sorted(known))
            if fitted.get(name, there) != there:
                raise InputError(f"{name}: is both in with_parts and in without_parts", parameters=[name])
            fitted[name] = there
    return fitted
