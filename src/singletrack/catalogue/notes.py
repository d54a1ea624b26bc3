"""Where each number of an estimate comes from, in words: the comments of its file."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Mapping

    from singletrack.catalogue.geometry import Geometry
    from singletrack.catalogue.weighing import Collection

__all__ = ["notes_of"]

_LISTED = 8
_HOW = {
    "x": "from where {parts} sit",
    "z": "from where {parts} sit",
    "inertia_xx": "{parts} as tubes and lumps: distances from the x-axis",
    "inertia_yy": "{parts} as tubes and lumps: distances from the y-axis",
    "inertia_zz": "{parts} as tubes and lumps: distances from the z-axis",
    "inertia_xz": "{parts} as tubes and lumps: minus the sum of m x z",
}


def notes_of(geometry: Geometry, collection: Collection, masses: Mapping[str, tuple[float, float]]) -> dict[str, str]:
    """Return where each parameter comes from, by name.

    Parameters
    ----------
    geometry : Geometry
    collection : Collection
    masses : mapping of str to (float, float)
        Mean and standard deviation in kg by ``assembly: component``.
    """
    notes = dict(geometry.notes)
    for end in ("rear", "front"):
        for body in ("frame", "wheel"):
            assembly = f"{end} {body}"
            own = {name.partition(": ")[2]: mass for name, mass in masses.items() if name.startswith(f"{assembly}:")}
            largest = sorted(own.items(), key=lambda item: -item[1][0])[:_LISTED]
            listed = ", ".join(f"{name} {mean:.2f}" for name, (mean, _) in largest if mean > 0.005)
            given = geometry.sheet.values.get(f"{end}_{body}_mass")
            how = "sum of its parts" if given is None else "given; in its parts"
            more = len(own) - len(largest)
            notes[f"{end}_{body}_mass"] = f"{how}, on average: {listed}{f' and {more} more' if more > 0 else ''} kg"
            if body == "frame":
                parts = f"{len(collection.members(assembly))} parts"
                notes |= {f"{end}_frame_{entry}": text.format(parts=parts) for entry, text in _HOW.items()}
        hoops = "tyre, tube, rim, spokes and hub as hoops"
        notes[f"{end}_wheel_inertia_yy"] = f"{hoops}: sum of m r^2"
        notes[f"{end}_wheel_inertia_xx"] = f"{hoops}: half of that about the axle, and their width"
    return notes
