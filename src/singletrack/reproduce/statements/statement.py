"""A statement of the paper beside what was computed."""

from __future__ import annotations

from dataclasses import dataclass
from decimal import Decimal
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from singletrack.model import LinearModel

__all__ = ["Statement", "first_speed", "gk0_22", "m_22", "number_statement", "printed_number_holds"]


@dataclass(frozen=True)
class Statement:
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
        Whether a statement that does not hold as a whole holds over part of the speeds, or with what the note says.
    paper : str
        Which paper says so, a key of :data:`singletrack.reproduce.statements.PAPERS`.
    corrected : bool
        Whether the authors have printed another number since.
    """

    section: str
    says: str
    computed: str
    holds: bool
    note: str = ""
    partly: bool = False
    paper: str = "founding"
    corrected: bool = False

    @property
    def verdict(self) -> str:
        """The verdict in words."""
        if self.corrected:
            return "corrected in 2012"
        return "holds" if self.holds else ("holds in part" if self.partly else "does not hold")


def printed_number_holds(printed: str, value: float) -> bool:
    """Tell whether a value rounds to a printed number, to the digits printed.

    >>> printed_number_holds("0.25", 0.2507), printed_number_holds("0.69", 0.633)
    (True, False)
    """
    digits = -int(Decimal(printed).as_tuple().exponent)
    return abs(value - float(printed)) <= 0.5 * 10.0**-digits * (1 + 1e-9)


def number_statement(
    section: str, what: str, printed: str, value: float, unit: str, note: str = "", *, paper: str = "founding"
) -> Statement:
    """Return the statement that something has a printed value, with the computed value in the same unit.

    The note is kept where the number does not hold.

    Parameters
    ----------
    section : str
        Of the paper.
    what : str
        What has the value.
    printed : str
        The value as printed, in ``unit``.
    value : float
        The computed one, in the same unit.
    unit : str
    note : str
        Said where the number does not hold.
    paper : str
        Which of the two.
    """
    holds = printed_number_holds(printed, value)
    text = f"{what} = {printed} {unit}"
    return Statement(section, text, f"{value:.4f} {unit}", holds, "" if holds else note, paper=paper)


def m_22(model: LinearModel) -> float:
    """Return M(2, 2) in kg m^2.

    Parameters
    ----------
    model : LinearModel
    """
    return float(model.M[1, 1])


def gk0_22(model: LinearModel) -> float:
    """Return g K0(2, 2) in N m/rad.

    Parameters
    ----------
    model : LinearModel
    """
    return float(model.gravity * model.K0[1, 1])


def first_speed(speeds: np.ndarray, condition: np.ndarray) -> str:
    """Return in words the first of the speeds at which a condition holds.

    Parameters
    ----------
    speeds : array, shape (k,)
        In m/s, ascending.
    condition : array of bool, shape (k,)
    """
    return f"{speeds[np.argmax(condition)]:.2f} m/s"
