"""What no one would type: every command answers in one sentence, prints nothing half, and no NaN.

In one process, through the program's own door, so that many can be tried.
"""

from __future__ import annotations

import re
import sys
import xml.etree.ElementTree as ET
from typing import TYPE_CHECKING

import pytest

from singletrack.commands import app

if TYPE_CHECKING:
    from pathlib import Path

NUMBERS = ("1e308", "1e308 ft", "-1e308", "nan", "inf", "1e400", "৪.৪", "1_0", "true", "", "0x10", "5 kg", "1/0")
VARY = ("--vary", "trail=20mm:80mm", "--starts", "1")
#: Where a number stands: command line before it, and after it.
PLACES = {
    "turn speed": (("turn", "benchmark", "--lean", "5 deg", "--speed"), ()),
    "turn lean": (("turn", "benchmark", "--speed", "5", "--lean"), ()),
    "turn radius": (("turn", "benchmark", "--speed", "5", "--radius"), ()),
    "ride speed": (("ride", "benchmark", "--for", "0.05", "--speed"), ()),
    "ride push": (("ride", "benchmark", "--for", "0.05", "--speed", "5", "--push"), ()),
    "ride lean": (("ride", "benchmark", "--for", "0.05", "--speed", "5", "--lean"), ()),
    "ride for": (("ride", "benchmark", "--speed", "5", "--for"), ()),
    "control speeds": (("control", "benchmark", "--json", "--speeds"), ()),
    "control gain": (("control", "benchmark", "--feedback", "steer torque: lean rate="), ()),
    "compare speeds": (("compare", "benchmark", "stratos", "--json", "--speeds"), ()),
    "eigenvalues speeds": (("eigenvalues", "benchmark", "--json", "--speeds"), ()),
    "sensitivity speeds": (("sensitivity", "benchmark", "--of", "eigenvalues", "--speeds"), ()),
    "plot speeds": (("plot", "benchmark", "-o", "figure.svg", "--speeds", "0:"), ()),
    "plot over": (("plot", "benchmark", "-o", "figure.svg", "--over", "trail=0:"), (":3",)),
    "plot width": (("plot", "benchmark", "-o", "figure.svg", "--width"), ()),
    "design effort": (("design", "benchmark", *VARY, "--aim", "effort="), ()),
    "design stable": (("design", "benchmark", *VARY, "--aim", "stable=4:"), ()),
    "design vary": (("design", "benchmark", "--aim", "weave", "--starts", "1", "--vary", "trail=0.01:"), ()),
    "design keep": (("design", "benchmark", "--aim", "weave", *VARY, "--keep", "front_clearance=0.1:"), ()),
    "new head angle": (("new", "--head-angle"), ()),
    "set": (("coefficients", "benchmark", "--set", "trail="), ()),
    "spring": (("coefficients", "benchmark", "--spring", "steer="), ()),
    "damper": (("critical-speeds", "benchmark", "--damper", "steer="), ()),
}


def answer(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch, *arguments: str
) -> tuple[int, str, str]:
    """Run the program; return its exit code, what it printed, and what it said."""
    monkeypatch.setattr(sys, "argv", ["singletrack", *arguments])
    with pytest.raises(SystemExit) as end:
        app.main()
    printed = capsys.readouterr()
    return int(end.value.code or 0), printed.out, printed.err


def joined(before: tuple[str, ...], number: str, after: tuple[str, ...]) -> list[str]:
    """Return a command line; a number belongs to what ends in a sign before it."""
    text = number + "".join(after)
    if before[-1].startswith("--"):
        return [*before[:-1], f"{before[-1]}={text}"]
    return [*before[:-1], before[-1] + text]


@pytest.mark.parametrize("place", PLACES)
def test_no_number_breaks_a_command(
    place: str, tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    for number in NUMBERS:
        arguments = joined(*(PLACES[place][0], number, PLACES[place][1]))
        code, out, err = answer(capsys, monkeypatch, *arguments)
        assert code in {0, 2}, (arguments, err)
        assert "internal error" not in err
        assert "Warning:" not in err
        if code == 2:
            assert not out, arguments
            assert err.startswith("singletrack: ")
            assert not list(tmp_path.iterdir()), arguments
        else:
            assert number not in {"nan", "inf", "1e400", "৪.৪", "true", "0x10", "5 kg", "1/0"}, arguments
            assert not re.search(r"\b(nan|inf|Infinity)\b", out, re.IGNORECASE), arguments
        for file in tmp_path.iterdir():
            file.unlink()


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (
            ["turn", "benchmark", "--speed", "5", "--lean", "0", "--set", "trail=1 mm", "--set", "trail=2 mm"],
            "given twice",
        ),
        (["design", "benchmark", "--aim", "weave", *VARY, "--vary", "trail=1mm:2mm"], "must be given once"),
        (["control", "benchmark", "--spring", "steer=1", "--spring", "steer=2"], "given twice"),
        (["sensitivity", "benchmark", "--sobol", "--range", "trail=0:1", "--range", "trail=0:2"], "must be given once"),
        (["design", "benchmark", "--aim", "matrices=/dev/zero", *VARY], "is larger than"),
        (["identify", "/dev/zero"], "/dev/zero"),
        (["spacar", "/dev/zero"], "/dev/zero"),
        (["compare", "benchmark", "/dev/zero"], "/dev/zero"),
        (["page", "benchmark", "--no-open", "-o", "/dev/full"], "cannot be written"),
        (["control", "benchmark", "--input", "[/red]"], "unknown input"),
        (["sensitivity", "benchmark", "--parameter", "[red]"], "unknown parameter"),
        (["design", "benchmark", "--aim", "weave", "--vary", "[/]=0:1"], "unknown parameter"),
    ],
    ids=lambda value: " ".join(value)[:40] if isinstance(value, list) else "",
)
def test_what_is_meant_by_no_one_is_refused(
    arguments: list[str], words: str, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    code, out, err = answer(capsys, monkeypatch, *arguments)
    assert (code, out) == (2, "")
    assert words in err


@pytest.mark.filterwarnings("default::UserWarning")
@pytest.mark.parametrize("title", ["\x1b[31mred", "\u202ereversed", "$\\frac{", "<&>", "自行车 🚲", "[red]x[/]"])
def test_any_title_makes_a_figure(
    title: str, tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    file = tmp_path / "figure.svg"
    code, _, err = answer(capsys, monkeypatch, "plot", "benchmark", "-o", str(file), "--title", title)
    assert code == 0, err
    assert err.count("\n") <= 1  # what the font lacks is said once, and not where in the code
    assert ".py" not in err
    ET.fromstring(file.read_bytes())  # noqa: S314  # our own file
