"""Fixtures shared by all tests."""

from __future__ import annotations

import json
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest
from hypothesis import settings

from singletrack import coefficients, load_bicycle, load_rider

if TYPE_CHECKING:
    from singletrack import Bicycle, CoefficientMatrices

HERE = Path(__file__).parent

# Tests are never timed: a machine may be busy.
settings.register_profile("untimed", deadline=None)
settings.load_profile("untimed")

#: Every shipped combination of bicycle, rider and posture; None: without rider.
COMBINATIONS = [
    ("benchmark", None),
    ("stratos", None),
    ("browser", None),
    *((bicycle, posture) for bicycle in ("stratos", "browser") for posture in ("rigid", "leaned", "upright")),
]


@pytest.fixture(scope="session")
def meijaard() -> dict[str, Any]:
    """Published benchmark: parameters, matrices, eigenvalues, critical speeds."""
    return json.loads((HERE / "reference" / "meijaard2007.json").read_text())


@pytest.fixture(scope="session")
def shared_data() -> Path:
    """Return the folder of measured files of others, read in place; they do not come with the package."""
    folder = HERE.parent.parent / "shared" / "data" / "bicycleparameters"
    if not folder.is_dir():
        pytest.skip("measured files of others are not here: ../shared/data/bicycleparameters does not exist")
    return folder


@pytest.fixture(params=COMBINATIONS, ids=lambda pair: f"{pair[0]}-{pair[1] or 'alone'}")
def combination(request: pytest.FixtureRequest) -> CoefficientMatrices:
    """Return the model of each shipped combination."""
    bicycle, posture = request.param
    return shipped_model(bicycle, posture)


def shipped_model(bicycle: str, posture: str | None) -> CoefficientMatrices:
    if posture is None:
        return coefficients(load_bicycle(bicycle))
    return coefficients(load_bicycle(bicycle), load_rider("rider-a"), posture)


@pytest.fixture(scope="session")
def random_models() -> CoefficientMatrices:
    """300 random bicycles: the 25 parameters of the three shipped ones, each within 30 %, seeded."""
    rng = np.random.default_rng(20071001)
    parts = [coefficients(random_bicycle(load_bicycle(name), rng, 100)) for name in ("benchmark", "stratos", "browser")]
    matrices = (np.concatenate([getattr(part, name) for part in parts]) for name in ("M", "C1", "K0", "K2"))
    return type(parts[0])(*matrices, np.array(9.81))


def random_bicycle(bicycle: Bicycle, rng: np.random.Generator, count: int) -> Bicycle:
    """Return a batch of bicycles with every parameter but gravity changed by up to 30 %."""
    names = bicycle.values()
    changed = {
        name: getattr(bicycle, name) * rng.uniform(0.7, 1.3, count)
        for name in names
        if bicycle.descriptions()[name].group[:5] != "frame" and name != "gravity"
    }
    return bicycle.replace(**changed)
