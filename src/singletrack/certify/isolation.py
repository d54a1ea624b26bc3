"""Real roots from zero to infinity of families of polynomials: each in an interval, or said to be undecided.

What is found holds for every polynomial of the family: a *single* interval holds exactly one root of each of them, an
*undecided* one may hold any number, and there are none elsewhere.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import flint

if TYPE_CHECKING:
    from singletrack.certify.families import Family

__all__ = ["Interval", "isolate"]

#: Where v gives place to w = 1 / v, so that infinity is a point like others.
_TURN = 16
#: Steps of Newton's method, each of which may double the digits.
_STEPS = 12
#: Where intervals are cut, in sixteenths, the best place first.
_PARTS = (8, 6, 10, 7, 9, 5, 11)
#: Intervals that are looked at before the rest is left undecided.
_MOST = 20000


@dataclass(frozen=True, eq=False)
class Interval:
    """From low to high, exact arbs (the upper one may be infinite), and whether it holds exactly one root."""

    low: Any
    high: Any
    single: bool = False


def isolate(family: Family, finest: int) -> list[Interval]:
    """Return where polynomials may have roots in (0, infinity), ascending.

    Parameters
    ----------
    family : Family
        Not zero; powers of the variable have been divided out.
    finest : int
        Intervals are halved down to a width of 2 to the power of minus this.

    Examples
    --------
    >>> from singletrack.certify.families import Family
    >>> with flint.ctx.workprec(128):
    ...     two, double = (isolate(Family(flint.arb_poly(p)), 60) for p in ([2, -3, 1], [1, -2, 1]))
    >>> [interval.single for interval in two], [interval.single for interval in double]
    ([True, True], [False])
    """
    near = _inside(family, Interval(flint.arb(0), flint.arb(_TURN)), finest)
    far = _inside(family.turned(), Interval(flint.arb(0), flint.arb(1) / _TURN), finest)
    # The point where both parts meet belongs to both: a root there is found twice, or not told by either.
    return _joined(family, near + [_turned(interval) for interval in reversed(far)])


def _turned(interval: Interval) -> Interval:
    high = flint.arb.pos_inf() if interval.low.is_zero() else (1 / interval.low).upper()
    return Interval((1 / interval.high).lower(), high, interval.single)


def _joined(family: Family, found: list[Interval]) -> list[Interval]:
    """Return intervals with those that touch made one."""
    joined: list[Interval] = []
    for interval in found:
        if joined and not bool(joined[-1].high < interval.low):
            whole = Interval(joined.pop().low, interval.high)
            single = bool(whole.high.is_finite()) and _changes_once(family, family.derivative(), whole)
            joined.append(Interval(whole.low, whole.high, single))
        else:
            joined.append(interval)
    return joined


def _inside(family: Family, whole: Interval, finest: int) -> list[Interval]:
    """Return intervals that may hold roots: shrunk where they hold one, as small as they get otherwise."""
    slope = family.derivative()
    todo, kept = [whole], list[Interval]()
    least = flint.arb(flint.fmpq(1, 2**finest))
    looked = 0
    while todo:
        one, looked = todo.pop(), looked + 1
        if family.sign_over(one.low, one.high):
            continue
        middle = _cut(family, one)
        if _changes_once(family, slope, one):
            kept.append(Interval(one.low, one.high, single=True))
        elif _keeps_its_sign(family, slope, one):
            continue
        elif looked > _MOST or bool(one.high - one.low < least) or _is_vague(family, one, middle):
            kept.append(one)
        else:
            todo += [Interval(middle, one.high), Interval(one.low, middle)]
    return [_shrunk(family, slope, one) for one in _clusters(family, slope, kept)]


def _cut(family: Family, one: Interval) -> Any:
    """Return where an interval is halved, or nearly: where the sign is told, so that no root is on the cut."""
    places = [(one.low + (one.high - one.low) * part / 16).mid() for part in _PARTS]
    return next((at for at in places if family.sign(at)), places[0])


def _clusters(family: Family, slope: Family, kept: list[Interval]) -> list[Interval]:
    """Return intervals with neighbours that nothing separates made one, which may then hold a single root."""
    merged: list[Interval] = []
    for one in kept:
        if merged and not one.single and not merged[-1].single and bool(merged[-1].high == one.low):
            merged.append(Interval(merged.pop().low, one.high))
        else:
            merged.append(one)
    undecided = (one for one in merged if one.single or not _keeps_its_sign(family, slope, one))
    return [Interval(one.low, one.high, one.single or _changes_once(family, slope, one)) for one in undecided]


def _shrunk(family: Family, slope: Family, one: Interval) -> Interval:
    """Return an interval with one root, made smaller by Newton's method on intervals."""
    if not one.single:
        return one
    low, high = one.low, one.high
    for _ in range(_STEPS):
        middle = ((low + high) / 2).mid()
        new = middle - family(middle) / slope.over(low, high)
        if not new.is_finite():
            break
        before = high - low
        low = new.lower() if bool(new.lower() > low) else low
        high = new.upper() if bool(new.upper() < high) else high
        if not bool(high - low < before / 2):
            break
    return Interval(low, high, single=True)


def _keeps_its_sign(family: Family, slope: Family, one: Interval) -> bool:
    return family.sign(one.low) * family.sign(one.high) > 0 and slope.sign_over(one.low, one.high) != 0


def _changes_once(family: Family, slope: Family, one: Interval) -> bool:
    return family.sign(one.low) * family.sign(one.high) < 0 and slope.sign_over(one.low, one.high) != 0


def _is_vague(family: Family, one: Interval, middle: Any) -> bool:
    """Tell whether nothing is known about the sign all over an interval: smaller ones would tell no more."""
    return not any(family.sign(at) for at in (one.low, middle, one.high))
