"""From polynomials in the speed to what is proven: where roots reach the imaginary axis, and on which side they are.

Roots pass from one side of the axis to the other only where one is zero, a_0(v) = 0, or where two add up to zero,
D(v) = 0 (:func:`~singletrack.certify.determinants.bezout_determinant`). Between such speeds the number of unstable
roots is the same, for all designs of a connected set, so that counting it at one speed of one design is enough.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cmp_to_key
from typing import TYPE_CHECKING, Any

import flint

from singletrack.certify.counting import alternates, unstable_roots
from singletrack.certify.families import Family
from singletrack.certify.isolation import isolate

if TYPE_CHECKING:
    from collections.abc import Sequence


__all__ = ["Event", "Factor", "Outcome", "analysed"]

#: Speeds at which roots are counted before it is given up, as parts of the range between two events.
_PLACES = (1, 2, 3, 5, 6, 7, 9, 10, 11, 13)
_OF = 16
#: How often an interval is halved to see that no root is on the axis.
_HALVINGS = 6


@dataclass(frozen=True)
class Factor:
    """Polynomials in the speed whose zeros are events: of a "real" root, of a "pair", or of "both" at once.

    ``halves`` are the even and the odd coefficients a_k(v), over all designs. Where two roots that add up to zero are
    on the axis, s² = z <= 0 is a root of both Σ a_2k z^k and Σ a_2k+1 z^k: not where the signs of either alternate.
    """

    family: Family
    kind: str
    halves: tuple[tuple[Family, ...], ...] = ()

    def is_off_axis(self, low: Any, high: Any, halvings: int = _HALVINGS) -> bool:
        """Tell whether roots that add up to zero between two speeds are seen not to be on the axis.

        Parameters
        ----------
        low, high : arb
            In m/s.
        halvings : int
            How often the interval may be halved.
        """
        if not self.halves or not high.is_finite():
            return False
        if any(alternates([one.sign_over(low, high) for one in half]) for half in self.halves):
            return True
        middle = ((low + high) / 2).mid()
        parts = ((low, middle), (middle, high))
        return halvings > 0 and all(self.is_off_axis(*part, halvings - 1) for part in parts)


@dataclass(frozen=True)
class Event:
    """A speed (if single: exactly one, for each design) or an undecided interval, between low and high (arbs)."""

    low: Any
    high: Any
    kind: str
    single: bool


@dataclass(frozen=True)
class Outcome:
    """Events in order; counts of unstable roots before, between and after them; where they were counted.

    A count is None where it cannot be told, and where there is no room between two events.
    """

    events: tuple[Event, ...]
    counts: tuple[int | None, ...]
    witnesses: tuple[Any, ...]

    @property
    def is_decided(self) -> bool:
        """Whether every event is a single speed and every count is known."""
        return all(event.single for event in self.events) and None not in self.counts

    @property
    def pattern(self) -> tuple[Any, ...]:
        """What two outcomes share if they say the same but for the numbers."""
        return tuple(event.kind for event in self.events), self.counts


def analysed(factors: Sequence[Factor], coefficients: Sequence[Any], finest: int) -> Outcome:
    """Return where stability may change, and the numbers of unstable roots.

    Parameters
    ----------
    factors : sequence of Factor
        Enclosures over all designs, free of powers of v.
    coefficients : sequence of arb_poly, shape (2 n + 1,)
        a_k(v) of one of the designs, as sharp as possible.
    finest : int
        As for :func:`~singletrack.certify.isolation.isolate`.
    """
    found = [
        Event(interval.low, interval.high, factor.kind, interval.single)
        for factor in factors
        for interval in isolate(factor.family, finest)
        if not factor.is_off_axis(interval.low, interval.high)
    ]
    events = _apart(sorted(found, key=cmp_to_key(_order)))
    counts, witnesses = [], []
    for before, after in zip((None, *events), (*events, None), strict=True):
        count, witness = _counted(coefficients, before, after)
        counts.append(count)
        witnesses.append(witness)
    return Outcome(tuple(events), tuple(counts), tuple(witnesses))


def _order(one: Event, other: Event) -> int:
    """Compare lower ends exactly: many events may round to the same double."""
    return -1 if bool(one.low < other.low) else int(bool(one.low > other.low))


def _apart(events: list[Event]) -> list[Event]:
    """Return events with those that cannot be told apart made one, undecided."""
    apart: list[Event] = []
    for event in events:
        if apart and not bool(apart[-1].high < event.low):
            last = apart.pop()
            high = last.high if bool(last.high > event.high) else event.high
            kind = last.kind if last.kind == event.kind else "both"
            apart.append(Event(last.low, high, kind, single=False))
        else:
            apart.append(event)
    return apart


def _counted(coefficients: Sequence[Any], before: Event | None, after: Event | None) -> tuple[int | None, Any]:
    """Return the number of unstable roots between two events, and a speed at which it was counted."""
    low = flint.arb(0) if before is None else before.high
    if not low.is_finite() or (after is not None and not bool(low < after.low)):
        return None, None
    high = 2 * low + 1 if after is None else after.low
    for place in _PLACES:
        speed = (low + (high - low) * place / _OF).mid()
        if not (bool(speed > low) and bool(speed < high)):
            continue
        count = unstable_roots([coefficient(speed) for coefficient in coefficients])
        if count is not None:
            return count, speed
    return None, None
