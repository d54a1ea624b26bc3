"""What riding costs in each posture: the question with which the founding paper ends."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from singletrack.control import Effort, effort

if TYPE_CHECKING:
    from singletrack.reproduce.cases import Case

__all__ = ["EFFORT_HEADER", "EFFORT_TEXT", "TITLES", "effort_rows", "efforts_of"]

TITLES = {
    "stratos-2012": "Hybrid, rigid or leaned rider: what balance costs",
    "browser-2012": "City bicycle, rigid or upright rider: what balance costs",
}
EFFORT_TEXT = (
    "The founding paper ends with the question how much control the rider needs in both postures. Each number here is "
    "what follows a push that leaves the bicycle leaning at 0.1 rad/s: the least energy that brings it back, of which "
    "only unstable modes cost (zero where it comes back by itself), and in brackets the largest torque under the state "
    "feedback that weighs 1 deg, 10 deg/s and 1 N m alike. Stretched arms cost effort at walking speed, some four "
    "times the energy of the rigid rider by steering; the upright rider, though no speed is stable, costs least there, "
    "because capsize alone grows fast and weave is calm. Above 4 m/s steering is easy in both postures. By leaning the "
    "torso alone balance is hard in both. The limits of the claim: energy is counted at the steer or the hip, not in "
    "muscles; one torque knows the whole state at once, without delay; the push is small, the rider otherwise passive."
)
_SHOWN = (1.0, 3.0, 5.0, 8.0)
_RANGE = np.linspace(0.5, 10.0, 39)
#: By bicycle: which case, by which input, in which words.
_COMPARED = {
    "stratos-2012": (
        ("stratos-2012-rigid", "steer torque", "rigid, by steer"),
        ("stratos-2012-leaned", "steer torque", "leaned, by steer"),
        ("stratos-2012-leaned-leaning", "steer torque", "leaned, torso leans, by steer"),
        ("stratos-2012-leaned-leaning", "torso torque", "leaned, torso leans, by torso"),
    ),
    "browser-2012": (
        ("browser-2012-rigid", "steer torque", "rigid, by steer"),
        ("browser-2012-upright", "steer torque", "upright, by steer"),
        ("browser-2012-upright-leaning", "steer torque", "upright, torso leans, by steer"),
        ("browser-2012-upright-leaning", "torso torque", "upright, torso leans, by torso"),
    ),
}
EFFORT_HEADER = ("bicycle", "rider", *(f"{speed:g} m/s" for speed in _SHOWN))


def efforts_of(cases: dict[str, Case], bicycle: str) -> dict[str, Effort]:
    """Return what riding a bicycle costs from 0.5 to 10 m/s, by posture and input.

    Parameters
    ----------
    cases : dict
        What was computed, by name.
    bicycle : str
        One of :data:`TITLES`.
    """
    return {words: effort(cases[name].model, _RANGE, by) for name, by, words in _COMPARED[bicycle]}


def effort_rows(cases: dict[str, Case]) -> list[list[str]]:
    """Return the table: least energy in (N m)² s, and in brackets the largest torque in N m.

    Parameters
    ----------
    cases : dict
        What was computed, by name.
    """
    rows = []
    for bicycle, compared in _COMPARED.items():
        for name, by, words in compared:
            found = effort(cases[name].model, np.array(_SHOWN), by)
            pairs = zip(found.least_energy, found.largest_torque, strict=True)
            rows.append([bicycle, words, *(_cell(energy, torque) for energy, torque in pairs)])
    return rows


def _cell(energy: float, torque: float) -> str:
    if not np.isfinite(energy):
        return "cannot"
    shown = "under 0.001" if 0.0 < energy < 0.001 else f"{energy:.3f}" if energy < 1.0 else f"{energy:.3g}"
    return f"{shown if energy < 1000 else round(energy)} N²m²s ({torque:.1f} N m)".replace("0.000 ", "0 ")
