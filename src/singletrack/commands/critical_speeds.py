"""``singletrack critical-speeds``."""

from __future__ import annotations

from singletrack.commands.model import model_from
from singletrack.commands.model_options import ModelOptions
from singletrack.commands.options import BicycleArgument, JsonOption
from singletrack.commands.printing import print_json, show
from singletrack.linear import always_unstable
from singletrack.present.tables import critical_speeds_text

__all__ = ["run"]


def run(bicycle: BicycleArgument, options: ModelOptions, json: JsonOption = False) -> None:
    """Print weave and capsize speeds and the stable ranges."""
    made = model_from(bicycle, options)
    speeds = made.asked.critical_speeds()
    unstable = always_unstable(made.model, speeds)
    if json:
        # Two freedoms have the JSON of version 0.1.
        more = {"unstable": [one.to_dict() for one in unstable]} if unstable and made.model.freedoms > 2 else {}
        print_json(speeds.to_dict() | more)
    else:
        show(f"{made.title}\n{critical_speeds_text(speeds, unstable=unstable)}")
