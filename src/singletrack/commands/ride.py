"""``singletrack ride``."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import numpy as np
import typer
from rich.progress import BarColumn, Progress, TextColumn

from singletrack.commands.model import answer_words, seated
from singletrack.commands.model_options import ModelOptions
from singletrack.commands.options import BicycleArgument, JsonOption
from singletrack.commands.printing import deliver, print_json, show
from singletrack.commands.sheets import bicycle_named
from singletrack.commands.turn import number_of
from singletrack.errors import InputError
from singletrack.files.signals import read_signal
from singletrack.files.source import read_text
from singletrack.output import check_writable
from singletrack.present.riding import animation_bytes, ride_figure
from singletrack.present.style import figure_bytes
from singletrack.present.tables import write_csv
from singletrack.present.terminal import Terminal
from singletrack.public import warn_of_oddities
from singletrack.public.riding import Ride, ride_for

if TYPE_CHECKING:
    from collections.abc import Callable

    from singletrack.arrays import Array

__all__ = ["run"]

_FIGURES = (".png", ".svg", ".pdf")
_MOVIES = (".gif", ".mp4")
_DATA = (".nc", ".csv")
_FRAMES_A_SECOND = 20


def run(
    bicycle: BicycleArgument,
    options: ModelOptions,
    speed: Annotated[str, typer.Option(help='Forward speed in m/s, or with a unit: "18 km/h".')],
    push: Annotated[str, typer.Option(help="Lean rate at the start in rad/s, as after a knock; to the right.")] = "0",
    lean: Annotated[str, typer.Option(help='Lean at the start in rad, or "5 deg"; to the right.')] = "0",
    torque: Annotated[
        Path | None, typer.Option(metavar="FILE", help="Steer torque: two columns, time in s and N m.")
    ] = None,
    duration: Annotated[str, typer.Option("--for", metavar="TIME", help="How long, in s.")] = "10",
    output: Annotated[
        Path | None, typer.Option("--output", "-o", metavar="FILE", help="Write everything here: .nc or .csv.")
    ] = None,
    plot: Annotated[Path | None, typer.Option(help="Draw lean, steer and path here: .png, .svg or .pdf.")] = None,
    animate: Annotated[Path | None, typer.Option(help="Show the ride here: .gif, or .mp4 with ffmpeg.")] = None,
    json: JsonOption = False,
) -> None:
    """Ride a bicycle, nonlinear, and say how it ended."""
    _check_files(output, plot, animate)
    record, rider, changed = seated(bicycle_named(bicycle), options)
    warn_of_oddities(record, rider)
    v, until = number_of("--speed", speed, "m/s"), number_of("--for", duration, "s")
    given: Any = {
        "speed": v,
        "duration": until,
        "push": number_of("--push", push, "rad/s"),
        "lean": number_of("--lean", lean, "rad"),
        "feedback": options.answer,
        "torque": None if torque is None else read_signal(read_text(torque), str(torque)),
    }
    found = _with_progress(until, lambda tell: ride_for(record, rider, options.sitting, **given, progress=tell))
    who = "" if rider is None else f" with {rider.name or 'rider'}, {options.sitting.title}"
    title = f"{record.name}{who}{changed}{answer_words(options)}, {v:g} m/s"
    _write(found, title, output, plot, animate)
    if json:
        print_json(_summary(found))
    else:
        show(f"{title}: {found.end}, at {found.end_time:.2f} s" if not found.whole else f"{title}: {found.end}")
        show(_lines(found))


def _with_progress(until: float, work: Callable[[Callable[[float], object]], Ride]) -> Ride:
    columns = (TextColumn("riding"), BarColumn(bar_width=24), TextColumn("{task.completed:.2f} s"))
    console = Terminal(stderr=True)
    with Progress(*columns, console=console, transient=True, disable=not console.is_terminal) as bar:
        task = bar.add_task("ride", total=until)
        return work(lambda t: bar.update(task, completed=t))


def _check_files(output: Path | None, plot: Path | None, animate: Path | None) -> None:
    for file, suffixes in ((output, _DATA), (plot, _FIGURES), (animate, _MOVIES)):
        if file is not None and file.suffix.lower() not in suffixes:
            raise InputError(f"{file}: unknown suffix {file.suffix!r}, must be one of {', '.join(suffixes)}")
        if file is not None:
            check_writable(file)


def _write(found: Ride, title: str, output: Path | None, plot: Path | None, animate: Path | None) -> None:
    if output is not None:
        deliver(_csv(found) if output.suffix.lower() == ".csv" else _netcdf(found, title), output)
    if plot is not None:
        time, lean, steer = (
            found.data.time.to_numpy(),
            *(np.degrees(found.coordinate(name)) for name in ("lean", "steer")),
        )
        figure = ride_figure(time, lean, steer, _path(found), title, found.end)
        deliver(figure_bytes(figure, plot.suffix.lower().removeprefix(".")), plot)
    if animate is not None:
        deliver(_animation(found, title, animate.suffix.lower()), animate)


def _path(found: Ride) -> Array:
    path: Array = found.data.contact.sel(wheel="rear wheel").to_numpy()[:, :2]
    return path


def _animation(found: Ride, title: str, suffix: str) -> bytes:
    time = found.data.time.to_numpy()
    every = max(1, round(1.0 / _FRAMES_A_SECOND / float(time[1] - time[0])))
    times = time[::every]
    if len(times) < 2:
        raise InputError(f"the ride ended at {found.end_time:.3g} s: too short for an animation")
    parts = [line.part for line in found.lines]
    console = Terminal(stderr=True)
    columns, silent = (TextColumn("drawing"), BarColumn(bar_width=24)), not console.is_terminal
    with Progress(*columns, console=console, transient=True, disable=silent) as bar:
        task = bar.add_task("draw", total=len(times))
        return animation_bytes(
            parts,
            found.places(every),
            _path(found)[::every],
            times,
            f"{title}: {found.end}",
            suffix,
            lambda i: bar.update(task, completed=i),
        )


def _csv(found: Ride) -> str:
    data = found.data
    names = [str(name) for name in data.coordinate.to_numpy()]
    inputs = [str(name) for name in data.input_name.to_numpy()]
    header = ["time", *names, *(f"{name} rate" for name in names), *inputs]
    rows = np.column_stack([data.time, data.q, data.u, data.input])
    return write_csv(header, rows.tolist())


def _netcdf(found: Ride, title: str) -> bytes:
    empty = [name for name, size in found.data.sizes.items() if not size]  # which this format takes for unlimited
    data = found.data.drop_dims(empty).assign_attrs(title=title, end=found.end, units="SI, angles in rad")
    return bytes(data.to_netcdf(engine="scipy"))


def _summary(found: Ride) -> dict[str, object]:
    lean, steer = found.coordinate("lean"), found.coordinate("steer")
    return {
        "end": found.end,
        "end_time": found.end_time,
        "whole": found.whole,
        "greatest_lean": float(np.max(abs(lean))),
        "greatest_steer": float(np.max(abs(steer))),
        "speed": float(-found.model.system.parameters["rear radius"] * found.data.u.sel(coordinate="rear wheel")[-1]),
    }


def _lines(found: Ride) -> str:
    lean, steer = (np.degrees(found.coordinate(name)) for name in ("lean", "steer"))
    greatest = f"greatest lean {np.max(abs(lean)):.2f} deg, greatest steer {np.max(abs(steer)):.2f} deg"
    return f"{greatest}; at the end {lean[-1]:.2f} and {steer[-1]:.2f} deg"
