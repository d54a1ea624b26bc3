"""``singletrack sensitivity``."""

from __future__ import annotations

import json

import pytest

from singletrack.commands.door import run
from singletrack.errors import InputError


def test_a_table_for_each_result(capsys):
    assert run(["sensitivity", "browser", "--top", "3"]) == 0
    printed = capsys.readouterr().out
    assert "weave speed" in printed
    assert "ceases at" in printed
    assert "m/s per deg" in printed


def test_json_of_eigenvalues_and_matrices(capsys):
    arguments = ["--of", "eigenvalues", "--of", "matrices", "--speeds", "18 km/h", "--parameter", "trail", "--json"]
    assert run(["sensitivity", "benchmark", *arguments]) == 0
    found = json.loads(capsys.readouterr().out)
    assert found["parameters"] == ["trail"]
    assert "Re weave at 5 m/s" in found["results"]
    assert "K0 steer, steer" in found["results"]


def test_tornado_file_and_sobol(tmp_path, capsys):
    file = tmp_path / "tornado.svg"
    assert run(["sensitivity", "benchmark", "-o", str(file)]) == 0
    assert file.stat().st_size > 5000
    arguments = ["--sobol", "--range", "trail=70mm:90mm", "--range", "steer_axis_tilt=17deg:19deg", "--samples", "64"]
    assert run(["sensitivity", "benchmark", *arguments]) == 0
    assert "256 designs" in capsys.readouterr().out


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (["--parameter", "trial"], "unknown parameter 'trial'"),
        (["--by", "deviation"], "no parameter has a standard deviation"),
        (["--sobol"], "no parameter has a standard deviation; give --range"),
        (["--sobol", "--range", "trail=90mm:70mm"], "LOW below HIGH"),
        (["--sobol", "--range", "trail"], "must be NAME=LOW:HIGH"),
        (["--engine", "multibody"], "takes the closed form"),
        (["--result", "wobble speed"], "unknown result 'wobble speed'"),
        (["-o", "tornado.gif"], "unknown suffix '.gif'"),
    ],
    ids=lambda a: " ".join(a) if isinstance(a, list) else "",
)
def test_what_is_wrong_is_said(arguments, words):
    with pytest.raises(InputError) as caught:
        run(["sensitivity", "benchmark", *arguments])
    assert words in str(caught.value)
