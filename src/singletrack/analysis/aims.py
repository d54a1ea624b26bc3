"""What a design is searched for: numbers that shall be small, with exact gradients."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Protocol

import numpy as np

from singletrack.errors import InputError
from singletrack.linear import critical_speeds, eigenvalues
from singletrack.linear.eigenvalues import checked_speeds
from singletrack.model import LinearModel

if TYPE_CHECKING:
    from singletrack.analysis.derivatives import Derivatives

__all__ = ["Aim", "LowestWeave", "StableBetween", "TargetMatrices", "WidestRange"]

# Speeds at which growth is looked at; what is found is then decided by the exact critical speeds.
_GRID = 25


class Aim(Protocol):
    """Something to be made small: the largest of r numbers, each with its gradient."""

    @property
    def name(self) -> str:
        """What it is, with its unit."""
        ...

    def __call__(self, slopes: Derivatives) -> tuple[np.ndarray, np.ndarray]:
        """Return the numbers (r,) and their derivatives (r, k) per SI unit of the k parameters.

        Parameters
        ----------
        slopes : Derivatives
            Of one design, with respect to k parameters.
        """
        ...


@dataclass(frozen=True)
class StableBetween:
    """All modes stable at all speeds from ``low`` to ``high`` in m/s: the fastest growth there, in 1/s."""

    low: float
    high: float

    def __post_init__(self) -> None:
        if not 0 <= self.low < self.high:
            raise InputError(f"stable from {self.low:g} to {self.high:g} m/s: must be from less to more, not negative")
        checked_speeds(self.high)

    @property
    def name(self) -> str:
        """What it is."""
        return f"fastest growth from {self.low:g} to {self.high:g} m/s (1/s)"

    def __call__(self, slopes: Derivatives) -> tuple[np.ndarray, np.ndarray]:
        """Return the growths (r,) of the modes at speeds in the range, and their gradients (r, k).

        Parameters
        ----------
        slopes : Derivatives
        """
        speeds = np.linspace(self.low, self.high, _GRID)
        roots = eigenvalues(slopes.model, speeds)
        rows = slopes.eigenvalues(speeds[:, None], roots).real
        upper = roots.imag >= 0  # of a pair, one is enough
        return roots.real[upper], np.nan_to_num(rows[upper], posinf=0.0, neginf=0.0)


@dataclass(frozen=True)
class WidestRange:
    """The widest range of stable speeds below ``top`` in m/s: minus its width; without any, the least growth."""

    top: float = 12.0

    def __post_init__(self) -> None:
        checked_speeds(self.top)

    @property
    def name(self) -> str:
        """What it is."""
        return f"minus the widest stable range below {self.top:g} m/s (m/s)"

    def __call__(self, slopes: Derivatives) -> tuple[np.ndarray, np.ndarray]:
        """Return one number (1,) and its gradient (1, k).

        Parameters
        ----------
        slopes : Derivatives
        """
        ranges = _stable_below(slopes, self.top)
        if not ranges:
            value, row = _least_growth(slopes, self.top)
            return np.array([value]), row[None]
        low, high = max(ranges, key=lambda r: r[1] - r[0])
        row = _speed_gradient(slopes, high if high < self.top else None) - _speed_gradient(slopes, low or None)
        return np.array([low - high]), -row[None]


@dataclass(frozen=True)
class LowestWeave:
    """The lowest speed from which a bicycle is stable over a range of at least ``width``, in m/s.

    A narrower range counts as if it began later by what it lacks; without any, ``top`` and the least growth below it.
    """

    top: float = 12.0
    width: float = 1.0

    @property
    def name(self) -> str:
        """What it is."""
        return f"speed from which it is stable over {self.width:g} m/s (m/s)"

    def __call__(self, slopes: Derivatives) -> tuple[np.ndarray, np.ndarray]:
        """Return two numbers (2,) and their gradients (2, k): the speed, and the speed later by what the range lacks.

        Parameters
        ----------
        slopes : Derivatives
        """
        ranges = _stable_below(slopes, self.top)
        if not ranges:
            value, row = _least_growth(slopes, self.top)
            return np.full(2, self.top + value), np.stack([row, row])
        low, high = min(ranges, key=lambda r: r[0] + max(0.0, self.width - (r[1] - r[0])))
        first = _speed_gradient(slopes, low or None)
        last = _speed_gradient(slopes, high if high < self.top else None)
        return np.array([low, 2 * low + self.width - high]), np.stack([first, 2 * first - last])


@dataclass(frozen=True, eq=False)
class TargetMatrices:
    """The matrices of another model: squared differences of M, C1, K0, K2, each relative to its matrix's size."""

    target: LinearModel

    @property
    def name(self) -> str:
        """What it is."""
        return "squared distance from the target matrices"

    def __call__(self, slopes: Derivatives) -> tuple[np.ndarray, np.ndarray]:
        """Return one number (1,) and its gradient (1, k).

        Parameters
        ----------
        slopes : Derivatives

        Raises
        ------
        InputError
            If the target has other coordinates.
        """
        if self.target.coordinates != slopes.model.coordinates:
            raise InputError(f"target: has coordinates {self.target.coordinates}, must be {slopes.model.coordinates}")
        value, row = 0.0, np.zeros(len(slopes.names))
        for name in ("M", "C1", "K0", "K2"):
            wanted = np.asarray(getattr(self.target, name))
            apart = (np.asarray(getattr(slopes.model, name)) - wanted) / np.linalg.norm(wanted)
            value += float((apart**2).sum())
            row += 2 * np.einsum("ij,kij->k", apart, slopes.matrices[name]) / np.linalg.norm(wanted)
        return np.array([value]), row[None]


def _stable_below(slopes: Derivatives, top: float) -> list[tuple[float, float]]:
    """Return the stable ranges in m/s, as far as they lie below top."""
    ranges = [(low, min(high, top)) for low, high in critical_speeds(slopes.model).stable_ranges]
    return [(low, high) for low, high in ranges if low < high]


def _least_growth(slopes: Derivatives, top: float) -> tuple[float, np.ndarray]:
    """Return the growth at the speed below top where it is least, positive there, and its gradient (k,)."""
    speeds = np.linspace(0.05 * top, top, 4 * _GRID)
    roots = eigenvalues(slopes.model, speeds)
    growth = roots.real.max(axis=-1)
    best = int(growth.argmin())
    root = roots[best][int(roots[best].real.argmax())]
    row = slopes.eigenvalues(speeds[best], root).real  # the speed's own change does nothing to first order
    return max(float(growth[best]), 0.0), np.nan_to_num(row, posinf=0.0, neginf=0.0)


def _speed_gradient(slopes: Derivatives, speed: float | None) -> np.ndarray:
    """Return the gradient (k,) of a critical speed of either kind; zero for an end that is none."""
    if speed is None:
        return np.zeros(len(slopes.names))
    roots = eigenvalues(slopes.model, speed)[0]
    nearest = roots[int(np.abs(roots.real).argmin())]
    kind = "capsize" if abs(nearest.imag) < 1e-6 * max(1.0, np.abs(roots).max()) else "weave"
    row: np.ndarray = slopes.critical_speeds(np.array([speed]), kind)[0]
    finite: np.ndarray = np.nan_to_num(row, posinf=0.0, neginf=0.0)
    return finite
