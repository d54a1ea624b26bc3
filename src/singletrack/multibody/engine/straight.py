"""The linear model of straight running: the equations of a machine as exact polynomials in speed and gravity."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from singletrack.model import LinearModel
from singletrack.multibody.engine.assembly import move
from singletrack.multibody.engine.linearise import linearise

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from singletrack.multibody.engine.model import State

__all__ = ["speed_polynomials"]


def speed_polynomials(upright: State, rolling: Mapping[str, float], names: Sequence[str]) -> LinearModel:
    """Return the linear model of straight running: the equations as exact polynomials in speed and gravity.

    C0 and S0 come from dampers and springs. The equations of a machine are quadratic in its speeds and linear in
    gravity, so the coefficients follow exactly from the linearisations at rest and at unit speed, without and with
    gravity.

    Parameters
    ----------
    upright
        The machine at rest.
    rolling
        Rates of independent speeds at a forward speed of 1 m/s, such as ``{"rear wheel": -1 / radius}``.
    names
        The freedoms to keep, such as ``("lean", "steer")``; any number of them.

    Returns
    -------
    LinearModel
        Of these coordinates and of all inputs of the machine, at its gravity.

    Examples
    --------
    >>> from singletrack import load_bicycle
    >>> from singletrack.multibody import assemble, bicycle_model
    >>> at_rest = assemble(bicycle_model(load_bicycle("benchmark")))
    >>> speed_polynomials(at_rest, {"rear wheel": -1 / 0.3}, ("lean", "steer")).K2.round(6).tolist()
    [[0.0, 76.597346], [0.0, 2.654315]]
    """
    weightless = upright.parameters.copy()
    weightless[0] = 0.0
    heavy = upright.parameters.copy()
    heavy[0] = 1.0
    still = linearise(replace(upright, parameters=weightless), keep=names).select(names)
    heavy_still = linearise(replace(upright, parameters=heavy), keep=names).select(names)
    moving = linearise(move(replace(upright, parameters=weightless), rolling), keep=names).select(names)
    return LinearModel(
        M=still[0],
        C0=still[1],
        C1=moving[1] - still[1],
        S0=still[2],
        K0=heavy_still[2] - still[2],
        K2=moving[2] - still[2],
        B=still[3],
        gravity=upright.parameters[0],
        coordinates=tuple(names),
        inputs=tuple(given.name for given in upright.model.system.inputs),
    )
