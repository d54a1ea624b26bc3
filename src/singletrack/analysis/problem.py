"""What is searched, and what was found: records."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from singletrack.analysis.aims import Aim
from singletrack.analysis.designs import Design
from singletrack.errors import InputError
from singletrack.parameters.description import BOUNDS

__all__ = ["Found", "Keep", "Problem"]


@dataclass(frozen=True)
class Keep:
    """A quantity or parameter that stays between two values, SI; either may be infinite."""

    name: str
    low: float = -np.inf
    high: float = np.inf


@dataclass(frozen=True, eq=False)
class Problem:
    """What is searched: a design, the parameters that may change and how far, aims and constraints.

    Attributes
    ----------
    design : Design
    aim : Aim
        To be made small.
    bounds : mapping of str to (float, float)
        The k parameters with their least and greatest values, SI.
    keeps : tuple of Keep
    limits : tuple of (Aim, float)
        Other aims, each to stay at or below a number.

    Raises
    ------
    InputError
        If a parameter is unknown, there is none, or its bounds are not in order.
    """

    design: Design
    aim: Aim
    bounds: Mapping[str, tuple[float, float]]
    keeps: tuple[Keep, ...] = ()
    limits: tuple[tuple[Aim, float], ...] = ()

    def __post_init__(self) -> None:
        if not self.bounds:
            raise InputError("design: no parameter may change; give at least one with its bounds")
        for name, (low, high) in self.bounds.items():
            most = BOUNDS.get(self.design.unit(name), (0.0, 1e6))[1]
            if not (np.isfinite([low, high]).all() and low < high):
                raise InputError(f"bounds of {name}: found {low:g} to {high:g}, must be finite, from less to more")
            if max(abs(low), abs(high)) > most:
                raise InputError(f"bounds of {name}: found {low:g} to {high:g}, must be from -{most:g} to {most:g}")

    @property
    def names(self) -> tuple[str, ...]:
        """The k parameters."""
        return tuple(self.bounds)

    def at(self, x: np.ndarray) -> Design:
        """Return the design with its parameters at x (k,), zero at the lower bounds and one at the upper.

        Parameters
        ----------
        x : array, shape (k,)
            Share of the way from each lower bound to the upper.
        """
        low, high = np.array(list(self.bounds.values())).T
        return self.design.changed(dict(zip(self.names, (low + x * (high - low)).tolist(), strict=True)))

    @property
    def start(self) -> np.ndarray:
        """The design as it is, within the bounds: x (k,)."""
        low, high = np.array(list(self.bounds.values())).T
        own = self.design.values()
        x: np.ndarray = np.clip((np.array([float(own[name]) for name in self.names]) - low) / (high - low), 0.0, 1.0)
        return x


@dataclass(frozen=True, eq=False)
class Found:
    """Where a search from one start ended.

    Attributes
    ----------
    x : array, shape (k,)
        From zero at the lower bounds to one at the upper.
    value : float
        Of the aim.
    feasible : bool
        Whether constraints and limits hold.
    binding : tuple of str
        Bounds and constraints that hold it back, in words.
    stationary : float
        What is left of the gradient after what binds, in the aim's unit per range of a parameter: zero at an optimum.
    """

    x: np.ndarray
    value: float
    feasible: bool
    binding: tuple[str, ...] = ()
    stationary: float = float("nan")

    def to_dict(self) -> dict[str, Any]:
        """Return it for JSON."""
        return {
            "x": self.x.tolist(),
            "value": self.value,
            "feasible": self.feasible,
            "binding": list(self.binding),
            "stationary": self.stationary,
        }
