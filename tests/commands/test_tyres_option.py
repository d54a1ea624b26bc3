"""``singletrack eigenvalues --tyres``: side forces instead of rolling."""

from __future__ import annotations

import json

import numpy as np
import pytest

from singletrack import InputError, load_bicycle
from singletrack.closed_form import Tyre, tyre_model
from singletrack.commands.door import run

TYRES = "9 kN/rad, 500 N/rad, 0.1 m / 8000, 400, 90 mm"


def printed(capsys, *arguments):
    assert run(["eigenvalues", "benchmark", "--speeds", "4, 6", *arguments]) == 0
    return capsys.readouterr().out


def test_front_and_rear_with_units(capsys):
    data = json.loads(printed(capsys, "--tyres", TYRES, "--json"))
    front, rear = Tyre(9e3, 500.0, 0.1), Tyre(8e3, 400.0, 0.09)
    expected = tyre_model(load_bicycle("benchmark"), front, rear).eigenvalues(np.array([4.0, 6.0]))
    found = np.array(data["eigenvalues"])
    np.testing.assert_allclose(found[..., 0] + 1j * found[..., 1], expected)
    assert data["speeds"] == [4.0, 6.0]


def test_table_and_csv(capsys):
    assert "on tyres" in printed(capsys, "--tyres", "9000, 500, 0")
    assert printed(capsys, "--tyres", "9000, 500, 0", "--csv").startswith("speed,root 1 real,root 1 imag,root 2 real")


@pytest.mark.parametrize(
    ("tyres", "more", "reason"),
    [
        ("9000", (), "found 1 values, must be cornering, camber, relaxation"),
        ("9 kN, 500, 0", (), r"--tyres: cornering: '9 kN' has a unit"),
        ("-9000, 500, 0", (), "cornering = -9000"),
        ("1, 2, 3, 4, 5, 6", (), "three for the front / three for the rear"),
        ("9000, 500, 0", ("--engine", "multibody"), "only the closed form"),
        ("9000, 500, 0", ("--speeds", "0, 5"), "greater than zero on tyres"),
    ],
)
def test_refusals(tyres, more, reason):
    with pytest.raises(InputError, match=reason):
        run(["eigenvalues", "benchmark", "--tyres", tyres, *more])
