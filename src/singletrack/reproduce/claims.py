"""Every number the paper prints and every sentence it says about eigenvalues, beside what was computed."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from singletrack.linear.characteristic import characteristic_polynomial
from singletrack.linear.meetings import meeting_speeds
from singletrack.reproduce.cases import SPEEDS
from singletrack.reproduce.claim import Claim, first_speed, gk0_22, m_22, printed_number_holds
from singletrack.reproduce.passive_claims import leaned_claims, upright_claims

if TYPE_CHECKING:
    from singletrack.reproduce.cases import Case

__all__ = ["Claim", "check_claims"]


def check_claims(cases: dict[str, Case]) -> list[Claim]:
    """Return all claims of the paper with what was computed for them."""
    return [*_general(cases["stratos-rigid"]), *_numbers(cases), *leaned_claims(cases), *upright_claims(cases)]


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
            ("M(2, 2)", mass, "kg m²", m_22(case.model), m_22(axial)),
            ("g K0(2, 2)", stiffness, "N m/rad", gk0_22(case.model), gk0_22(axial)),
        ):
            note = _NOT_FROM_DATA.format(axial=other)
            claims.append(_number(section, f"{what}: {name}", printed, value, unit, note))
    return claims


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
            f"Steer exceeds lean above {first_speed(SPEEDS, ratio[:, 2] > 1)}." if (ratio[:, 2] > 1).any() else "",
        ),
        Claim(
            "2",
            "Castering: overall stable, a large negative real eigenvalue with an eigenvector dominated by steer",
            f"{roots[0, 3].real:.2f} to {roots[-1, 3].real:.2f} 1/s; steer / lean at least {ratio[:, 3].min():.1f}",
            bool((roots[:, 3].imag == 0).all() and (roots[:, 3].real < -1).all() and (ratio[:, 3] > 1).all()),
        ),
    ]
