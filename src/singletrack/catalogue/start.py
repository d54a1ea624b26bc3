"""Where entries of a sheet that vary begin: what it gives, or what is typical."""

from __future__ import annotations

from typing import TYPE_CHECKING

from singletrack.catalogue.tables import bars, entries
from singletrack.errors import InputError, unknown_name

if TYPE_CHECKING:
    from singletrack.catalogue.geometry import Geometry
    from singletrack.catalogue.sheet import Sheet

__all__ = ["PARTS_OF_LOADS", "starts", "typical_start"]

#: What of a load may vary, with its unit.
PARTS_OF_LOADS = {"mass": "kg", "x": "m", "z": "m"}
_BARS = ("bar_width", "bar_rise", "bar_sweep")


def starts(sheet: Sheet, base: Geometry) -> tuple[dict[str, float], dict[str, str], dict[str, float]]:
    """Return the entries that may vary: their values, SI units, and standard deviations where there are.

    Parameters
    ----------
    sheet : Sheet
    base : Geometry
        That the sheet makes, shape (1,).
    """
    values = {name: float(quantity.value) for name, quantity in sheet.values.items()}
    deviations = {name: quantity.deviation or 0.0 for name, quantity in sheet.values.items()}
    for name in entries():
        # The note on stem_length is on the skeleton's, which goes up to the grips.
        typical = name == "stem_length" or base.notes.get(name, "").startswith("not given, typical")
        if name not in values and typical:
            values[name] = _typical(sheet, base, name)
            deviations[name] = (entries()[name].typical or (0.0, 0.0))[1]
    units = {name: entries()[name].unit for name in values}
    for load in sheet.loads:
        for part, unit in PARTS_OF_LOADS.items():
            name, quantity = f"{load.name} {part}", getattr(load, part)
            values[name], units[name], deviations[name] = float(quantity.value), unit, quantity.deviation or 0.0
    return values, units, {name: deviation for name, deviation in deviations.items() if deviation > 0}


def typical_start(sheet: Sheet, base: Geometry, name: str) -> float | None:
    """Return what an entry that shall vary is taken to be where the sheet does not give it; None where it does.

    Parameters
    ----------
    sheet : Sheet
    base : Geometry
        That the sheet makes, shape (1,).
    name : str

    Raises
    ------
    InputError
        If there is no such entry, or it follows from others.
    """
    known, _, _ = starts(sheet, base)
    if name in sheet.values or (name in known and name not in entries()):
        return None
    if name in known or (name in _BARS and not {"grip_x", "grip_height"} & set(sheet.values)) or name == "bar_width":
        return _typical(sheet, base, name)
    if name not in entries():
        raise InputError(unknown_name("entry of the sheet", name, (*known, *_BARS)), parameters=(name,))
    how = base.notes.get(name)
    reason = f"it follows ({how})" if how and how != "given" else "the sheet does not give it"
    reason = "it is no number" if entries()[name].unit == "" else reason
    raise InputError(f"{name}: cannot vary, {reason}; allowed: {', '.join(known)}", parameters=(name,))


def _typical(sheet: Sheet, base: Geometry, name: str) -> float:
    v = {key: float(value[0]) for key, value in base.values.items()}
    follows = {
        "stack": v["head top"] - v["bottom_bracket_height"],
        "fork_offset": v["fork offset"],
        "bottom_bracket_drop": v["rear_wheel_radius"] - v["bottom_bracket_height"],
        "saddle_height": v["seat_tube_length"] + v["seat_post_length"],
    }
    same = ("fork_length", "seat_tube_length", "chain_stay_length", "seat_tube_angle")
    if name in _BARS:
        return bars()[sheet.texts.get("bar", "any")][name][0]
    if name in follows or name in same:
        return follows[name] if name in follows else v[name]
    return (entries()[name].typical or (0.0, 0.0))[0]
