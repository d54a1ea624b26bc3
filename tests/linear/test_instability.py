"""What is unstable at every speed: planted in models of known eigenvalues, and of riders."""

from __future__ import annotations

import numpy as np
import pytest

from singletrack import InputError, coefficients, load_bicycle
from singletrack.linear import always_unstable, critical_speeds
from singletrack.model import LinearModel


def beside(stiffness: float, damping: float, moving: float = 0.0) -> LinearModel:
    """The benchmark bicycle with a third coordinate that moves by itself: q'' + d q' + (k + v² m) q = 0."""
    model = coefficients(load_bicycle("benchmark"))
    blocks = {}
    for name, alone in {"M": 1.0, "C0": damping, "C1": 0.0, "S0": stiffness, "K0": 0.0, "K2": moving}.items():
        blocks[name] = np.zeros((3, 3))
        blocks[name][:2, :2], blocks[name][2, 2] = getattr(model, name), alone
    return LinearModel(**blocks, gravity=9.81, coordinates=("lean", "steer", "load"), inputs=("lean torque",))


def test_a_load_that_falls_by_itself_is_named_with_its_eigenvalue() -> None:
    """q'' + 3 q' - 4 q = 0 falls with 1 1/s at every speed, whatever the bicycle does."""
    (found,) = always_unstable(beside(-4.0, 3.0))
    assert (found.mode, found.oscillates) == ("load", False)
    np.testing.assert_allclose(found.growth, (1.0, 1.0), rtol=1e-9)


def test_a_load_that_swings_ever_wider_is_an_oscillation() -> None:
    """q'' - 0.4 q' + 9 q = 0: a pair with the real part 0.2 1/s."""
    (found,) = always_unstable(beside(9.0, -0.4))
    assert (found.mode, found.oscillates) == ("load", True)
    np.testing.assert_allclose(found.growth, (0.2, 0.2), rtol=1e-9)


def test_nothing_is_named_where_a_speed_is_stable_or_modes_take_turns() -> None:
    assert always_unstable(coefficients(load_bicycle("benchmark"))) == ()
    # Weave is unstable below 4.29 m/s, a load above 3 m/s: they take turns.
    turns = beside(9.0, 3.0, -1.0)
    critical = critical_speeds(turns)
    assert (critical.status, critical.stable_ranges) == ("found", [])
    assert always_unstable(turns) == ()
    with pytest.raises(InputError, match="single design"):
        always_unstable(coefficients(load_bicycle("benchmark").replace(trail=np.array([0.05, 0.06]))))
