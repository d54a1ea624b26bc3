"""``singletrack plot``."""

from __future__ import annotations

import warnings
from enum import StrEnum
from typing import TYPE_CHECKING, Annotated, Any

import numpy as np
import typer

from singletrack.analysis.designs import Design
from singletrack.analysis.family import Family, family, stability_map
from singletrack.analysis.uncertainty import eigenvalue_uncertainty
from singletrack.commands.figures import (
    BicyclesArgument,
    FigureOption,
    TitleOption,
    WidthOption,
    axis_label,
    check_figure,
    deliver_figure,
    millimetres,
    parse_over,
)
from singletrack.commands.model import Made, model_from
from singletrack.commands.model_options import EngineName, ModelOptions
from singletrack.errors import InputError, OddityWarning
from singletrack.files.speeds import parse_speeds
from singletrack.linear import critical_speeds, modes
from singletrack.present.maps import map_figure, parameter_figure
from singletrack.present.plotting import Drawn, overlay_figure, single_figure
from singletrack.present.words import KILOMETRES, METRES, SpeedUnit

if TYPE_CHECKING:
    from matplotlib.figure import Figure

__all__ = ["run"]

_FINE = 401  # speeds of a curve
_ROWS = 161  # parameter values of a map
_FIGURE = "singletrack.pdf"


class OverKind(StrEnum):
    """What ``--over`` draws."""

    family = "family"
    axis = "axis"
    map = "map"


def run(
    bicycles: BicyclesArgument,
    options: ModelOptions,
    output: FigureOption,
    speeds: Annotated[
        str, typer.Option("--speeds", metavar="START:STOP", help='In m/s or with a unit: "0:10", "0 km/h:36 km/h".')
    ] = "0:10",
    over: Annotated[
        str | None,
        typer.Option("--over", metavar="PARAMETER=START:STOP:COUNT", help="Vary a parameter: trail=40mm:80mm:9."),
    ] = None,
    kind: Annotated[
        OverKind,
        typer.Option("--as", help="With --over: a family of curves, the parameter on an axis, or a stability map."),
    ] = OverKind.family,
    at: Annotated[str, typer.Option("--at", metavar="SPEED", help="With --as axis: the speed.")] = "5",
    bands: Annotated[
        bool, typer.Option("--bands", help="Shade the central 95 % that the standard deviations make.")
    ] = False,
    kmh: Annotated[bool, typer.Option("--kmh", help="Speeds in km/h.")] = False,
    limit: Annotated[
        float, typer.Option("--limit", min=0.1, max=1e3, help="Eigenvalues shown up to this, 1/s.")
    ] = 10.0,
    width: WidthOption = "84 mm",
    title: TitleOption = "",
) -> None:
    """Draw eigenvalues over speed or a parameter, or the map of where a bicycle is stable."""
    check_figure(output)
    look: dict[str, Any] = {"width": millimetres(width), "title": title}
    unit = KILOMETRES if kmh else METRES
    ends = _ends(speeds)
    made = [model_from(bicycle, options) for bicycle in bicycles]
    if over is None:
        fine = np.linspace(*ends, _FINE)
        drawn = [_drawn(one, options, fine, bands=bands) for one in made]
        deliver_figure(_eigenvalues(drawn, look | {"unit": unit, "limit": limit}), output)
        return
    design = _only(made, options, bands=bands)
    figure = _varied(design, over, kind, at, ends, look, unit, limit)
    deliver_figure(figure, output)


def _varied(
    design: Design,
    over: str,
    kind: OverKind,
    at: str,
    ends: tuple[float, float],
    look: dict[str, Any],
    unit: SpeedUnit,
    limit: float,
) -> Figure:
    """Return the figure of a parameter that varies."""
    name, values = parse_over(design, over)
    label, factor = axis_label(design, name)
    if kind is OverKind.map:
        rows = np.linspace(values[0], values[-1], max(_ROWS, len(values)))
        found = stability_map(design, name, rows)
        _say_lost(family(design, name, rows), label, factor)
        return map_figure(found, factor, label, ends[1], **look, unit=unit)
    if kind is OverKind.axis:
        rows = np.linspace(values[0], values[-1], max(_ROWS, len(values)))
        along = family(design, name, rows)
        _say_lost(along, label, factor)
        return parameter_figure(rows * factor, along.modes(parse_speeds(at, "--at")[:1]), label, **look, limit=limit)
    some = family(design, name, values)
    _say_lost(some, label, factor)
    return _family(some, np.linspace(*ends, _FINE), label, factor, look, unit, limit)


def _ends(text: str) -> tuple[float, float]:
    """Return the lowest and the highest speed in m/s; a count that is given is not needed."""
    parts = text.split(":")
    if len(parts) not in {2, 3}:
        raise InputError(f'--speeds {text!r}: must be START:STOP, e.g. "0:10" or "0 km/h:36 km/h"')
    fine = parse_speeds(":".join([*parts[:2], "2"]))
    return float(fine[0]), float(fine[-1])


def _eigenvalues(drawn: list[Drawn], look: dict[str, Any]) -> Figure:
    return single_figure(drawn[0], **look) if len(drawn) == 1 else overlay_figure(drawn, **look)


def _drawn(made: Made, options: ModelOptions, speeds: np.ndarray, *, bands: bool) -> Drawn:
    uncertainty = None
    if bands:
        _closed_form_only(options, "--bands")
        coarse = np.linspace(speeds[0], speeds[-1], 101)
        uncertainty = eigenvalue_uncertainty(made.bicycle, made.rider, options.sitting, speeds=coarse, samples=500)
    return Drawn(made.title, made.asked.modes(speeds), made.asked.critical_speeds(), uncertainty)


def _closed_form_only(options: ModelOptions, what: str) -> None:
    if options.engine is EngineName.multibody:
        raise InputError(f"{what}: takes the closed form; leave --engine away")


def _only(made: list[Made], options: ModelOptions, *, bands: bool) -> Design:
    """Return the one design that a parameter is varied of."""
    _closed_form_only(options, "--over")
    if len(made) > 1:
        raise InputError(f"--over: varies one bicycle, found {len(made)}")
    if bands:
        raise InputError("--over and --bands exclude each other")
    (one,) = made
    return Design.of(one.bicycle, one.rider, options.sitting, one.title)


def _say_lost(found: Family, label: str, factor: float) -> None:
    """Warn of designs that cannot exist: how many, and the first reason of each cause."""
    name, _, bracket = label.partition(" (")
    lost = found.lost()
    if not lost:
        return
    count = sum(number for number, _, _ in lost)
    words = [f"{number} from {value * factor:.4g} {bracket[:-1]} on, {reason}" for number, value, reason in lost]
    text = f"{count} of {len(found.values)} values of {name} make no design that can exist; they are left out: "
    warnings.warn(text + "; ".join(words), OddityWarning, stacklevel=3)


def _family(
    found: Family, speeds: np.ndarray, label: str, factor: float, look: dict[str, Any], unit: Any, limit: float
) -> Figure:
    good = found.model.valid
    values, kept = found.values[good] * factor, [found.model[int(i)] for i in np.flatnonzero(good)]
    name, _, bracket = label.partition(" (")
    words = [f"{name} {value:.4g} {bracket[:-1]}" for value in values]
    drawn = [Drawn(w, modes(m, speeds), critical_speeds(m)) for w, m in zip(words, kept, strict=True)]
    return overlay_figure(drawn, **look, unit=unit, limit=limit, scale=(label, values.tolist()))
