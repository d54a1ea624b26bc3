"""Every number that the papers print and every sentence they say, beside what was computed."""

from __future__ import annotations

from typing import TYPE_CHECKING

from singletrack.reproduce.statements.control import control_statements
from singletrack.reproduce.statements.founding import founding_statements
from singletrack.reproduce.statements.journal import journal_statements
from singletrack.reproduce.statements.measured import measured_statements
from singletrack.reproduce.statements.statement import Statement

if TYPE_CHECKING:
    from singletrack.reproduce.cases import Case
    from singletrack.reproduce.measured import MeasuredCase

__all__ = ["PAPERS", "Statement", "check_statements"]

#: The papers by the word that a statement names its paper with.
PAPERS = {
    "founding": "Schwab and Kooijman, Lateral dynamics of a bicycle with passive rider model",
    "journal": (
        "Schwab, Meijaard and Kooijman (2012), Lateral dynamics of a bicycle with a passive rider model: stability and "
        "controllability, Vehicle System Dynamics 50:1209-1224"
    ),
    "measured": (
        "Kooijman, Schwab and Meijaard (2008), Experimental validation of a model of an uncontrolled bicycle, "
        "Multibody System Dynamics 19:115-132"
    ),
}


def check_statements(cases: dict[str, Case], measured: MeasuredCase) -> list[Statement]:
    """Return all statements of the papers with what was computed for them, from all cases and the measured bicycle."""
    return [
        *founding_statements(cases),
        *journal_statements(cases),
        *control_statements(cases),
        *measured_statements(measured),
    ]
