"""The units in which people change parameters and read figures: mm, deg, kg; everything inside stays SI."""

from __future__ import annotations

from math import pi
from typing import NamedTuple

__all__ = ["Step", "step_of"]


class Step(NamedTuple):
    """A unit to change a parameter in, and a change that one can make on a bicycle.

    ``unit`` is its name, ``factor`` what a number in SI is multiplied with to get it, ``size`` the change in SI.
    """

    unit: str
    factor: float
    size: float


_STEPS = {
    "m": Step("mm", 1e3, 0.01),
    "rad": Step("deg", 180 / pi, pi / 180),
    "kg": Step("kg", 1.0, 1.0),
    "kg*m**2": Step("kg m²", 1.0, 0.01),
    "m/s**2": Step("m/s²", 1.0, 0.1),
    "": Step("%", 1e2, 0.01),
    "N*m/rad": Step("N m/rad", 1.0, 10.0),
    "N*m*s/rad": Step("N m s/rad", 1.0, 1.0),
    "N/m": Step("N/m", 1.0, 100.0),
    "N*s/m": Step("N s/m", 1.0, 10.0),
}


def step_of(unit: str) -> Step:
    """Return how people change a parameter: 10 mm, 1 deg, 1 kg, 0.01 kg m², a hundredth of the whole, ...

    Parameters
    ----------
    unit : str
        The parameter's SI unit, as its description has it.

    Examples
    --------
    >>> step_of("m")
    Step(unit='mm', factor=1000.0, size=0.01)
    """
    return _STEPS.get(unit, Step(unit, 1.0, 1.0))
