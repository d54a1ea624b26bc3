"""What the paper computes: the Stratos and the Browser with Rider A in each posture."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from singletrack.library import load_bicycle, load_rider
from singletrack.parameters import Bicycle, Rider
from singletrack.posture import POSTURES, Options, seat
from singletrack.public import coefficients

if TYPE_CHECKING:
    from singletrack.linear import CriticalSpeeds, Modes
    from singletrack.posture import Posture
    from singletrack.public import CoefficientMatrices

__all__ = ["SPEEDS", "Case", "paper_cases"]

#: The paper's range, 0 to 10 m/s.
SPEEDS = np.linspace(0.0, 10.0, 1001)


@dataclass(frozen=True, eq=False)
class Case:
    """A bicycle with a rider in a posture, and what follows from it."""

    bicycle: Bicycle
    rider: Rider
    posture: str
    shoulder: str | None = None

    @property
    def name(self) -> str:
        """Name for files, such as ``stratos-leaned``."""
        return "-".join(part for part in (self.bicycle.name, self.posture, self.shoulder) if part)

    @property
    def title(self) -> str:
        """Name for people."""
        return f"{self.bicycle.name.title()}, {self.rider.name.replace('rider-a', 'Rider A')}, {self.posture}"

    @property
    def options(self) -> Options:
        """How the rider sits."""
        return Options(self.posture, self.shoulder, "bent" if self.posture == "leaned" else None)

    @cached_property
    def seated(self) -> Posture:
        """The rider on the bicycle."""
        return seat(self.bicycle, self.rider, self.options)

    @cached_property
    def model(self) -> CoefficientMatrices:
        """The coefficient matrices."""
        return coefficients(self.bicycle, self.rider, self.posture, self.shoulder, arms=self.options.arms)

    @cached_property
    def modes(self) -> Modes:
        """The modes over :data:`SPEEDS`."""
        return self.model.modes(SPEEDS)

    @cached_property
    def critical(self) -> CriticalSpeeds:
        """Critical speeds and stable ranges."""
        return self.model.critical_speeds()


def paper_cases() -> dict[str, Case]:
    """Return all combinations by name, and the leaned Stratos rider with the other shoulder for comparison.

    >>> list(paper_cases())[:3]
    ['stratos-rigid', 'stratos-leaned', 'stratos-upright']
    """
    rider = load_rider("rider-a")
    cases = [Case(load_bicycle(bicycle), rider, posture) for bicycle in ("stratos", "browser") for posture in POSTURES]
    cases.append(Case(load_bicycle("stratos"), rider, "leaned", "axial"))
    return {case.name: case for case in cases}
