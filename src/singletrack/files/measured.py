"""Raw measurements of the BicycleParameters package: one ``name = value+/-deviation`` a line, units by name."""

from __future__ import annotations

import re
from pathlib import Path
from typing import TYPE_CHECKING

from singletrack.files.format import Format
from singletrack.files.measured_template import measured_template
from singletrack.files.text_lines import read_values
from singletrack.measuring.measurement import measure
from singletrack.parameters.symbols import NAMES

if TYPE_CHECKING:
    from singletrack.files.format import Clues
    from singletrack.measuring.measurement import Measurement
    from singletrack.parameters.bicycle import Bicycle

__all__ = ["FORMAT", "read_measured", "read_measured_bicycle"]


def read_measured(text: str, where: str, centre_fit: str = "perpendicular") -> Measurement:
    """Return the bicycle that a text of raw measurements describes, with its uncertainties.

    Parameters
    ----------
    text : str
        Lines ``name = value+/-deviation`` with the names of
        :data:`singletrack.measuring.quantities.MEASURED_QUANTITIES`.
    where : str
        The file's name, for messages.
    centre_fit : {"perpendicular", "vertical", "intersections"}
        As for :func:`singletrack.measuring.measurement.measure`.

    Raises
    ------
    InputError
        Names file, line, measurement, what was found and what is allowed.
    """
    given = read_values(text, where)
    source = f"raw measurements {Path(where).name}"
    places = {**_LOCATES, **{name: name for name in given.lines}}
    return given.build(
        lambda: measure(given.values(), given.deviations(), centre_fit, name=given.name, source=source), places
    )


def read_measured_bicycle(text: str, where: str) -> Bicycle:
    """Return the bicycle alone (arguments as for :func:`read_measured`)."""
    return read_measured(text, where).bicycle


def _recognises(clues: Clues) -> bool:
    return any(re.fullmatch(r"T[ct][A-Z][0-9]|alpha[BHGS][0-9]", name) for name in clues.values)


FORMAT = Format(
    name="measured",
    description="raw measurements of BicycleParameters",
    recognises=_recognises,
    read_bicycle=read_measured_bicycle,
    templates={"measurements": measured_template},
)


#: The measurement to look at first when a parameter is impossible.
_LOCATES = {
    **{NAMES[f"{letter}"]: letter for letter in ("w", "g", "mR", "mF", "mB", "mH")},
    **{NAMES[s]: name for s, name in {"rR": "dR", "rF": "dF", "c": "f", "lam": "gamma"}.items()},
    **{NAMES[f"I{b}xx"]: f"Tt{b}1" for b in "RFBH"},
    **{NAMES[f"I{b}yy"]: f"Tc{b}1" for b in "RFBH"},
    **{NAMES[f"I{b}{axes}"]: f"Tt{b}{i}" for b in "BH" for axes, i in (("xz", 2), ("zz", 3))},
    **{NAMES[f"{axis}{b}"]: f"a{b}1" for b in "BH" for axis in "xz"},
    **{NAMES[s]: s for s in ("hbb", "lcs", "lsp", "lst", "lamst", "lf", "wfh", "wrh")},
    "stem_length": "LhbR",
    "handlebar_length": "LhbF",
}
