"""``singletrack coefficients``."""

from __future__ import annotations

from singletrack.commands.model import model_from
from singletrack.commands.model_options import ModelOptions
from singletrack.commands.options import BicycleArgument, JsonOption
from singletrack.commands.printing import print_json, show
from singletrack.present.tables import coefficients_table

__all__ = ["run"]


def run(bicycle: BicycleArgument, options: ModelOptions, json: JsonOption = False) -> None:
    """Print the coefficient matrices."""
    made = model_from(bicycle, options)
    if json:
        print_json(made.model.to_dict())
    else:
        show(coefficients_table(made.model, made.title))
