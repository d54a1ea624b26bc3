"""Problems certified: more digits until all is decided, boxes of designs cut until each is."""

from __future__ import annotations

from dataclasses import dataclass, replace
from fractions import Fraction
from itertools import product
from typing import TYPE_CHECKING

from singletrack.certify.analysis import Event, Outcome, analysed
from singletrack.certify.balls import precision
from singletrack.certify.counting import Sides, sides_at_rest
from singletrack.certify.families import sign
from singletrack.certify.problems import Box

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from singletrack.certify.problems import Posed, Problem

__all__ = ["Found", "solved", "solved_box"]

#: Digits (bits) that are tried one after the other.
_BITS = (128, 256, 512, 1024, 2048)
_BOX_BITS = 128
#: From here on, speeds that only infinity leaves open are left open.
_FAR_BITS = 512
#: Cells of the speed are halved to 2 to the power of minus this times the bits.
_FINEST = 0.5
#: Excess of a critical speed's interval over what single designs have, relative to that, that cutting further mends.
_EXCESS = 0.02


@dataclass(frozen=True, eq=False)
class Found:
    """What is proven of one box of designs.

    ``signs`` are, for each event, those of the derivatives of what vanishes there by each parameter, 0 for unknown.
    """

    box: Box
    outcome: Outcome | None
    at_rest: Sides | None
    bits: int
    always: str = ""
    influence: tuple[float, ...] = ()
    signs: tuple[tuple[int, ...], ...] = ()

    @property
    def is_decided(self) -> bool:
        """Whether nothing is left open."""
        return bool(self.always) or (self.outcome is not None and self.outcome.is_decided)


def _at(problem: Problem, box: Box, bits: int) -> Found:
    with precision(bits):
        posed = problem.posed(box)
        if not _is_sound(posed):
            return Found(box, None, None, bits, influence=posed.influence)
        at_rest = sides_at_rest(posed.at_rest)
        if posed.always:
            return Found(box, None, at_rest, bits, posed.always)
        outcome = analysed(posed.factors, posed.coefficients, int(_FINEST * bits))
        return Found(box, outcome, at_rest, bits, influence=posed.influence, signs=_signs(posed, outcome))


def _signs(posed: Posed, outcome: Outcome) -> tuple[tuple[int, ...], ...]:
    if not outcome.is_decided:
        return ()
    slopes = {factor.kind: factor.family.slope_families for factor in posed.factors}
    return tuple(
        tuple(slope.sign_over(event.low, event.high) for slope in slopes[event.kind]) for event in outcome.events
    )


def _is_sound(posed: Posed) -> bool:
    """Tell whether all polynomials are finite and the mass matrix is regular, so that there are 2 n roots."""
    own = all(c.is_finite() for a in posed.coefficients for c in a.coeffs())
    finite = own and all(factor.family.is_finite() for factor in posed.factors)
    return finite and sign(posed.leading) != 0


def solved(problem: Problem, box: Box = ()) -> Found:
    """Return what is proven of a single design, with as many digits as it takes.

    Parameters
    ----------
    problem : Problem
    box : tuple
        A box that is a point, () without intervals.
    """
    found = None
    for bits in _BITS:
        latest = _at(problem, box, bits)
        if latest.is_decided or (bits >= _FAR_BITS and _is_open_at_infinity_alone(latest)):
            return latest
        found = latest if found is None or latest.outcome is not None else found
    assert found is not None  # noqa: S101  # there are bits to try
    return found


def _is_open_at_infinity_alone(found: Found) -> bool:
    """Tell whether all is decided but what lies beyond some enormous speed.

    There a leading coefficient may vanish by an identity of the equations (soft frames): no precision shows that.
    """
    if found.outcome is None or not found.outcome.events:
        return False
    *others, last = found.outcome.events
    return not last.high.is_finite() and all(event.single for event in others) and None not in found.outcome.counts[:-1]


def solved_box(problem: Problem, most: int, progress: Callable[[int], object] | None = None) -> list[Found]:
    """Return what is proven of all designs of a problem, box by box.

    Parameters
    ----------
    problem : Problem
        Some of its parameters are intervals.
    most : int
        Boxes that are looked at before it is given up.
    progress : callable, optional
        Called with the number of boxes looked at so far.
    """
    tell = progress or (lambda _: None)
    whole: Box = ((Fraction(0), Fraction(1)),) * problem.dimensions
    done, open_boxes, looked = list[Found](), [_at(problem, whole, _BOX_BITS)], 1
    while open_boxes:
        found = open_boxes.pop(0)
        if found.is_decided or looked >= most:
            done.append(found)
            continue
        halves = [_at(problem, half, _BOX_BITS) for half in _halves(found)]
        looked += len(halves)
        tell(looked)
        open_boxes += halves
    return _sharpened(problem, done, looked, most, tell)


