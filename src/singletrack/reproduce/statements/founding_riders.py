"""What the paper says of the passive riders: section 3.1, leaned, and section 3.2, upright."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from singletrack.body import skeleton
from singletrack.posture import steer_axis
from singletrack.posture.motion import joint_motion
from singletrack.public import coefficients
from singletrack.reproduce.cases import SPEEDS
from singletrack.reproduce.statements.statement import Statement, first_speed, gk0_22, m_22

if TYPE_CHECKING:
    from singletrack.reproduce.cases import Case

__all__ = ["arm_direction", "frequency_changes", "frequency_statement", "leaned_statements", "upright_statements"]


def leaned_statements(cases: dict[str, Case]) -> list[Statement]:
    """Return what section 3.1 says of the leaned rider.

    Parameters
    ----------
    cases : dict
        What was computed, by name.
    """
    return [*_leaned(cases), *_leaned_causes(cases), arm_direction(cases["stratos-leaned"], "3.1")]


def _leaned(cases: dict[str, Case]) -> list[Statement]:
    """Section 3.1, the Stratos with the leaned rider against the rigid one."""
    rigid, leaned = cases["stratos-rigid"], cases["stratos-leaned"]
    first, second, _ = joint_motion(leaned.seated, leaned.bicycle)
    (low, high), (rigid_low, rigid_high) = leaned.critical.stable_ranges[0], rigid.critical.stable_ranges[0]
    off, rigid_off = leaned.model.M[0, 1], rigid.model.M[0, 1]
    k_off, rigid_k_off = (model.gravity * model.K0[0, 1] for model in (leaned.model, rigid.model))
    axial_k_off = 9.81 * cases["stratos-leaned-axial"].model.K0[0, 1]
    slower = frequency_changes(rigid.modes.eigenvalues, leaned.modes.eigenvalues)
    return [
        Statement(
            "3.1",
            "To first order the torso does not pitch when steering",
            f"pitch' = {abs(first['torso pitch']):.1e}, twist' = {first['torso twist']:.3f}",
            bool(abs(first["torso pitch"]) < 1e-9),
            f"To second order it does: pitch'' = {second['torso pitch']:.4f} per rad; the torso's weight then works on "
            "the arms, which is the stiffness that the paper speaks of.",
        ),
        Statement(
            "3.1",
            "The stable speed range goes up",
            f"{low:.3f} to {high:.3f} m/s, from {rigid_low:.3f} to {rigid_high:.3f} m/s",
            bool(low > rigid_low and high > rigid_high),
        ),
        frequency_statement("3.1", "The frequency of the weave motion goes down", slower, -1),
        Statement(
            "3.1",
            "The off-diagonal terms of M increase slightly",
            f"{off:.4f} kg m², from {rigid_off:.4f} kg m² ({off / rigid_off - 1:+.1%})",
            bool(0 < off / rigid_off - 1 < 0.2),
        ),
        Statement(
            "3.1",
            "The off-diagonal terms of K0 decrease by 50 %",
            f"{k_off:.3f} N m/rad, from {rigid_k_off:.3f} N m/rad ({k_off / rigid_k_off - 1:+.1%} in size)",
            bool(abs(k_off / rigid_k_off - 0.5) < 0.05),
            "Does not follow from the printed data: by symmetry this term knows only first-order motion, in which the "
            f"arms follow the grips. With the other shoulder axis: {axial_k_off:.3f} N m/rad.",
        ),
        Statement(
            "3.1",
            "The overall structure of the eigenvalues stays the same",
            "one pair emerges from two real roots and is then stable; castering and capsize real, as without hands",
            bool(np.array_equal(leaned.modes.applies[100:], rigid.modes.applies[100:])),
        ),
    ]


def frequency_changes(reference: np.ndarray, other: np.ndarray) -> np.ndarray:
    """Return the relative changes (k,) of the weave frequency from 1 m/s on where both oscillate, roots (n, 4) each.

    Parameters
    ----------
    reference, other : array, shape (n, 4)
        Eigenvalues in 1/s, weave first.
    """
    both = (reference[:, 0].imag > 0) & (other[:, 0].imag > 0) & (SPEEDS >= 1.0)
    change: np.ndarray = other[both, 0].imag / reference[both, 0].imag - 1
    return change


def frequency_statement(
    section: str, says: str, changes: np.ndarray, sign: int, note: str = "", *, paper: str = "founding"
) -> Statement:
    """Return a statement that the weave frequency changes, by relative changes (n,), in the direction of ``sign``.

    Parameters
    ----------
    section : str
        Of the paper.
    says : str
        The statement in words.
    changes : array, shape (n,)
    sign : int
        1 where the frequency rises, -1 where it falls.
    note : str
        What is to be said besides.
    paper : str
        Which of the two.
    """
    agree = np.sign(changes) == sign
    found = f"{changes.min():+.1%} to {changes.max():+.1%} over 1 to 10 m/s"
    if not agree.all():
        way = "up" if sign > 0 else "down"
        found += f", {way} at {agree.mean():.0%} of these speeds, {changes.mean():+.1%} on average"
    holds = bool(agree.all())
    return Statement(section, says, found, holds, "" if holds else note, bool(agree.mean() > 0.25), paper)


def _leaned_causes(cases: dict[str, Case]) -> list[Statement]:
    """Section 3.1 explains the change by two causes; each is tried alone."""
    base, leaned = cases["stratos-rigid"], cases["stratos-leaned"].model
    heavier, stiffer = replace(base.model, M=leaned.M), replace(base.model, K0=leaned.K0)
    roots = base.modes.eigenvalues
    weave = heavier.critical_speeds().weave
    critical = stiffer.critical_speeds()
    # Without a capsize speed the range has no upper end: the capsize speed has risen beyond all speeds.
    unbounded = bool(critical.stable_ranges and np.isinf(critical.stable_ranges[-1][1]))
    before = f"from {base.critical.capsize[0]:.3f} m/s"
    found = f"{critical.capsize[0]:.3f} m/s, {before}" if critical.capsize else f"no capsize at any speed, {before}"
    return [
        Statement(
            "3.1",
            "The added mass (the leaned rider's M alone) increases the weave speed",
            f"{weave[0]:.3f} m/s, from {base.critical.weave[0]:.3f} m/s" if weave else "never stable",
            bool(weave and weave[0] > base.critical.weave[0]),
        ),
        frequency_statement(
            "3.1",
            "The added mass decreases the weave frequencies overall",
            frequency_changes(roots, heavier.modes(SPEEDS).eigenvalues),
            -1,
            "The frequency falls at low speed, where most of the change is, and rises at high speed.",
        ),
        Statement(
            "3.1",
            "The changed stiffness (the leaned rider's K0 alone) increases the capsize speed",
            found,
            unbounded or bool(critical.capsize and critical.capsize[0] > base.critical.capsize[0]),
            f"From the paper's data g K0(2, 2) falls to {gk0_22(leaned):.1f} N m/rad (see above), where the paper has"
            " it rise to -3.2; the effect on the capsize speed is as the paper says all the same.",
        ),
        frequency_statement(
            "3.1",
            "The changed stiffness increases the weave frequencies overall",
            frequency_changes(roots, stiffer.modes(SPEEDS).eigenvalues),
            1,
            "It is lower near the speed at which the pair emerges and, by a little, above 7 m/s.",
        ),
    ]


def arm_direction(case: Case, section: str, *, paper: str = "founding") -> Statement:
    """Return what both papers say of the arms' direction: bars that come back turn them towards the steer axis.

    Parameters
    ----------
    case : Case
        What was computed.
    section : str
        Of the paper.
    paper : str
        Which of the two.
    """
    _, axis = steer_axis(case.bicycle)
    rows = []
    for back in (-0.09, -0.03, 0.03, 0.09):
        bicycle = case.bicycle.replace(handlebar_length=back)
        grip, shoulder = (skeleton(bicycle, case.rider)[point] for point in (19, 21))
        along = (grip - shoulder) / np.linalg.norm(grip - shoulder)
        angle = float(np.degrees(np.arccos(along @ axis)))
        leaned = coefficients(bicycle, case.rider, "leaned", arms=case.options.arms)
        rigid = coefficients(bicycle, case.rider, "rigid")
        rows.append((angle, m_22(leaned) / m_22(rigid) - 1))
    angles, added = (np.array(column) for column in zip(*rows, strict=True))
    order = np.argsort(-angles)
    found = ", ".join(f"{angles[i]:.0f}° {added[i]:+.0%}" for i in order)
    return Statement(
        section,
        "The more parallel the arms are to the steer axis, the smaller the change against the rigid rider",
        f"angle of arms and steer axis, change of M(2, 2): {found}",
        bool((np.diff(added[order]) < 0).all()),
        "Tried with grips at -90, -30, 30 and 90 mm of handlebar length.",
        paper=paper,
    )


def upright_statements(cases: dict[str, Case]) -> list[Statement]:
    """Return what section 3.2 says of the Browser with the upright rider.

    Parameters
    ----------
    cases : dict
        What was computed, by name.
    """
    case = cases["browser-upright"]
    roots, applies = case.modes.eigenvalues, case.modes.applies
    moving = SPEEDS > 0
    return [
        Statement(
            "3.2",
            "The stable forward speed range has disappeared completely",
            "stable: never" if not case.critical.stable_ranges else str(case.critical.stable_ranges),
            not case.critical.stable_ranges,
            "Found for all speeds, from Routh and Hurwitz' criterion, not only up to 10 m/s.",
        ),
        Statement(
            "3.2",
            "The weave speed has decreased to zero: weave is always stable",
            f"real part {roots[moving, 0].real.max():.4f} 1/s or less for v > 0, {abs(roots[0, 0].real):.0e} at rest",
            bool((roots[moving, 0].real < 0).all() and abs(roots[0, 0].real) < 1e-9 and not case.critical.weave),
        ),
        Statement(
            "3.2",
            "The capsize motion is always unstable",
            f"{roots[:, 2].real.min():.3f} 1/s or more up to 10 m/s; capsize speed: never",
            bool((roots[:, 2].real > 0).all() and not case.critical.capsize),
        ),
        Statement(
            "3.2",
            "A stable pendulum-type oscillator has been added to the steer assembly",
            f"at rest the pair is ±{roots[0, 0].imag:.3f}i 1/s: steer swings with a period of "
            f"{2 * np.pi / roots[0, 0].imag:.2f} s",
            bool(roots[0, 0].imag > 0 and gk0_22(case.model) > 0),
            f"The name castering does not apply below {first_speed(SPEEDS, applies[:, 3])}: there the fourth root "
            "is the time reversal of falling, mostly lean.",
        ),
    ]
