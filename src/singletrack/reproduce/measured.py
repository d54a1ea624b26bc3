"""The riderless bicycle of Kooijman, Schwab and Meijaard (2008), computed and measured."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

from singletrack.library import load_bicycle
from singletrack.library.measured import MeasuredModes, load_measured_modes
from singletrack.public import CoefficientMatrices, coefficients
from singletrack.reproduce.cases import SPEEDS

if TYPE_CHECKING:
    from singletrack.linear import CriticalSpeeds, Modes

__all__ = ["MeasuredCase", "measured_case"]


@dataclass(frozen=True, eq=False)
class MeasuredCase:
    """A bicycle's model with runs that were measured on it."""

    name: str
    model: CoefficientMatrices
    runs: MeasuredModes

    @cached_property
    def modes(self) -> Modes:
        """The modes over :data:`~singletrack.reproduce.cases.SPEEDS`."""
        return self.model.modes(SPEEDS)

    @cached_property
    def critical(self) -> CriticalSpeeds:
        """Critical speeds and stable ranges."""
        return self.model.critical_speeds()


def measured_case() -> MeasuredCase:
    """Return the instrumented bicycle with its 26 runs.

    >>> len(measured_case().runs.eigenvalues)
    26
    """
    name = "kooijman-2008"
    return MeasuredCase(name, coefficients(load_bicycle(name)), load_measured_modes(name))
