"""One design changed in one or many ways: batches of its linear model, real or complex."""

from __future__ import annotations

import dataclasses
from typing import TYPE_CHECKING

from singletrack.closed_form import coefficients
from singletrack.errors import InputError, unknown_name
from singletrack.parameters import Bicycle, Rider
from singletrack.posture import Options

if TYPE_CHECKING:
    from collections.abc import Mapping

    import numpy as np

    from singletrack.arrays import Number
    from singletrack.model import LinearModel

__all__ = ["Design"]

_SPRING, _DAMPER, _FIT = "spring at ", "damper at ", "elbow angle"


@dataclasses.dataclass(frozen=True, eq=False)
class Design:
    """A bicycle, who sits on it and how: everything that a linear model is made from.

    Attributes
    ----------
    bicycle : Bicycle
    rider : Rider, optional
        With the forward lean angle on this bicycle.
    options : Options
        How the rider sits.
    title : str
        For headings and legends.
    """

    bicycle: Bicycle
    rider: Rider | None = None
    options: Options = dataclasses.field(default_factory=Options)
    title: str = ""

    @classmethod
    def of(
        cls, bicycle: Bicycle, rider: Rider | None = None, options: Options | str = "rigid", title: str = ""
    ) -> Design:
        """Return a design with its rider seated.

        Parameters
        ----------
        bicycle : Bicycle
        rider : Rider, optional
        options : Options or str
            How the rider sits, or a posture's name.
        title : str
            By default the bicycle's name.
        """
        sitting = Options.of(options)
        seated = None if rider is None else rider if sitting.fit is not None else rider.on(bicycle)
        return cls(bicycle, seated, sitting, title or bicycle.name or "bicycle")

    def values(self) -> dict[str, Number]:
        """Return every number that can be changed, in SI, each of shape (...).

        Of the bicycle, the rider and the posture: ``spring at JOINT``, ``damper at JOINT``, ``elbow angle``.
        """
        found = dict(self.bicycle.values())
        found |= {} if self.rider is None else self.rider.values()
        found |= {f"{_SPRING}{joint}": value for joint, value in self.options.springs.items()}
        found |= {f"{_DAMPER}{joint}": value for joint, value in self.options.dampers.items()}
        return found if self.options.fit is None else found | {_FIT: self.options.fit}

    def units(self) -> dict[str, str]:
        """Return the SI unit of each of :meth:`values`."""
        known = {name: p.unit for name, p in self.bicycle.descriptions().items()}
        if self.rider is not None:
            known |= {name: p.unit for name, p in self.rider.descriptions().items()}
        return {name: known.get(name) or _unit_of_posture(name) for name in self.values()}

    def deviations(self) -> dict[str, float]:
        """Return the standard deviations of :meth:`values`, in SI, where there are."""
        found = dict(self.bicycle.standard_deviations)
        found |= {} if self.rider is None else self.rider.standard_deviations
        return {name: float(deviation) for name, deviation in found.items()}

    def unit(self, name: str) -> str:
        """Return the SI unit of one parameter.

        Parameters
        ----------
        name : str

        Raises
        ------
        InputError
            If there is no such parameter.
        """
        units = self.units()
        if name not in units:
            raise InputError(unknown_name("parameter", name, tuple(units)), parameters=(name,))
        return units[name]

    def changed(self, changes: Mapping[str, Number]) -> Design:
        """Return the design, or a batch of designs, with some parameters of other values.

        Parameters
        ----------
        changes : mapping of str to array, shape (...)
            SI.

        Raises
        ------
        InputError
            If there is no such parameter, or a single design cannot have the value.
        """
        for name in changes:
            self.unit(name)
        own = self.bicycle.values()
        theirs = {} if self.rider is None else self.rider.values()
        bicycle = self.bicycle.replace(**{name: v for name, v in changes.items() if name in own})
        rider = self.rider
        if rider is not None:
            rider = rider.replace(**{name: v for name, v in changes.items() if name in theirs})
        return dataclasses.replace(self, bicycle=bicycle, rider=rider, options=self._options(changes))

    def _options(self, changes: Mapping[str, Number]) -> Options:
        def changed(prefix: str, values: Mapping[str, Number]) -> dict[str, Number]:
            return {joint: changes.get(f"{prefix}{joint}", value) for joint, value in values.items()}

        springs, dampers = changed(_SPRING, self.options.springs), changed(_DAMPER, self.options.dampers)
        fit = changes.get(_FIT, self.options.fit)
        return dataclasses.replace(self.options, springs=springs, dampers=dampers, fit=fit)

    def model(self) -> LinearModel:
        """Return the linear model, of a batch for batches."""
        return coefficients(self.bicycle, self.rider, self.options)

    def shifted(self, names: tuple[str, ...], shifts: np.ndarray) -> Design:
        """Return a batch of n designs with parameters shifted.

        Parameters
        ----------
        names : tuple of str
            The k parameters.
        shifts : array, shape (n, k)
            SI.
        """
        own = self.values()
        return self.changed({name: own[name] + shifts[:, i] for i, name in enumerate(names)})


def _unit_of_posture(name: str) -> str:
    if name == _FIT:
        return "rad"
    hands = "hand" in name
    if name.startswith(_SPRING):
        return "N/m" if hands else "N*m/rad"
    if name.startswith(_DAMPER):
        return "N*s/m" if hands else "N*m*s/rad"
    return ""
