"""The commands that concern files: template, show, convert, measure, period, schema. Plain functions that print."""

from __future__ import annotations

import json
from pathlib import Path
from typing import TYPE_CHECKING, Any

from singletrack.errors import InputError

if TYPE_CHECKING:
    from rich.console import Console

    from singletrack.parameters import Bicycle, Rider

__all__ = ["convert", "measure", "period", "schema", "show", "template"]

_SUFFIXES = {".toml": "toml", ".txt": "text", ".yml": "yaml", ".yaml": "yaml"}


def _console() -> Console:
    from rich.console import Console

    return Console(highlight=False, soft_wrap=False)


def _deliver(text: str, output: str | Path | None) -> None:
    """Write a file whole, or print."""
    from singletrack.present.files import write_whole

    if output is None:
        print(text, end="" if text.endswith("\n") else "\n")  # noqa: T201  # plain text, to be piped into a file
    else:
        write_whole(Path(output), text)
        _console().print(f"wrote {output}", markup=False, soft_wrap=True)


def template(kind: str, output: str | Path | None = None) -> None:
    """Print (or write) a commented file to fill in.

    Parameters
    ----------
    kind : {"bicycle", "rider", "measurements"}
    output : path, optional
        Where to write it; printed without.

    Raises
    ------
    InputError
        For an unknown kind, or an output that cannot be written.
    """
    from singletrack.library.template import template as text

    _deliver(text(kind), output)


def schema(kind: str, output: str | Path | None = None) -> None:
    """Print (or write) the JSON schema of a bicycle's or a rider's TOML file (arguments as :func:`template`)."""
    from singletrack.library.schema import schema as make

    _deliver(json.dumps(make(kind), indent=2, ensure_ascii=False) + "\n", output)


def _load(name_or_path: str | Path, configuration: str | Path | None = None) -> Bicycle | Rider:
    """Load whichever of a bicycle and a rider it is; a rider by Yeadon's measurements with a configuration."""
    from singletrack.files.source import read_text
    from singletrack.library.load import load_any

    if configuration is None:
        return load_any(name_or_path)
    from singletrack.files.yeadon import read_configuration, read_yeadon

    lean = read_configuration(read_text(Path(configuration)), str(configuration))
    return read_yeadon(read_text(Path(name_or_path)), str(name_or_path), lean)


def show(
    name_or_path: str,
    rider: str | None = None,
    posture: str = "rigid",
    shoulder: str | None = None,
    drawing: bool = True,
) -> None:
    """Print everything that follows from a bicycle or a rider, with a drawing.

    Parameters
    ----------
    name_or_path : str
        A shipped bicycle or rider, or a file in any format.
    rider : str, optional
        Rider to seat on the bicycle: a shipped name or a file.
    posture, shoulder
        As for :func:`singletrack.coefficients`; used with a rider.
    drawing : bool
        Whether to draw the bicycle.

    Raises
    ------
    SingletrackError
        If there is no such thing or it cannot be used.
    """
    from singletrack.library import load_rider
    from singletrack.parameters import Rider
    from singletrack.posture import Options
    from singletrack.present.printing import print_oddities, print_record, print_results

    record = _load(name_or_path)
    console = _console()
    if isinstance(record, Rider):
        if rider is not None:
            raise InputError(f"{name_or_path}: is a rider, must be a bicycle to seat {rider} on")
        print_record(console, record)
        print_oddities(console, record, None)
        return
    person = None if rider is None else load_rider(rider).on(record)
    if drawing:
        from singletrack.present.sketch import side_view

        console.print(side_view(record, person), markup=False)
        console.print("centres of mass: R rear wheel, B rear frame, H front frame, F front wheel\n", style="dim")
    print_record(console, record)
    if person is not None:
        print_record(console, person)
    print_results(console, record, person, Options(posture, shoulder))
    print_oddities(console, record, person)


def convert(
    source: str,
    output: str | Path,
    parameterization: str = "benchmark",
    configuration: str | Path | None = None,
    rigid_rider: str | Path | None = None,
) -> None:
    """Read a bicycle or a rider in any format and write it in the format of the output's suffix.

    Parameters
    ----------
    source : str
        A shipped name or a file.
    output : path
        ``.toml``: our own; ``.txt``: parameter text; ``.yml``, ``.yaml``: parameter set. Riders: ``.toml`` only.
    parameterization : {"benchmark", "principal"}
        Of a parameter set.
    configuration : path, optional
        Configuration of Yeadon's human, for the forward lean angle of a rider read from 95 measurements.
    rigid_rider : path, optional
        Parameter text of a rigid rider (``mB, xB, zB, IBxx, ...``) to lump into the bicycle's rear frame.

    Raises
    ------
    InputError
        If the source cannot be read, the suffix is unknown, the format cannot hold the record, or the output is the
        source itself or cannot be written; nothing is written then.
    """
    from singletrack.files.parameter_sets import write_parameter_set
    from singletrack.files.text import write_bicycle_text
    from singletrack.files.toml_write import write_toml
    from singletrack.parameters import Bicycle
    from singletrack.present.printing import print_oddities

    target = Path(output)
    kind = _SUFFIXES.get(target.suffix.lower())
    if kind is None:
        raise InputError(f"{output}: unknown suffix {target.suffix!r}, must be one of {', '.join(_SUFFIXES)}")
    if target.exists() and Path(source).exists() and target.samefile(source):
        raise InputError(f"{output}: is the file to read, must be another one")
    record = _load(source, configuration)
    if rigid_rider is not None:
        record = _with_rigid_rider(record, rigid_rider)
    if kind == "toml":
        text = write_toml(record)
    elif not isinstance(record, Bicycle):
        raise InputError(f"{output}: the format holds no rider, must be .toml")
    elif kind == "text":
        text = write_bicycle_text(record)
    else:
        text = write_parameter_set(record, parameterization)
    _deliver(text, output)
    console = _console()
    print_oddities(console, record, None)
    if kind == "yaml" and isinstance(record, Bicycle):
        _note_losses(console, record)


