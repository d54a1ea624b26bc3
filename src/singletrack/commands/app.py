"""The command line: arguments only; everything else is done by the layers below."""

from __future__ import annotations

import os
import sys
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from singletrack.commands.options import (
    BicycleArgument,
    CentreFit,
    CsvOption,
    EngineName,
    EngineOption,
    JsonOption,
    OutputFileOption,
    Parameterization,
    PostureName,
    PostureOption,
    RecordKind,
    RiderOption,
    SetOption,
    ShoulderName,
    ShoulderOption,
    SpeedsOption,
    TemplateKind,
)
from singletrack.errors import InputError, SingletrackError, unknown_name

if TYPE_CHECKING:
    from singletrack.public import CoefficientMatrices

__all__ = ["app", "main"]

app = typer.Typer(
    help="Lateral dynamics of bicycles with real riders, hands on the handlebar.",
    no_args_is_help=True,
    add_completion=False,
    pretty_exceptions_enable=False,
)


def _changes(settings: list[str] | None) -> dict[str, str]:
    changes = {}
    for setting in settings or []:
        name, sign, value = setting.partition("=")
        if not sign or not value.strip():
            raise InputError(f"--set {setting!r}: found no value; must be NAME=VALUE, e.g. --set trail=0.06")
        changes[name.strip()] = value.strip()
    return changes


def _model(
    bicycle_name: str,
    rider_name: str | None,
    posture: PostureName,
    shoulder: ShoulderName | None,
    engine: EngineName,
    settings: list[str] | None,
) -> tuple[CoefficientMatrices, str]:
    """Return the coefficient matrices that the arguments ask for, and a title."""
    from singletrack.library import load_bicycle, load_rider
    from singletrack.library.load import override
    from singletrack.parameters import Rider

    changes = _changes(settings)
    bicycle = load_bicycle(bicycle_name)
    rider = None if rider_name is None else load_rider(rider_name)
    known = list(bicycle.descriptions())
    for name in changes:
        if rider is None and name in Rider.descriptions():
            raise InputError(f"--set {name}: is a parameter of a rider, and there is no --rider")
        if name not in known and name not in Rider.descriptions():
            raise InputError(
                f"--set: {unknown_name('parameter', name, known + list(rider.descriptions() if rider else []))}"
            )
    bicycle = override(bicycle, {name: text for name, text in changes.items() if name in known})
    if rider is not None:
        rider = override(rider, {name: text for name, text in changes.items() if name not in known})
    shoulder_name = None if shoulder is None else shoulder.value
    title = bicycle.name if rider is None else f"{bicycle.name} with {rider.name}, {posture.value}"
    if engine is EngineName.multibody:
        from singletrack.multibody import coefficients as derived
        from singletrack.posture import Options
        from singletrack.public import CoefficientMatrices

        return CoefficientMatrices.of(derived(bicycle, rider, Options(posture.value, shoulder_name))), title
    from singletrack.public import coefficients as closed_form

    return closed_form(bicycle, rider, posture.value, shoulder_name), title


def _print_json(value: Any) -> None:
    import json

    typer.echo(json.dumps(value, indent=1))


def _print(renderable: Any) -> None:
    from rich.console import Console

    Console(highlight=False).print(renderable)


@app.command()
def coefficients(
    bicycle: BicycleArgument,
    rider: RiderOption = None,
    posture: PostureOption = PostureName.rigid,
    shoulder: ShoulderOption = None,
    engine: EngineOption = EngineName.closed_form,
    settings: SetOption = None,
    json: JsonOption = False,
) -> None:
    """Print the coefficient matrices M, C1, K0 and K2."""
    model, title = _model(bicycle, rider, posture, shoulder, engine, settings)
    if json:
        _print_json(model.to_dict())
        return
    from singletrack.present.tables import coefficients_table

    _print(coefficients_table(model, title))


@app.command()
def eigenvalues(
    bicycle: BicycleArgument,
    rider: RiderOption = None,
    posture: PostureOption = PostureName.rigid,
    shoulder: ShoulderOption = None,
    engine: EngineOption = EngineName.closed_form,
    settings: SetOption = None,
    speeds: SpeedsOption = "0:10:11",
    json: JsonOption = False,
    csv: CsvOption = False,
) -> None:
    """Print the eigenvalues at forward speeds, one column for each mode."""
    from singletrack.files.speeds import parse_speeds
    from singletrack.present.tables import eigenvalues_csv, eigenvalues_table

    if json and csv:
        raise InputError("--json and --csv exclude each other")
    values = parse_speeds(speeds)
    model, title = _model(bicycle, rider, posture, shoulder, engine, settings)
    modes = model.modes(values)
    if json:
        _print_json(modes.to_dict())
    elif csv:
        typer.echo(eigenvalues_csv(modes), nl=False)
    else:
        _print(eigenvalues_table(modes, title))


@app.command("critical-speeds")
def critical_speeds(
    bicycle: BicycleArgument,
    rider: RiderOption = None,
    posture: PostureOption = PostureName.rigid,
    shoulder: ShoulderOption = None,
    engine: EngineOption = EngineName.closed_form,
    settings: SetOption = None,
    json: JsonOption = False,
) -> None:
    """Print weave and capsize speeds and the stable ranges."""
    model, title = _model(bicycle, rider, posture, shoulder, engine, settings)
    speeds = model.critical_speeds()
    if json:
        _print_json(speeds.to_dict())
        return
    from singletrack.present.tables import critical_speeds_text

    typer.echo(f"{title}\n{critical_speeds_text(speeds)}")


