"""``singletrack turn``."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import numpy as np
import typer

from singletrack.commands.figures import check_figure
from singletrack.commands.model import seated
from singletrack.commands.model_options import ModelOptions
from singletrack.commands.options import BicycleArgument, JsonOption
from singletrack.commands.printing import deliver, print_json, show
from singletrack.commands.sheets import bicycle_named
from singletrack.errors import InputError
from singletrack.parameters.units import parse_quantity
from singletrack.present.style import figure_bytes
from singletrack.present.turning import turn_figure, turn_text
from singletrack.public import warn_of_oddities
from singletrack.public.turning import turn, turn_family

if TYPE_CHECKING:
    from singletrack.public.turning import Turn, TurnFamily

__all__ = ["number_of", "run"]


def run(
    bicycle: BicycleArgument,
    options: ModelOptions,
    speed: Annotated[str, typer.Option(help='Forward speed in m/s, or with a unit: "18 km/h".')],
    lean: Annotated[str | None, typer.Option(help='Lean angle in rad, or "20 deg"; to the right.')] = None,
    radius: Annotated[str | None, typer.Option(help="Radius of the rear wheel's track in m; to the right.")] = None,
    plot: Annotated[
        Path | None, typer.Option(help="Draw the eigenvalues of all turns at this speed here: .png, .svg or .pdf.")
    ] = None,
    json: JsonOption = False,
) -> None:
    """Print a steady turn: lean, steer, hand torque, path, forces, and whether it is stable."""
    if plot is not None:
        check_figure(plot)
    if (lean is None) == (radius is None):
        raise InputError("turn: found neither or both of --lean and --radius, must be one of them")
    if options.answer is not None:
        raise InputError("--feedback, --gains: a turn is held by constant torques; `singletrack ride` takes feedback")
    record, rider, changed = seated(bicycle_named(bicycle), options)
    warn_of_oddities(record, rider)
    v = number_of("--speed", speed, "m/s")
    found = turn(
        record,
        rider,
        options.sitting,
        speed=v,
        lean=None if lean is None else number_of("--lean", lean, "rad"),
        radius=None if radius is None else number_of("--radius", radius, "m"),
    )
    who = "" if rider is None else f" with {rider.name or 'rider'}, {options.sitting.title}"
    title = f"{record.name}{who}{changed}, {v:g} m/s"
    if plot is not None:
        family = turn_family(record, rider, options.sitting, speed=v, right=found.lean >= 0.0)
        deliver(_drawn(family, title, plot), plot)
    if json:
        print_json(found.to_dict())
    else:
        show(f"steady turn of {title}\n{_text(found)}")


def number_of(option: str, text: str, unit: str) -> float:
    """Return the value of an option, a number in SI or with a unit.

    Parameters
    ----------
    option, text : str
    unit : str
        Of the number, if it has none.

    Raises
    ------
    InputError
        If it is no quantity of this kind; the option is named.
    """
    try:
        return float(parse_quantity(text, unit).value)
    except InputError as error:
        raise InputError(f"{option}: {error}") from None


def _text(found: Turn) -> str:
    quantities = [
        ("lean", np.degrees(found.lean), "deg"),
        ("steer", np.degrees(found.steer), "deg"),
        ("hand torque", found.hand_torque, "N m"),
        ("path speed", found.path_speed, "m/s"),
        *([("path radius", found.radius, "m")] if np.isfinite(found.radius) else []),  # straight ahead: none
        ("lateral acceleration", found.lateral_acceleration, "m/s²"),
        ("yaw rate", found.yaw_rate, "rad/s"),
        ("friction demanded", found.friction, ""),
    ]
    forces = [(f"{name}, on it", force) for name, force in found.wheel_forces.items()]
    forces += [(f"{name}, on the bar", force) for name, force in found.hand_forces.items()]
    roots = list(zip(found.names, found.eigenvalues.tolist(), strict=True))
    verdict = "stable" if found.stable else "unstable"
    axes = "forces: forward, to the right, up on wheels, down on the bar"
    return f"{turn_text(quantities, forces, roots)}\n{verdict}; {axes}"


def _drawn(family: TurnFamily, title: str, plot: Path) -> bytes:
    lean = np.degrees([each.lean for each in family.turns])
    figure = turn_figure(lean, family.names, family.eigenvalues, title, family.end)
    return figure_bytes(figure, plot.suffix.lower().removeprefix("."))
