"""A parameter run through a range: eigenvalues of the family, and the map of where it is stable."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from singletrack.errors import InputError
from singletrack.linear import CriticalSpeeds, Modes, critical_speeds, modes
from singletrack.model import LinearModel

if TYPE_CHECKING:
    from singletrack.analysis.designs import Design
    from singletrack.arrays import Array

__all__ = ["Family", "StabilityMap", "family", "stability_map"]

# Halvings of the step between two designs with different numbers of critical speeds: a fold to 1e-9 of the step.
_HALVINGS = 30


@dataclass(frozen=True, eq=False)
class Family:
    """Designs that differ in one parameter.

    Attributes
    ----------
    name, unit : str
        The parameter and its SI unit.
    values : array, shape (m,)
        SI.
    model : LinearModel
        Of shape (m,).
    """

    name: str
    unit: str
    values: np.ndarray
    model: LinearModel

    def lost(self) -> list[tuple[int, float, str]]:
        """Return why designs cannot exist: of each cause how many it hits, the value of the first, the reason."""
        found: list[tuple[int, float, str]] = []
        open_still = ~np.asarray(self.model.valid)
        for fault in self.model.faults:
            bad = np.broadcast_to(np.asarray(fault.bad), self.values.shape) & open_still
            if bad.any():
                first = int(np.argmax(bad))
                found.append((int(bad.sum()), float(self.values[first]), fault.reason((first,))))
                open_still = open_still & ~bad
        return found

    def modes(self, speeds: Array) -> Modes:
        """Return the modes of all designs at speeds (k,) in m/s; eigenvalues of shape (m, k, 2 n)."""
        return modes(self.model, speeds)


@dataclass(frozen=True, eq=False)
class StabilityMap:
    """Where a family of designs is stable: its critical speeds and stable ranges at ascending parameter values.

    Attributes
    ----------
    name, unit : str
        The parameter and its SI unit.
    values : array, shape (m,)
        Of the parameter, SI, ascending: those asked for, and those just before critical speeds cease to exist.
    critical : CriticalSpeeds
        Of the m designs.
    folds : array, shape (j,)
        Values at which critical speeds appear or cease to exist.
    """

    name: str
    unit: str
    values: np.ndarray
    critical: CriticalSpeeds
    folds: np.ndarray


def family(design: Design, name: str, values: Array) -> Family:
    """Return the designs that one parameter's values make.

    Parameters
    ----------
    design : Design
    name : str
        A parameter of bicycle, rider or posture.
    values : array, shape (m,)
        SI.

    Raises
    ------
    InputError
        If there is no such parameter, or none of the designs can exist.

    Examples
    --------
    >>> from singletrack import load_bicycle
    >>> from singletrack.analysis.designs import Design
    >>> family(Design.of(load_bicycle("benchmark")), "trail", [0.04, 0.06, 0.08]).model.shape
    (3,)
    """
    numbers = np.atleast_1d(np.asarray(values, dtype=float))
    unit = design.unit(name)
    model = design.changed({name: numbers}).model()
    model = model.broadcast_to(numbers.shape)
    if not model.valid.any():
        raise InputError(f"{name} from {numbers.min():g} to {numbers.max():g} {unit}: {_first_reason(model)}")
    return Family(name, unit, numbers, model)


def _first_reason(model: LinearModel) -> str:
    fault = next(fault for fault in model.faults if np.any(np.asarray(fault.bad)))
    return f"no design can exist, such as {fault.reason((int(np.argmax(np.asarray(fault.bad))),))}"


def stability_map(design: Design, name: str, values: Array) -> StabilityMap:
    """Return critical speeds and stable ranges over a parameter, with the folds where critical speeds cease to exist.

    Parameters
    ----------
    design : Design
    name : str
        A parameter of bicycle, rider or posture.
    values : array, shape (m,)
        SI, two or more.

    Raises
    ------
    InputError
        As :func:`family`.

    Notes
    -----
    Every critical speed is a root of a polynomial, of each design by itself. Between two designs with different numbers
    of them the parameter is bisected, all such places in one batch.
    """
    numbers = np.sort(np.atleast_1d(np.asarray(values, dtype=float)))
    known = critical_speeds(family(design, name, numbers).model)
    count = _counts(known)
    places = np.flatnonzero((count[1:] != count[:-1]) & known.told[1:] & known.told[:-1])
    low, high, below = numbers[places], numbers[places + 1], count[places]
    for _ in range(_HALVINGS if len(places) else 0):
        middle = (low + high) / 2
        same = _counts(critical_speeds(family(design, name, middle).model)) == below
        low, high = np.where(same, middle, low), np.where(same, high, middle)
    refined = np.unique(np.concatenate([numbers, low, high]))
    critical = critical_speeds(family(design, name, refined).model)
    return StabilityMap(name, design.unit(name), refined, critical, (low + high) / 2)


def _counts(critical: CriticalSpeeds) -> np.ndarray:
    """Return the numbers of pair and real crossings of each design as one number (m,)."""
    pairs, reals = (np.isfinite(a).sum(axis=-1) for a in (critical.weave_speeds, critical.capsize_speeds))
    result: np.ndarray = 1000 * pairs + reals
    return result
