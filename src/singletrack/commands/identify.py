"""``singletrack identify``."""

from __future__ import annotations

import warnings
from dataclasses import replace
from pathlib import Path
from typing import Annotated, Any

import numpy as np
import typer

from singletrack.commands.figures import check_figure, deliver_figure
from singletrack.commands.model import model_from
from singletrack.commands.model_options import ModelOptions
from singletrack.commands.options import JsonOption
from singletrack.commands.printing import print_json, show
from singletrack.commands.turn import number_of
from singletrack.control import IdentifiedMode, combine_modes, identify_mode
from singletrack.control.agreement import ModeAgreement, compare_modes
from singletrack.errors import InputError, OddityWarning
from singletrack.files.recordings import read_measured_set, read_recording
from singletrack.files.source import read_text
from singletrack.library.measured import MeasuredModes
from singletrack.linear import critical_speeds, modes
from singletrack.model import LinearModel
from singletrack.parameters import Bicycle
from singletrack.present.measured import measured_figure
from singletrack.public import coefficients

__all__ = ["run"]


def run(
    files: Annotated[
        list[Path], typer.Argument(metavar="FILE...", help="Records of one motion, or a published set (.json).")
    ],
    options: ModelOptions,
    column: Annotated[str | None, typer.Option(metavar="NAME", help="Column of the signal.")] = None,
    start: Annotated[float | None, typer.Option(metavar="SECONDS", help="Use each record from here on.")] = None,
    bicycle: Annotated[str | None, typer.Option(metavar="BICYCLE", help="Predict with this bicycle.")] = None,
    speed: Annotated[
        str | None, typer.Option(metavar="SPEED", help='Forward speed of the records in m/s, or "18 km/h".')
    ] = None,
    plot: Annotated[Path | None, typer.Option(metavar="FILE", help="Draw points on curves: .png, .svg, .pdf.")] = None,
    json: JsonOption = False,
) -> None:
    """Find the eigenvalue of an oscillation in recorded rates, or compare a published set with its model."""
    if plot is not None:
        check_figure(plot)
    if files[0].suffix.lower() == ".json":
        if (
            bicycle is not None
            or column is not None
            or start is not None
            or speed is not None
            or options.answer is not None
        ):
            raise InputError(f"{files[0]}: a published set brings its own bicycle and speeds; give only the file")
        _published(files, plot, json)
        return
    if plot is not None and (bicycle is None or speed is None):
        raise InputError("--plot draws points on a model's curves: it needs --bicycle and --speed")
    v = None if speed is None else number_of("--speed", speed, "m/s")
    single = [identify_mode(*_record(file, column), start, str(file)) for file in files]
    found = combine_modes(single)
    model = None if bicycle is None else model_from(bicycle, options).model
    predicted = None if model is None or v is None else _nearest(model, v, found)
    if json:
        print_json(_as_dict(files, single, found, predicted))
    else:
        _print(files, single, found, predicted)
    if model is not None and v is not None and predicted is None:
        warnings.warn(OddityWarning(f"the model has no oscillation at {v:g} m/s to compare with"), stacklevel=2)
    if plot is not None and model is not None and v is not None:
        own = np.array([v])
        runs = MeasuredModes(str(bicycle), own, own, np.array([found.eigenvalue]))
        _draw(model, runs, f"{bicycle}: measured and computed", plot)


def _record(file: Path, column: str | None) -> tuple[np.ndarray, np.ndarray]:
    if not file.exists():
        raise InputError(f"{file}: there is no such file")
    return read_recording(read_text(file), str(file), column)


def _nearest(model: LinearModel, speed: float, found: IdentifiedMode) -> complex | None:
    """Return the model's oscillation whose eigenvalue is the nearest, if it has one."""
    roots = modes(model, speed).eigenvalues[0]
    roots = roots[roots.imag > 0]
    if not roots.size:
        return None
    return complex(roots[np.argmin(np.abs(roots - found.eigenvalue))])


def _as_dict(
    files: list[Path], single: list[IdentifiedMode], found: IdentifiedMode, predicted: complex | None
) -> dict[str, Any]:
    def told(one: IdentifiedMode) -> dict[str, Any]:
        return {
            "eigenvalue": [one.eigenvalue.real, one.eigenvalue.imag],
            "standard_deviation": list(one.deviations),
            "interval_95": [list(ends) for ends in one.interval()],
            "start": one.start,
            "samples": one.samples,
            "correlation": one.correlation,
            "explained": one.explained,
        }

    result = {"runs": [{"file": str(file), **told(one)} for file, one in zip(files, single, strict=True)]}
    both: dict[str, Any] = {**told(found), **result}
    if predicted is not None:
        both["predicted"] = [predicted.real, predicted.imag]
    return both


def _print(files: list[Path], single: list[IdentifiedMode], found: IdentifiedMode, predicted: complex | None) -> None:
    def told(one: IdentifiedMode) -> str:
        real, imaginary = one.deviations
        return f"{one.eigenvalue.real:.4f} ± {real:.2g}, {one.eigenvalue.imag:.4f} ± {imaginary:.2g} 1/s"

    for file, one in zip(files, single, strict=True):
        show(f"{file}: {told(one)}; from {one.start:g} s on, {one.samples} samples, {one.explained:.1%} explained")
    if len(files) > 1:
        show(f"together: {told(found)} (real, imaginary part)")
    if predicted is not None:
        show(f"model: {predicted.real:.4f}, {predicted.imag:.4f} 1/s")


def _published(files: list[Path], plot: Path | None, as_json: bool) -> None:
    if len(files) > 1:
        raise InputError(f"{files[1]}: a published set is compared alone")
    values, rows = read_measured_set(read_text(files[0]), str(files[0]))
    given: dict[str, Any] = dict(values)
    bicycle = Bicycle(name=files[0].stem, **given)
    model = coefficients(bicycle)
    found = compare_modes(model, rows[:, 0], rows[:, 1], rows[:, 2] + 1j * rows[:, 3])
    if as_json:
        print_json(_agreement_dict(found))
    else:
        show(f"{files[0]}: {len(rows)} runs, weave measured and computed")
        show(f"rms difference {found.rms:.3f} 1/s")
        text = f"chi-square {found.chi_square:.1f} of {2 * len(rows)} parts (probability {found.probability:.2g})"
        show(f"{text}; deviations: what the change of speed in a run does to the eigenvalue")
    if plot is not None:
        runs = MeasuredModes(bicycle.name, rows[:, 0], rows[:, 1], rows[:, 2] + 1j * rows[:, 3])
        _draw(model, runs, f"{bicycle.name}: measured and computed", plot)


def _agreement_dict(found: ModeAgreement) -> dict[str, Any]:
    def parts(values: np.ndarray) -> list[list[float]]:
        return np.stack([values.real, values.imag], axis=-1).tolist()

    return {
        "speeds": found.speeds.tolist(),
        "measured": parts(found.measured),
        "computed": parts(found.computed),
        "standard_deviation": found.deviations.tolist(),
        "rms": found.rms,
        "chi_square": found.chi_square,
        "probability": found.probability,
    }


def _draw(model: LinearModel, runs: MeasuredModes, title: str, plot: Path) -> None:
    speeds = np.linspace(0.0, max(10.0, 1.2 * float(runs.highest_speeds.max())), 501)
    plain = replace(model)
    figure = measured_figure(modes(plain, speeds), critical_speeds(plain), runs, title)
    deliver_figure(figure, plot)
