"""The door to the commands: their names and help are here, their modules are imported when they are asked for.

A new command is a module here with a function ``run``, whose parameters are its arguments and options, and a line in
:data:`COMMANDS`.
"""

from __future__ import annotations

import dataclasses
import functools
import importlib
import inspect
import logging
from enum import StrEnum
from pathlib import PurePath
from types import NoneType, UnionType
from typing import TYPE_CHECKING, Annotated, Any, get_args, get_origin, get_type_hints

import typer
from typer.core import TyperCommand, TyperGroup

from singletrack.errors import InputError
from singletrack.present.terminal import open_streams
from singletrack.version import __version__

if TYPE_CHECKING:
    from collections.abc import Callable

__all__ = ["COMMANDS", "command", "run"]

#: Each command and what it does; its module has its name, with "_" for "-".
COMMANDS = {
    "reproduce": "Reproduce the paper: matrices, eigenvalues, figures, and a report that checks every printed number.",
    "coefficients": "Print the coefficient matrices of the linear equations.",
    "eigenvalues": "Print the eigenvalues at forward speeds, one column for each mode.",
    "critical-speeds": "Print weave and capsize speeds and the stable ranges.",
    "plot": "Draw eigenvalues over speed or a parameter, of one bicycle or several; or the map of where it is stable.",
    "compare": "Put bicycles side by side: what differs, critical speeds, modes, handling, with uncertainties.",
    "sensitivity": "Rank parameters by what they do to critical speeds, eigenvalues or matrices; Sobol's indices.",
    "design": "Search a design by aim: bounds, constraints, several starts; the front of two aims.",
    "list": "List the bicycles and riders that come with the package.",
    "show": "Print everything that follows from a bicycle or rider, with a drawing.",
    "new": "Make a bicycle from a geometry sheet and what was weighed, with uncertainties.",
    "template": "Print a commented parameter file to fill in.",
    "schema": "Print the JSON schema of a parameter file, for editors.",
    "convert": "Read a bicycle or rider in any format and write it in another.",
    "measure": "Turn pendulum periods, hanging angles and lengths into parameters with uncertainties.",
    "period": "Fit a decaying oscillation to a recorded signal and print its period with its uncertainty.",
    "control": "Print where inputs lose modes, how well they reach them, and what riding costs.",
    "identify": "Find the eigenvalue of the oscillation in recorded rates, with its deviation, beside the model's.",
    "page": "Write a page with sliders and a rider in motion, and open it in the browser.",
    "spacar": "Run a file of SPACAR: motion, small motions, equilibrium, buckling; rigid and flexible.",
    "sweep": "Compute many designs as a study file says; interrupted, the same command goes on.",
    "turn": "Print a steady turn: lean, steer, hand torque, path, forces, and whether it is stable.",
    "ride": "Ride a bicycle, nonlinear, until it falls or the time is over; draw, animate and write the ride.",
}

_SETTINGS = {"help_option_names": ["-h", "--help"]}
# typer may carry a click of its own: take the base of its usage errors from itself.
_UsageError: Any = next(base for base in typer.BadParameter.__mro__ if base.__name__ == "ClickException")


class _Command(TyperCommand):
    """A command that loads nothing to tell that no help was asked for."""

    def get_help_option(self, ctx: Any) -> Any:
        return _unasked_for(super().get_help_option(ctx))


class _Door(TyperGroup):
    """A group that knows its commands by name and help, and imports a command's module when it is called."""

    def __init__(self, **attributes: Any) -> None:
        super().__init__(**attributes)
        self.commands.update({name: TyperCommand(name, help=text) for name, text in COMMANDS.items()})

    def get_help_option(self, ctx: Any) -> Any:
        return _unasked_for(super().get_help_option(ctx))

    def resolve_command(self, ctx: Any, args: list[str]) -> tuple[str | None, Any, list[str]]:
        name, found, rest = super().resolve_command(ctx, args)
        return name, found and command(str(name)), rest


def command(name: str) -> Any:
    """Return a command with its arguments and options; its module is imported.

    Parameters
    ----------
    name : str
        One of :data:`COMMANDS`.
    """
    module = importlib.import_module(f"singletrack.commands.{name.replace('-', '_')}")
    alone = typer.Typer(add_completion=False)
    function = _flat(module.run)
    alone.command(name, help=COMMANDS[name], context_settings=_SETTINGS, cls=_Command)(function)
    made = typer.main.get_command(alone)
    for parameter in made.params:
        _leave_as_it_is(parameter, function.__annotations__.get(parameter.name))
    return made


