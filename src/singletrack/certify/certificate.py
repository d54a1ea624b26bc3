"""From what is proven of each box of designs to one certificate for all of them."""

from __future__ import annotations

from fractions import Fraction
from itertools import pairwise
from math import inf
from typing import TYPE_CHECKING, Any

import flint

from singletrack.certify.balls import Ball, ball_of, outward, precision
from singletrack.certify.boxes import Found, solved, solved_box
from singletrack.certify.counting import enclosed_roots
from singletrack.certify.families import sign
from singletrack.certify.record import Certificate, CertifiedCrossing, CertifiedRange, Eigenvalue

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping, Sequence

    from singletrack.certify.analysis import Event
    from singletrack.certify.problems import Problem

__all__ = ["MOST_BOXES", "certified", "eigenvalues_at"]

#: Boxes of designs that are looked at before the rest is left undecided.
MOST_BOXES = 600

Span = tuple[float, float]


def certified(
    problem: Problem,
    parameters: Mapping[str, str],
    most_boxes: int = MOST_BOXES,
    progress: Callable[[int], object] | None = None,
) -> Certificate:
    """Return the certificate of a problem.

    Parameters
    ----------
    problem : Problem
    parameters : mapping of str to str
        What was taken as exact, for the record.
    most_boxes : int
        Boxes of designs that are looked at before the rest is left undecided.
    progress : callable, optional
        Called with the number of boxes looked at so far.
    """
    boxes = solved_box(problem, most_boxes, progress) if problem.dimensions else [solved(problem)]
    rests = {found.at_rest for found in boxes}
    at_rest = rests.pop() if len(rests) == 1 else None
    common: dict[str, Any] = {"at_rest": at_rest, "bits": max(found.bits for found in boxes), "boxes": len(boxes)}
    always = {found.always for found in boxes}
    if len(always) == 1 and "" not in always:
        return Certificate(parameters, (), (), (), always=always.pop(), **common)
    crossings = _crossings(boxes)
    ranges = tuple(
        _with_witness(problem, CertifiedRange(low, high, count, 0.0), boxes) for low, high, count in _ranges(boxes)
    )
    covered = sorted([(r.start, r.stop) for r in ranges] + [(c.speed.lower, c.speed.upper) for c in crossings])
    undecided = _united([*_gaps(covered), *(span for found in boxes for span in _open_spans(found))])
    return Certificate(parameters, crossings, ranges, tuple(undecided), **common)


def _kept(found: Found) -> list[tuple[Event | None, int | None, int | None]]:
    """Return the events that matter, with the counts on both sides: changes, and touches of what is stable."""
    if found.outcome is None:
        return [(None, None, None)]
    counts = found.outcome.counts
    events = zip(found.outcome.events, pairwise(counts), strict=True)
    return [(event, *sides) for event, sides in events if not event.single or sides[0] != sides[1] or not sides[0]]


def _crossings(boxes: Sequence[Found]) -> tuple[CertifiedCrossing, ...]:
    """Return the crossings, those of several boxes put together; () if the boxes do not have the same ones."""
    lists = [
        [(event, before, after) for event, before, after in _kept(found) if _is_crossing(event, before, after)]
        for found in boxes
    ]
    if len({tuple((event.kind, before, after) for event, before, after in each if event) for each in lists}) > 1:
        return ()
    if len(boxes) > 1 and not all(found.is_decided for found in boxes):
        return ()
    found = []
    for same in zip(*lists, strict=True):
        (event, before, after), *_ = same
        low, high = same[0][0].low, same[0][0].high
        for other, *_ in same[1:]:
            low, high = (other.low if bool(other.low < low) else low), (other.high if bool(other.high > high) else high)
        direction = "gained" if after < before else "lost" if after > before else "touches"
        found.append(CertifiedCrossing(_speed(low, high), event.kind, direction, before, after))
    return tuple(found)


def _is_crossing(event: Event | None, before: int | None, after: int | None) -> bool:
    return event is not None and event.single and before is not None and after is not None


