"""Our own files: a bicycle or a rider in TOML, with units, standard deviations and comments."""

from __future__ import annotations

from typing import TYPE_CHECKING

from singletrack.files.format import Format
from singletrack.files.toml_read import parse_record
from singletrack.files.toml_template import template_of
from singletrack.files.toml_write import write_toml
from singletrack.parameters.bicycle import Bicycle
from singletrack.parameters.rider import Rider

if TYPE_CHECKING:
    from singletrack.files.format import Clues

__all__ = ["FORMAT"]

#: Parameters that every rider has and no bicycle.
_RIDERS_OWN = ("rider_mass", "torso_length", "chest_circumference")


def _recognises(clues: Clues) -> bool:
    ours = "parameters" in clues.tables or "kind" in clues.values
    return clues.suffix == ".toml" or (ours and "parameters" not in clues.values)


def _holds_rider(clues: Clues) -> bool:
    if "kind" in clues.values:
        return clues.values["kind"].strip("\"' ") == "rider"
    return any(name in clues.values for name in _RIDERS_OWN)


FORMAT = Format(
    name="toml",
    description="singletrack's own TOML",
    recognises=_recognises,
    suffixes=(".toml",),
    read_bicycle=lambda text, where: parse_record(Bicycle, text, where),
    read_rider=lambda text, where: parse_record(Rider, text, where),
    write_bicycle=write_toml,
    write_rider=write_toml,
    holds_rider=_holds_rider,
    templates={"bicycle": lambda: template_of(Bicycle), "rider": lambda: template_of(Rider)},
)
