"""Tyres that slip: growing cornering stiffness recovers rolling; a soft fork then wobbles."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
import pytest

from singletrack import InputError, coefficients, load_bicycle, load_rider
from singletrack.closed_form import Tyre, tyre_model
from singletrack.closed_form import coefficients as closed_form
from singletrack.posture import Options

SOFT = {"fork_bending_stiffness": 2e3, "fork_bending_damping": 20.0, "fork_hinge_x": 0.95, "fork_hinge_z": -0.65}


@pytest.mark.parametrize(
    ("bicycle", "rider", "options"),
    [
        (load_bicycle("benchmark"), None, "rigid"),
        (load_bicycle("stratos").replace(**SOFT), load_rider("rider-a"), Options("leaned", torso_lean=True)),
        (load_bicycle("browser"), load_rider("rider-a"), Options("upright", springs={"steer": 5.0})),
    ],
    ids=["alone", "leaned on a soft fork", "upright"],
)
@pytest.mark.parametrize("relaxation", [0.0, 0.05])
def test_stiff_tyres_are_rolling_at_rate_one_over_cornering_stiffness(bicycle, rider, options, relaxation):
    rolling = closed_form(bicycle, rider, options)
    speed = 6.0
    A = np.block(
        [
            [np.zeros_like(rolling.M), np.eye(len(rolling.M))],
            [
                -np.linalg.solve(rolling.M, rolling.S0 + rolling.gravity * rolling.K0 + speed**2 * rolling.K2),
                -np.linalg.solve(rolling.M, rolling.C0 + speed * rolling.C1),
            ],
        ]
    )
    expected = np.linalg.eigvals(A)
    errors = []
    for cornering in (1e5, 1e6, 1e7):
        tyre = Tyre(cornering, 500.0, relaxation)
        found = tyre_model(bicycle, tyre, tyre, rider, options).eigenvalues(speed)[0]
        errors.append([np.min(abs(found - one)) for one in expected])
    np.testing.assert_allclose(np.array(errors[0]) / errors[1], 10.0, rtol=0.15)
    np.testing.assert_allclose(np.array(errors[1]) / errors[2], 10.0, rtol=0.15)


def test_motions_that_rolling_allows_are_the_rolling_model():
    """The rates that rolling gives, put into the free equations, give the matrices of the rolling model."""
    bicycle = load_bicycle("stratos").replace(**SOFT)
    rolling, model = coefficients(bicycle), tyre_model(bicycle, Tyre(1.0), Tyre(1.0))
    n, base = 3, float(bicycle.wheel_base)
    # u = 0, r = sum of v kappa q + mu q'.
    mu, kappa = -model.front_contact[2:] / base, model.heading / base
    T = np.zeros((n + 2, n))
    T[1], T[2:] = mu, np.eye(n)
    along = np.zeros((n + 2, n))
    along[1] = kappa
    np.testing.assert_allclose(T.T @ model.M @ T, rolling.M, atol=1e-10)
    np.testing.assert_allclose(T.T @ (model.M @ along + model.C1 @ T), rolling.C1, atol=1e-10)
    np.testing.assert_allclose(T.T @ model.C1 @ along, rolling.K2, atol=1e-10)


def test_a_soft_fork_and_tyres_wobble():
    """With a soft fork and tyres that slip there is a steering oscillation of several hertz, hands off; not without."""
    bicycle = load_bicycle("benchmark")
    rolling = coefficients(bicycle).eigenvalues(np.array([8.0]))[0]
    assert np.max(abs(rolling.imag)) / (2 * np.pi) < 2.0
    tyre = Tyre(9e3, 500.0, 0.1)
    found = tyre_model(bicycle.replace(**SOFT), tyre, tyre).eigenvalues(8.0)[0]
    hertz = abs(found.imag) / (2 * np.pi)
    assert np.any((hertz > 3.0) & (hertz < 12.0))


def test_what_tyres_refuse():
    with pytest.raises(InputError, match=r"tyre: cornering = 0\.0, must be a finite number greater than zero"):
        Tyre(0.0)
    with pytest.raises(InputError, match="tyre: relaxation = -1"):
        Tyre(1e4, 0.0, -1.0)
    tyre = Tyre(1e4)
    with pytest.raises(InputError, match="greater than zero on tyres"):
        tyre_model(load_bicycle("benchmark"), tyre, tyre).eigenvalues(0.0)
    with pytest.raises(InputError, match="one design at a time"):
        tyre_model(load_bicycle("benchmark").replace(trail=np.array([0.05, 0.06])), tyre, tyre)


def test_the_program_and_the_tables_of_the_page(capsys):
    page = (Path(__file__).parents[2] / "docs" / "theory" / "flexible.md").read_text(encoding="utf-8")
    (program,) = re.findall(r"```python\n(.*?)```", page, flags=re.DOTALL)
    exec(compile(program, "flexible.md", "exec"), {})  # noqa: S102  # our own page
    off, on = capsys.readouterr().out.splitlines()
    assert "0.98" in off or "0.99" in off
    assert "-2.2" in on
    stratos, rider = load_bicycle("stratos"), load_rider("rider-a")
    for row in re.findall(r"\| ([0-9]+) \| ([0-9.]+) \| ([0-9.]+) \| -", page):
        stiffness = 1e3 * float(row[0])
        soft = SOFT | {"fork_bending_stiffness": stiffness, "fork_bending_damping": 0.003 * stiffness}
        for posture, printed in zip(("rigid", "leaned"), row[1:], strict=True):
            speeds = coefficients(stratos.replace(**soft), rider, posture).critical_speeds().weave
            assert min(abs(speed - float(printed)) for speed in speeds) < 0.006
