"""The equations of a bicycle with its rider, traced once into a list of scalar statements that runs on balls.

The statements are those of the closed form, the same ones from which the page is made: there is no second derivation.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

import jax
import numpy as np

from singletrack.certify.problems import MATRICES
from singletrack.closed_form import coefficients
from singletrack.tracing import Graph, trace

if TYPE_CHECKING:
    from collections.abc import Sequence

    from singletrack.parameters import Bicycle, Rider
    from singletrack.posture import Options

__all__ = ["Program", "reads_of", "traced"]


@dataclass(frozen=True, eq=False)
class Program:
    """A traced program: its inputs by name, its graph, the nodes of M, C0, C1, S0, K0, K2 and gravity."""

    reads: tuple[str, ...]
    graph: Graph
    outputs: tuple[np.ndarray, ...]


#: Programs by what they were traced from, the latest last.
_KNOWN: dict[tuple[Any, ...], Program] = {}
_MOST_KNOWN = 64


def reads_of(bicycle: Bicycle, rider: Rider | None, options: Options) -> dict[str, float]:
    """Return what a program reads, by name, of a bicycle, rider and options: parameters, stiffness and damping."""
    found = {name: float(value) for name, value in bicycle.values().items()}
    found |= {} if rider is None else {name: float(value) for name, value in rider.values().items()}
    for what, values in (("spring", options.springs), ("damper", options.dampers)):
        found |= {f"{what} at {joint}": float(value) for joint, value in values.items()}
    if options.fit is not None:
        found["fit"] = float(options.fit)
    return found


def traced(bicycle: Bicycle, rider: Rider | None, options: Options, *, anew: bool = False) -> Program:
    """Return the program of all designs that sit like this one.

    Parameters
    ----------
    bicycle : Bicycle
        A single design.
    rider : Rider, or None
        On this bicycle.
    options : Options
    anew : bool
        Trace even if it is known, so that pivots are chosen for this design.

    Raises
    ------
    InputError
        For equations that have no straight list of statements.
    """
    nominal = reads_of(bicycle, rider, options)
    shapes = None if rider is None else repr(rider.shapes)
    sitting = replace(options, springs={}, dampers={}, fit=None)
    key = (tuple(nominal), repr(sitting), shapes)
    if anew or key not in _KNOWN:
        while len(_KNOWN) >= _MOST_KNOWN:
            del _KNOWN[next(iter(_KNOWN))]
        _KNOWN[key] = _trace(bicycle, rider, options, nominal)
    return _KNOWN[key]


def _trace(bicycle: Bicycle, rider: Rider | None, options: Options, nominal: dict[str, float]) -> Program:
    def equations(inputs: Any) -> tuple[Any, ...]:
        named = dict(zip(nominal, inputs, strict=False))
        design = _with(bicycle, rider, options, named)
        model = coefficients(*design)
        return (*(jax.numpy.asarray(getattr(model, name)) for name in MATRICES), jax.numpy.asarray(model.gravity))

    config: Any = jax.config
    before = config.jax_enable_x64
    config.update("jax_enable_x64", val=True)
    try:
        graph, outputs = trace(equations, list(nominal.values()))
    finally:
        config.update("jax_enable_x64", val=before)
    return Program(tuple(nominal), graph, tuple(outputs))


def _with(
    bicycle: Bicycle, rider: Rider | None, options: Options, named: dict[str, Any]
) -> tuple[Bicycle, Rider | None, Options]:
    """Return a design with other numbers, which may be those of a trace."""
    bicycle = bicycle.replace(**{name: named[name] for name in bicycle.values()})
    if rider is not None:
        rider = rider.replace(**{name: named[name] for name in rider.values()})

    def amounts(what: str, joints: Sequence[str]) -> dict[str, Any]:
        return {joint: named[f"{what} at {joint}"] for joint in joints}

    springs, dampers = amounts("spring", list(options.springs)), amounts("damper", list(options.dampers))
    return bicycle, rider, replace(options, springs=springs, dampers=dampers, fit=named.get("fit"))
