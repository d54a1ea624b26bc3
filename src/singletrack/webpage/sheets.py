"""The page's geometry sheets: one for each kind of handlebar, with what it begins at, as a function to be traced."""

from __future__ import annotations

import functools
from dataclasses import dataclass
from typing import Any

import jax.numpy as jnp

from singletrack.catalogue import Expected, expected
from singletrack.catalogue.expected import SIZES
from singletrack.catalogue.tables import entries

__all__ = ["PageSheet", "page_sheets"]

#: What the three sheets begin at: a trekking bicycle, a city bicycle, a road bicycle.
_SHEETS: dict[str, dict[str, Any]] = {
    "flat": {
        "head_angle": "70.5 deg",
        "fork_offset": "45 mm",
        "wheel_size": "37-622",
        "wheel_base": "1.06 m",
        "rear_frame_mass": "7.6 kg",
        "front_frame_mass": "2.9 kg",
        "rear_wheel_mass": "2.6 kg",
        "front_wheel_mass": "2.0 kg",
        "with_parts": ["diamond", "rigid fork"],
    },
    "city": {
        "head_angle": "68.5 deg",
        "fork_offset": "55 mm",
        "wheel_size": "40-622",
        "wheel_base": "1.11 m",
        "rear_frame_mass": "9.6 kg",
        "front_frame_mass": "3.4 kg",
        "rear_wheel_mass": "3.3 kg",
        "front_wheel_mass": "2.4 kg",
        "with_parts": ["carrier", "kickstand", "rear mudguard", "front mudguard", "rigid fork"],
    },
    "drop": {
        "head_angle": "73 deg",
        "fork_offset": "44 mm",
        "wheel_size": "28-622",
        "wheel_base": "1.00 m",
        "rear_frame_mass": "5.3 kg",
        "front_frame_mass": "2.2 kg",
        "rear_wheel_mass": "1.9 kg",
        "front_wheel_mass": "1.4 kg",
        "with_parts": ["diamond", "rigid fork", "derailleur"],
        "without_parts": ["carrier", "kickstand", "ring lock", "basket", "rear mudguard", "front mudguard"],
    },
}
#: Entries of the form, besides tyres, in its order.
_ENTRIES = (
    *("head_angle", "fork_offset", "wheel_base", "chain_stay_length", "bottom_bracket_drop", "stack", "fork_length"),
    *("seat_tube_angle", "seat_tube_length", "saddle_height", "stem_length", "stem_angle", "spacers"),
    *("bar_width", "bar_rise", "bar_sweep"),
    *(f"{end}_{body}_mass" for body in ("frame", "wheel") for end in ("rear", "front")),
)


@dataclass(frozen=True, eq=False)
class PageSheet:
    """A sheet of the page.

    Attributes
    ----------
    bar : str
        Kind of handlebar.
    expected : Expected
        What bicycles it makes.
    inputs : dict of str to float
        Entries that its program reads, in order, with what they begin at, in SI.
    outputs : tuple of str
        Parameters of the bicycle that the program writes, in order.
    """

    bar: str
    expected: Expected
    inputs: dict[str, float]
    outputs: tuple[str, ...]

    @property
    def name(self) -> str:
        """Of its program."""
        return f"sheet_{self.bar}"

    def program(self, inputs: Any) -> Any:
        """Return the parameters (m,) for entries ``inputs`` (n,), JAX."""
        changes = {name: inputs[i : i + 1] for i, name in enumerate(self.inputs)}
        found = self.expected.parameters(changes)
        return jnp.stack([found[name][0] for name in self.outputs])

    def described(self) -> dict[str, Any]:
        """Return it for the page's manifest."""
        known = entries()
        rows = [
            {
                "name": name,
                "unit": "m" if name in SIZES else known[name].unit,
                "meaning": name if name in SIZES else known[name].meaning,
                "value": value,
            }
            for name, value in self.inputs.items()
        ]
        return {"bar": self.bar, "program": self.name, "inputs": rows, "outputs": list(self.outputs)}


@functools.cache
def page_sheets() -> tuple[PageSheet, ...]:
    """Return the sheets that the page knows, by kind of handlebar."""
    found = []
    for bar, given in _SHEETS.items():
        made = expected(_ENTRIES, bar=bar, **given)
        width, diameter = (int(part) / 1000 for part in given["wheel_size"].split("-"))
        sizes = dict(zip(SIZES, (width, diameter) * 2, strict=True))
        inputs = {name: float(made.values[name]) for name in _ENTRIES} | sizes
        # The page's programs seat riders with hands as far apart as their shoulders: they read no handlebar_width.
        outputs = tuple(name for name in made.parameters({}) if name != "handlebar_width")
        found.append(PageSheet(bar, made, inputs, outputs))
    return tuple(found)
