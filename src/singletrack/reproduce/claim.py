"""A statement of the paper beside what was computed."""

from __future__ import annotations

from dataclasses import dataclass
from decimal import Decimal
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from singletrack.model import LinearModel

__all__ = ["Claim", "first_speed", "gk0_22", "m_22", "printed_number_holds"]


@dataclass(frozen=True)
class Claim:
    """A printed number or a sentence, and what was found.

    Attributes
    ----------
    section : str
        Where the paper says so.
    says : str
        What it says, in short.
    computed : str
        What was found.
    holds : bool
    note : str
        Why not, or what else is worth knowing.
    partly : bool
        Whether a claim that does not hold as a whole holds over part of the speeds.
    """

    section: str
    says: str
    computed: str
    holds: bool
    note: str = ""
    partly: bool = False

    @property
    def verdict(self) -> str:
        """The verdict in words."""
        return "holds" if self.holds else ("holds in part" if self.partly else "does not hold")


def printed_number_holds(printed: str, value: float) -> bool:
    """Tell whether a value rounds to a printed number, to the digits printed.

    >>> printed_number_holds("0.25", 0.2507), printed_number_holds("0.69", 0.633)
    (True, False)
    """
    digits = -int(Decimal(printed).as_tuple().exponent)
    return abs(value - float(printed)) <= 0.5 * 10.0**-digits * (1 + 1e-9)


def m_22(model: LinearModel) -> float:
    """Return M(2, 2) in kg m^2."""
    return float(model.M[1, 1])


def gk0_22(model: LinearModel) -> float:
    """Return g K0(2, 2) in N m/rad."""
    return float(model.gravity * model.K0[1, 1])


def first_speed(speeds: np.ndarray, condition: np.ndarray) -> str:
    """Return in words the first of the speeds at which a condition holds."""
    return f"{speeds[np.argmax(condition)]:.2f} m/s"
