"""A program compiled by numba: its statements as the body of a loop over designs, the same bits, sooner.

The loop has no branches and calls nothing, so that the compiler uses the processor's vector instructions: sines and
cosines, which are of parameters alone, are taken beforehand by NumPy. Machine code is kept on disk for the next process
beside the program or in the user's cache, where there is a place to write to, and made anew where not.
"""

from __future__ import annotations

import math
import re
from typing import TYPE_CHECKING, Any

import numba
import numpy as np

from singletrack.closed_form.programs import FOLDER

if TYPE_CHECKING:
    from collections.abc import Callable

    from singletrack.arrays import Array, Number
    from singletrack.closed_form.programs import Program

__all__ = ["compiled_program", "loop_text"]

#: Designs in a call: what goes in and comes out stays in the cache.
_BLOCK = 512
# Division as NumPy does it: no exceptions, hence no branches. No fast-math: the bits stay NumPy's.
_OPTIONS: Any = {"error_model": "numpy", "nogil": True}
_SIGNATURE = "void(float64[:, ::1], float64[:, ::1], int64)"
_TURNS = {"sin": np.sin, "cos": np.cos}
_TURN = re.compile(r"\b(sin|cos)\((\w+)\)")


def _where(condition: bool, yes: float, no: float) -> float:
    return yes if condition else no


def _maximum(a: float, b: float) -> float:
    return a if a > b or math.isnan(a) else b


def loop_text(name: str) -> tuple[str, list[tuple[str, str]], int]:
    """Return a program as the text of a loop over designs, the sines and cosines that it takes, and how many results.

    Parameters
    ----------
    name : str
        Of a shipped program.

    Examples
    --------
    >>> text, turns, results = loop_text("bicycle")
    >>> text.splitlines()[:3]
    ['def loop(given, found, count):', '    for k in range(count):', '        wheel_base = given[0, k]']
    >>> turns, results
    ([('sin', 'steer_axis_tilt'), ('cos', 'steer_axis_tilt')], 16)
    """
    text = (FOLDER / f"{name}.txt").read_text(encoding="utf-8")
    head, statements = re.search(r"def program\((.*?)\):\n(.*)", text, re.DOTALL).groups()  # type: ignore[union-attr]
    turns = list(dict.fromkeys(_TURN.findall(statements)))
    statements = _TURN.sub(r"\1_of_\2", statements)
    body, _, entries = statements.partition("    return (\n")
    results = [line.strip().removesuffix(",") for line in entries.splitlines() if line.startswith("        ")]
    inputs = [*head.split(", "), *(f"{turn}_of_{angle}" for turn, angle in turns)]
    lines = ["def loop(given, found, count):", "    for k in range(count):"]
    lines += [f"        {word} = given[{place}, k]" for place, word in enumerate(inputs)]
    lines += [f"    {line}" for line in body.splitlines()]
    lines += [f"        found[{place}, k] = {entry}" for place, entry in enumerate(results)]
    return "\n".join([*lines, ""]), turns, len(results)


def compiled_program(program: Program) -> Callable[[tuple[Number, ...], int], Array]:
    """Return the function from a program's values, arrays (N,) or numbers, and N to its entries (rows, N).

    Parameters
    ----------
    program : Program
    """
    text, turns, rows = loop_text(program.name)
    words: dict[str, Any] = {
        "__name__": __name__,  # where what is kept on disk belongs
        "sqrt": math.sqrt,
        "where": numba.njit(_where, forceinline=True, **_OPTIONS),
        "maximum": numba.njit(_maximum, forceinline=True, **_OPTIONS),
    }
    exec(compile(text, str(FOLDER / f"{program.name}.txt"), "exec"), words)  # noqa: S102  # our own text
    try:
        loop = numba.njit(_SIGNATURE, cache=True, **_OPTIONS)(words["loop"])
    except RuntimeError:  # no place to keep it
        loop = numba.njit(_SIGNATURE, **_OPTIONS)(words["loop"])
    names = [*program.of_bicycle, *program.of_rider]
    places = [(_TURNS[turn], names.index(angle)) for turn, angle in turns]

    def run(values: tuple[Number, ...], count: int) -> Array:
        found = np.empty((rows, count))
        given, part = np.empty((len(names) + len(places), _BLOCK)), np.empty((rows, _BLOCK))
        for start in range(0, count, _BLOCK):
            size = min(_BLOCK, count - start)
            block = slice(start, start + size)
            for row, value in zip(given, values, strict=False):
                row[:size] = value[block] if isinstance(value, np.ndarray) else value
            for row, (turn, place) in zip(given[len(names) :], places, strict=True):
                turn(given[place, :size], out=row[:size])
            loop(given, part, size)
            found[:, block] = part[:, :size]
        return found

    return run
