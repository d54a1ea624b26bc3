"""What Kooijman, Schwab and Meijaard (2008) print of their bicycle, and what their runs say of the model."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from singletrack.reproduce.statements.statement import Statement, number_statement

if TYPE_CHECKING:
    from singletrack.reproduce.measured import MeasuredCase

__all__ = ["measured_statements"]

#: Equation (5): M, C1, g K0 and K2 as printed.
_PRINTED = {
    "M": (("7.98981", "0.89569"), ("0.89569", "0.29857")),
    "C1": (("0", "7.17025"), ("-0.59389", "1.32610")),
    "g K0": (("-109.91168", "-13.45745"), ("-13.45745", "-4.82272")),
    "K2": (("0", "11.19798"), ("0", "1.42200")),
}


def measured_statements(case: MeasuredCase) -> list[Statement]:
    """Return the statements about the measured case."""
    return [*_matrices(case), *_speeds(case), _runs(case)]


def _matrices(case: MeasuredCase) -> list[Statement]:
    model = case.model
    computed = {"M": model.M, "C1": model.C1, "g K0": model.gravity * np.asarray(model.K0), "K2": model.K2}
    found = []
    for name, printed in _PRINTED.items():
        largest = float(np.abs(np.array(printed, dtype=float) - computed[name]).max())
        text = "; ".join(", ".join(row) for row in printed)
        found.append(
            Statement(
                "5",
                f"{name} = [{text}]",
                f"largest difference of an entry {largest:.1e}",
                largest <= 0.5e-5,
                paper="measured",
            )
        )
    return found


def _speeds(case: MeasuredCase) -> list[Statement]:
    return [
        number_statement("5", "weave speed", "4.0", case.critical.weave[0], "m/s", paper="measured"),
        number_statement("5", "capsize speed", "7.9", case.critical.capsize[0], "m/s", paper="measured"),
    ]


def _runs(case: MeasuredCase) -> Statement:
    runs = case.runs
    middle = (runs.lowest_speeds + runs.highest_speeds) / 2
    gap = runs.eigenvalues - case.model.modes(middle).eigenvalues[:, 0]
    # What a run cannot tell: its speed fell, and the eigenvalue with it.
    ends = [case.model.modes(speeds).eigenvalues[:, 0] for speeds in (runs.lowest_speeds, runs.highest_speeds)]
    spread = np.abs(ends[1] - ends[0])
    inside = np.abs(gap) <= spread
    return Statement(
        "6",
        "Measured weave eigenvalues agree with the model over the measured speeds (26 runs, Fig. 7)",
        f"rms difference {np.sqrt(np.mean(np.abs(gap) ** 2)):.2f} 1/s; {inside.sum()} of {len(gap)} runs differ by "
        "less than the model's eigenvalue changes while the speed falls in the run",
        bool(inside.mean() > 0.8),
        paper="measured",
    )
