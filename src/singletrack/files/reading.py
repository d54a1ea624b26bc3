"""Which of the formats a text is in, and reading it."""

from __future__ import annotations

import re
from pathlib import Path
from typing import TYPE_CHECKING, TypeVar, cast

from singletrack.errors import InputError
from singletrack.files.measured import read_measured_bicycle
from singletrack.files.parameter_sets import read_parameter_set
from singletrack.files.text import read_bicycle_text
from singletrack.files.toml_read import parse_record
from singletrack.files.yeadon import read_yeadon
from singletrack.parameters.bicycle import Bicycle
from singletrack.parameters.record import Record

if TYPE_CHECKING:
    from collections.abc import Callable

__all__ = ["FORMATS", "format_of", "is_rider", "read_record"]

R = TypeVar("R", bound=Record)

#: Formats by name, in words.
FORMATS = {
    "toml": "singletrack's own TOML",
    "text": "a parameter text file of BicycleParameters",
    "measured": "raw measurements of BicycleParameters",
    "yaml": "a YAML parameter set of BicycleParameters",
    "yeadon": "Yeadon's 95 measurements",
    "configuration": "a configuration of Yeadon's human",
}

_BICYCLE_READERS: dict[str, Callable[[str, str], Record]] = {
    "text": read_bicycle_text,
    "measured": read_measured_bicycle,
    "yaml": read_parameter_set,
}
_RIDER_READERS: dict[str, Callable[[str, str], Record]] = {"yeadon": read_yeadon}


def format_of(text: str, where: str) -> str:
    """Return the format of a text, a key of :data:`FORMATS`: by the file's suffix, else by what it says.

    >>> format_of("w = 1.02", "bicycle.txt"), format_of("TcB1 = 1.6", "raw.txt"), format_of("", "a.toml")
    ('text', 'measured', 'toml')
    """
    suffix = Path(where).suffix.lower()
    return "toml" if suffix == ".toml" else _format_by_content(text, suffix)


def _format_by_content(text: str, suffix: str) -> str:
    names = set(re.findall(r"^\s*([A-Za-z]\w*)\s*[:=]", text, re.MULTILINE))
    if "measurementconversionfactor" in names or {"Ls1L", "La2L"} <= names:
        return "yeadon"
    if "somersault" in names:
        return "configuration"
    if "parameters" not in names and re.search(r"^\s*\[\s*parameters\s*\]|^\s*kind\s*=", text, re.MULTILINE):
        return "toml"
    if any(re.fullmatch(r"T[ct][A-Z]\d|alpha[BHGS]\d", name) for name in names):
        return "measured"
    if suffix in {".yml", ".yaml"}:
        return "yaml"
    equals = len(re.findall(r"^[^#\n:]*=", text, re.MULTILINE))
    colons = len(re.findall(r"^[^#\n=]*:", text, re.MULTILINE))
    return "yaml" if colons > equals else "text"


def is_rider(text: str, where: str) -> bool:
    """Tell whether a text describes a rider rather than a bicycle.

    >>> is_rider('kind = "rider"', "a.toml"), is_rider("w = 1.02", "b.txt")
    (True, False)
    """
    found = format_of(text, where)
    if found != "toml":
        return found in {"yeadon", "configuration"}
    kind = re.search(r"^\s*kind\s*=\s*[\"'](\w*)", text, re.MULTILINE)
    if kind:
        return kind[1] == "rider"
    return bool(re.search(r"^\s*(rider_mass|torso_length|chest_circumference)\s*=", text, re.MULTILINE))


def read_record(cls: type[R], text: str, where: str) -> R:
    """Return the bicycle or rider that a text in any of the formats describes.

    Raises
    ------
    InputError
        Names file, line, parameter, what was found and what is allowed.
    """
    found = format_of(text, where)
    if found == "toml":
        return parse_record(cls, text, where)
    if not text.strip():
        raise InputError(f"{where}: is empty; `singletrack template {cls.kind}` prints a file to fill in")
    readers = _BICYCLE_READERS if cls is Bicycle else _RIDER_READERS
    if found not in readers:
        allowed = ", ".join(FORMATS[name] for name in ("toml", *readers))
        raise InputError(f"{where}: looks like {FORMATS[found]}, must be a {cls.kind}: {allowed}")
    return cast("R", readers[found](text, where))
