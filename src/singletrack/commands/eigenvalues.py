"""``singletrack eigenvalues``."""

from __future__ import annotations

from typing import TYPE_CHECKING

from singletrack.closed_form import Tyre, tyre_model
from singletrack.commands.model import model_from
from singletrack.commands.model_options import EngineName, ModelOptions
from singletrack.commands.options import BicycleArgument, CsvOption, JsonOption, SpeedsOption, TyresOption
from singletrack.commands.printing import print_json, print_plain, show
from singletrack.errors import InputError
from singletrack.files.speeds import parse_speeds
from singletrack.parameters.units import parse_quantity
from singletrack.present.tables import eigenvalues_csv, eigenvalues_table
from singletrack.present.tyres import roots_csv, roots_dict, roots_table

if TYPE_CHECKING:
    import numpy as np

__all__ = ["run"]

_TYRE = {"cornering": "N/rad", "camber": "N/rad", "relaxation": "m"}


def run(
    bicycle: BicycleArgument,
    options: ModelOptions,
    speeds: SpeedsOption = "0:10:11",
    tyres: TyresOption = None,
    json: JsonOption = False,
    csv: CsvOption = False,
) -> None:
    """Print the eigenvalues at forward speeds."""
    if json and csv:
        raise InputError("--json and --csv exclude each other")
    values = parse_speeds(speeds)
    if tyres is not None:
        _on_tyres(bicycle, options, values, tyres, json=json, csv=csv)
        return
    made = model_from(bicycle, options)
    modes = made.asked.modes(values)
    if json:
        print_json(modes.to_dict())
    elif csv:
        print_plain(eigenvalues_csv(modes))
    else:
        show(eigenvalues_table(modes, made.title))


def _on_tyres(bicycle: str, options: ModelOptions, speeds: np.ndarray, tyres: str, *, json: bool, csv: bool) -> None:
    """Print the eigenvalues of a bicycle whose tyres slip; they have no names."""
    if options.engine is EngineName.multibody:
        raise InputError("--tyres: only the closed form has tyres that slip; leave --engine away")
    front, rear = _tyres(tyres)
    made = model_from(bicycle, options)
    roots = tyre_model(made.bicycle, front, rear, made.rider, options.sitting).eigenvalues(speeds)
    if json:
        print_json(roots_dict(speeds, roots))
    elif csv:
        print_plain(roots_csv(speeds, roots))
    else:
        show(roots_table(speeds, roots, f"{made.title}, on tyres"))


def _tyres(text: str) -> tuple[Tyre, Tyre]:
    """Return front and rear tyre."""
    given = [_tyre(part) for part in _ends(text)]
    return given[0], given[-1]


def _ends(text: str) -> list[str]:
    """Return the parts for front and rear; the stroke between them stands in the third value, those of units do not."""
    words = text.split(",")
    if len(words) <= len(_TYRE):
        return [text]
    if len(words) != 2 * len(_TYRE) - 1 or "/" not in words[2]:
        raise InputError(f"--tyres {text!r}: must be three values, or three for the front / three for the rear")
    last, _, first = words[2].partition("/")
    return [",".join([*words[:2], last]), ",".join([first, *words[3:]])]


def _tyre(text: str) -> Tyre:
    words = [word.strip() for word in text.split(",")]
    if len(words) != len(_TYRE):
        raise InputError(f"--tyres {text!r}: found {len(words)} values, must be cornering, camber, relaxation")
    values = {}
    for (name, unit), word in zip(_TYRE.items(), words, strict=True):
        try:
            values[name] = parse_quantity(word, unit).value
        except InputError as error:
            raise error.at(f"--tyres: {name}") from None
    return Tyre(**values)
