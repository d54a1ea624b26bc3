"""A measured bicycle against another source of the same parameters."""

from __future__ import annotations

from dataclasses import dataclass
from decimal import Decimal
from typing import TYPE_CHECKING

from singletrack.parameters.symbols import MODEL_SYMBOLS, NAMES

if TYPE_CHECKING:
    from singletrack.parameters.bicycle import Bicycle

__all__ = ["ComparedParameter", "compare_measured"]

#: Differences up to this many standard deviations are what measuring twice gives (95 %).
_SIGMAS = 2.0


@dataclass(frozen=True)
class ComparedParameter:
    """One parameter in two sources.

    Attributes
    ----------
    name : str
    measured, deviation, other : float
        SI.
    ratio : float
        Difference (other less measured) over the standard deviation; 0 for equal values, infinite without deviation.
    agrees : bool
        Within two standard deviations, or equal to the digits of the other.
    reason : str
        Why they differ all the same, where it is known; "" otherwise.
    """

    name: str
    measured: float
    deviation: float
    other: float
    ratio: float
    agrees: bool
    reason: str


def compare_measured(measured: Bicycle, other: Bicycle) -> list[ComparedParameter]:
    """Compare the 25 parameters (and gravity) of a measured bicycle with another source's.

    The other source's numbers count as rounded to their last decimal digit. Where both moments of the wheels about a
    diameter differ but agree with those of the other wheel, they were exchanged.

    Examples
    --------
    >>> from singletrack import load_bicycle
    >>> stratos = load_bicycle("stratos")
    >>> all(agreement.agrees for agreement in compare_measured(stratos, stratos))
    True
    """
    rows = {name: _agreement(name, measured, other) for name in (NAMES[symbol] for symbol in MODEL_SYMBOLS)}
    wheels = ("rear_wheel_inertia_xx", "front_wheel_inertia_xx")
    if not any(rows[name].agrees for name in wheels):
        crossed = [_agreement(name, measured, other, twin) for name, twin in zip(wheels, wheels[::-1], strict=True)]
        if all(row.agrees for row in crossed):
            for name, twin in zip(wheels, wheels[::-1], strict=True):
                text = f"no: it is this bicycle's {twin}; front and rear are exchanged in the other source"
                rows[name] = _with_reason(rows[name], text)
    return [
        _with_reason(row, "yes: rounded") if row.agrees and abs(row.ratio) > _SIGMAS and not row.reason else row
        for row in rows.values()
    ]


def _agreement(name: str, measured: Bicycle, other: Bicycle, other_name: str = "") -> ComparedParameter:
    value, reference = float(getattr(measured, name)), float(getattr(other, other_name or name))
    deviation = float(measured.standard_deviations.get(name, 0.0))
    difference = reference - value
    ratio = 0.0 if difference == 0 else (difference / deviation if deviation else float("inf"))
    half_digit = _half_last_digit(reference)
    agrees = abs(difference) <= _SIGMAS * deviation + half_digit
    return ComparedParameter(name, value, deviation, reference, ratio, agrees, "")


def _half_last_digit(value: float) -> float:
    """Return half a unit of the last decimal digit that the shortest text of a number has, at least of the third.

    >>> _half_last_digit(0.338), _half_last_digit(1.0)
    (0.0005, 0.0005)
    """
    exponent = Decimal(repr(value)).as_tuple().exponent
    digits = max(-exponent, 3) if isinstance(exponent, int) else 3
    return 0.5 * 10.0**-digits


def _with_reason(row: ComparedParameter, reason: str) -> ComparedParameter:
    return ComparedParameter(row.name, row.measured, row.deviation, row.other, row.ratio, row.agrees, reason)
