"""Batches in stretches and threads: the same bits and faults however they are cut, errors and context as without."""

from __future__ import annotations

import sys
import threading
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from singletrack import PostureError, closed_form, load_bicycle, load_rider
from singletrack.arrays import complex_steps, in_stretches, stretches, threads
from singletrack.closed_form import batches
from singletrack.linear import critical_speeds, eigenvalues, modes
from singletrack.posture import Options

if TYPE_CHECKING:
    from singletrack.model import LinearModel
    from singletrack.parameters import Bicycle, Rider

COUNT = 61
SPEEDS = np.array([0.0, 3.0, 8.0])
MATRICES = ("M", "C0", "C1", "S0", "K0", "K2")
WAYS: list[Options | None] = [
    None,
    Options("rigid"),
    Options("upright"),
    Options("leaned"),
    Options("leaned", arms="bent", torso_lean=True, springs={"torso lean": np.linspace(0.0, 100.0, COUNT)}),
]


def varied() -> tuple[Bicycle, Rider]:
    """Designs of which some are faulty, in ways that are found at different places."""
    rng = np.random.default_rng(3)
    bicycle = load_bicycle("browser")
    rider = load_rider("rider-a").on(bicycle)
    trail, stay = bicycle.trail * rng.uniform(0.9, 1.1, COUNT), np.full(COUNT, bicycle.chain_stay_length)
    arm = rider.upper_arm_length * rng.uniform(0.99, 1.01, COUNT)
    trail[7], stay[30], arm[[3, 50]] = np.nan, 0.01, (0.05, 2.0)
    mass = rider.rider_mass * rng.uniform(0.9, 1.1, COUNT)
    return bicycle.replace(trail=trail, chain_stay_length=stay), rider.replace(upper_arm_length=arm, rider_mass=mass)


def in_pieces_of(monkeypatch: pytest.MonkeyPatch, length: int, cores: int) -> None:
    monkeypatch.setattr(batches, "STRETCH", length)
    monkeypatch.setenv("SINGLETRACK_THREADS", str(cores))


def faults_of(model: LinearModel) -> list[Any]:
    return [(fault.kind, {i: fault.reason((i,)) for i in np.flatnonzero(fault.bad)}) for fault in model.faults]


