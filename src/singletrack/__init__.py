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
    from singletrack.analysis.compare import compare
    from singletrack.analysis.designs import Design
    from singletrack.analysis.search import search
    from singletrack.analysis.sensitivity import sensitivity
    from singletrack.body.fit import elbow_angle, fit
    from singletrack.library import load_bicycle, load_rider
    from singletrack.measuring.measurement import measure
    from singletrack.parameters import Bicycle, Rider
    from singletrack.posture import Options
    from singletrack.public import CoefficientMatrices, coefficients
    from singletrack.public.riding import ride_for
    from singletrack.public.turning import turn, turn_family
    from singletrack.webpage import page

__all__ = [
    "Bicycle",
    "CoefficientMatrices",
    "Design",
    "InputError",
    "OddityWarning",
    "Options",
    "PostureError",
    "Rider",
    "SingletrackError",
    "__version__",
    "catalogue",
    "coefficients",
    "compare",
    "elbow_angle",
    "fit",
    "load_bicycle",
    "load_rider",
    "measure",
    "page",
    "ride_for",
    "search",
    "sensitivity",
    "spacar",
    "turn",
    "turn_family",
]

# Where each public name lives; loaded on first use, so that `import singletrack` stays light.
_LAZY = {
    "Bicycle": "singletrack.parameters",
    "CoefficientMatrices": "singletrack.public",
    "coefficients": "singletrack.public",
    "compare": "singletrack.analysis.compare",
    "Design": "singletrack.analysis.designs",
    "elbow_angle": "singletrack.body.fit",
    "fit": "singletrack.body.fit",
    "load_bicycle": "singletrack.library",
    "load_rider": "singletrack.library",
    "measure": "singletrack.measuring.measurement",
    "Options": "singletrack.posture",
    "page": "singletrack.webpage",
    "ride_for": "singletrack.public.riding",
    "Rider": "singletrack.parameters",
    "search": "singletrack.analysis.search",
    "sensitivity": "singletrack.analysis.sensitivity",
    "turn": "singletrack.public.turning",
    "turn_family": "singletrack.public.turning",
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
