"""Every number the paper prints and every sentence it says about eigenvalues, beside what was computed."""

from __future__ import annotations

from dataclasses import dataclass, replace
from decimal import Decimal
from typing import TYPE_CHECKING

import numpy as np

from singletrack.body import skeleton
from singletrack.linear import coefficients
from singletrack.linear.characteristic import characteristic_polynomial
from singletrack.linear.meetings import meeting_speeds
from singletrack.posture.motion import joint_motion, steer_axis
from singletrack.reproduce.cases import SPEEDS

if TYPE_CHECKING:
    from singletrack.linear import CoefficientMatrices
    from singletrack.reproduce.cases import Case

__all__ = ["Claim", "check_claims"]


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
    """

    section: str
    says: str
    computed: str
    holds: bool
    note: str = ""


def check_claims(cases: dict[str, Case]) -> list[Claim]:
    """Return all claims of the paper with what was computed for them."""
    return [
        *_general(cases["stratos-rigid"]),
        *_numbers(cases),
        *_leaned(cases),
        *_leaned_causes(cases),
        *_arm_direction(cases["stratos-leaned"]),
        *_upright(cases),
    ]


def printed_number_holds(printed: str, value: float) -> bool:
    """Tell whether a value rounds to a printed number, to the digits printed.

    >>> printed_number_holds("0.25", 0.2507), printed_number_holds("0.69", 0.633)
    (True, False)
    """
    digits = -int(Decimal(printed).as_tuple().exponent)
    return abs(value - float(printed)) <= 0.5 * 10.0**-digits * (1 + 1e-9)


def _number(section: str, what: str, printed: str, value: float, unit: str, note: str = "") -> Claim:
    holds = printed_number_holds(printed, value)
    return Claim(section, f"{what} = {printed} {unit}", f"{value:.4f} {unit}", holds, "" if holds else note)


_NOT_FROM_DATA = (
    "The printed number does not follow from the printed data. With the shoulder's second axis along the upper arm it "
    "would be {axial:.4f}."
)


def _numbers(cases: dict[str, Case]) -> list[Claim]:
    stratos, leaned, browser, upright = (
        cases[name] for name in ("stratos-rigid", "stratos-leaned", "browser-rigid", "browser-upright")
    )
    axial = cases["stratos-leaned-axial"].model
    claims = [
        _number("2", "Stratos, rigid rider: weave speed", "4.7", stratos.critical.weave[0], "m/s"),
        _number("2", "Stratos, rigid rider: capsize speed", "7.9", stratos.critical.capsize[0], "m/s"),
    ]
    rows = [
        ("3.1", "Stratos, rigid rider", stratos, "0.25", "-6.8"),
        ("3.1", "Stratos, leaned rider", leaned, "0.69", "-3.2"),
        ("3.2", "Browser, rigid rider", browser, "0.25", "-6.6"),
        ("3.2", "Browser, upright rider", upright, "0.46", "2.3"),
    ]
    for section, what, case, mass, stiffness in rows:
        for name, printed, unit, value, other in (
            ("M(2, 2)", mass, "kg m²", _m22(case.model), _m22(axial)),
            ("g K0(2, 2)", stiffness, "N m/rad", _k22(case.model), _k22(axial)),
        ):
            note = _NOT_FROM_DATA.format(axial=other)
            claims.append(_number(section, f"{what}: {name}", printed, value, unit, note))
    return claims


def _m22(model: CoefficientMatrices) -> float:
    return float(model.M[1, 1])


def _k22(model: CoefficientMatrices) -> float:
    return float(model.gravity * model.K0[1, 1])


def _general(case: Case) -> list[Claim]:
    """Section 2, on the Stratos with the rigid rider."""
    modes, critical = case.modes, case.critical
    roots, motions = modes.eigenvalues, modes.eigenmotions
    meeting = float(meeting_speeds(characteristic_polynomial(case.model))[0])
    at_rest = np.sort(case.model.eigenvalues(0.0)[0].real)
    weave, capsize = critical.weave[0], critical.capsize[0]
    below, above = weave > SPEEDS, capsize < SPEEDS
    emerged = meeting < SPEEDS
    stable = np.all(roots.real < 0, axis=-1)
    inside = (weave < SPEEDS) & (capsize > SPEEDS)
    ratio = np.abs(motions[..., 1])
    return [
        Claim(
            "2",
            "M and K0 are symmetric",
            f"M12 - M21 = {case.model.M[0, 1] - case.model.M[1, 0]:.1e}, "
            f"K0 12 - K0 21 = {case.model.K0[0, 1] - case.model.K0[1, 0]:.1e}",
            bool(np.array_equal(case.model.M, case.model.M.T) and np.array_equal(case.model.K0, case.model.K0.T)),
        ),
        Claim(
            "2",
            "At near-zero speed, typically below 0.5 m/s, there are two pairs of real eigenvalues, each a positive and "
            "a negative one",
            f"at rest {', '.join(f'{value:.3f}' for value in at_rest)} 1/s; four real roots up to {meeting:.3f} m/s",
            bool(meeting > 0.5 and np.allclose(at_rest, -at_rest[::-1])),
        ),
        Claim(
            "2",
            "Two real eigenvalues coalesce to a pair: the weave motion emerges, at first unstable",
            f"the pair emerges at {meeting:.3f} m/s and has positive real parts up to {weave:.3f} m/s",
            bool((roots[emerged & below, 0].real > 0).all() and (roots[emerged, 0].imag > 0).all()),
        ),
        Claim(
            "2",
            "At the capsize speed a real eigenvalue crosses zero and the bicycle becomes mildly unstable",
            f"largest capsize eigenvalue up to 10 m/s: {roots[above, 2].real.max():.3f} 1/s "
            f"(doubles in {np.log(2) / roots[above, 2].real.max():.1f} s)",
            bool((roots[above, 2].real > 0).all() and roots[above, 2].real.max() < 0.2),
        ),
        Claim(
            "2",
            "All eigenvalues have negative real parts between weave and capsize speed, and only there",
            f"stable from {critical.stable_ranges[0][0]:.3f} to {critical.stable_ranges[0][1]:.3f} m/s",
            bool(len(critical.stable_ranges) == 1 and np.array_equal(stable, inside)),
        ),
        Claim(
            "2",
            "Capsize: a real eigenvalue with an eigenvector dominated by lean",
            f"steer / lean: {ratio[:, 2].min():.3f} to {ratio[:, 2].max():.3f} in size",
            bool((roots[:, 2].imag == 0).all() and (ratio[weave > SPEEDS, 2] < 1).all()),
            f"Steer exceeds lean above {_first(SPEEDS, ratio[:, 2] > 1)}." if (ratio[:, 2] > 1).any() else "",
        ),
        Claim(
            "2",
            "Castering: overall stable, a large negative real eigenvalue with an eigenvector dominated by steer",
            f"{roots[0, 3].real:.2f} to {roots[-1, 3].real:.2f} 1/s; steer / lean at least {ratio[:, 3].min():.1f}",
            bool((roots[:, 3].imag == 0).all() and (roots[:, 3].real < -1).all() and (ratio[:, 3] > 1).all()),
        ),
    ]


def _first(speeds: np.ndarray, condition: np.ndarray) -> str:
    return f"{speeds[np.argmax(condition)]:.2f} m/s"


def _leaned(cases: dict[str, Case]) -> list[Claim]:
    """Section 3.1, the Stratos with the leaned rider against the rigid one."""
    rigid, leaned = cases["stratos-rigid"], cases["stratos-leaned"]
    first, second, _ = joint_motion(leaned.seated, leaned.bicycle)
    (low, high), (rigid_low, rigid_high) = leaned.critical.stable_ranges[0], rigid.critical.stable_ranges[0]
    off, rigid_off = leaned.model.M[0, 1], rigid.model.M[0, 1]
    k_off, rigid_k_off = (model.gravity * model.K0[0, 1] for model in (leaned.model, rigid.model))
    axial_k_off = 9.81 * cases["stratos-leaned-axial"].model.K0[0, 1]
    slower = _frequency_comparison(rigid.modes.eigenvalues, leaned.modes.eigenvalues)
    return [
        Claim(
            "3.1",
            "To first order the torso does not pitch when steering",
            f"pitch' = {abs(first['torso pitch']):.1e}, twist' = {first['torso twist']:.3f}",
            bool(abs(first["torso pitch"]) < 1e-9),
            f"To second order it does: pitch'' = {second['torso pitch']:.4f} per rad; the torso's weight then works on "
            "the arms, which is the stiffness that the paper speaks of.",
        ),
        Claim(
            "3.1",
            "The stable speed range goes up",
            f"{low:.3f} to {high:.3f} m/s, from {rigid_low:.3f} to {rigid_high:.3f} m/s",
            bool(low > rigid_low and high > rigid_high),
        ),
        Claim("3.1", "The frequency of the weave motion goes down", slower[0], slower[1]),
        Claim(
            "3.1",
            "The off-diagonal terms of M increase slightly",
            f"{off:.4f} kg m², from {rigid_off:.4f} kg m² ({off / rigid_off - 1:+.1%})",
            bool(0 < off / rigid_off - 1 < 0.2),
        ),
        Claim(
            "3.1",
            "The off-diagonal terms of K0 decrease by 50 %",
            f"{k_off:.3f} N m/rad, from {rigid_k_off:.3f} N m/rad ({k_off / rigid_k_off - 1:+.1%} in size)",
            bool(abs(k_off / rigid_k_off - 0.5) < 0.05),
            "Does not follow from the printed data: by symmetry this term knows only first-order motion, in which the "
            f"arms follow the grips. With the other shoulder axis: {axial_k_off:.3f} N m/rad.",
        ),
        Claim(
            "3.1",
            "The overall structure of the eigenvalues stays the same",
            "one pair emerges from two real roots and is then stable; castering and capsize real, as without hands",
            bool(np.array_equal(leaned.modes.applies[100:], rigid.modes.applies[100:])),
        ),
    ]


def _frequency_comparison(reference: np.ndarray, other: np.ndarray) -> tuple[str, bool]:
    both = (reference[:, 0].imag > 0) & (other[:, 0].imag > 0) & (SPEEDS >= 1.0)
    change = other[both, 0].imag / reference[both, 0].imag - 1
    text = f"{change.min():+.1%} to {change.max():+.1%} over 1 to 10 m/s"
    return text, bool((change < 0).all())


def _leaned_causes(cases: dict[str, Case]) -> list[Claim]:
    """Section 3.1 explains the change by two causes; each is tried alone."""
    rigid, leaned = cases["stratos-rigid"].model, cases["stratos-leaned"].model
    heavier = replace(rigid, M=leaned.M)
    stiffer = replace(rigid, K0=leaned.K0)
    base = cases["stratos-rigid"]
    claims = []
    weave = heavier.critical_speeds().weave
    slower = _frequency_comparison(base.modes.eigenvalues, heavier.modes(SPEEDS).eigenvalues)
    claims.append(
        Claim(
            "3.1",
            "The added mass (the leaned rider's M alone) increases the weave speed",
            f"{weave[0]:.3f} m/s, from {base.critical.weave[0]:.3f} m/s" if weave else "never stable",
            bool(weave and weave[0] > base.critical.weave[0]),
        )
    )
    claims.append(Claim("3.1", "The added mass decreases the weave frequencies overall", slower[0], slower[1]))
    capsize = stiffer.critical_speeds().capsize
    faster = _frequency_comparison(base.modes.eigenvalues, stiffer.modes(SPEEDS).eigenvalues)
    note = (
        "The paper explains this by a stiffness that rises from -6.8 to -3.2; from its data it falls to -9.4 N m/rad "
        "(see above), and the effect of K0 alone is the reverse."
    )
    up = bool(capsize and capsize[0] > base.critical.capsize[0])
    found = f"{capsize[0]:.3f} m/s, from {base.critical.capsize[0]:.3f} m/s" if capsize else "never"
    claims.append(
        Claim("3.1", "The added stiffness (K0 alone) increases the capsize speed", found, up, "" if up else note)
    )
    rises = faster[0].startswith("+")
    claims.append(
        Claim(
            "3.1",
            "The added stiffness increases the weave frequencies overall",
            faster[0],
            rises,
            "" if rises else note,
        )
    )
    return claims


def _arm_direction(case: Case) -> list[Claim]:
    """Section 3.1: bars that come back, with arms that bend no more, turn the arms towards the steer axis."""
    _, axis = steer_axis(case.bicycle)
    rows = []
    for back in (-0.09, -0.03, 0.03, 0.09):
        bicycle = case.bicycle.replace(handlebar_length=back)
        grip, shoulder = (skeleton(bicycle, case.rider)[point] for point in (19, 21))
        along = (grip - shoulder) / np.linalg.norm(grip - shoulder)
        angle = float(np.degrees(np.arccos(along @ axis)))
        leaned, rigid = (coefficients(bicycle, case.rider, posture) for posture in ("leaned", "rigid"))
        rows.append((angle, _m22(leaned) / _m22(rigid) - 1))
    angles, added = (np.array(column) for column in zip(*rows, strict=True))
    order = np.argsort(-angles)
    found = ", ".join(f"{angles[i]:.0f}° {added[i]:+.0%}" for i in order)
    return [
        Claim(
            "3.1",
            "The more parallel the arms are to the steer axis, the smaller the change against the rigid rider",
            f"angle of arms and steer axis, change of M(2, 2): {found}",
            bool((np.diff(added[order]) < 0).all()),
            "Tried with grips at -90, -30, 30 and 90 mm of handlebar length.",
        )
    ]


def _upright(cases: dict[str, Case]) -> list[Claim]:
    """Section 3.2, the Browser with the upright rider."""
    case = cases["browser-upright"]
    roots, applies = case.modes.eigenvalues, case.modes.applies
    moving = SPEEDS > 0
    return [
        Claim(
            "3.2",
            "The stable forward speed range has disappeared completely",
            "stable: never" if not case.critical.stable_ranges else str(case.critical.stable_ranges),
            not case.critical.stable_ranges,
            "Found for all speeds, from Routh and Hurwitz' criterion, not only up to 10 m/s.",
        ),
        Claim(
            "3.2",
            "The weave speed has decreased to zero: weave is always stable",
            f"real part {roots[moving, 0].real.max():.4f} 1/s or less for v > 0, {abs(roots[0, 0].real):.0e} at rest",
            bool((roots[moving, 0].real < 0).all() and abs(roots[0, 0].real) < 1e-9 and not case.critical.weave),
        ),
        Claim(
            "3.2",
            "The capsize motion is always unstable",
            f"{roots[:, 2].real.min():.3f} 1/s or more up to 10 m/s; capsize speed: never",
            bool((roots[:, 2].real > 0).all() and not case.critical.capsize),
        ),
        Claim(
            "3.2",
            "A stable pendulum-type oscillator has been added to the steer assembly",
            f"at rest the pair is ±{roots[0, 0].imag:.3f}i 1/s: steer swings with a period of "
            f"{2 * np.pi / roots[0, 0].imag:.2f} s",
            bool(roots[0, 0].imag > 0 and _k22(case.model) > 0),
            f"The name castering does not apply below {_first(SPEEDS, applies[:, 3])}: there the fourth root "
            "is the time reversal of falling, mostly lean.",
        ),
    ]
