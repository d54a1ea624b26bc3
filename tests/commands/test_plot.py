"""``singletrack plot``: files by suffix, whole or not at all."""

from __future__ import annotations

import numpy as np
import pytest

from singletrack import load_bicycle, load_rider
from singletrack.analysis.designs import Design
from singletrack.analysis.family import family
from singletrack.commands.door import run
from singletrack.errors import InputError, OddityWarning


@pytest.mark.parametrize(
    "arguments",
    [
        ["stratos", "-o", "figure.svg"],
        ["stratos", "browser", "--kmh", "-o", "figure.pdf", "--title", "two bicycles"],
        ["benchmark", "--over", "trail=40mm:80mm:3", "-o", "figure.png", "--width", "60 mm"],
        ["benchmark", "--over", "trail=40mm:80mm:3", "--as", "axis", "--at", "18 km/h", "-o", "figure.svg"],
        ["benchmark", "--over", "steer_axis_tilt=10deg:30deg:3", "--as", "map", "-o", "figure.svg"],
    ],
    ids=lambda a: " ".join(a[:4]),
)
def test_figures_are_written(arguments, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert run(["plot", *arguments]) == 0
    (file,) = tmp_path.iterdir()
    assert file.stat().st_size > 5000


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (["stratos", "-o", "figure.bmp"], "unknown suffix '.bmp'"),
        (["stratos", "-o", "figure.svg", "--width", "3 m"], "--width '3 m': must be between 40 and 400 mm"),
        (["stratos", "-o", "figure.svg", "--over", "trial=1:2:3"], "--over: unknown parameter 'trial'"),
        (["stratos", "-o", "figure.svg", "--over", "trail=1kg:2:3"], "no length"),
        (["stratos", "-o", "figure.svg", "--over", "trail"], "must be PARAMETER=START:STOP:COUNT"),
        (["stratos", "browser", "-o", "figure.svg", "--over", "trail=40mm:80mm:3"], "varies one bicycle, found 2"),
        (["stratos", "-o", "figure.svg", "--speeds", "5"], "must be START:STOP"),
        (["benchmark", "-o", "figure.svg", "--bands"], "no parameter has a standard deviation"),
    ],
    ids=lambda a: " ".join(a[1:]) if isinstance(a, list) else "",
)
def test_what_is_wrong_is_said_and_nothing_written(arguments, words, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    with pytest.raises(InputError) as caught:
        run(["plot", *arguments])
    assert words in str(caught.value)
    assert list(tmp_path.iterdir()) == []


def test_why_designs_of_a_family_cannot_exist_is_said(tmp_path):
    """Of each cause how many, from where, and the first reason."""
    over = ["--over", "handlebar_length=-300mm:300mm:9", "-o", str(tmp_path / "figure.svg")]
    for kind, count in (("family", 9), ("axis", 161), ("map", 161)):
        with pytest.warns(OddityWarning, match=rf"of {count} values.*from -300 mm on, the shoulder-grip distance is"):
            assert run(["plot", "stratos", "--rider", "rider-a", *over, "--as", kind]) == 0


def test_a_family_tells_which_value_has_which_reason():
    design = Design.of(load_bicycle("stratos"), load_rider("rider-a"), "leaned")
    found = family(design, "fork_length", np.array([0.02, 0.35, 0.40]))
    assert [(number, value) for number, value, _ in found.lost()] == [(1, 0.02)]
    assert "fork_length" in found.lost()[0][2]
    assert family(design, "trail", np.array([0.05, 0.06])).lost() == []