def _speed(low: Any, high: Any) -> Ball:
    with precision(4096):  # ends are exact: their ball is to be no wider than they are apart
        return ball_of(low.union(high))


def _ranges(boxes: Sequence[Found]) -> list[tuple[float, float, int]]:
    """Return (from, to, count) of all speeds at which all boxes have the same count."""
    of_each = [_ranges_of(found) for found in boxes]
    shared: list[tuple[float, float, int]] = []
    for count in sorted({count for ranges in of_each for *_, count in ranges}):
        spans = [[(low, high) for low, high, own in ranges if own == count] for ranges in of_each]
        common = spans[0]
        for other in spans[1:]:
            common = [(max(a, c), min(b, d)) for a, b in common for c, d in other if max(a, c) < min(b, d)]
        shared += [(low, high, count) for low, high in common]
    return sorted(shared)


def _ranges_of(found: Found) -> list[tuple[float, float, int]]:
    if found.outcome is None:
        return []
    ends, start = list[tuple[float, float, int | None]](), 0.0
    for event, before, _ in _kept(found):
        assert event is not None  # noqa: S101  # there is an outcome
        ends.append((start, outward(event.low)[0], before))
        start = outward(event.high)[1]
    ends.append((start, inf, found.outcome.counts[-1]))
    return [(max(low, 0.0), high, count) for low, high, count in ends if count is not None and low < high]


def _gaps(covered: Sequence[Span]) -> list[Span]:
    """Return what lies between neighbours that do not touch, from zero to infinity."""
    gaps, reached = list[Span](), 0.0
    for low, high in covered:
        if low > reached:
            gaps.append((reached, low))
        reached = max(reached, high)
    return gaps if reached == inf else [*gaps, (reached, inf)]


def _open_spans(found: Found) -> list[Span]:
    """Return where a box has events that are not told, also where they are too narrow for doubles."""
    told = (_is_crossing(*each) for each in _kept(found))
    events = [event for (event, *_), is_told in zip(_kept(found), told, strict=True) if event and not is_told]
    return [(max(outward(event.low)[0], 0.0), outward(event.high)[1]) for event in events]


def _united(spans: list[Span]) -> list[Span]:
    """Return spans with those that touch made one."""
    united: list[Span] = []
    for low, high in sorted(spans):
        if united and low <= united[-1][1]:
            united[-1] = (united[-1][0], max(high, united[-1][1]))
        else:
            united.append((low, high))
    return united


def _with_witness(problem: Problem, given: CertifiedRange, boxes: Sequence[Found]) -> CertifiedRange:
    """Return a range with a speed inside and the eigenvalues there, of the only design or of the middle one."""
    speed = 2 * given.start + 1 if given.stop == inf else (given.start + given.stop) / 2
    eigenvalues = () if len(boxes) > 1 else eigenvalues_at(problem, flint.arb(speed))
    return CertifiedRange(given.start, given.stop, given.unstable, speed, eigenvalues)


def eigenvalues_at(problem: Problem, speed: Any, bits: int = 128) -> tuple[Eigenvalue, ...]:
    """Return the eigenvalues of the middle design at a speed; () where roots do not separate, such as double ones.

    Parameters
    ----------
    problem : Problem
    speed : arb
        In m/s.
    bits : int
        Precision.
    """
    with precision(bits):
        posed = problem.posed(((Fraction(1, 2),) * 2,) * problem.dimensions)
        roots = enclosed_roots([coefficient(speed) for coefficient in posed.coefficients])
        return () if roots is None else tuple(map(_eigenvalue, roots))


def _eigenvalue(root: Any) -> Eigenvalue:
    """Return a root as an eigenvalue: alone in a ball that meets its mirror image, it is its own conjugate: real."""
    return Eigenvalue(ball_of(root.real), ball_of(root.imag) if sign(root.imag) else Ball(0.0, 0.0, "0"))
