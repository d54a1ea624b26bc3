"""``singletrack identify``, as a user runs it: what it needs is said before anything is computed."""

from __future__ import annotations

import json

import numpy as np
import pytest

from singletrack import InputError, OddityWarning
from singletrack.commands import door


@pytest.fixture
def record(tmp_path):
    """A decaying oscillation of -0.5 +- 4i 1/s under names, with a little noise."""
    t = np.linspace(0, 6, 601)
    w = np.exp(-0.5 * t) * np.cos(4 * t) + 1e-3 * np.random.default_rng(1).normal(size=t.size)
    path = tmp_path / "rates.csv"
    path.write_text("time,w,other\n" + "".join(f"{a:.3f},{b:.6f},0\n" for a, b in zip(t, w, strict=True)))
    return path


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        ((), "line 2: found .* --column NAME"),
        (("--column", "w", "--plot", "a.png"), "needs --bicycle and --speed"),
        (("--column", "w", "--bicycle", "stratos", "--speed", "5 kg"), "--speed: '5 kg' has a unit"),
    ],
)
def test_what_is_missing_is_said(record, arguments, said):
    with pytest.raises(InputError, match=said):
        door.run(["identify", str(record), *arguments])


def test_a_published_set_takes_no_other_bicycle(tmp_path):
    with pytest.raises(InputError, match="brings its own bicycle"):
        door.run(["identify", str(tmp_path / "set.json"), "--bicycle", "stratos"])


def test_speeds_have_units(record, capsys):
    told = []
    for speed in ("18 km/h", "5"):
        door.run(["identify", str(record), "--column", "w", "--bicycle", "benchmark", "--speed", speed, "--json"])
        told.append(json.loads(capsys.readouterr().out)["predicted"])
    assert told[0] == pytest.approx(told[1], rel=1e-12)


def test_a_model_without_oscillation_predicts_nothing(record, capsys):
    options = ["--bicycle", "benchmark", "--speed", "0", "--json"]
    with pytest.warns(OddityWarning, match="no oscillation at 0 m/s"):
        door.run(["identify", str(record), "--column", "w", *options])
    assert "predicted" not in json.loads(capsys.readouterr().out)
