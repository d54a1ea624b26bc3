"""Lateral dynamics of bicycles with real riders, hands on the handlebar.

>>> from singletrack import coefficients, load_bicycle, load_rider
>>> model = coefficients(load_bicycle("stratos"), load_rider("rider-a"), posture="leaned")
>>> model.critical_speeds().stable_ranges
[(5.99..., 9.58...)]
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from singletrack.errors import InputError, OddityWarning, PostureError, SingletrackError
from singletrack.version import __version__

if TYPE_CHECKING:
    from singletrack import catalogue, spacar
    from singletrack.body.fit import fit
    from singletrack.library import load_bicycle, load_rider
    from singletrack.parameters import Bicycle, Rider
    from singletrack.public import CoefficientMatrices, coefficients
    from singletrack.public.turning import turn
    from singletrack.webpage import page

__all__ = [
    "Bicycle",
    "CoefficientMatrices",
    "InputError",
    "OddityWarning",
    "PostureError",
    "Rider",
    "SingletrackError",
    "__version__",
    "catalogue",
    "coefficients",
    "fit",
    "load_bicycle",
    "load_rider",
    "page",
    "spacar",
    "turn",
]

# Where each public name lives; loaded on first use, so that `import singletrack` stays light.
_LAZY = {
    "Bicycle": "singletrack.parameters",
    "CoefficientMatrices": "singletrack.public",
    "Rider": "singletrack.parameters",
    "coefficients": "singletrack.public",
    "fit": "singletrack.body.fit",
    "load_bicycle": "singletrack.library",
    "load_rider": "singletrack.library",
    "turn": "singletrack.public.turning",
    "page": "singletrack.webpage",
}
_MODULES = ("catalogue", "spacar")


def __getattr__(name: str) -> Any:
    if name not in _LAZY and name not in _MODULES:
        raise AttributeError(f"module 'singletrack' has no attribute {name!r}")
    import importlib

    if name in _MODULES:
        return importlib.import_module(f"singletrack.{name}")
    return getattr(importlib.import_module(_LAZY[name]), name)


def __dir__() -> list[str]:
    return sorted(__all__)