def _with_rigid_rider(record: Bicycle | Rider, path: str | Path) -> Bicycle:
    from singletrack.files.source import read_text
    from singletrack.files.text import read_rigid_rider
    from singletrack.parameters import Bicycle
    from singletrack.parameters.bodies import with_rigid_rider

    if not isinstance(record, Bicycle):
        raise InputError(f"{record.name}: is a rider, must be a bicycle to put the rigid rider {path} on")
    return with_rigid_rider(record, read_rigid_rider(read_text(Path(path)), str(path)))


def _note_losses(console: Console, record: Bicycle) -> None:
    """Say what a parameter set does not hold."""
    lost = [name for name in record.values() if name not in _model_names()]
    if record.standard_deviations:
        console.print("note: a parameter set holds no standard deviations; they stand in its comments", markup=False)
    if lost:
        console.print(f"note: a parameter set holds no {', '.join(lost)}", markup=False, soft_wrap=True)


def _model_names() -> list[str]:
    from singletrack.parameters.symbols import MODEL_SYMBOLS, NAMES

    return [NAMES[symbol] for symbol in MODEL_SYMBOLS]


def measure(
    path: str | Path,
    compare: str | None = None,
    output: str | Path | None = None,
    centre_fit: str = "perpendicular",
) -> None:
    """Turn raw measurements into the 25 parameters with uncertainties, and print them.

    Parameters
    ----------
    path : path
        A file of raw measurements (`singletrack template measurements`).
    compare : str, optional
        A bicycle to compare with: a shipped name or a file. By default the shipped bicycle of the same name, if any;
        ``"none"`` for none.
    output : path, optional
        Where to write the bicycle (``.toml``, ``.txt``, ``.yml``).
    centre_fit : {"perpendicular", "vertical", "intersections"}
        How centres of mass follow from the plumb lines.

    Raises
    ------
    InputError
        Names file, line, measurement, what was found and what is allowed.
    """
    from singletrack.files.measured import read_measured
    from singletrack.files.source import read_text
    from singletrack.library import load_bicycle, shipped
    from singletrack.present.printing import print_measured, print_measured_speeds, print_oddities

    if not Path(path).exists():
        raise InputError(f"{path}: there is no such file")
    found = read_measured(read_text(Path(path)), str(path), centre_fit)
    name = found.bicycle.name if compare is None and found.bicycle.name in shipped("bicycle") else compare
    other = None if name in {None, "none"} else load_bicycle(str(name))
    console = _console()
    print_measured(console, found, other)
    print_measured_speeds(console, found)
    print_oddities(console, found.bicycle, None)
    if output is not None:
        _write_bicycle(found.bicycle, output)


def _write_bicycle(bicycle: Bicycle, output: str | Path) -> None:
    from singletrack.files.parameter_sets import write_parameter_set
    from singletrack.files.text import write_bicycle_text
    from singletrack.files.toml_write import write_toml

    writers: dict[str, Any] = {"toml": write_toml, "text": write_bicycle_text, "yaml": write_parameter_set}
    kind = _SUFFIXES.get(Path(output).suffix.lower())
    if kind is None:
        raise InputError(f"{output}: unknown suffix {Path(output).suffix!r}, must be one of {', '.join(_SUFFIXES)}")
    _deliver(writers[kind](bicycle), output)


def period(path: str | Path, plot: str | Path | None = None) -> None:
    """Fit a decaying oscillation to a recorded signal and print its period with its standard deviation.

    Parameters
    ----------
    path : path
        Two columns: time in s, signal (a rate, an angle, a voltage).
    plot : path, optional
        Where to write the figure (``.png``, ``.svg`` or ``.pdf``).

    Raises
    ------
    InputError
        Names file, line, what was found and what is allowed.
    """
    from singletrack.files.signals import read_signal
    from singletrack.files.source import read_text
    from singletrack.measuring.oscillation import fit_oscillation

    if not Path(path).exists():
        raise InputError(f"{path}: there is no such file")
    fit = fit_oscillation(*read_signal(read_text(Path(path)), str(path)), str(path))
    console = _console()
    console.print(f"period: {fit.period:.9g} ± {fit.period_deviation:.2g} s", markup=False)
    console.print(f"without damping: {fit.natural_period:.9g} s", markup=False)
    console.print(f"decay: {fit.decay:.4g} ± {fit.decay_deviation:.2g} 1/s", markup=False)
    console.print(f"for the measurements' file: {fit.natural_period!r}+/-{fit.period_deviation!r}", markup=False)
    if plot is not None:
        _save_plot(fit, Path(path).stem, Path(plot))


def _save_plot(fit: Any, title: str, plot: Path) -> None:
    import io

    from singletrack.present.files import write_whole
    from singletrack.present.oscillation import oscillation_figure

    suffix = plot.suffix.lower().removeprefix(".")
    if suffix not in {"png", "svg", "pdf"}:
        raise InputError(f"{plot}: unknown suffix {plot.suffix!r}, must be one of .png, .svg, .pdf")
    content = io.BytesIO()
    oscillation_figure(fit, title).savefig(content, format=suffix)
    write_whole(plot, content.getvalue())
    _console().print(f"wrote {plot}", markup=False, soft_wrap=True)