@pytest.mark.parametrize("options", WAYS, ids=lambda way: "bare" if way is None else way.title)
@pytest.mark.parametrize(("length", "cores"), [(2, 1), (7, 2), (20, 2)])
def test_no_bit_and_no_fault_depends_on_the_cut(
    options: Options | None, length: int, cores: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    bicycle, rider = varied()
    arguments = (bicycle,) if options is None else (bicycle, rider, options)
    found = []
    for pieces in ((COUNT, 1), (length, cores)):
        in_pieces_of(monkeypatch, *pieces)
        found.append(closed_form.coefficients(*arguments))
    whole, cut = found
    for name in MATRICES:
        assert getattr(whole, name).tobytes() == getattr(cut, name).tobytes(), name
    assert faults_of(whole) == faults_of(cut)
    assert not cut.valid[7]
    assert cut.valid.sum() == COUNT - (1 if options is None else 4)


@pytest.mark.parametrize("options", [Options("upright"), Options("upright", torso_lean=True)], ids=["two", "three"])
def test_answers_do_not_depend_on_it_either(options: Options, monkeypatch: pytest.MonkeyPatch) -> None:
    model = closed_form.coefficients(*varied(), options)
    found = []
    for length, cores in ((10**6, 1), (4, 2)):
        for name in ("CHUNK", "_PROBLEMS"):
            monkeypatch.setattr(sys.modules["singletrack.linear.eigenvalues"], name, length)
        monkeypatch.setattr(sys.modules["singletrack.linear.modes"], "_PROBLEMS", length)
        monkeypatch.setattr(sys.modules["singletrack.linear.critical"], "_STRETCH", length)
        monkeypatch.setattr(sys.modules["singletrack.linear.critical"], "_CHUNK", length)
        monkeypatch.setenv("SINGLETRACK_THREADS", str(cores))
        named, critical = modes(model, SPEEDS), critical_speeds(model)
        found.append(
            (
                eigenvalues(model, SPEEDS).tobytes(),
                named.eigenvalues.tobytes(),
                named.eigenmotions.tobytes(),
                critical.weave_speeds.tobytes(),
                critical.ranges.tobytes(),
                critical.weave_modes.tolist(),
            )
        )
    assert found[0] == found[1]


def test_a_grid_is_its_designs() -> None:
    bicycle, rider = varied()
    trails, masses = bicycle.trail[:5, None], rider.rider_mass[:4]
    grid = closed_form.coefficients(
        load_bicycle("browser").replace(trail=trails),
        rider.replace(rider_mass=masses, upper_arm_length=0.28),
        "upright",
    )
    flat = closed_form.coefficients(
        load_bicycle("browser").replace(trail=np.repeat(trails, 4)),
        rider.replace(rider_mass=np.tile(masses, 5), upper_arm_length=0.28),
        "upright",
    )
    assert grid.shape == (5, 4)
    for name in ("M", "C1", "K0", "K2"):
        np.testing.assert_array_equal(getattr(grid, name).reshape(20, 2, 2), getattr(flat, name))


def test_which_design_is_singular_is_told_for_each() -> None:
    """Arms stretched straight in some designs: the others keep the bits that they have without them."""
    bicycle = load_bicycle("browser")
    rider = load_rider("rider-a").on(bicycle)
    sound = closed_form.coefficients(bicycle.replace(trail=np.full(3, bicycle.trail)), rider, "upright")
    lengths = np.array([0.28, 0.28, 0.28])
    some = closed_form.coefficients(
        bicycle,
        rider.replace(upper_arm_length=lengths, lower_arm_length=[rider.lower_arm_length, 0.2, rider.lower_arm_length]),
        "upright",
    )
    assert some.valid.tolist() == [True, False, True]
    assert np.isfinite(sound.M).all()


@given(st.integers(0, 500), st.integers(1, 60))
def test_stretches_make_up_the_range(count: int, length: int) -> None:
    pieces = stretches(count, length)
    assert [k for piece in pieces for k in range(count)[piece]] == list(range(count))
    assert all(1 < piece.stop - piece.start <= max(length, 3) for piece in pieces) or len(pieces) == 1


def test_threads_see_what_the_caller_has_set_and_start_no_others(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("SINGLETRACK_THREADS", "2")
    seen, names = np.zeros(8, dtype=int), set()

    def work(piece: slice) -> None:
        seen[piece] = threads()
        names.add(threading.current_thread().name)
        np.log(np.zeros(2))
        load_bicycle("benchmark").replace(trail=0.05 + 1e-30j)

    with np.errstate(all="ignore"), complex_steps():
        in_stretches(work, 8, 2)
    assert seen.tolist() == [1] * 8
    assert threading.main_thread().name not in names or threads() == 1


def test_the_first_stretch_that_fails_is_told(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("SINGLETRACK_THREADS", "2")

    def work(piece: slice) -> None:
        if piece.start > 2:
            raise PostureError(f"no {piece.start}")

    with pytest.raises(PostureError, match="no 4"):
        in_stretches(work, 20, 2)


@pytest.mark.parametrize(("own", "others", "expected"), [("1", "", 1), ("", "1", 1), ("0", "", 1), ("many", "1", None)])
def test_the_environment_says_how_many_threads(
    own: str, others: str, expected: int | None, monkeypatch: pytest.MonkeyPatch
) -> None:
    for name, value in (("SINGLETRACK_THREADS", own), ("OMP_NUM_THREADS", others)):
        monkeypatch.setenv(name, value) if value else monkeypatch.delenv(name, raising=False)
    assert threads() == (expected or threads())
    assert threads() >= 1


@pytest.mark.parametrize("shape", [(0,), (1,), (2, 0, 3)])
def test_batches_of_none_and_of_one(shape: tuple[int, ...]) -> None:
    rider = load_rider("rider-a").on(load_bicycle("browser"))
    model = closed_form.coefficients(load_bicycle("browser").replace(trail=np.full(shape, 0.05)), rider, "upright")
    assert model.shape == shape
    assert eigenvalues(model, SPEEDS).shape == (*shape, 3, 4)
    assert modes(model, SPEEDS).eigenmotions.shape == (*shape, 3, 4, 2)
    assert critical_speeds(model).ranges.shape == (*shape, 3, 2)