def _halves(found: Found) -> Iterator[Box]:
    """Yield the two halves of a box, cut across the parameter that widens the enclosures most."""
    sizes = [high - low for low, high in found.box]
    if any(found.influence):
        axis = max(range(len(sizes)), key=lambda k: (found.influence[k], sizes[k]))
    else:
        axis = max(range(len(sizes)), key=lambda k: sizes[k])
    low, high = found.box[axis]
    for part in ((low, (low + high) / 2), ((low + high) / 2, high)):
        yield (*found.box[:axis], part, *found.box[axis + 1 :])


def _sharpened(
    problem: Problem, done: list[Found], looked: int, most: int, tell: Callable[[int], object]
) -> list[Found]:
    """Return boxes with intervals of critical speeds that are not much wider than their designs need."""
    patterns = {found.outcome.pattern if found.outcome is not None else None for found in done}
    if len(patterns) > 1 or None in patterns or not all(found.is_decided for found in done):
        return done
    corners = _Corners(problem)
    reached = _reached(corners, done)
    todo, done = [_tightened(corners, found) for found in done], []
    while todo:
        found = todo.pop()
        if looked >= most or not reached or not _exceeds(found, reached):
            done.append(found)
            continue
        todo += [_tightened(corners, _at(problem, half, _BOX_BITS)) for half in _halves(found)]
        looked += 2
        tell(looked)
    return done


class _Corners:
    """Outcomes of single designs of a problem, each found once."""

    def __init__(self, problem: Problem) -> None:
        self.problem = problem
        self.known: dict[tuple[Fraction, ...], Outcome | None] = {}

    def __call__(self, point: tuple[Fraction, ...]) -> Outcome | None:
        if point not in self.known:
            self.known[point] = _at(self.problem, tuple((part, part) for part in point), _BOX_BITS).outcome
        return self.known[point]


def _tightened(corners: _Corners, found: Found) -> Found:
    """Return a box with events as wide as they are between two corners, where a critical speed is monotone.

    Where F(v, p) = 0 has one root v for each p, dv/dp_k = - F_k / F_v has one sign if F_k has, so that the extremes are
    at the corner where each p_k is largest or least by this sign, and at the opposite one.
    """
    if found.outcome is None or not found.signs:
        return found
    events = [_between_corners(corners, found.box, *one) for one in zip(found.outcome.events, found.signs, strict=True)]
    return replace(found, outcome=replace(found.outcome, events=tuple(events)))


def _between_corners(corners: _Corners, box: Box, event: Event, signs: tuple[int, ...]) -> Event:
    if 0 in signs:
        return event
    chosen = [
        corners(tuple(ends[(sign * way + 1) // 2] for ends, sign in zip(box, signs, strict=True))) for way in (1, -1)
    ]
    there = [
        other
        for outcome in chosen
        for other in ([] if outcome is None else outcome.events)
        if other.kind == event.kind and other.single and bool(event.low <= other.low) and bool(other.high <= event.high)
    ]
    if len(there) != len(chosen):
        return event
    first, second = there
    low = first.low if bool(first.low < second.low) else second.low
    high = first.high if bool(first.high > second.high) else second.high
    return replace(event, low=low, high=high)


def _reached(corners: _Corners, done: list[Found]) -> list[tuple[float, float]]:
    """Return intervals of each event, a little wider than what corners and middles have; [] if these do not agree."""
    whole = product((Fraction(0), Fraction(1)), repeat=corners.problem.dimensions)
    middles = [tuple((low + high) / 2 for low, high in found.box) for found in done[:32]]
    told = [outcome for outcome in map(corners, (*whole, *middles)) if outcome is not None and outcome.is_decided]
    if len({outcome.pattern for outcome in told}) != 1:
        return []
    speeds = zip(*([float(event.low) for event in outcome.events] for outcome in told), strict=True)
    return [_allowed(min(each), max(each)) for each in speeds]


def _allowed(low: float, high: float) -> tuple[float, float]:
    slack = _EXCESS * (high - low) + 1e-9 * high
    return low - slack, high + slack


def _exceeds(found: Found, allowed: list[tuple[float, float]]) -> bool:
    if found.outcome is None or len(found.outcome.events) != len(allowed):
        return False
    events = zip(found.outcome.events, allowed, strict=True)
    return any(float(event.low) < low or float(event.high) > high for event, (low, high) in events)
