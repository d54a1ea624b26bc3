"""Values that are of their kind already reach a command as they do through the library of options alone."""

from __future__ import annotations

import sys
import types
from enum import StrEnum
from pathlib import Path  # noqa: TC003  # read when the command runs
from typing import Annotated, Any

import pytest
import typer

from singletrack.commands import door

FOUND: list[dict[str, Any]] = []


class Kind(StrEnum):
    one = "one"
    two = "the second"


def run(
    name: Annotated[str, typer.Argument()],
    text: Annotated[str | None, typer.Option("--text")] = None,
    word: Annotated[str, typer.Option("--word")] = "usual",
    several: Annotated[list[str] | None, typer.Option("--several")] = None,
    needed: Annotated[list[str], typer.Option("--needed")] = [],  # noqa: B006  # never changed
    flag: Annotated[bool, typer.Option("--flag")] = False,
    kind: Annotated[Kind, typer.Option("--kind")] = Kind.one,
    path: Annotated[Path | None, typer.Option("--path")] = None,
    count: Annotated[int, typer.Option("--count", min=1, max=3)] = 2,
    number: Annotated[float | None, typer.Option("--number")] = None,
) -> None:
    FOUND.append(dict(locals()))


def outcome(command: Any, arguments: list[str]) -> Any:
    """Return what a command is called with, with kinds, or the message."""
    FOUND.clear()
    try:
        with command.make_context("it", list(arguments)) as context:
            command.invoke(context)
    except Exception as error:  # noqa: BLE001  # whatever it is, it is compared
        return type(error).__name__, str(getattr(error, "message", error))
    return {name: (type(value), value) for name, value in FOUND[0].items()}


@pytest.mark.parametrize(
    "arguments",
    [
        ["a"],
        [],
        ["a", "b"],
        ["", "--text", ""],
        ["a", "--text", "x", "--word=y", "--flag"],
        ["a", "--several", "x", "--several", "y", "--needed", "z"],
        ["a", "--kind", "the second", "--path", "somewhere/x", "--count", "3", "--number", "1e-3"],
        ["a", "--kind", "two"],
        ["a", "--kind", "ONE"],
        ["a", "--count", "4"],
        ["a", "--count", "x"],
        ["a", "--number", "x"],
        ["a", "--nonsense"],
        ["a", "--text"],
        ["--", "--text"],
    ],
    ids=" ".join,
)
def test_values_are_those_of_the_library(arguments, monkeypatch):
    module: Any = types.ModuleType("singletrack.commands.try_values")
    module.run = run
    monkeypatch.setitem(sys.modules, module.__name__, module)
    monkeypatch.setitem(door.COMMANDS, "try-values", "Try.")
    alone = typer.Typer(add_completion=False)
    alone.command("try-values")(run)
    assert outcome(door.command("try-values"), arguments) == outcome(typer.main.get_command(alone), arguments)


def test_help_is_help(capsys):
    for word in ("--help", "-h"):
        assert door.run(["period", word]) == 0
        assert "Usage" in capsys.readouterr().out
