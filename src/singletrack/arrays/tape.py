"""Arithmetic on many numbers, recorded once and replayed in memory of its own.

An expression of NumPy arrays asks the system for memory at every operator, which takes longer than the arithmetic. A
function of plain operators is recorded here as a list of steps, each of which writes to a register that is free, so
that a thousand steps on some thousand numbers stay in the processor's cache. Every step is the same operation of
NumPy's: not a bit differs.
"""

from __future__ import annotations

import math
import threading
from dataclasses import dataclass, field
from functools import partial
from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from singletrack.arrays.namespace import Array

__all__ = ["WORDS", "Tape", "Word", "record"]

_NUMBERS: dict[str, Any] = {
    "add": np.add,
    "subtract": np.subtract,
    "multiply": np.multiply,
    "divide": np.divide,
    "negative": np.negative,
    "absolute": np.absolute,
    "sqrt": np.sqrt,
    "sin": np.sin,
    "cos": np.cos,
    "maximum": np.maximum,
}
_TRUTHS: dict[str, Any] = {
    "less": np.less,
    "less_equal": np.less_equal,
    "greater": np.greater,
    "greater_equal": np.greater_equal,
    "equal": np.equal,
    "logical_and": np.logical_and,
    "logical_or": np.logical_or,
}
_WORK: dict[str, Any] = {**_NUMBERS, **_TRUTHS}
Operand: TypeAlias = "Word | float"
_Call: TypeAlias = "tuple[Callable[..., Any], tuple[Any, ...]]"


def _operator(name: str, *, turned: bool = False) -> Any:
    def work(self: Word, *others: Operand) -> Word:
        return self.steps.add(name, (*others, self) if turned else (self, *others))

    return work


@dataclass(frozen=True, eq=False)
class Word:
    """A number, or truth value, of each entry that a step is going to compute."""

    steps: _Steps
    place: int

    __add__ = _operator("add")
    __radd__ = _operator("add", turned=True)
    __sub__ = _operator("subtract")
    __rsub__ = _operator("subtract", turned=True)
    __mul__ = _operator("multiply")
    __rmul__ = _operator("multiply", turned=True)
    __truediv__ = _operator("divide")
    __rtruediv__ = _operator("divide", turned=True)
    __neg__ = _operator("negative")
    __abs__ = _operator("absolute")
    __lt__ = _operator("less")
    __le__ = _operator("less_equal")
    __gt__ = _operator("greater")
    __ge__ = _operator("greater_equal")
    __eq__ = _operator("equal")
    __and__ = _operator("logical_and")
    __or__ = _operator("logical_or")
    __hash__ = None  # type: ignore[assignment]


@dataclass(eq=False)
class _Steps:
    """Steps in the order in which they are computed, each once."""

    listed: list[tuple[str, tuple[int | float, ...]]] = field(default_factory=list)
    known: dict[Any, int] = field(default_factory=dict)

    def add(self, name: str, operands: Sequence[Operand]) -> Word:
        """Return the word of an operation; operands that are places are whole numbers, constants are floats."""
        places = tuple(one.place if isinstance(one, Word) else float(one) for one in operands)
        key = (name, tuple(str(place) for place in places))
        if key not in self.known:
            self.known[key] = len(self.listed)
            self.listed.append((name, places))
        return Word(self, self.known[key])


def _word(name: str) -> Callable[..., Word]:
    def work(*operands: Operand) -> Word:
        steps = next(one.steps for one in operands if isinstance(one, Word))
        return steps.add(name, operands)

    return work


#: What stands for NumPy's functions while a function is recorded.
WORDS = {
    "abs": _word("absolute"),
    **{name: _word(name) for name in ("sqrt", "sin", "cos", "where", "maximum")},
}


