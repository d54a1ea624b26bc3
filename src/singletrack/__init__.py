"""Lateral dynamics of bicycles with real riders, hands on the handlebar.

>>> from singletrack import coefficients, load_bicycle, load_rider
>>> model = coefficients(load_bicycle("stratos"), load_rider("rider-a"), posture="leaned")
>>> model.critical_speeds().stable_ranges
[(5.90..., 9.44...)]
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from singletrack.errors import InputError, PostureError, SingletrackError

if TYPE_CHECKING:
    from singletrack.linear import CoefficientMatrices, coefficients
    from singletrack.parameters import Bicycle, Rider, load_bicycle, load_rider

__version__ = "0.1.0"

__all__ = [
    "Bicycle",
    "CoefficientMatrices",
    "InputError",
    "PostureError",
    "Rider",
    "SingletrackError",
    "__version__",
    "coefficients",
    "load_bicycle",
    "load_rider",
]

# Where each public name lives; loaded on first use, so that `import singletrack` stays light.
_LAZY = {
    "Bicycle": "singletrack.parameters",
    "CoefficientMatrices": "singletrack.linear",
    "Rider": "singletrack.parameters",
    "coefficients": "singletrack.linear",
    "load_bicycle": "singletrack.parameters",
    "load_rider": "singletrack.parameters",
}


def __getattr__(name: str) -> Any:
    if name not in _LAZY:
        raise AttributeError(f"module 'singletrack' has no attribute {name!r}")
    import importlib

    return getattr(importlib.import_module(_LAZY[name]), name)


def __dir__() -> list[str]:
    return sorted(__all__)
