"""A sheet whose entries vary: the bicycle expected for each, smooth, exact under complex steps, traceable by JAX.

The bicycle of the sheet itself is that of :func:`~singletrack.catalogue.estimate`; what varies adds its change,
computed from the mean of every component's mass at its mean place. Components stay what they are, given all that was
weighed: tubes get longer and heavier, hoops larger, all else moves with the frame.
"""

from __future__ import annotations

import dataclasses
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from singletrack.arrays import namespace, vector
from singletrack.catalogue.estimate import Estimate, summary
from singletrack.catalogue.geometry import resolve
from singletrack.catalogue.points import points_of
from singletrack.catalogue.sample import TYRES, Drawn, draw, geometric, inertial
from singletrack.catalogue.sheet import Sheet
from singletrack.catalogue.start import starts, typical_start
from singletrack.catalogue.weighing import ASSEMBLIES, size_of
from singletrack.errors import InputError, unknown_name
from singletrack.parameters import Bicycle
from singletrack.parameters.units import Quantity

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from singletrack.catalogue.geometry import Geometry

__all__ = ["SIZES", "Expected", "expected"]

#: Share of a batch of designs that may be no bicycles: NaN; a single one raises.
_MOST_LOST = 0.999
#: Numbers of tyres that may vary in place of their sizes by ETRTO: width and bead diameter in m.
SIZES = tuple(f"{end} tyre {part}" for end in ("rear", "front") for part in ("width", "diameter"))


@dataclass(frozen=True, eq=False)
class Expected:
    """Bicycles expected for a sheet whose entries vary.

    Attributes
    ----------
    sheet : Sheet
    drawn : Drawn
        The sample that agrees with the sheet.
    estimate : Estimate
        What it says.
    values, units : dict of str to float and to str
        Entries that may vary, with what they are on the sheet, and their SI units: those it gives, those that are
        typical, of each load ``NAME mass``, ``NAME x``, ``NAME z``.
    deviations : dict of str to float
        Their standard deviations, where the sheet gives one or they are typical.
    """

    sheet: Sheet
    drawn: Drawn
    estimate: Estimate
    values: dict[str, float]
    units: dict[str, str]
    deviations: dict[str, float]
    _first: dict[str, float] = dataclasses.field(default_factory=dict)

    def bicycle(self, changes: Mapping[str, Any]) -> Bicycle:
        """Return the bicycles for entries of other values, ``changes``, of their shape; see :meth:`parameters`."""
        own = self.estimate.bicycle
        return Bicycle(**self.parameters(changes), name=own.name, source=own.source)

    def parameters(self, changes: Mapping[str, Any]) -> dict[str, Any]:
        """Return a bicycle's parameters by name, each of shape (n,), for entries of other values.

        Parameters
        ----------
        changes : mapping of str to array, shape () or (n,)
            In SI: NumPy, complex for derivatives, or JAX. Parameters of a single design are numbers.

        Raises
        ------
        InputError
            If there is no such entry, it contradicts what the sheet says besides, or no such frame can exist.
        """
        for name in changes:
            if name not in self.values and name not in SIZES:
                raise InputError(unknown_name("entry of the sheet", name, tuple(self.values)), parameters=(name,))
        own, single = self.estimate.bicycle.values(), all(np.ndim(value) == 0 for value in changes.values())
        found = {name: own.get(name, 0.0) + (v - self._first[name]) for name, v in self._computed(changes).items()}
        return {name: value[0] for name, value in found.items()} if single else found

    def _computed(self, changes: Mapping[str, Any]) -> dict[str, Any]:
        """Return the parameters (n,) from the mean masses, each component at its mean place."""
        xp = namespace(*changes.values()) if changes else np
        nothing = sum((0.0 * xp.asarray(value) for value in changes.values()), xp.zeros(1))  # of shape and kind of all
        geometry = resolve(_sheet(self.sheet, changes), lambda: nothing, xp, lost=_MOST_LOST)
        points = points_of(geometry)
        own = self.drawn.collection
        still = {a: np.zeros((len(own.members(a)), *((4,) if a.endswith("frame") else ()), 1)) for a in ASSEMBLIES}
        first = len(own.rows) - len(self.sheet.loads)
        moved = {first + k: _moved(load, changes) for k, load in enumerate(self.sheet.loads)}
        sizes = {name: geometry.values[name] for name in TYRES}
        masses = [mass + nothing for mass in self._masses(geometry, points, changes)]
        found = geometric(geometry) | inertial(own, sizes, points, masses, still, moved)
        found["handlebar_drop"] = geometry.values["grip drop"]
        return {name: value + nothing for name, value in found.items()}

    def _masses(self, geometry: Geometry, points: Mapping[str, Any], changes: Mapping[str, Any]) -> list[Any]:
        """Return the components' masses, (n,) each: as they are expected, larger where tubes and hoops are."""
        own, drawn = self.drawn.collection, self.drawn
        found: list[Any] = []
        for row, mass in zip(own.rows, drawn.masses.mean(0), strict=True):
            before = np.ravel(size_of(row, drawn.geometry, drawn.points))[0]
            found.append(float(mass) * (size_of(row, geometry, points) / before))
        for weighing in own.weighings:
            if weighing.name in changes:
                # What more is weighed is where the masses are least known: as a Gaussian sum is conditioned.
                share = drawn.masses[:, weighing.members].var(0)
                for i, part in zip(weighing.members, share / share.sum(), strict=True):
                    found[i] = found[i] + part * (changes[weighing.name] - self.values[weighing.name])
        first = len(own.rows) - len(self.sheet.loads)
        for k, load in enumerate(self.sheet.loads):
            found[first + k] = found[first + k] + (changes.get(f"{load.name} mass", load.mass.value) - load.mass.value)
        return found


