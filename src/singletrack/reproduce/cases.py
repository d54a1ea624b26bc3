"""What the papers compute: bicycles with Rider A in each posture, and the variations that were tried."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from singletrack.closed_form import coefficients as linear_model
from singletrack.library import load_bicycle, load_rider
from singletrack.parameters import Bicycle, Rider
from singletrack.posture import POSTURES, Options, seat
from singletrack.public import CoefficientMatrices

if TYPE_CHECKING:
    from singletrack.linear import CriticalSpeeds, Modes
    from singletrack.posture import Posture

__all__ = ["SPEEDS", "WIDE_TORSO", "Case", "paper_cases"]

#: The papers' range, 0 to 10 m/s.
SPEEDS = np.linspace(0.0, 10.0, 1001)

#: At the lean hinge, in N m/rad and N m s/rad, as the journal version has them.
_SPRING, _DAMPER = {"torso lean": 100.0}, {"torso lean": 10.0}

#: Width of a torso, in m, from which the printed numbers of the leaned rider follow: found by trying, none gives it.
WIDE_TORSO = 0.40


@dataclass(frozen=True, eq=False)
class Case:
    """A bicycle with a rider who sits in some way, and what follows from it.

    Attributes
    ----------
    bicycle, rider : Bicycle, Rider
    options : Options
        How the rider sits.
    variation : str
        What differs from the rider and posture as they are shipped, in a word; "" for nothing.
    """

    bicycle: Bicycle
    rider: Rider
    options: Options
    variation: str = ""

    @property
    def posture(self) -> str:
        """Name of the posture."""
        return str(self.options.posture)

    @property
    def name(self) -> str:
        """Name for files, such as ``stratos-leaned``."""
        return "-".join(part for part in (self.bicycle.name, self.posture, self.variation) if part)

    @property
    def title(self) -> str:
        """Name for people."""
        return f"{self.bicycle.name.title()}, {self.rider.name.replace('rider-a', 'Rider A')}, {self.posture}"

    @cached_property
    def seated(self) -> Posture:
        """The rider on the bicycle."""
        return seat(self.bicycle, self.rider, self.options)

    @cached_property
    def model(self) -> CoefficientMatrices:
        """The coefficient matrices."""
        return CoefficientMatrices.of(linear_model(self.bicycle, self.rider, self.options))

    @cached_property
    def modes(self) -> Modes:
        """The modes over :data:`SPEEDS`."""
        return self.model.modes(SPEEDS)

    @cached_property
    def critical(self) -> CriticalSpeeds:
        """Critical speeds and stable ranges."""
        return self.model.critical_speeds()


def paper_cases() -> dict[str, Case]:
    """Return all combinations of both papers by name, and the variations that explain what was printed.

    >>> list(paper_cases())[:3]
    ['stratos-rigid', 'stratos-leaned', 'stratos-upright']
    """
    rider = load_rider("rider-a")
    wide = rider.replace(torso_width=WIDE_TORSO)
    stratos, browser = load_bicycle("stratos"), load_bicycle("browser")
    hybrid, city = load_bicycle("stratos-2012"), load_bicycle("browser-2012")
    cases = [Case(bicycle, rider, Options(posture)) for bicycle in (stratos, browser) for posture in POSTURES]
    cases += [
        Case(stratos, rider, Options("leaned", arms="bent"), "bent"),
        Case(stratos, rider, Options("leaned", "axial"), "axial"),
        Case(stratos, wide, Options("leaned"), "wide"),
        Case(hybrid, rider, Options("rigid")),
        Case(hybrid, rider, Options("leaned")),
        Case(hybrid, wide, Options("leaned"), "wide"),
        Case(city, rider, Options("rigid")),
        Case(city, rider, Options("upright")),
        Case(hybrid, wide, Options("leaned", torso_lean=True), "leaning"),
        Case(city, wide, Options("upright", torso_lean=True), "leaning"),
        Case(hybrid, rider, Options("leaned", torso_lean=True), "leaning-default"),
        Case(city, rider, Options("upright", torso_lean=True), "leaning-default"),
        Case(hybrid, wide, Options("leaned", torso_lean=True, springs=_SPRING, dampers=_DAMPER), "sprung"),
    ]
    return {case.name: case for case in cases}
