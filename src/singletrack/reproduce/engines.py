"""The two derivations side by side, and what only the multibody engine knows: the forces of the hands."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from singletrack import multibody

if TYPE_CHECKING:
    from singletrack.reproduce.cases import Case

__all__ = ["Agreement", "compare_engines"]

_MATRICES = ("M", "C1", "K0", "K2")


@dataclass(frozen=True)
class Agreement:
    """How well the two derivations agree for one case.

    Attributes
    ----------
    name : str
        Of the case.
    differences : dict of str to float
        For each matrix the largest difference of an entry, relative to the matrix' largest entry.
    hand_force : tuple of float, or None
        Forward and downward force of one hand on its grip at rest, in N; None without hands on the bar.
    """

    name: str
    differences: dict[str, float]
    hand_force: tuple[float, float] | None


def compare_engines(cases: dict[str, Case]) -> list[Agreement]:
    """Return the agreement of closed form and multibody engine for every case."""
    return [_compare(case) for case in cases.values()]


def _compare(case: Case) -> Agreement:
    other = multibody.coefficients(case.bicycle, case.rider, case.options)
    differences = {}
    for name in _MATRICES:
        one, two = np.asarray(getattr(case.model, name)), np.asarray(getattr(other, name))
        differences[name] = float(np.abs(one - two).max() / np.abs(one).max())
    return Agreement(case.name, differences, _hand_force(case))


def _hand_force(case: Case) -> tuple[float, float] | None:
    if not case.seated.loops:
        return None
    model = multibody.bicycle_model(case.bicycle, case.rider, case.options)
    force = multibody.loop_forces(multibody.ride(model, 0.0))["right hand"]
    return float(force[0]), float(force[2])
