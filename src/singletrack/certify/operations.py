"""What traced programs do to balls, and to balls with derivatives; comparisons may have no answer (None)."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any

import flint

from singletrack.certify.duals import Centred, Dual, narrowed

if TYPE_CHECKING:
    from collections.abc import Sequence

__all__ = ["ball_operations", "centred_operations", "dual_operations"]

Operations = dict[str, Callable[..., Any]]


def _truth(value: Any) -> bool | None:
    """Return what a truth value is: told by a comparison, or a number, 1 or 0."""
    if value is None or isinstance(value, bool):
        return value
    return True if bool(value != 0) else False if bool(value == 0) else None


def _told(yes: Any, no: Any) -> bool | None:
    return True if bool(yes) else False if bool(no) else None


def _and(x: Any, y: Any) -> bool | None:
    told = (_truth(x), _truth(y))
    return False if False in told else None if None in told else True


def _or(x: Any, y: Any) -> bool | None:
    told = (_truth(x), _truth(y))
    return True if True in told else None if None in told else False


def _not(x: Any) -> bool | None:
    told = _truth(x)
    return None if told is None else not told


def _selected(condition: Any, no: Any, yes: Any) -> Any:
    told = _truth(condition)
    return (yes if told else no) if told is not None else no.union(yes)


_COMPARISONS: Operations = {
    "lt": lambda x, y: _told(x < y, x >= y),
    "le": lambda x, y: _told(x <= y, x > y),
    "gt": lambda x, y: _told(x > y, x <= y),
    "ge": lambda x, y: _told(x >= y, x < y),
    "eq": lambda x, y: _told(x == y, x != y),
    "ne": lambda x, y: _told(x != y, x == y),
    "and": _and,
    "or": _or,
    "not": _not,
    "is_finite": lambda x: True if x.is_finite() else None,
}


def ball_operations() -> Operations:
    """Return what each operation of a program does to balls (arb)."""

    def method(name: str) -> Callable[[Any], Any]:
        return lambda x: getattr(x, name)()

    return {
        **_COMPARISONS,
        **{name: method(name) for name in ("sqrt", "sin", "cos", "tan", "asin", "acos", "atan", "exp", "log")},
        "add": lambda x, y: x + y,
        "sub": lambda x, y: x - y,
        "mul": lambda x, y: x * y,
        "div": lambda x, y: x / y,
        "neg": lambda x: -x,
        "abs": abs,
        "sign": lambda x: x.sgn(),
        "pow": lambda x, y: x**y,
        "atan2": flint.arb.atan2,
        "max": lambda x, y: x.max(y),
        "min": lambda x, y: x.min(y),
        "select": _selected,
    }


#: Derivatives of functions of one ball.
_SLOPES: dict[str, Callable[[Any], Any]] = {
    "sqrt": lambda x: 1 / (2 * x.sqrt()),
    "sin": lambda x: x.cos(),
    "cos": lambda x: -x.sin(),
    "tan": lambda x: 1 / x.cos() ** 2,
    "asin": lambda x: 1 / (1 - x**2).sqrt(),
    "acos": lambda x: -1 / (1 - x**2).sqrt(),
    "atan": lambda x: 1 / (1 + x**2),
    "exp": lambda x: x.exp(),
    "log": lambda x: 1 / x,
    "abs": lambda x: x.sgn(),
}


def dual_operations() -> Operations:
    """Return what each operation of a program does to :class:`~singletrack.certify.duals.Dual` numbers of balls.

    Where two branches cannot be told apart, derivatives are unknown (nan), and with them what follows.
    """
    balls = ball_operations()

    def of_one(name: str) -> Callable[[Dual], Dual]:
        return lambda x: x.through(balls[name](x.value), _SLOPES[name](x.value))

    def compared(name: str) -> Callable[..., Any]:
        return lambda *values: _COMPARISONS[name](*(v.value if isinstance(v, Dual) else v for v in values))

    return {
        **{name: compared(name) for name in _COMPARISONS},
        **{name: of_one(name) for name in _SLOPES},
        "add": lambda x, y: x + y,
        "sub": lambda x, y: x - y,
        "mul": lambda x, y: x * y,
        "div": lambda x, y: x / y,
        "neg": lambda x: -x,
        "sign": lambda x: _unknown(x.value.sgn(), x) if x.value.contains(0) else x.through(x.value.sgn(), 0),
        "pow": _dual_power,
        "atan2": _dual_angle,
        "max": lambda x, y: _extreme(x.value.max(y.value), (1 + (x.value - y.value).sgn()) / 2, x, y),
        "min": lambda x, y: _extreme(x.value.min(y.value), (1 - (x.value - y.value).sgn()) / 2, x, y),
        "select": _dual_selected,
    }


def _unknown(value: Any, like: Dual) -> Dual:
    return Dual(value, (flint.arb.nan(),) * len(like.slopes))


def _dual_selected(condition: Any, no: Dual, yes: Dual) -> Dual:
    told = _truth(condition.value if isinstance(condition, Dual) else condition)
    return _unknown(no.value.union(yes.value), no) if told is None else yes if told else no


def _extreme(value: Any, share: Any, x: Dual, y: Dual) -> Dual:
    """Return the larger or smaller of two, whose derivative is that of x by its share, else that of y."""
    return Dual(value, tuple(share * a + (1 - share) * b for a, b in zip(x.slopes, y.slopes, strict=True)))


def _dual_power(x: Dual, y: Dual) -> Dual:
    if any(not bool(slope == 0) for slope in y.slopes):
        return _unknown(x.value**y.value, x)
    return x.through(x.value**y.value, y.value * x.value ** (y.value - 1))


def _dual_angle(y: Dual, x: Dual) -> Dual:
    square = x.value**2 + y.value**2
    both = zip(y.slopes, x.slopes, strict=True)
    return Dual(flint.arb.atan2(y.value, x.value), tuple((x.value * a - y.value * b) / square for a, b in both))


def centred_operations(halves: Sequence[Any]) -> Operations:
    """Return what each operation does to :class:`~singletrack.certify.duals.Centred` numbers.

    Every result is made narrower: without that, what depends on a parameter in many places grows far too wide.

    Parameters
    ----------
    halves : sequence of arb, shape (k,)
        Balls of all differences of a parameter from its middle.
    """
    duals, balls = dual_operations(), ball_operations()

    def centred(name: str) -> Callable[..., Any]:
        def of(*values: Any) -> Any:
            dual = duals[name](*(v.dual if isinstance(v, Centred) else v for v in values))
            if not isinstance(dual, Dual):
                return dual
            middle = balls[name](*(v.middle if isinstance(v, Centred) else v for v in values))
            return Centred(narrowed(dual, middle, halves), middle)

        return of

    return {name: centred(name) for name in duals}
