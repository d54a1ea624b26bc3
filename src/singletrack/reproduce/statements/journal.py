"""What the authors' journal version (2012) prints and says of the passive riders: its sections on figures 3 and 5."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from singletrack.reproduce.cases import SPEEDS, WIDE_TORSO
from singletrack.reproduce.statements.founding_riders import arm_direction, frequency_changes, frequency_statement
from singletrack.reproduce.statements.statement import Statement, gk0_22, m_22, number_statement, printed_number_holds

if TYPE_CHECKING:
    from singletrack.reproduce.cases import Case

__all__ = ["journal_statements"]

_SECTION = "3"


def journal_statements(cases: dict[str, Case]) -> list[Statement]:
    """Return what the journal version says of the cases with its own bicycles."""
    return [*_rigid(cases), *_leaned(cases), *_upright(cases)]


def _number(what: str, printed: str, value: float, unit: str, note: str = "") -> Statement:
    return number_statement(_SECTION, what, printed, value, unit, note, paper="journal")


def _says(says: str, computed: str, holds: bool, note: str = "") -> Statement:
    return Statement(_SECTION, says, computed, holds, note, paper="journal")


def _rigid(cases: dict[str, Case]) -> list[Statement]:
    hybrid, city = cases["stratos-2012-rigid"], cases["browser-2012-rigid"]
    return [
        _number("Hybrid, rigid rider: M(2, 2)", "0.28", m_22(hybrid.model), "kg m²"),
        _number(
            "Hybrid, rigid rider: g K0(2, 2)",
            "-6.9",
            gk0_22(hybrid.model),
            "N m/rad",
            "One unit of the last digit off. The entry knows only masses and places, whatever shape segments have.",
        ),
        _number("Hybrid, rigid rider: weave speed", "4.8", hybrid.critical.weave[0], "m/s"),
        _number("Hybrid, rigid rider: capsize speed", "7.9", hybrid.critical.capsize[0], "m/s"),
        _number("City, rigid rider: M(2, 2)", "0.25", m_22(city.model), "kg m²"),
        _number("City, rigid rider: g K0(2, 2)", "-6.6", gk0_22(city.model), "N m/rad"),
    ]


def _leaned(cases: dict[str, Case]) -> list[Statement]:
    rigid, leaned, wide = (cases[f"stratos-2012-{name}"] for name in ("rigid", "leaned", "leaned-wide"))
    m_off = leaned.model.M[0, 1] / rigid.model.M[0, 1] - 1
    k_off = leaned.model.K0[0, 1] / rigid.model.K0[0, 1] - 1
    (low, high), (rigid_low, rigid_high) = leaned.critical.stable_ranges[0], rigid.critical.stable_ranges[0]
    changes = frequency_changes(rigid.modes.eigenvalues, leaned.modes.eigenvalues)
    return [
        Statement(
            _SECTION,
            "Hybrid, leaned rider: M(2, 2) = 0.72 kg m²",
            f"{m_22(leaned.model):.4f} kg m²",
            holds=False,
            note=f"With a torso {WIDE_TORSO:.2f} m wide instead of Moore's: {m_22(wide.model):.4f} kg m².",
            partly=printed_number_holds("0.72", m_22(wide.model)),
            paper="journal",
        ),
        _number("Hybrid, leaned rider: g K0(2, 2)", "-9.7", gk0_22(leaned.model), "N m/rad"),
        _says("The off-diagonal terms of M increase by about 10 %", f"{m_off:+.1%}", 0.05 < m_off < 0.15),
        _says(
            "The off-diagonal terms of K0 become about 10 % more negative", f"{k_off:+.1%} in size", 0.05 < k_off < 0.15
        ),
        _says(
            "The stable range moves up",
            f"{low:.3f} to {high:.3f} m/s, from {rigid_low:.3f} to {rigid_high:.3f} m/s",
            bool(low > rigid_low and high > rigid_high),
        ),
        frequency_statement(_SECTION, "The weave frequency goes down", changes, -1, paper="journal"),
        _says(
            "The structure is as for the rigid rider",
            "one pair emerges from two real roots and is then stable; castering and capsize real, as without hands",
            bool(np.array_equal(leaned.modes.applies[100:], rigid.modes.applies[100:])),
        ),
        arm_direction(leaned, _SECTION, paper="journal"),
    ]


def _upright(cases: dict[str, Case]) -> list[Statement]:
    upright = cases["browser-2012-upright"]
    roots = upright.modes.eigenvalues
    moving = SPEEDS > 0
    return [
        _number("City, upright rider: M(2, 2)", "0.46", m_22(upright.model), "kg m²"),
        _number("City, upright rider: g K0(2, 2)", "2.3", gk0_22(upright.model), "N m/rad"),
        _says("No speed is stable", "stable: never", not upright.critical.stable_ranges),
        _says(
            "Weave is always stable",
            f"real part {roots[moving, 0].real.max():.4f} 1/s or less for v > 0",
            bool((roots[moving, 0].real < 0).all() and not upright.critical.weave),
        ),
        _says(
            "Capsize is always unstable",
            f"{roots[:, 2].real.min():.3f} 1/s or more up to 10 m/s; capsize speed: never",
            bool((roots[:, 2].real > 0).all() and not upright.critical.capsize),
        ),
    ]