@app.command("list")
def list_shipped() -> None:
    """List the bicycles and riders that come with the package."""
    from singletrack.library import load_bicycle, load_rider, shipped

    for kind, load in (("bicycle", load_bicycle), ("rider", load_rider)):
        typer.echo(f"{kind}s")
        for name in shipped(kind):
            typer.echo(f"  {name:<12}{load(name).description}")


@app.command()
def show(
    name: Annotated[str, typer.Argument(metavar="NAME", help="A shipped name or a file in any format.")],
    rider: RiderOption = None,
    posture: PostureOption = PostureName.rigid,
    shoulder: ShoulderOption = None,
) -> None:
    """Print everything that follows from a bicycle or rider, with a drawing."""
    from singletrack.commands import files as commands_files

    commands_files.show(name, rider, posture.value, None if shoulder is None else shoulder.value)


@app.command()
def template(
    kind: Annotated[TemplateKind, typer.Argument(help="What to fill in.")], output: OutputFileOption = None
) -> None:
    """Print a commented parameter file to fill in."""
    from singletrack.commands import files as commands_files

    commands_files.template(kind.value, output)


@app.command()
def schema(
    kind: Annotated[RecordKind, typer.Argument(help="bicycle or rider")], output: OutputFileOption = None
) -> None:
    """Print the JSON schema of a parameter file, for editors."""
    from singletrack.commands import files as commands_files

    commands_files.schema(kind.value, output)


@app.command()
def convert(
    source: Annotated[str, typer.Argument(metavar="IN", help="A shipped name or a file in any format.")],
    output: Annotated[Path, typer.Argument(metavar="OUT", help="Its suffix says how: .toml, .txt, .yml.")],
    parameterization: Annotated[Parameterization, typer.Option(help="Symbols of a .yml parameter set.")] = (
        Parameterization.benchmark
    ),
    configuration: Annotated[Path | None, typer.Option(help="Posture file of a rider by 95 measurements.")] = None,
    rigid_rider: Annotated[Path | None, typer.Option(help="Rigid rider to lump into the rear frame.")] = None,
) -> None:
    """Read a bicycle or rider in any format and write it in another."""
    from singletrack.commands import files as commands_files

    commands_files.convert(source, output, parameterization.value, configuration, rigid_rider)


@app.command()
def measure(
    file: Annotated[Path, typer.Argument(metavar="FILE", help="Raw measurements.")],
    compare: Annotated[str | None, typer.Option(help="A bicycle to compare with, or none.")] = None,
    output: Annotated[Path | None, typer.Option(help="Write the bicycle here: .toml, .txt or .yml.")] = None,
    centre_fit: Annotated[CentreFit, typer.Option(help="How centres follow from plumb lines.")] = (
        CentreFit.perpendicular
    ),
) -> None:
    """Turn pendulum periods, hanging angles and lengths into parameters with uncertainties."""
    from singletrack.commands import files as commands_files

    commands_files.measure(file, compare, output, centre_fit.value)


@app.command()
def period(
    file: Annotated[Path, typer.Argument(metavar="FILE", help="Two columns: time in s, signal.")],
    plot: Annotated[Path | None, typer.Option(help="Draw signal and fit here: .png, .svg or .pdf.")] = None,
) -> None:
    """Fit a decaying oscillation to a recorded signal and print its period with its uncertainty."""
    from singletrack.commands import files as commands_files

    commands_files.period(file, plot)


@app.command()
def sweep(
    study: Annotated[Path, typer.Argument(metavar="STUDY", help="A study file (TOML).")],
    output: Annotated[Path | None, typer.Option(metavar="STORE", help="Zarr store to write.")] = None,
    scheduler: Annotated[str | None, typer.Option(metavar="ADDRESS", help="A running Dask scheduler.")] = None,
    workers: Annotated[int | None, typer.Option(help="Processes on this machine; by default one a core.")] = None,
) -> None:
    """Compute many designs as a study file says; interrupted, the same command goes on."""
    from singletrack.commands.sweep import run_study

    run_study(study, output, scheduler, workers)


@app.command()
def reproduce(
    output: Annotated[Path, typer.Option("--output", metavar="DIR", help="Where to write; made if needed.")] = Path(
        "singletrack-output"
    ),
) -> None:
    """Reproduce the paper: matrices, eigenvalues, figures, and a report that checks every printed number."""
    from singletrack.reproduce import reproduce as run

    report = run(output)
    typer.echo(f"report: {report}")


def main() -> None:
    """Run the command line; one message and exit code 2 for anything the user can mend."""
    # typer may carry a click of its own: take the base of its usage errors from itself.
    usage_error: Any = next(base for base in typer.BadParameter.__mro__ if base.__name__ == "ClickException")
    try:
        code = app(standalone_mode=False)
    except SingletrackError as error:
        typer.echo(f"singletrack: {error}", err=True)
        code = 2
    except (typer.Abort, KeyboardInterrupt):
        typer.echo("singletrack: interrupted", err=True)
        code = 130
    except BrokenPipeError:
        sys.stderr.close()  # the reader of a pipe has seen enough
        code = 0
    except usage_error as error:
        typer.echo(f"singletrack: {error.format_message()}", err=True)
        code = 2
    except OSError as error:
        typer.echo(f"singletrack: {error.filename or 'a file'}: {error.strerror or error}", err=True)
        code = 2
    except Exception as error:  # a user is told what happened; the traceback is for those who ask for it
        if os.environ.get("SINGLETRACK_TRACEBACK"):
            raise
        text = f"internal error, please report it: {type(error).__name__}: {error}"
        typer.echo(f"singletrack: {text} (SINGLETRACK_TRACEBACK=1 shows where)", err=True)
        code = 1
    sys.exit(code if isinstance(code, int) else 0)
