"""Fixtures shared by all tests."""

from __future__ import annotations

import json
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest
from hypothesis import settings

from designs import COMBINATIONS, random_bicycle, shipped_model
from singletrack import coefficients, load_bicycle

if TYPE_CHECKING:
    from singletrack import CoefficientMatrices

HERE = Path(__file__).parent
# The mutation runner is a program; it needs a library that only its own make target installs.
collect_ignore_glob = ["mutation/*"]

# Tests are never timed: a machine may be busy.
settings.register_profile("untimed", deadline=None)
settings.load_profile("untimed")


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


@pytest.fixture(scope="session")
def random_models() -> CoefficientMatrices:
    """300 random bicycles: the 25 parameters of the three shipped ones, each within 30 %, seeded."""
    rng = np.random.default_rng(20071001)
    parts = [coefficients(random_bicycle(load_bicycle(name), rng, 100)) for name in ("benchmark", "stratos", "browser")]
    matrices = (np.concatenate([getattr(part, name) for part in parts]) for name in ("M", "C1", "K0", "K2"))
    return type(parts[0])(*matrices, np.array(9.81))
