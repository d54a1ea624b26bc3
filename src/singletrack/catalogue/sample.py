"""A seeded sample of designs that agree with a sheet: geometry, masses, and what centres and inertias they make."""

from __future__ import annotations

import warnings
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from singletrack.catalogue.geometry import Geometry, resolve
from singletrack.catalogue.masses import sample_masses
from singletrack.catalogue.points import points_of
from singletrack.catalogue.shapes import assemble, place, wheel_inertias
from singletrack.catalogue.sheet import Sheet
from singletrack.catalogue.weighing import ASSEMBLIES, Collection, collect
from singletrack.errors import OddityWarning
from singletrack.parameters import Bicycle

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

__all__ = ["TYRES", "Drawn", "draw", "geometric", "inertial"]

_SEED = 20_070_801
_FRAME = ("mass", "x", "z", "inertia_xx", "inertia_yy", "inertia_zz", "inertia_xz")
#: Widths of tyres and radii of beads, as the geometry has them.
TYRES = tuple(f"{end} {part}" for end in ("rear", "front") for part in ("tyre width", "bead"))


@dataclass(frozen=True, eq=False)
class Drawn:
    """A sample of n designs that agree with a sheet, and what they were drawn from.

    Geometry and points are of shape (n + 1,), those of the sheet itself first.

    Attributes
    ----------
    sheet : Sheet
    geometry : Geometry
    points : dict of str to array, shape (n + 1, 3)
    collection : Collection
        Of c components.
    masses : array, shape (n, c)
        In kg.
    values : dict of str to array
        Parameters of a bicycle: geometry (n + 1,), the rest (n,).
    """

    sheet: Sheet
    geometry: Geometry
    points: dict[str, np.ndarray]
    collection: Collection
    masses: np.ndarray
    values: dict[str, np.ndarray]


def draw(count: int = 2000, **entries: Any) -> Drawn:
    """Return a sample of designs that agree with a sheet (``count`` of them; ``entries`` as for :func:`bicycle`)."""
    sheet = Sheet.of(entries)
    random = np.random.default_rng(_SEED)

    def normal() -> np.ndarray:
        return np.concatenate([[0.0], random.standard_normal(count)])

    geometry = resolve(sheet, normal)
    points = points_of(geometry)
    collection = collect(sheet, geometry, points)
    masses, odd = sample_masses(collection.prior, collection.weighings, count, random)
    for text in odd:
        warnings.warn(OddityWarning(text, name=sheet.name), stacklevel=4)
    sizes = {name: geometry.values[name][1:] for name in TYRES}
    sample = {name: point[1:] for name, point in points.items()}
    scatter = {}
    for assembly in ASSEMBLIES:
        numbers = (4, count) if assembly.endswith("frame") else (count,)
        scatter[assembly] = random.standard_normal((len(collection.members(assembly)), *numbers))
    values = geometric(geometry) | inertial(collection, sizes, sample, list(masses.T), scatter)
    return Drawn(sheet, geometry, points, collection, masses, values)


def geometric(geometry: Geometry) -> dict[str, Any]:
    """Return the parameters that are geometry (``geometry``), each of its shape (n,)."""
    return {name: geometry.values[name] for name in Bicycle.descriptions() if name in geometry.values}


def inertial(
    collection: Collection,
    sizes: Mapping[str, Any],
    points: Mapping[str, Any],
    masses: Sequence[Any],
    scatter: Mapping[str, Any],
    moved: Mapping[int, Any] | None = None,
) -> dict[str, Any]:
    """Return masses, centres and inertias, each (n,).

    Parameters
    ----------
    collection : Collection
        Of c components.
    sizes : mapping of str to array, shape (n,)
        ``front tyre width``, ``front bead`` and those of the rear wheel, in m.
    points : mapping of str to array, shape (n, 3)
    masses : sequence of c arrays, shape (n,)
        In kg.
    scatter : mapping of str to array, shape (k, 4, n) or (k, n)
        For each assembly of k components, standard normal numbers: how far they are from their usual places and sizes.
    moved : mapping of int to array, shape (n, 3), optional
        How far components are moved besides, in m.
    """
    found: dict[str, Any] = {}
    for assembly in ASSEMBLIES:
        own = collection.members(assembly)
        weights, rows = [masses[i] for i in own], [collection.rows[i] for i in own]
        end, _, body = assembly.partition(" ")
        if body == "frame":
            shifts = [
                collection.places[i] * shift[:3].T + (moved or {}).get(i, 0.0)
                for i, shift in zip(own, scatter[assembly], strict=True)
            ]
            placed = [
                place(row.shape, row.form, points, shift, swell)
                for row, shift, swell in zip(rows, shifts, scatter[assembly][:, 3], strict=True)
            ]
            together = assemble(weights, placed)
            found |= {f"{end}_frame_{part}": entry for part, entry in zip(_FRAME, together, strict=True)}
            continue
        width, bead = sizes[f"{end} tyre width"], sizes[f"{end} bead"]
        radii = {"hub": 0.0 * bead, "bead": bead, "outside": bead + width}
        across, about_axle = wheel_inertias(weights, [row.form for row in rows], radii, scatter[assembly])
        found |= {f"{end}_wheel_mass": sum(weights[1:], weights[0])}
        found |= {f"{end}_wheel_inertia_xx": across, f"{end}_wheel_inertia_yy": about_axle}
    return found
