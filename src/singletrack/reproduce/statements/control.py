"""What the journal version (2012) prints and says of controllability: Tables 1 and 2 and the sentences beside them."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from singletrack.control import modal_controllability, uncontrollable_speeds
from singletrack.reproduce.cases import SPEEDS
from singletrack.reproduce.statements.statement import Statement

if TYPE_CHECKING:
    from singletrack.control import LostMode
    from singletrack.model import LinearModel
    from singletrack.reproduce.cases import Case

__all__ = ["control_statements"]

#: Tables 1 and 2: forward speed (m/s), eigenvalue (1/s), the mode's name; rows by input.
_TABLES = {
    "1": (
        "stratos-2012-leaned-leaning",
        {
            "steer torque": [
                ("0.0091", "-3.015", "capsize"),
                ("1.5482", "-3.015", "capsize"),
                ("1.7656", "7.825", "lean1"),
                ("4.5588", "-7.825", "caster"),
            ],
            "torso torque": [("0.0067", "3.0177", "weave"), ("1.5033", "-3.0233", "capsize")],
        },
    ),
    "2": (
        "browser-2012-upright-leaning",
        {
            "steer torque": [
                ("0.0133", "-2.898", "caster"),
                ("0.8271", "6.5895", "lean1"),
                ("1.0177", "-2.898", "caster"),
                ("4.1381", "-6.5895", "lean2"),
            ],
            "torso torque": [("0.2695", "2.9017", "capsize"), ("1.2375", "-2.9125", "caster")],
        },
    ),
}
_CLOSE = 0.03
_SLOW = 0.1


def control_statements(cases: dict[str, Case]) -> list[Statement]:
    """Return what is said of losing modes, from the cases with a leaning torso 0.40 m wide."""
    found = [statement for number in _TABLES for statement in _table(cases, number)]
    return [*found, *_sentences(cases), _critical(cases)]


def _table(cases: dict[str, Case], number: str) -> list[Statement]:
    name, by_input = _TABLES[number]
    statements = []
    for input_name, printed in by_input.items():
        lost = uncontrollable_speeds(cases[name].model, [input_name])
        default = uncontrollable_speeds(cases[f"{name}-default"].model, [input_name])
        for k, row in enumerate(printed):
            own = lost[k] if len(lost) == len(printed) else None
            other = default[k] if len(default) == len(printed) else None
            statements.append(_row(number, input_name, row, own, other))
    return statements


def _row(
    number: str, input_name: str, row: tuple[str, str, str], own: LostMode | None, other: LostMode | None
) -> Statement:
    speed, root, name = row
    says = f"Table {number}: {input_name} loses the mode {root} 1/s ({name}) at {speed} m/s"
    if own is None:
        return Statement("4", says, "another number of losses", holds=False, paper="journal")
    slack = 0.005 if float(speed) < _SLOW else _CLOSE * float(speed)
    holds = abs(own.speed - float(speed)) <= slack and abs(own.eigenvalue - float(root)) <= _CLOSE * abs(float(root))
    computed = f"{own.eigenvalue.real:.4f} 1/s ({own.mode}) at {own.speed:.4f} m/s"
    note = "" if other is None else f"With Moore's torso: {other.eigenvalue.real:.4f} 1/s at {other.speed:.4f} m/s."
    return Statement("4", says, computed, bool(holds), note, paper="journal")


def _sentences(cases: dict[str, Case]) -> list[Statement]:
    model = cases["stratos-2012-leaned-leaning"].model
    sprung = cases["stratos-2012-leaned-sprung"].model
    losses = {
        (which, name): [loss.speed for loss in uncontrollable_speeds(m, [name])]
        for which, m in (("free", model), ("sprung", sprung))
        for name in ("steer torque", "torso torque")
    }
    by_torso = losses["free", "torso torque"], losses["sprung", "torso torque"]
    unstable = [_unstable(m) for m in (model, sprung)]
    lower = bool(unstable[0] and unstable[1] and unstable[1][0].speed < unstable[0][0].speed / 2)
    return [
        Statement(
            "4",
            "Spring (100 N m/rad) and damper (10 N m s/rad) at the lean hinge move the loss of the unstable mode by "
            "steer torque to a much lower speed",
            f"{unstable[1][0].speed:.4f} m/s ({unstable[1][0].mode}), from {unstable[0][0].speed:.4f} m/s"
            if lower
            else "-",
            lower,
            paper="journal",
        ),
        _calm(cases["stratos-2012-leaned-sprung"]),
        Statement(
            "4",
            "They do not change controllability by lean torque",
            f"losses move by {np.abs(np.subtract(*by_torso)).max():.1e} m/s",
            bool(np.allclose(*by_torso, rtol=1e-6)),
            "Exact: the spring acts where the torque does.",
            paper="journal",
        ),
        *_angles(cases),
    ]


def _unstable(model: LinearModel) -> list[LostMode]:
    """Return the losses of unstable modes by steer torque."""
    return [one for one in uncontrollable_speeds(model, ["steer torque"]) if one.eigenvalue.real > 0]


def _calm(case: Case) -> Statement:
    """Return whether, beside weave, a pair of roots oscillates and dies out: the torso on its spring."""
    others = case.modes.eigenvalues[:, 2:]
    pair = (others.imag > 0) & (others.real < 0)
    share = float(pair.any(axis=1).mean())
    first = SPEEDS[np.argmin(pair.any(axis=1))] if share < 1 else np.inf
    return Statement(
        "4",
        "They make the lean modes stable and oscillatory",
        f"beside weave one pair dies out, {others[0][pair[0]][0]:.2f} 1/s at rest, up to {first:.2f} m/s",
        share == 1.0,
        "Above, the pair grows slowly: it is there what capsize is without the hinge.",
        partly=share > 0.5,
        paper="journal",
    )


def _moved(unstable: list[list[LostMode]]) -> str:
    (free, *_), (sprung, *_) = unstable
    return f"{sprung.speed:.4f} m/s ({sprung.mode}), from {free.speed:.4f} m/s"


def _angles(cases: dict[str, Case]) -> list[Statement]:
    model = cases["stratos-2012-leaned-leaning"].model
    angles = {name: np.degrees(a) for name, a in modal_controllability(model, SPEEDS[300::20]).items()}
    steer, torso = angles["steer torque"], angles["torso torque"]
    weave, lean = slice(0, 1), slice(4, 6)
    gaps = steer[:, weave].max(), torso[:, weave].min(), torso[:, lean].max(), steer[:, lean].min()
    return [
        Statement(
            "4",
            "Weave of the leaned rider is well controllable by steer torque and hardly by lean torque",
            f"above 3 m/s: by steer {steer[:, weave].min():.1f} to {gaps[0]:.1f} deg, by torso over {gaps[1]:.1f} deg",
            bool((steer[:, weave] < torso[:, weave]).all()),
            "The order holds at every speed; all angles are large in these units (rad, rad/s).",
            paper="journal",
        ),
        Statement(
            "4",
            "The lean mode is well controllable by lean torque and marginally by steer torque",
            f"above 3 m/s: by torso {torso[:, lean].min():.1f} to {gaps[2]:.1f} deg, by steer over {gaps[3]:.1f} deg",
            bool((torso[:, lean].min(axis=1) < steer[:, lean].min(axis=1)).all()),
            paper="journal",
        ),
    ]


def _critical(cases: dict[str, Case]) -> Statement:
    wide, default = (cases[f"stratos-2012-leaned-leaning{end}"].critical for end in ("", "-default"))
    weave, capsize = wide.weave[0], wide.capsize[0]
    return Statement(
        "4",
        "Hybrid with the lean freedom: weave and capsize speed 7.4 and 8.7 m/s",
        f"{weave:.3f} and {capsize:.3f} m/s",
        bool(abs(weave - 7.4) <= 0.05 and abs(capsize - 8.7) <= 0.05),
        f"With Moore's torso {default.weave[0]:.3f} and {default.capsize[0]:.3f} m/s: what is printed lies between.",
        partly=bool(abs(weave - 7.4) <= _CLOSE * 7.4 and abs(capsize - 8.7) <= 0.05),
        paper="journal",
    )
