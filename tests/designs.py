"""Designs that several tests look at."""

from __future__ import annotations

from typing import TYPE_CHECKING

from singletrack import coefficients, load_bicycle, load_rider

if TYPE_CHECKING:
    import numpy as np

    from singletrack import Bicycle, CoefficientMatrices

#: Every shipped combination of bicycle, rider and posture; None: without rider.
COMBINATIONS = [
    ("benchmark", None),
    ("stratos", None),
    ("browser", None),
    *((bicycle, posture) for bicycle in ("stratos", "browser") for posture in ("rigid", "leaned", "upright")),
]


def shipped_model(bicycle: str, posture: str | None) -> CoefficientMatrices:
    if posture is None:
        return coefficients(load_bicycle(bicycle))
    return coefficients(load_bicycle(bicycle), load_rider("rider-a"), posture)


def random_bicycle(bicycle: Bicycle, rng: np.random.Generator, count: int) -> Bicycle:
    """Return a batch of bicycles with every parameter but gravity changed by up to 30 %."""
    names = bicycle.values()
    changed = {
        name: getattr(bicycle, name) * rng.uniform(0.7, 1.3, count)
        for name in names
        if bicycle.descriptions()[name].group[:5] != "frame" and name != "gravity"
    }
    return bicycle.replace(**changed)
