"""Which components a bicycle may have, and what was weighed of them."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from singletrack.catalogue.masses import Prior, Weighing
from singletrack.catalogue.tables import Component, components
from singletrack.errors import InputError

if TYPE_CHECKING:
    from collections.abc import Mapping

    from singletrack.catalogue.geometry import Geometry
    from singletrack.catalogue.sheet import Load, Sheet
    from singletrack.parameters.units import Quantity

__all__ = ["ASSEMBLIES", "Collection", "collect", "size_of"]

ASSEMBLIES = ("rear frame", "front frame", "rear wheel", "front wheel")
#: The kinds of component by the sheet's word for the handlebar.
BARS = {"flat": "straight bar", "riser": "straight bar", "city": "city bar", "drop": "drop bar"}
#: Of the tyre that the table's masses are of: width and bead radius in m.
_USUAL = (0.037, 0.311)
#: Relative standard deviation of a single tube's mass per length beside what a frame's tubes share (source "tubes").
_TUBE = 0.20


@dataclass(frozen=True)
class Collection:
    """All c components that may be there, with what is known of their masses.

    Attributes
    ----------
    prior : Prior
    weighings : tuple of Weighing
    rows : tuple of Component
        Loads last.
    places : array, shape (c, 3)
        Standard deviations of places in m: forward, down, aside.
    """

    prior: Prior
    weighings: tuple[Weighing, ...]
    rows: tuple[Component, ...]
    places: np.ndarray

    def members(self, assembly: str) -> list[int]:
        """Return the positions of the components of an ``assembly``."""
        return [i for i, row in enumerate(self.rows) if row.assembly == assembly]


def collect(sheet: Sheet, geometry: Geometry, points: Mapping[str, np.ndarray]) -> Collection:
    """Return the components that a bicycle may have, and the weighings that a sheet tells.

    Parameters
    ----------
    sheet : Sheet
    geometry : Geometry
    points : mapping of str to array, shape (n, 3)
        As :func:`~singletrack.catalogue.points.points_of` makes them.

    Raises
    ------
    InputError
        If masses contradict each other, or nothing of a kind that is said to be there is left.
    """
    rows = [component for component in components() if _probability(component, sheet) > 0]
    means = [_mass(component, geometry, points) for component in rows]
    loads = [_of_load(load) for load in sheet.loads]
    masses = [(mean, deviation) for mean, deviation in means] + [mass for _, mass in loads]
    rows += [component for component, _ in loads]
    prior = Prior(
        names=tuple(row.name for row in rows),
        mean=np.array([mean for mean, _ in masses]),
        own=np.array([max(deviation, 1e-6) for _, deviation in masses]),
        common=np.array([row.common * mean for row, (mean, _) in zip(rows, masses, strict=True)]),
        parts=tuple(f"{row.assembly} {row.part}" if row.part else "" for row in rows),
        choices=tuple(row.choice for row in rows),
        kinds=tuple(row.kind for row in rows),
        probability=np.array([_probability(row, sheet) for row in rows]),
        fitted=np.array([1.0 if sheet.fitted.get(row.name) else row.fitted for row in rows]),
        told=np.arange(len(rows)) >= len(rows) - len(loads),
    )
    return Collection(
        prior,
        tuple(_weighings(sheet, rows)),
        tuple(rows),
        np.array([(*row.place, 0.0)[:3] for row in rows]),
    )


def _probability(component: Component, sheet: Sheet) -> float:
    """Return how probable a component is, given what is said to be there; impossible where another kind is."""
    own = {name for name in (component.name, component.kind) if name}
    if any(sheet.fitted.get(name) is False for name in own):
        return 0.0
    if component.choice:
        rivals = [other for other in components() if other.choice == component.choice]
        chosen = {other.kind for other in rivals if sheet.fitted.get(other.name) or sheet.fitted.get(other.kind)}
        if component.choice == "bar" and "bar" in sheet.texts:
            chosen |= {BARS[sheet.texts["bar"]]}
        if chosen:
            return float(component.kind in chosen)
        return component.probability
    return 1.0 if sheet.fitted.get(component.name) else component.probability


def _mass(component: Component, geometry: Geometry, points: Mapping[str, np.ndarray]) -> tuple[float, float]:
    """Return a component's mass in kg with its own standard deviation, on this bicycle."""
    size = float(np.ravel(size_of(component, geometry, points))[0])
    if component.tube is not None:
        diameter, wall, density = component.tube
        mean = float(component.count * np.pi * (diameter - wall) * wall * density * size)
        return mean, _TUBE * mean
    mean, deviation = component.mass or (0.0, 0.0)
    return mean * size, deviation * size


