"""``singletrack critical-speeds``."""

from __future__ import annotations

from singletrack.commands.model import model_from
from singletrack.commands.model_options import ModelOptions
from singletrack.commands.options import BicycleArgument, JsonOption
from singletrack.commands.printing import print_json, show
from singletrack.present.tables import critical_speeds_text

__all__ = ["run"]


def run(bicycle: BicycleArgument, options: ModelOptions, json: JsonOption = False) -> None:
    """Print weave and capsize speeds and the stable ranges."""
    made = model_from(bicycle, options)
    speeds = made.asked.critical_speeds()
    if json:
        print_json(speeds.to_dict())
    else:
        show(f"{made.title}\n{critical_speeds_text(speeds)}")
