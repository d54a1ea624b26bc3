"""``singletrack plot``: files by suffix, whole or not at all."""

from __future__ import annotations

import pytest

from singletrack.commands.door import run
from singletrack.errors import InputError


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
