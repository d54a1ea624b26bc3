"""Elimination by hand and by a solver: the same accelerations and forces; chains of loops stay short."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from singletrack.multibody import Body, System, assemble, build, close_point, move, revolute
from singletrack.multibody.engine.dynamics import _reduced_numerically, by_hand, reduced
from singletrack.multibody.engine.reduction import elimination_operations, pivot_growth

Y = (0, 1, 0)


def four_bars(count: int) -> Any:
    """Cranks that hang on bars in a row."""
    bodies = [Body(f"crank {i}", 1.0 + 0.1 * i, (i, 0, -0.5)) for i in range(count + 1)]
    bodies += [Body(f"bar {i}", 1.0, (i + 0.5, 0, -1)) for i in range(count)]
    joints = [revolute(f"crank {i}", "ground", f"crank {i}", (i, 0, 0), Y) for i in range(count + 1)]
    joints += [revolute(f"bar {i}", f"crank {i}", f"bar {i}", (i, 0, -1), Y) for i in range(count)]
    loops = [close_point(f"pin {i}", f"bar {i}", f"crank {i + 1}", (i + 1, 0, -1), normal=Y) for i in range(count)]
    return build(System(bodies, joints, loops))


@pytest.mark.parametrize("count", [4, 16])
def test_by_hand_and_by_a_solver_agree(count: int) -> None:
    state = move(assemble(four_bars(count), {"crank 0": 0.4}), {"crank 0": -1.0})
    assert by_hand(state.model, state.partition)
    u_i = state.u[list(state.partition.independent_speeds)]
    one, other = (
        function(state.q, u_i, [], state.parameters)
        for function in (reduced(state.model, state.partition), _reduced_numerically(state.model, state.partition))
    )
    for own, their in zip(one, other, strict=True):
        np.testing.assert_allclose(own.full(), their.full(), rtol=1e-9, atol=1e-9)


def test_expressions_of_chains_of_loops_grow_with_their_length() -> None:
    """Twice as many loops, at most some more than twice as many instructions; with a full block it were eight times."""
    lengths = []
    for count in (10, 20):
        state = assemble(four_bars(count), {"crank 0": 0.4})
        lengths.append(reduced(state.model, state.partition).n_instructions())
    assert lengths[1] < 3.0 * lengths[0]


def test_operations_are_counted_as_elimination_takes_them() -> None:
    """A full block of k takes the sum of i (i + 1), a band of three k - 1 pivots with two each."""
    for k in (1, 3, 8):
        assert elimination_operations(np.ones((k, k), dtype=bool)) == sum(i * (i + 1) for i in range(k))
        band = abs(np.subtract.outer(range(k), range(k))) <= 1
        assert elimination_operations(band) == 2 * (k - 1)


def test_growth_is_that_of_elimination_in_order() -> None:
    rng = np.random.default_rng(0)
    block = rng.normal(size=(7, 7)) * (rng.random((7, 7)) < 0.5) + 2 * np.eye(7)
    a, least, most = block.copy(), np.inf, abs(block).max()
    for k in range(7):
        least = min(least, abs(a[k, k]))
        a[k + 1 :] -= np.outer(a[k + 1 :, k] / a[k, k], a[k])
        most = max(most, abs(a[k + 1 :, k + 1 :]).max(initial=0.0))
    assert pivot_growth(block) == pytest.approx(most / least, rel=1e-12)
