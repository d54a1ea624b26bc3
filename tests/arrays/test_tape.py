"""Tapes: what is recorded and replayed is what NumPy computes, bit for bit, whatever the registers are used for."""

from __future__ import annotations

import threading
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from singletrack.arrays.tape import WORDS, record

NUMPY = {"abs": np.abs, "sqrt": np.sqrt, "sin": np.sin, "cos": np.cos, "where": np.where, "maximum": np.maximum}
#: By operation: an expression of the operands a, b, c and the words.
FOLLOWED = {
    "+": "a + b",
    "-": "1.5 - a",
    "*": "a * b",
    "/": "a / b",
    "neg": "-a",
    "abs": "abs(a)",
    "sqrt": "sqrt(a)",
    "where": "where(a < b, b, c)",
    "where same": "where(a >= b, a, 0.25)",
    "maximum": "maximum(a, b)",
    "and": "where((a > b) & (b <= c), a, c)",
    "or": "where((a > b) | ((b < c) == False), b, a)",
}


def computed(plan: list[tuple[str, int, int, int]], words: dict[str, Any], values: list[Any]) -> list[Any]:
    """Follow a plan: each step is an operation on what is known so far, by number, newest last."""
    known = list(values)
    for operation, i, j, k in plan:
        a, b, c = (known[n % len(known)] for n in (i, j, k))
        known.append(eval(FOLLOWED[operation], {**words, "a": a, "b": b, "c": c}))  # noqa: S307  # our own text
    return known[-3:]


PLANS = st.lists(
    st.tuples(st.sampled_from(sorted(FOLLOWED)), *(st.integers(0, 40) for _ in range(3))), min_size=1, max_size=40
)


@given(PLANS, st.integers(0, 2**32 - 1))
def test_a_tape_is_its_function_bit_for_bit(plan: list[tuple[str, int, int, int]], seed: int) -> None:
    values = list(np.random.default_rng(seed).standard_normal((3, 5)))
    tape = record(lambda *words: computed(plan, WORDS, list(words)), 3)
    with np.errstate(all="ignore"):
        expected = computed(plan, NUMPY, values)
        for _ in range(2):  # registers hold what the first run has left
            found = tape.run(*values)
            for one, other in zip(found, expected, strict=True):
                np.testing.assert_array_equal(one, other)
    assert tape.passes <= 5 * len(plan)


def test_what_is_not_needed_or_known_already_is_not_computed() -> None:
    tape = record(lambda x, y: [(x * y) + (x * y), x / y][:1], 2)
    assert [step[0] for step in tape.steps] == ["multiply", "add"]


def test_registers_are_used_again() -> None:
    def power(x: Any) -> list[Any]:
        for _ in range(50):
            x = x * 1.01 + 0.5
        return [x]

    assert len(record(power, 1).truths) < 5


def test_any_shapes_that_broadcast_and_any_number_of_lengths() -> None:
    tape = record(lambda x, y: [x * y], 2)
    for rows in (2, 7, 3, 5, 2):
        x, y = np.arange(rows)[:, None], np.arange(4.0)
        np.testing.assert_array_equal(tape.run(x, y)[0], (x * y).ravel())
    assert tape.run(2.0, np.ones(3))[0].tolist() == [2.0] * 3


def test_threads_do_not_share_registers() -> None:
    tape = record(lambda x: [x * 2.0], 1)
    mine = tape.run(np.ones(4))[0]
    other = threading.Thread(target=lambda: tape.run(np.full(4, 9.0)))
    other.start()
    other.join()
    assert mine.tolist() == [2.0] * 4


def test_words_of_one_function_only() -> None:
    with pytest.raises(StopIteration):
        WORDS["sqrt"](4.0)
