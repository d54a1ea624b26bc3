"""``singletrack eigenvalues``."""

from __future__ import annotations

from singletrack.commands.model import model_from
from singletrack.commands.model_options import ModelOptions
from singletrack.commands.options import BicycleArgument, CsvOption, JsonOption, SpeedsOption
from singletrack.commands.printing import print_json, print_plain, show
from singletrack.errors import InputError
from singletrack.files.speeds import parse_speeds
from singletrack.present.tables import eigenvalues_csv, eigenvalues_table

__all__ = ["run"]


def run(
    bicycle: BicycleArgument,
    options: ModelOptions,
    speeds: SpeedsOption = "0:10:11",
    json: JsonOption = False,
    csv: CsvOption = False,
) -> None:
    """Print the eigenvalues at forward speeds."""
    if json and csv:
        raise InputError("--json and --csv exclude each other")
    values = parse_speeds(speeds)
    made = model_from(bicycle, options)
    modes = made.model.modes(values)
    if json:
        print_json(modes.to_dict())
    elif csv:
        print_plain(eigenvalues_csv(modes))
    else:
        show(eigenvalues_table(modes, made.title))
