"""Numbers in words: one way to write a quantity, a speed, a range of speeds."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, NamedTuple

from singletrack.files.toml_write import unit_text

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from singletrack.arrays import Number
    from singletrack.linear import AlwaysUnstable, CriticalSpeeds
    from singletrack.linear.critical import Crossing

__all__ = [
    "KILOMETRES",
    "METRES",
    "SpeedUnit",
    "critical_speed_lines",
    "deviation_text",
    "quantity_text",
    "range_text",
    "speed_text",
]


class SpeedUnit(NamedTuple):
    """A unit of speed in figures: its name, and what a speed in m/s is multiplied with."""

    name: str
    factor: float


METRES, KILOMETRES = SpeedUnit("m/s", 1.0), SpeedUnit("km/h", 3.6)


def quantity_text(values: Sequence[float], unit: str) -> str:
    """Return SI numbers for reading, angles in degrees.

    Parameters
    ----------
    values : sequence of float
    unit : str
        As pint writes it.

    Examples
    --------
    >>> quantity_text([1.0, 0.5], "m"), quantity_text([math.pi / 10], "rad"), quantity_text([2.0], "kg*m**2")
    ('1, 0.5 m', '18 deg', '2 kg*m^2')
    """
    numbers = ", ".join(f"{_for_people(value, unit):.6g}" for value in values)
    return f"{numbers} {unit_text(unit)}".rstrip()


def deviation_text(deviation: Number | None, unit: str) -> str:
    """Return a standard deviation beside its quantity, or nothing where there is none.

    Parameters
    ----------
    deviation : float or None
        SI.
    unit : str

    Examples
    --------
    >>> deviation_text(0.00123, "m"), deviation_text(None, "m")
    ('± 0.0012', '')
    """
    return "" if deviation is None else f"± {_for_people(float(deviation), unit):.2g}"


def _for_people(value: float, unit: str) -> float:
    return math.degrees(value) if unit == "rad" else value


def speed_text(speed: float, deviation: float | None = None) -> str:
    """Return a speed in m/s, with its standard deviation if given.

    >>> speed_text(4.2924), speed_text(4.2924, 0.0123)
    ('4.292 m/s', '4.292 ± 0.012 m/s')
    """
    return f"{speed:.3f} m/s" if deviation is None else f"{speed:.3f} ± {deviation:.2g} m/s"


def range_text(low: float, high: float) -> str:
    """Return a range of speeds, from low to high, in m/s; high may be infinite.

    >>> range_text(4.2924, 6.0243), range_text(3.6053, math.inf)
    ('4.292 to 6.024 m/s', 'above 3.605 m/s')
    """
    return f"above {speed_text(low)}" if math.isinf(high) else f"{low:.3f} to {speed_text(high)}"


def critical_speed_lines(
    critical: CriticalSpeeds,
    deviations: Mapping[str, Sequence[float]] | None = None,
    unstable: Sequence[AlwaysUnstable] = (),
) -> dict[str, str]:
    """Return critical speeds and stable ranges of a single design: what they are, and the words for it.

    Where a mode gains or loses stability otherwise than bicycles do (weave gains it, capsize loses it), that is said.

    Parameters
    ----------
    critical : CriticalSpeeds
    deviations : mapping of "weave", "capsize" to sequences of float, optional
        Standard deviations of the speeds in m/s.
    unstable : sequence of AlwaysUnstable, optional
        What is unstable where no speed is stable.
    """
    if critical.status == "could not tell":
        return dict.fromkeys(("weave speed", "capsize speed", "stable"), "could not tell")
    lines = {}
    for mode, kind in (("weave", "pair"), ("capsize", "real")):
        crossings = [crossing for crossing in critical.crossings if crossing.kind == kind]
        spreads = (deviations or {}).get(mode, [None] * len(crossings))
        texts = [
            speed_text(crossing.speed, spread) + _direction(crossing, mode)
            for crossing, spread in zip(crossings, spreads, strict=True)
        ]
        lines[f"{mode} speed"] = ", ".join(texts) or "never"
    never = f"never{': ' if unstable else ''}{'; '.join(map(_unstable_text, unstable))}"
    lines["stable"] = ", ".join(range_text(*bounds) for bounds in critical.stable_ranges) or never
    return lines


def _unstable_text(found: AlwaysUnstable) -> str:
    """Return what a mode does that is unstable at every speed, and how fast."""
    verb = "oscillates ever wider" if found.oscillates else "falls"
    least, most = (f"{value:.2f}" for value in found.growth)
    span = f"+{most}" if least == most else f"+{least} to +{most}"
    return f"{found.mode} {verb} at every speed ({span} 1/s below 10 m/s)"


def _direction(crossing: Crossing, mode: str) -> str:
    """Return what a crossing does where it is not what every bicycle does: weave gains stability, capsize loses it."""
    whose = "" if crossing.mode == mode else f"{crossing.mode} "
    usual = "gained" if mode == "weave" else "lost"
    if not whose and crossing.direction == usual:
        return ""
    return f" ({whose}stability {crossing.direction})"
