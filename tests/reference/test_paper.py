"""What the paper prints (reference/paper.json) and what follows from its data."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from singletrack import coefficients, load_bicycle, load_rider

PRINTED = json.loads((Path(__file__).parent / "paper.json").read_text())
CASES = {
    "stratos_rigid": ("stratos", "rigid"),
    "browser_rigid": ("browser", "rigid"),
    "browser_upright": ("browser", "upright"),
}


def model(bicycle, posture, **options):
    return coefficients(load_bicycle(bicycle), load_rider("rider-a"), posture, **options)


@pytest.mark.parametrize("case", CASES)
def test_printed_entries(case):
    computed = model(*CASES[case])
    assert round(float(computed.M[1, 1]), 2) == PRINTED[case]["M22"]
    assert round(float(computed.gravity * computed.K0[1, 1]), 1) == PRINTED[case]["gK0_22"]


def test_printed_critical_speeds():
    critical = model("stratos", "rigid").critical_speeds()
    assert round(critical.weave[0], 1) == PRINTED["stratos_rigid"]["weave_speed"]
    assert round(critical.capsize[0], 1) == PRINTED["stratos_rigid"]["capsize_speed"]


@pytest.mark.parametrize(
    ("bicycle", "posture", "options", "m22", "k22"),
    [
        ("stratos", "rigid", {}, "0.2507", "-6.8166"),
        ("browser", "rigid", {}, "0.2478", "-6.5916"),
        ("browser", "upright", {}, "0.4614", "2.3268"),
        ("stratos", "leaned", {"arms": "bent"}, "0.6332", "-9.4401"),
        ("stratos", "leaned", {}, "0.6502", "-9.6850"),
        ("stratos", "leaned", {"shoulder": "axial"}, "0.7371", "-3.7067"),
    ],
)
def test_values_agreed_before(bicycle, posture, options, m22, k22):
    """Reference values for the paper's data that were fixed before this code was written."""
    computed = model(bicycle, posture, **options)
    assert f"{computed.M[1, 1]:.4f}" == m22
    assert f"{computed.gravity * computed.K0[1, 1]:.4f}" == k22


def test_speeds_agreed_before():
    rigid, leaned = (
        model("stratos", "rigid").critical_speeds(),
        model("stratos", "leaned", arms="bent").critical_speeds(),
    )
    assert [f"{rigid.weave[0]:.3f}", f"{rigid.capsize[0]:.3f}"] == ["4.658", "7.867"]
    ((low, high),) = leaned.stable_ranges
    assert [f"{low:.3f}", f"{high:.3f}"] == ["5.901", "9.444"]
    ((low, high),) = model("stratos", "leaned").critical_speeds().stable_ranges
    assert [f"{low:.3f}", f"{high:.3f}"] == ["5.993", "9.588"]


def test_upright_rider_is_never_stable():
    upright = model("browser", "upright")
    critical = upright.critical_speeds()
    assert (critical.weave, critical.capsize, critical.stable_ranges) == ([], [], [])
    modes = upright.modes([0.5, 2.0, 5.0, 10.0, 50.0])
    assert (modes.eigenvalues[:, 0].real < 0).all()
    assert (modes.eigenvalues[:, 2].real > 0).all()
