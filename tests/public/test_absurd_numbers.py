"""Numbers far beyond all bicycles: refused, or followed by finite answers; no NaN, no infinity, no warning of NumPy."""

from __future__ import annotations

import math
import re
import warnings
from typing import Any

import numpy as np
import pytest

from singletrack import Bicycle, Rider, SingletrackError, coefficients, load_bicycle, load_rider
from singletrack.linear import critical_speeds, eigenvalues, modes
from singletrack.model import LinearModel
from singletrack.parameters.description import BOUNDS

#: What a double can be: beside the least and the largest, and in the middle of nowhere.
EDGES = (0.0, -0.0, 5e-324, 2.3e-308, 1e-150, 1e150, 1.7e308, -1e-300, -1e300)
FACTORS = (1e-300, 1e-150, 1e-40, 1e-12, 1e-3, 1e3, 1e12, 1e40, 1e150, 1e300)
SPEEDS = ([0.0, 5.0], [5e-324, 1e-310, 1.0], [1e-300], [1e7], [2.9e8], [-5.0, 3.0], [1e300])


def changed(rng: np.random.Generator, record: Bicycle | Rider) -> dict[str, Any]:
    """Return absurd values for a few parameters, or all masses and inertias by a factor."""
    known = {name: float(np.asarray(value)) for name, value in record.values().items() if value is not None}
    units = {name: record.descriptions()[name].unit for name in known}
    if rng.random() < 0.2:
        factor = rng.choice(FACTORS)
        return {name: value * factor for name, value in known.items() if units[name][:2] == "kg"}
    found = {}
    for name in rng.choice(list(known), int(rng.choice([1, 2, 3, 6])), replace=False):
        least, most = BOUNDS.get(units[name], (1e-6, 1.0))
        allowed = 10.0 ** rng.uniform(np.log10(max(least, 1e-300)), np.log10(most))
        drawn = (math.copysign(allowed, known[name]), known[name] * rng.choice(FACTORS), rng.choice(EDGES))
        found[name] = float(rng.choice(drawn, p=[0.8, 0.1, 0.1]))
    return found


def sprung(rng: np.random.Generator) -> dict[str, dict[str, float]]:
    values = (*EDGES, 1e12, 1e5)
    return {what: {"steer": float(rng.choice(values))} for what in ("springs", "dampers") if rng.random() < 0.3}


@pytest.mark.parametrize("seed", range(4))
def test_finite_or_refused(seed: int) -> None:
    rng = np.random.default_rng([20261124, seed])
    bicycles = [load_bicycle(name) for name in ("benchmark", "stratos", "browser")]
    rider = load_rider("rider-a")
    answered, refusals = 0, set()
    with warnings.catch_warnings():
        warnings.simplefilter("error", RuntimeWarning)
        for _ in range(300):
            bicycle = bicycles[rng.integers(3)]
            posture = str(rng.choice(["", "rigid", "leaned", "upright"]))
            ridden = posture and rng.random() < 0.5
            try:
                on = bicycle if ridden else bicycle.replace(**changed(rng, bicycle))
                by = rider.replace(**changed(rng, rider)) if ridden else rider
                who = {"rider": by, "posture": posture, "torso_lean": bool(rng.random() < 0.3)} if posture else {}
                model = coefficients(on, **who, **sprung(rng))
            except SingletrackError as error:
                refusals.add(str(error))
                continue
            answered += finite_answers(model, SPEEDS[rng.integers(len(SPEEDS))])
    assert answered > 10  # the test is about something
    assert not [text for text in refusals if re.search(r"\bnan\b", text)]


def finite_answers(model: Any, speeds: list[float]) -> bool:
    for name in ("M", "C0", "C1", "S0", "K0", "K2", "B"):
        assert np.isfinite(getattr(model, name)).all(), name
    found = model.critical_speeds()
    assert np.isfinite([*found.weave, *found.capsize]).all()
    assert all(low < high for low, high in found.stable_ranges)
    try:
        assert np.isfinite(model.eigenvalues(speeds)).all()
        assert np.isfinite(model.state_space(speeds).A).all()
        assert np.isfinite(model.modes(speeds).eigenvalues).all()
    except SingletrackError:  # of what is faster than light, or cannot be followed
        return False
    return True


@pytest.mark.parametrize("factor", [1e-300, 1e-200, 1e-40, 1e40, 1e100, 1e200, 1e300])
def test_all_matrices_times_a_number_move_alike(factor: float) -> None:
    """Speeds, eigenvalues and names know nothing of the unit of mass."""
    model = coefficients(load_bicycle("stratos"), springs={"steer": 1.0}, dampers={"steer": 0.1})
    data = {name: np.asarray(getattr(model, name)) * factor for name in ("M", "C0", "C1", "S0", "K0", "K2")}
    scaled = LinearModel.from_dict({name: value.tolist() for name, value in data.items()} | {"gravity": 9.81})
    np.testing.assert_allclose(eigenvalues(scaled, [0.0, 5.0]), eigenvalues(model, [0.0, 5.0]), rtol=1e-9, atol=1e-9)
    np.testing.assert_allclose(critical_speeds(scaled).weave, critical_speeds(model).weave, rtol=1e-9)
    assert modes(scaled, [5.0, 6.0]).names == modes(model, [5.0, 6.0]).names


def test_of_a_batch_those_out_of_range_do_not_touch_the_others() -> None:
    model = coefficients(load_bicycle("benchmark"))
    factors = np.array([1.0, 1e200, 1e-200, 1.0])[:, None, None]
    names = ("M", "C1", "K0", "K2")
    batch = LinearModel(*(np.asarray(getattr(model, name)) * factors for name in names), model.gravity)
    found, wanted = eigenvalues(batch, [3.0, 5.0]), eigenvalues(model, [3.0, 5.0])
    np.testing.assert_array_equal(found[[0, 3]], [wanted, wanted])
    np.testing.assert_allclose(found[[1, 2]], [wanted, wanted], rtol=1e-12, atol=1e-12)


@pytest.mark.parametrize("what", ["springs", "dampers"])
@pytest.mark.parametrize("value", [1e13, 1e308, np.array([1.0, 1e300])])
def test_springs_beyond_all_that_is_ridden_are_refused(what: str, value: Any) -> None:
    with pytest.raises(SingletrackError, match=r"at steer: found 1e\+\d+ .*, must be at most 1e\+12"):
        coefficients(load_bicycle("benchmark"), **{what: {"steer": value}})