def size_of(component: Component, geometry: Geometry, points: Mapping[str, np.ndarray]) -> Any:
    """Return what a component's mass is proportional to, shape (n,): a tube's length in m, a hoop's size, else 1.

    Parameters
    ----------
    component : Component
    geometry : Geometry
    points : mapping of str to array, shape (n, 3)
    """
    if component.tube is not None:
        start, end = (points[component.form[key]] for key in ("from", "to"))
        return geometry.xp.sqrt(((end - start) ** 2).sum(-1))
    if component.shape != "hoop" or component.form["to"][0] == "hub":
        return 1.0
    which = component.assembly.partition(" ")[0]
    width, bead = geometry.values[f"{which} tyre width"], geometry.values[f"{which} bead"]
    return bead / _USUAL[1] * (width / _USUAL[0]) ** component.form.get("width_power", 0.0)


def _of_load(load: Load) -> tuple[Component, tuple[float, float]]:
    deviation = load.mass.deviation or 0.0
    form = {"at": "rear contact", "offset": (load.x.value, load.z.value), "size": load.size}
    place = (load.x.deviation or 0.0, load.z.deviation or 0.0)
    return Component(load.name, load.on, "lump", form, place=place), (load.mass.value, deviation)


def _weighings(sheet: Sheet, rows: list[Component]) -> list[Weighing]:
    """Return disjoint sets of components with their masses: parts first, then what is left of each assembly."""
    taken: set[int] = set()
    found: list[Weighing] = []
    known = dict.fromkeys(ASSEMBLIES, 0.0)
    for part, mass in sheet.parts.items():
        members = [i for i, row in enumerate(rows) if part in (row.name, row.part) and i not in taken]
        assemblies = {rows[i].assembly for i in members}
        if len(assemblies) != 1:
            reason = "was weighed twice, or is not there" if not assemblies else "is on both wheels: weigh the wheels"
            raise InputError(f"mass of {part}: {reason}", parameters=["parts"])
        _refuse_open_choice(part, members, rows)
        taken |= set(members)
        known[assemblies.pop()] += mass.value
        found.append(Weighing(f"mass of {part}", np.array(members), mass.value, mass.deviation or 0.0))
    rest: list[int] = []
    weighed = 0.0
    for assembly in ASSEMBLIES:
        name = f"{assembly.replace(' ', '_')}_mass"
        members = [i for i, row in enumerate(rows) if row.assembly == assembly and i not in taken]
        whole = sheet.values.get(name)
        if whole is None:
            rest += members
            weighed += known[assembly]
        else:
            weighed += whole.value
            found.append(_left(name, members, whole, known[assembly]))
    total = sheet.values.get("total_mass")
    if not rest:
        if total is not None and abs(total.value - weighed) > 0.05 + 3 * (total.deviation or 0.0):
            raise InputError(
                f"total_mass contradicts itself: {total.value:.3f} kg (given), but {weighed:.3f} kg (its assemblies)",
                parameters=["total_mass"],
                found=(total.value, weighed),
            )
    elif total is None:
        found.append(Weighing("masses", np.array(rest)))
    else:
        found.append(_left("total_mass", rest, total, weighed))
    return found


def _refuse_open_choice(part: str, members: list[int], rows: list[Component]) -> None:
    """Raise InputError if what else is there depends on which kind of the part was weighed, and that is not said."""
    for choice in {rows[i].choice for i in members} - {""}:
        own = {i for i, row in enumerate(rows) if row.choice == choice}
        kinds = sorted({rows[i].kind for i in own})
        if own - set(members) and len(kinds) > 1:
            raise InputError(
                f"mass of {part}: of which kind? Say one of them in with_parts: {', '.join(kinds)}",
                parameters=["parts", "with_parts"],
                allowed=tuple(kinds),
            )


def _left(name: str, members: list[int], mass: Quantity, known: float) -> Weighing:
    if mass.value <= known:
        raise InputError(
            f"{name} = {mass.value:.3f} kg (given) contradicts {known:.3f} kg (sum of what was weighed of it)",
            parameters=[name],
            found=(mass.value, known),
        )
    return Weighing(name, np.array(members), mass.value - known, mass.deviation or 0.0)