def expected(vary: Sequence[str] = (), count: int = 2000, **given: Any) -> Expected:
    """Return what is expected of a sheet whose entries vary.

    Parameters
    ----------
    vary : sequence of str
        Entries that will vary: where the sheet does not give them, it is taken to give what is typical.
    count : int
        Size of the sample.
    **given
        As for :func:`~singletrack.catalogue.bicycle`.

    Raises
    ------
    InputError
        As :func:`~singletrack.catalogue.bicycle`; or if an entry that shall vary is none, or follows from others.

    Examples
    --------
    >>> import numpy as np
    >>> mine = expected(head_angle="69 deg", fork_offset="50 mm", wheel_size="37-622", wheel_base="1.1 m")
    >>> mine.parameters({"head_angle": np.radians([69.0, 72.0])})["trail"].round(3).tolist()
    [0.078, 0.059]
    """
    sheet = Sheet.of(given)
    base = resolve(sheet, lambda: np.zeros(1))
    whole = dict(given)
    for name in vary:
        start = typical_start(sheet, base, name)
        whole |= {} if start is None else {name: start}
    made = draw(count, **whole)
    values, units, deviations = starts(made.sheet, resolve(made.sheet, lambda: np.zeros(1)))
    found = Expected(made.sheet, made, summary(made), values, units, deviations)
    first = {name: float(value[0]) for name, value in found._computed({}).items()}  # noqa: SLF001  # being made
    return dataclasses.replace(found, _first=first)


def _sheet(sheet: Sheet, changes: Mapping[str, Any]) -> Sheet:
    """Return the sheet with other values; arrays take the place of numbers."""
    values = {name: Quantity(changes.get(name, old.value)) for name, old in sheet.values.items()}
    values |= {name: Quantity(value) for name, value in changes.items() if name not in SIZES}
    texts: dict[str, Any] = dict(sheet.texts)
    for end in ("rear", "front"):
        size = tuple(changes.get(f"{end} tyre {part}") for part in ("width", "diameter"))
        if None not in size:
            texts[f"{end}_wheel_size"] = size
            values.pop(f"{end}_wheel_radius", None)
    return dataclasses.replace(sheet, values=values, texts=texts)


def _moved(load: Any, changes: Mapping[str, Any]) -> Any:
    """Return how far a load is from where the sheet has it, (n, 3), in m: forward, down, aside."""
    x, z = (changes.get(f"{load.name} {part}", getattr(load, part).value) - getattr(load, part).value for part in "xz")
    return vector(x, z, 0.0 * x)
