"""Files of gains."""

from __future__ import annotations

import re
import sys

import numpy as np
import pytest

from singletrack import InputError, coefficients, load_bicycle
from singletrack.commands import app as cli
from singletrack.files.gains import read_gains

GOOD = """
kind = "gains"
limit = "20 N m"
delay = "100 ms"

[gains."steer torque"]
lean = "1 N*m/deg"
"lean rate" = [50, -10]
"""


def test_units_and_coefficients_are_read():
    found = read_gains(GOOD, "gains.toml")
    assert (found.limit, found.delay, found.period) == (20.0, 0.1, 0.005)
    assert found.gains["steer torque", "lean"] == pytest.approx(57.29577951308232)
    assert found.at(3.0).gains["steer torque", "lean rate"] == 20.0


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("", "gains.toml: has no gains"),
        ("limit = 2", "gains.toml: has no gains"),
        ("[gains]\nlean = 2", "line 2: lean = 2, must be a table of signals"),
        (GOOD.replace("limit", "limt"), "line 3: unknown entry 'limt'"),
        (GOOD.replace('"gains"', '"rider"'), "line 2: is a 'rider' file"),
        (GOOD.replace("20 N m", "20 s"), "line 3: .*'20 s'"),
        (GOOD.replace("[50, -10]", '[50, "x"]'), "line 8: .*'x'"),
        (GOOD.replace("20 N m", "-20 N m"), "limit = -20.0, must be greater than zero"),
        (GOOD.replace("50", "nan"), "must be finite"),
        ("[gains", "is not valid TOML"),
    ],
)
def test_mistakes_are_named_with_their_line(text, words):
    with pytest.raises(InputError, match=words):
        read_gains(text, "gains.toml")


def test_the_command_line_takes_gains_from_options_and_from_a_file(monkeypatch, capsys, tmp_path):
    def run(*arguments):
        monkeypatch.setattr(sys, "argv", ["singletrack", *arguments])
        with pytest.raises(SystemExit) as stop:
            cli.main()
        return stop.value.code, *capsys.readouterr()

    file = tmp_path / "gains.toml"
    file.write_text('[gains."steer torque"]\n"lean rate" = 10\n')
    code, from_file, _ = run("critical-speeds", "benchmark", "--gains", str(file))
    assert code == 0
    code, from_option, _ = run("critical-speeds", "benchmark", "--feedback", "steer torque: lean rate=10")
    assert code == 0
    assert from_file.splitlines()[1:] == from_option.splitlines()[1:]
    # Weave by hand: the feedback is a term of the damping; its real part changes sign at the speed that is printed.
    model = coefficients(load_bicycle("benchmark"))
    printed = float(re.findall(r"weave speed +([0-9.]+) m/s", from_file)[0])

    def growth(v):
        damping = v * np.asarray(model.C1) - [[0.0, 0.0], [10.0, 0.0]]
        stiffness = 9.81 * np.asarray(model.K0) + v**2 * np.asarray(model.K2)
        lower = -np.linalg.solve(model.M, np.hstack([stiffness, damping]))
        roots = np.linalg.eigvals(np.vstack([np.hstack([np.zeros((2, 2)), np.eye(2)]), lower]))
        return roots[roots.imag > 0].real.max()

    assert growth(printed - 1e-3) > 0 > growth(printed + 1e-3)
    for arguments, words in (
        (["--gains", str(file), "--feedback", "steer torque: lean=1"], "two ways to say the same"),
        (["--feedback", "steer torque"], "must be"),
        (["--feedback", "steer torque: leen=1"], "--feedback: unknown signal 'leen'; did you mean lean"),
        (["--gains", str(tmp_path / "none.toml")], "none.toml"),
    ):
        code, _, err = run("critical-speeds", "benchmark", *arguments)
        assert code == 2
        assert words in err
    code, _, err = run("turn", "benchmark", "--speed", "5", "--lean", "0.1", "--gains", str(file))
    assert code == 2
    assert "singletrack ride" in err