@dataclass(frozen=True, eq=False)
class Tape:
    """A recorded function of k arrays.

    Attributes
    ----------
    inputs : int
        The number k.
    steps : tuple of (operation, register, operands)
        Operands: a register's number, or a constant as a float. The first registers are the inputs.
    results : tuple of int or float
        Registers, or constants.
    truths : tuple of bool
        For each register whether it holds truth values.
    """

    inputs: int
    steps: tuple[tuple[str, int, tuple[int | float, ...]], ...]
    results: tuple[int | float, ...]
    truths: tuple[bool, ...]
    _own: threading.local = field(default_factory=threading.local)

    @property
    def passes(self) -> int:
        """How often an array is gone through: what it costs, in units of an array's length."""
        return len(self.steps)

    def run(self, *values: Array | float) -> list[Any]:
        """Return the results (n,) for arrays of n entries; they are this thread's until the next run.

        Parameters
        ----------
        *values : array, shape (...), or float
        """
        shape = np.broadcast_shapes(*(np.shape(value) for value in values))
        registers, bound = self._bound(math.prod(shape))
        for register, value in zip(registers, values, strict=False):
            register.reshape(shape)[...] = value
        for work, operands in bound:
            work(*operands)
        return [registers[one] if isinstance(one, int) else one for one in self.results]

    def _bound(self, count: int) -> tuple[list[Array], list[_Call]]:
        """Return the registers of n numbers, of this thread, and the steps bound to them."""
        own = self._own
        if count > getattr(own, "capacity", -1):
            own.capacity, own.bound = count, {}
            own.whole = [np.empty(count, dtype=bool if truth else float) for truth in self.truths]
        if count not in own.bound:
            if len(own.bound) > 1:  # nearly equal stretches have two lengths
                own.bound.clear()
            registers = [whole[:count] for whole in own.whole]
            own.bound[count] = registers, [call for step in self.steps for call in _calls(step, registers)]
        found: tuple[list[Array], list[_Call]] = own.bound[count]
        return found


def _calls(step: tuple[str, int, tuple[int | float, ...]], registers: list[Array]) -> list[_Call]:
    """Return what a step calls, and with which arrays."""
    name, target, operands = step
    given = [registers[one] if isinstance(one, int) else one for one in operands]
    if name == "maximum":  # NumPy takes no third argument here
        return [(partial(np.maximum, out=registers[target]), tuple(given))]
    if name != "where":
        return [(_WORK[name], (*given, registers[target]))]
    condition, yes, no = given
    # What is not chosen may stand in the target already.
    first: list[_Call] = [] if no is registers[target] else [(np.copyto, (registers[target], no))]
    return [*first, (np.copyto, (registers[target], yes, "same_kind", condition))]


def record(function: Callable[..., Sequence[Operand]], inputs: int) -> Tape:
    """Return a function of plain operators as a tape.

    Parameters
    ----------
    function : callable
        Of that many words; returns a sequence of words (or constants).
    inputs : int

    Examples
    --------
    >>> sqrt, where = WORDS["sqrt"], WORDS["where"]
    >>> tape = record(lambda x, y: [sqrt(x * x + y * y), where(x < y, x, y)], 2)
    >>> [found.tolist() for found in tape.run(np.array([3.0, 5.0]), np.array([4.0, 12.0]))], tape.passes
    ([[5.0, 13.0], [3.0, 5.0]], 6)
    """
    steps = _Steps()
    words = [steps.add("input", (k,)) for k in range(inputs)]
    found = function(*words)
    results = [one.place if isinstance(one, Word) else float(one) for one in found]
    return _registered(steps.listed, inputs, results)


def _registered(listed: list[tuple[str, tuple[int | float, ...]]], inputs: int, results: list[int | float]) -> Tape:
    """Return the steps that are needed, with registers in place of places, each used again as soon as it is free."""
    needed = {one for one in results if isinstance(one, int)}
    for place in range(len(listed) - 1, inputs - 1, -1):
        if place in needed:
            needed.update(one for one in listed[place][1] if isinstance(one, int))
    last = {one: len(listed) for one in results if isinstance(one, int)}
    for place in range(len(listed) - 1, inputs - 1, -1):
        for one in listed[place][1] if place in needed else ():
            if isinstance(one, int):
                last.setdefault(one, place)
    truths = [False] * inputs
    at: dict[int, int] = {place: place for place in range(inputs)}
    free: dict[bool, list[int]] = {True: [], False: []}
    steps = []
    for place in range(inputs, len(listed)):
        if place not in needed:
            continue
        name, operands = listed[place]
        truth = name in _TRUTHS
        registers = tuple(at[one] if isinstance(one, int) else one for one in operands)
        dying = {at[one] for one in operands if isinstance(one, int) and last[one] == place and at[one] >= inputs}
        if name == "where":
            # The target must not be what is chosen; best it is what is not.
            other = registers[2]
            takes_over = other in dying and other != registers[1] and not isinstance(other, float)
            target = int(other) if takes_over else _taken(free, truths, truth=False)
        else:
            _free(free, truths, dying)
            dying = set()
            target = _taken(free, truths, truth=truth)
        _free(free, truths, dying - {target})
        at[place] = target
        steps.append((name, target, registers))
    return Tape(inputs, tuple(steps), tuple(at[one] if isinstance(one, int) else one for one in results), tuple(truths))


def _taken(free: dict[bool, list[int]], truths: list[bool], *, truth: bool) -> int:
    if free[truth]:
        return free[truth].pop()
    truths.append(truth)
    return len(truths) - 1


def _free(free: dict[bool, list[int]], truths: list[bool], registers: set[int]) -> None:
    for register in registers:
        free[truths[register]].append(register)
