"""``singletrack critical-speeds``."""

from __future__ import annotations

import dataclasses
import importlib
from typing import TYPE_CHECKING, Annotated, Any

import numpy as np
import typer
from rich.progress import BarColumn, Progress, TextColumn

from singletrack.commands.model import Made, model_from
from singletrack.commands.model_options import EngineName, ModelOptions, pairs
from singletrack.commands.options import BicycleArgument, JsonOption
from singletrack.commands.printing import print_json, show
from singletrack.errors import InputError
from singletrack.linear import always_unstable
from singletrack.model import LinearModel
from singletrack.present.certificates import certificate_text
from singletrack.present.tables import critical_speeds_text
from singletrack.present.terminal import Terminal
from singletrack.public.certifying import certifier

if TYPE_CHECKING:
    from collections.abc import Callable

__all__ = ["run"]

CertifyOption = Annotated[
    bool, typer.Option("--certify", help="Prove the speeds by ball arithmetic, for the parameters exactly as written.")
]
OverOption = Annotated[
    list[str] | None,
    typer.Option(
        "--over", metavar="NAME=FROM:TO", help='With --certify: for every value between, e.g. "trail=55 mm:57 mm".'
    ),
]


def run(
    bicycle: BicycleArgument,
    options: ModelOptions,
    json: JsonOption = False,
    certify: CertifyOption = False,
    over: OverOption = None,
) -> None:
    """Print weave and capsize speeds and the stable ranges."""
    if over and not certify:
        raise InputError("--over: says which designs are certified, and there is no --certify")
    made = model_from(bicycle, options)
    if certify:
        certificate = _certificate(made, options, over)
        if json:
            print_json(certificate.to_dict())
        else:
            show(f"{made.title}\n{certificate_text(certificate)}")
        return
    speeds = made.asked.critical_speeds()
    unstable = always_unstable(made.model, speeds)
    if json:
        # Two freedoms have the JSON of version 0.1.
        more = {"unstable": [one.to_dict() for one in unstable]} if unstable and made.model.freedoms > 2 else {}
        print_json(speeds.to_dict() | more)
    else:
        show(f"{made.title}\n{critical_speeds_text(speeds, unstable=unstable)}")


def _certificate(made: Made, options: ModelOptions, over: list[str] | None) -> Any:
    if options.engine is not EngineName.closed_form:
        raise InputError("--certify: proves what the closed form says, and takes no --engine multibody")
    bounds = {name: _bounds(name, text) for name, text in pairs("--over", over).items()}
    room = certifier()
    added = _fed_back(made.model, options)
    try:
        return _with_progress(
            room.MOST_BOXES,
            lambda tell: room.certify_design(made.bicycle, made.rider, options.sitting, bounds, added, progress=tell),
        )
    except InputError as error:
        raise error.at("--certify") from None


def _with_progress(most: int, work: Callable[[Callable[[int], object]], Any]) -> Any:
    columns = (
        TextColumn("proving"),
        BarColumn(bar_width=24),
        TextColumn("{task.completed} of at most {task.total} boxes"),
    )
    console = Terminal(stderr=True)
    with Progress(*columns, console=console, transient=True, disable=not console.is_terminal) as bar:
        task = bar.add_task("boxes", total=most)
        return work(lambda looked: bar.update(task, completed=looked))


def _bounds(name: str, text: str) -> tuple[str, str]:
    low, sign, high = (part.strip() for part in text.partition(":"))
    if not sign or not low or not high or ":" in high:
        raise InputError(f'--over {name}={text}: must be FROM:TO, e.g. --over "trail=55 mm:57 mm"')
    return low, high


def _fed_back(model: LinearModel, options: ModelOptions) -> dict[str, np.ndarray]:
    """Return what feedback adds to matrices, {} without: that of a model whose own matrices are zero."""
    if options.answer is None:
        return {}
    names = ("C0", "C1", "S0", "K2")
    zeros: dict[str, Any] = {name: np.zeros(model.M.shape) for name in names}
    empty = dataclasses.replace(model, **zeros)
    control = importlib.import_module("singletrack.control")  # a door: few commands need it
    closed = control.closed_loop(empty, options.answer.gains)
    return {name: np.asarray(getattr(closed, name)) for name in names}
