"""Raw measurements of the BicycleParameters package: one ``name = value+/-deviation`` a line, units by name."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from singletrack.errors import InputError
from singletrack.files.text import read_entries
from singletrack.measuring.pendulums import measure
from singletrack.measuring.raw import RAW, orientations
from singletrack.parameters.symbols import NAMES

if TYPE_CHECKING:
    from singletrack.files.entries import Entries
    from singletrack.measuring.pendulums import Measurement
    from singletrack.parameters.bicycle import Bicycle

__all__ = ["read_measured", "read_measured_bicycle"]


def read_measured(text: str, where: str, centre_fit: str = "perpendicular") -> Measurement:
    """Return the bicycle that a text of raw measurements describes, with its uncertainties.

    Parameters
    ----------
    text : str
        Lines ``name = value+/-deviation`` with the names of :data:`singletrack.measuring.raw.RAW`.
    where : str
        The file's name, for messages.
    centre_fit : {"perpendicular", "vertical", "intersections"}
        As for :func:`singletrack.measuring.pendulums.measure`.

    Raises
    ------
    InputError
        Names file, line, measurement, what was found and what is allowed.
    """
    entries = read_entries(text, where)
    _check(entries)
    source = f"raw measurements {Path(where).name}"
    return entries.build(
        lambda: measure(entries.values(), entries.deviations(), centre_fit, name=entries.name, source=source), _LOCATES
    )


def read_measured_bicycle(text: str, where: str) -> Bicycle:
    """Return the bicycle alone (arguments as for :func:`read_measured`)."""
    return read_measured(text, where).bicycle


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


def _check(entries: Entries) -> None:
    """Raise InputError for measurements that are unknown, missing or not allowed; names file, line, name."""
    entries.require_known(RAW, "measurement")
    entries.require([name for name, p in RAW.items() if p.needed], "the measurements")
    for name, quantity in entries.quantities.items():
        p = RAW[name]
        if not p.low < quantity.value < p.high or abs(quantity.value) > 1e6 or (p.low == 0 and quantity.value < 1e-6):
            high = min(p.high, 1e6)
            raise InputError(
                f"{entries.place(name)}: {name} = {quantity.value:g} {p.unit}".rstrip()
                + f", must be between {max(p.low, -1e6):g} and {high:g} ({p.meaning})"
            )
        if quantity.deviation is not None and quantity.deviation > abs(quantity.value) + 1:
            raise InputError(
                f"{entries.place(name)}: {name} has a standard deviation of {quantity.deviation:g} {p.unit}, must be "
                f"less than the value's size ({p.meaning})"
            )
    for letter in "BH":
        numbers = orientations(entries.quantities, letter)
        entries.require([f"{kind}{letter}{i}" for i in numbers for kind in ("a", "Tt")], "the measurements")
