"""Many designs by programs: bits do not depend on the other designs or the way, faults are as before."""

from __future__ import annotations

import importlib.util
import os
import subprocess
import sys
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest

from designs import random_bicycle
from singletrack import closed_form, load_bicycle, load_rider
from singletrack.closed_form import many
from singletrack.closed_form.coefficients import by_arrays
from singletrack.closed_form.generate import structures
from singletrack.closed_form.programs import program_named, program_of
from singletrack.posture import Options

if TYPE_CHECKING:
    from singletrack.parameters import Bicycle, Rider

COUNT = 50
MATRICES = ("M", "C0", "C1", "S0", "K0", "K2")
WAYS = structures()


def varied(names: tuple[str, ...] | None = None) -> tuple[Bicycle, Rider]:
    rng = np.random.default_rng(7)
    bicycle = load_bicycle("stratos")
    rider = load_rider("rider-a").on(bicycle)

    def moved(record: Any) -> Any:
        changed = [name for name in record.values() if "fraction" not in name and (names is None or name in names)]
        return record.replace(**{name: getattr(record, name) * rng.uniform(0.998, 1.002, COUNT) for name in changed})

    return moved(bicycle), moved(rider)


def model_of(name: str, bicycle: Bicycle, rider: Rider, make: Any = closed_form.coefficients) -> Any:
    options = WAYS[name]
    return make(bicycle, None, Options()) if options is None else make(bicycle, rider, options)


@pytest.mark.parametrize("name", WAYS)
def test_programs_are_the_equations(name: str) -> None:
    designs = varied()
    found, expected = model_of(name, *designs), model_of(name, *designs, by_arrays)
    assert found.valid.all()
    for matrix in MATRICES:
        one, other = getattr(found, matrix), np.asarray(getattr(expected, matrix))
        scale = np.abs(other).max()
        np.testing.assert_allclose(np.broadcast_to(one, other.shape), other, rtol=1e-9, atol=1e-11 * scale)


@pytest.mark.parametrize("name", ["bicycle", "upright-axial", "leaned-straight-abduction-torso-lean"])
def test_arrays_tapes_and_machine_code_give_the_same_bits(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    designs = varied()
    found = []
    for threshold in (np.inf, -1):
        monkeypatch.setattr(many, "_WORTH_RECORDING", threshold)
        found.append(model_of(name, *designs))
    if name != "leaned-straight-abduction-torso-lean" and importlib.util.find_spec("numba"):
        program = program_named(name)
        assert program is not None
        assert many.use_compiled(program)
        found.append(model_of(name, *designs))
        monkeypatch.delitem(many._Kernels.compiled, name)
    for other in found[1:]:
        for matrix in MATRICES:
            assert getattr(found[0], matrix).tobytes() == getattr(other, matrix).tobytes()


@pytest.mark.parametrize("names", [("trail",), ("rider_mass",), ("gravity",)])
def test_few_parameters_or_none_that_matters(names: tuple[str, ...]) -> None:
    bicycle, rider = varied(names)
    found, expected = (make(bicycle, rider, Options("upright")) for make in (closed_form.coefficients, by_arrays))
    assert found.shape == expected.shape == (COUNT,)
    for matrix in MATRICES:
        one, other = np.asarray(getattr(found, matrix)), np.asarray(getattr(expected, matrix))
        np.testing.assert_allclose(*np.broadcast_arrays(one, other), rtol=1e-9, atol=1e-11)


def test_a_doubtful_design_is_computed_again_and_alters_no_other() -> None:
    """Arms all but stretched: beyond what programs are trusted with, within what the equations allow."""
    bicycle, rider = load_bicycle("browser"), load_rider("rider-a").on(load_bicycle("browser"))
    alone = closed_form.coefficients(bicycle, rider.replace(rider_mass=np.array([70.0, 80.0])), "upright")
    length = np.array([rider.upper_arm_length, 0.01, rider.upper_arm_length, 5.0])
    mixed = rider.replace(rider_mass=np.array([70.0, 75.0, 80.0, 75.0]), upper_arm_length=length)
    found = closed_form.coefficients(bicycle, mixed, "upright")
    assert found.valid.tolist() == [True, False, True, False]
    for matrix in ("M", "C1", "K0", "K2"):
        np.testing.assert_array_equal(getattr(found, matrix)[[0, 2]], getattr(alone, matrix))
    texts = {i: [fault.reason((i,)) for fault in found.faults if fault.bad[i]] for i in (1, 3)}
    assert "reaches only" in texts[1][0]
    assert "cannot fold below" in texts[3][0]


def test_random_bicycles_with_springs_and_dampers_on_the_steer() -> None:
    batch = random_bicycle(load_bicycle("benchmark"), np.random.default_rng(2), 20)
    options = Options(springs={"steer": np.arange(20.0)}, dampers={"steer": 0.5})
    found, expected = closed_form.coefficients(batch, None, options), by_arrays(batch, None, options)
    for matrix in MATRICES:
        np.testing.assert_allclose(getattr(found, matrix), getattr(expected, matrix), rtol=1e-9, atol=1e-12)


def test_no_place_for_machine_code_is_no_obstacle() -> None:
    """An installation that cannot be written to and no home: compiled anew, the same entries."""
    pytest.importorskip("numba")
    code = (
        "import numpy as np; from singletrack.closed_form import many; "
        "from singletrack.closed_form.programs import program_named; "
        "p = program_named('bicycle'); v = tuple(np.linspace(1, 2, 3) for _ in p.of_bicycle); "
        "a = many._run(p, v); assert many.use_compiled(p); assert (a == many._run(p, v)).all(); print('same')"
    )
    nowhere = {**os.environ, "NUMBA_CACHE_LOCATOR_CLASSES": "ZipCacheLocator"}
    found = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, env=nowhere, check=False)
    assert found.stdout.strip() == "same", found.stderr[-2000:]


def test_programs_for_batches_are_those_of_single_designs() -> None:
    bicycle, rider = varied()
    program = program_of(bicycle, rider, Options("upright"))
    assert program is not None
    assert program.name == "upright-axial"
