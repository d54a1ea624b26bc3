"""The door: commands known by name, imported when they are called."""

from __future__ import annotations

import subprocess
import sys
import types
from pathlib import Path

import pytest

from singletrack.commands import door
from singletrack.commands.options import BicycleArgument  # noqa: TC001  # read when the command runs
from singletrack.errors import InputError
from singletrack.version import __version__

COMMANDS = Path(door.__file__).parent
#: Modules of the room that are no commands.
SHARED = {"__init__", "app", "door", "figures", "model", "model_options", "options"}
SHARED |= {"plain", "printing", "sheets", "writing"}


def test_every_command_is_a_module_and_every_module_a_command():
    modules = {path.stem for path in COMMANDS.glob("*.py")} - SHARED
    assert modules == {name.replace("-", "_") for name in door.COMMANDS}


@pytest.mark.parametrize("option", ["--help", "-h"])
def test_help_names_all_commands(option, capsys):
    assert door.run([option]) == 0
    printed = capsys.readouterr().out
    assert all(name in printed for name in door.COMMANDS)


def test_without_arguments_helps(capsys):
    assert door.run([]) == 0
    assert "critical-speeds" in capsys.readouterr().out


def test_version(capsys):
    assert door.run(["--version"]) == 0
    assert capsys.readouterr().out == f"singletrack {__version__}\n"


@pytest.mark.parametrize("name", door.COMMANDS)
def test_each_command_has_help_with_a_word_on_each_option(name, capsys, monkeypatch):
    monkeypatch.setenv("COLUMNS", "200")
    assert door.run([name, "-h"]) == 0
    printed = capsys.readouterr().out
    assert door.COMMANDS[name] in printed
    for line in printed.splitlines():
        if line.startswith("│ --"):
            assert len(line.strip("│ ").split(maxsplit=2)) == 3, line


@pytest.mark.parametrize("arguments", [["--help"], ["--version"], ["nonsense"]])
def test_the_door_needs_no_numpy(arguments):
    code = (
        "import sys; from singletrack.commands.door import run\n"
        f"try: run({arguments!r})\nexcept ValueError: pass\n"
        "print([m for m in ('numpy', 'scipy', 'matplotlib', 'pint', 'yaml', 'casadi') if m in sys.modules])"
    )
    result = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert result.stdout.splitlines()[-1] == "[]"


@pytest.mark.parametrize(
    "arguments", [["template", "rider"], ["coefficients", "stratos"], ["critical-speeds", "stratos", "--json"]]
)
def test_models_of_the_closed_form_need_none_of_the_engines_libraries(arguments):
    code = (
        f"import sys; from singletrack.commands.door import run\nrun({arguments!r})\n"
        "print([m for m in ('scipy', 'matplotlib', 'pint', 'casadi', 'xarray', 'control') if m in sys.modules])"
    )
    result = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert result.stdout.splitlines()[-1] == "[]"


def test_a_new_command_is_a_module_and_a_line(monkeypatch, capsys):
    def run(bicycle: BicycleArgument) -> None:
        sys.stdout.write(f"{bicycle.upper()}\n")

    module = types.ModuleType("singletrack.commands.shout")
    module.run = run
    monkeypatch.setitem(sys.modules, "singletrack.commands.shout", module)
    monkeypatch.setitem(door.COMMANDS, "shout", "Print a name in capitals.")
    assert door.run(["shout", "stratos"]) == 0
    assert capsys.readouterr().out == "STRATOS\n"


def test_a_misspelt_command_is_told_the_nearest():
    with pytest.raises(InputError, match=r"eigenvalue'.*'eigenvalues'"):
        door.run(["eigenvalue"])
