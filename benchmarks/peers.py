"""BicycleParameters from PyPI, asked for what we compute."""

from __future__ import annotations

import warnings
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest

if TYPE_CHECKING:
    from singletrack import Bicycle

_BODIES = {"B": "rear_frame", "H": "front_frame", "R": "rear_wheel", "F": "front_wheel"}
_GENERAL = {"c": "trail", "g": "gravity", "lam": "steer_axis_tilt", "w": "wheel_base"}


def names() -> dict[str, str]:
    """Return our name of each parameter by theirs."""
    found = dict(_GENERAL)
    for letter, body in _BODIES.items():
        frame = letter in "BH"
        for axes in ("xx", "yy", "zz", "xz") if frame else ("xx", "yy"):
            found[f"I{letter}{axes}"] = f"{body}_inertia_{axes}"
        for symbol, what in (("m", "mass"), *((("x", "x"), ("z", "z")) if frame else (("r", "radius"),))):
            found[f"{symbol}{letter}"] = f"{body}_{what}"
    return found


def parameters(bicycle: Bicycle, index: int | None = None) -> dict[str, float]:
    """Return a bicycle's parameters as theirs; of a batch, those of one design."""
    values = {theirs: getattr(bicycle, ours) for theirs, ours in names().items()}
    if index is not None:
        values = {name: np.broadcast_to(value, bicycle.shape)[index] for name, value in values.items()}
    return {name: float(value) for name, value in values.items()} | {"v": 1.0}


def model(bicycle: Bicycle) -> Any:
    """Return their model of a single bicycle; skip where BicycleParameters is not installed."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        models = pytest.importorskip("bicycleparameters.models", reason="pip install 'singletrack[benchmark]'")
        sets = pytest.importorskip("bicycleparameters.parameter_sets")
    return models.Meijaard2007Model(sets.Meijaard2007ParameterSet(parameters(bicycle), includes_rider=True))
