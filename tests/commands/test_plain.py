"""The light commands in their plainest words: the same text as through the door, without the libraries behind it."""

from __future__ import annotations

import subprocess
import sys

import pytest

from singletrack.commands import door, plain
from singletrack.library import descriptions, load_bicycle, load_rider
from singletrack.posture import load_posture

LIGHT = [
    ["--version"],
    ["list"],
    *(["template", kind] for kind in ("bicycle", "rider", "measurements", "posture")),
    *(["schema", kind] for kind in ("bicycle", "rider")),
]


@pytest.mark.parametrize("arguments", LIGHT, ids=" ".join)
def test_plain_words_print_what_the_door_prints(arguments, capsys):
    assert plain.answered(arguments)
    found = capsys.readouterr()
    assert door.run(arguments) == 0
    assert found == capsys.readouterr()


def test_a_conversion_in_plain_words_is_that_of_the_door(tmp_path, capsys):
    assert plain.answered(["convert", "browser", str(tmp_path / "a.toml")])
    assert "a.toml" in capsys.readouterr().out
    assert door.run(["convert", "browser", str(tmp_path / "b.toml")]) == 0
    assert (tmp_path / "a.toml").read_text() == (tmp_path / "b.toml").read_text()


@pytest.mark.parametrize(
    "arguments",
    [
        [],
        ["--help"],
        ["list", "--help"],
        ["list", "x"],
        ["template"],
        ["template", "Bicycle"],
        ["template", "bicycle", "--output", "x"],
        ["schema", "posture"],
        ["convert", "browser"],
        ["convert", "--help", "x"],
        ["convert", "browser", "--help"],
        ["nonsense"],
        ["--version", "list"],
    ],
    ids=" ".join,
)
def test_all_else_is_left_to_the_door(arguments, capsys):
    assert not plain.answered(arguments)
    assert capsys.readouterr() == ("", "")


@pytest.mark.parametrize(
    ("kind", "load"), [("bicycle", load_bicycle), ("rider", load_rider), ("posture", load_posture)]
)
def test_descriptions_are_those_of_the_things(kind, load):
    assert descriptions(kind) == {name: load(name).description for name in descriptions(kind)}


def loaded(arguments: list[str]) -> set[str]:
    """Return the modules that a command has imported at its end."""
    code = (
        f"import sys; sys.argv = ['singletrack', *{arguments!r}]; from singletrack.commands.app import main\n"
        "try: main()\nexcept SystemExit: pass\nprint(*sys.modules, file=sys.stderr)"
    )
    return set(subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True).stderr.split())


#: The most modules, and the most of ours, that a command may import; what it may not. Each costs some 0.5 ms.
MODULES = {
    ("--version",): (110, 9, {"numpy", "typer", "rich", "pydantic"}),
    ("--help",): (370, 12, {"numpy", "pydantic"}),
    ("list",): (320, 68, {"typer", "rich", "pydantic"}),
    ("template", "bicycle"): (320, 68, {"typer", "rich", "pydantic"}),
    ("schema", "rider"): (320, 68, {"typer", "rich", "pydantic"}),
    ("convert", "browser", "OUT"): (430, 83, {"pydantic"}),
    ("coefficients", "browser", "--rider", "rider-a", "--posture", "upright"): (
        520,
        132,
        {"singletrack.linear", "pydantic"},
    ),
}
HEAVY = {"scipy", "matplotlib", "pint", "casadi", "xarray", "control", "yaml", "jinja2", "jax", "numba"}


@pytest.mark.parametrize("arguments", MODULES, ids=" ".join)
def test_commands_import_no_more_than_they_did(arguments, tmp_path):
    most, own, without = MODULES[arguments]
    found = loaded([str(tmp_path / "x.toml") if word == "OUT" else word for word in arguments])
    assert not found & (HEAVY | without)
    assert len([name for name in found if name.partition(".")[0] == "singletrack"]) <= own
    assert len(found) <= most