def _unasked_for(option: Any) -> Any:
    """Return an option that does nothing where it is not given; None where there is none."""
    if option is None:
        return None
    convert = type(option).process_value

    def process(ctx: Any, value: Any) -> Any:
        return None if value is None else convert(option, ctx, value)

    option.process_value = process
    return option


def _leave_as_it_is(parameter: Any, annotation: Any) -> None:
    """Let a value that is of its kind already pass: the library would load one more, that converts, to tell.

    What is not, or is missing, or has more to it, is left to the library.
    """
    convert = parameter.process_value
    many, kind = _kind_of(annotation)

    def process(ctx: Any, value: Any) -> Any:
        if parameter.callback is None and kind is not None and not parameter.required:
            if value is None:
                return () if many else None
            if many and isinstance(value, tuple | list) and all(isinstance(each, kind) for each in value):
                return list(value)
        if parameter.callback is None and kind is not None and not many:
            if isinstance(value, kind):
                return value
            if issubclass(kind, StrEnum) and value in list(kind):
                return kind(value)
        return convert(ctx, value)

    parameter.process_value = process


def _kind_of(annotation: Any) -> tuple[bool, type | None]:
    """Return whether an annotated parameter takes a list, and of what kind, None for none of the simple ones."""
    kind = get_args(annotation)[0] if get_origin(annotation) is Annotated else annotation
    if get_origin(kind) is UnionType:
        kind = next(each for each in get_args(kind) if each is not NoneType)
    many = get_origin(kind) is list
    kind = get_args(kind)[0] if many else kind
    return many, kind if isinstance(kind, type) and issubclass(kind, (str, bool, PurePath)) else None


def _flat(function: Callable[..., None]) -> Callable[..., None]:
    """Return a function whose parameters that are records (bundles of options) are replaced by the records' fields."""
    hints = get_type_hints(function, include_extras=True)
    flat: list[inspect.Parameter] = []
    bundles: dict[str, tuple[Any, list[str]]] = {}
    for parameter in inspect.signature(function).parameters.values():
        record = hints[parameter.name]
        if not dataclasses.is_dataclass(record):
            flat.append(parameter.replace(annotation=record, kind=inspect.Parameter.KEYWORD_ONLY))
            continue
        kinds = get_type_hints(record, include_extras=True)
        fields = {field.name: field.default for field in dataclasses.fields(record)}
        bundles[parameter.name] = record, list(fields)
        flat += [
            inspect.Parameter(name, inspect.Parameter.KEYWORD_ONLY, default=default, annotation=kinds[name])
            for name, default in fields.items()
        ]

    @functools.wraps(function)
    def call(**values: Any) -> None:
        records = {
            name: record(**{field: values.pop(field) for field in fields})
            for name, (record, fields) in bundles.items()
        }  # fmt: skip
        function(**values, **records)

    call.__signature__ = inspect.Signature(flat)  # type: ignore[attr-defined]
    call.__annotations__ = {parameter.name: parameter.annotation for parameter in flat}
    return call


def _print_version(wanted: bool) -> None:
    if wanted:
        typer.echo(f"singletrack {__version__}")
        raise typer.Exit


_app = typer.Typer(
    cls=_Door,
    help="Lateral dynamics of bicycles with real riders, hands on the handlebar.",
    invoke_without_command=True,
    add_completion=False,
    pretty_exceptions_enable=False,
    context_settings=_SETTINGS,
)


@_app.callback()
def _program(
    context: typer.Context,
    version: Annotated[
        bool, typer.Option("--version", callback=_print_version, is_eager=True, help="Print the version.")
    ] = False,
) -> None:
    if context.invoked_subcommand is None and not version:
        typer.echo(context.get_help())


def run(arguments: list[str]) -> int:
    """Run a command.

    Parameters
    ----------
    arguments : list of str
        As after the program's name.

    Returns
    -------
    int
        The exit code; anything that goes wrong is raised.

    Raises
    ------
    InputError
        For arguments that are no command's.
    """
    # Where it keeps its fonts, or that it cannot keep them without a home folder, is nothing that a user asked for.
    logging.getLogger("matplotlib").setLevel(logging.ERROR)
    open_streams()
    program: Any = typer.main.get_command(_app)
    try:
        with program.make_context("singletrack", arguments) as context:
            program.invoke(context)
    except typer.Exit as end:
        return end.exit_code
    except typer.Abort:
        raise KeyboardInterrupt from None
    except _UsageError as error:
        # The library puts the kind of Python's exception before its words.
        raise InputError(error.format_message().replace(": Value error, ", ": ")) from None
    return 0
