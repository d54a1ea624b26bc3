"""``singletrack show``."""

from __future__ import annotations

from singletrack.analysis.outline import outline
from singletrack.analysis.summary import derived, results
from singletrack.body.oddities import warn_of_oddities
from singletrack.commands.model import model_from
from singletrack.commands.model_options import ModelOptions
from singletrack.commands.options import ThingArgument
from singletrack.errors import InputError
from singletrack.library import load_bicycle, load_rider, shipped
from singletrack.library.load import load_any
from singletrack.parameters import Rider
from singletrack.posture import Options, is_posture, load_posture, seat
from singletrack.posture.describe import mechanism_lines
from singletrack.present.printing import print_record, print_results
from singletrack.present.sketch import side_view
from singletrack.present.terminal import Terminal, Words

__all__ = ["run"]


def _show_posture(console: Terminal, name: str, options: ModelOptions) -> None:
    """Print a mechanism; with a rider, in his numbers on the first bicycle that he has a lean angle on."""
    mechanism, seated = load_posture(name), None
    if options.rider is not None:
        rider = load_rider(options.rider)
        known = [bicycle for bicycle in shipped("bicycle") if bicycle in rider.forward_lean_angles]
        if not known:
            raise InputError(
                f"{name}: rider {options.rider} has a lean angle on no shipped bicycle; show BICYCLE instead"
            )
        bicycle = load_bicycle(known[0])
        seated = seat(bicycle, rider, Options(mechanism))
        console.print(side_view(outline(bicycle, rider)))
        console.print(Words(f"{rider.name} on {bicycle.name}\n", "dim"))
    for line in mechanism_lines(mechanism, seated):
        console.print(line)


def run(name: ThingArgument, options: ModelOptions) -> None:
    """Print everything that follows from a bicycle or a rider, with a drawing; or what a posture is made of."""
    console = Terminal()
    if is_posture(name):
        _show_posture(console, name, options)
        return
    record = load_any(name)
    if isinstance(record, Rider):
        if options.rider is not None:
            raise InputError(f"{name}: is a rider, must be a bicycle to seat {options.rider} on")
        warn_of_oddities(record)
        print_record(console, record, derived(record))
        return
    made = model_from(name, options)
    console.print(side_view(outline(made.bicycle, made.rider)))
    console.print(Words("centres of mass: R rear wheel, B rear frame, H front frame, F front wheel\n", "dim"))
    for each in (made.bicycle, made.rider):
        if each is not None:
            print_record(console, each, derived(each))
    print_results(console, results(made.model, made.bicycle, made.rider, options.sitting), made.title)
