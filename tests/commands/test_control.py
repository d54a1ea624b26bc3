"""``singletrack control``: what is seen, by name, as tables, JSON, figures and for Matlab."""

from __future__ import annotations

import json
import sys
from typing import Any

import numpy as np
import pytest

from singletrack import coefficients, load_bicycle, load_rider
from singletrack.commands import app as cli
from singletrack.control import frequency_response

LEANED = (
    "control",
    "stratos",
    "--rider",
    "rider-a",
    "--posture",
    "leaned",
    "--speeds",
    "3,6",
    "--input",
    "steer torque",
)
HAND = ("--output", "right hand force y", "--output", "lean acceleration")


@pytest.fixture
def run(monkeypatch: Any, capsys: Any) -> Any:
    """Run the command line in this process; return exit code, standard output, standard error."""

    def run(*arguments: str) -> tuple[Any, str, str]:
        monkeypatch.setattr(sys, "argv", ["singletrack", *arguments])
        with pytest.raises(SystemExit) as stop:
            cli.main()
        captured = capsys.readouterr()
        return stop.value.code, captured.out, captured.err

    return run


@pytest.fixture(scope="module")
def system() -> Any:
    names = ["right hand force y", "lean acceleration"]
    return coefficients(load_bicycle("stratos"), load_rider("rider-a"), "leaned").state_space([3.0, 6.0], names)


def test_outputs_are_printed_in_full(run: Any, tmp_path: Any, system: Any) -> None:
    import scipy.io

    figure, mat = tmp_path / "b.svg", tmp_path / "b.mat"
    code, out, err = run(*LEANED, *HAND, "--json", "--bode", str(figure), "--mat", str(mat))
    assert (code, err) == (0, "")
    found = json.loads(out)
    assert found["outputs"] == list(system.outputs)
    for name in "ABCD":
        np.testing.assert_allclose(found[name], getattr(system, name), rtol=1e-12, atol=1e-13)
    np.testing.assert_allclose(np.moveaxis(scipy.io.loadmat(mat)["C"], 2, 0), system.C, rtol=1e-12, atol=1e-13)
    assert b"<svg" in figure.read_bytes()[:400]


def test_tables_tell_what_happens_at_once_and_over_speed(run: Any, system: Any) -> None:
    code, out, _ = run(*LEANED, *HAND)
    assert code == 0
    words = out.replace("\n", " ")
    amplitudes = abs(frequency_response(system, [2 * np.pi])).sel(input="steer torque", output="right hand force y")
    for value in (*system.D[0, 0], *amplitudes.values.ravel()):
        assert f"{value:.4g}" in words
    assert "amplitude at 1 Hz, per unit of steer torque" in words


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (("--output", "right hand"), "did you mean right hand force"),
        (("--output", "steer", *(["--output", "lean"] * 6), "--bode", "x.svg"), "at most 6 outputs, found 7"),
        (("--bode", "x.txt"), "unknown suffix"),
    ],
)
def test_what_cannot_be_seen_is_refused(run: Any, arguments: tuple[str, ...], words: str) -> None:
    code, out, err = run(*LEANED, *arguments)
    assert (code, out) == (2, "")
    assert words in err
