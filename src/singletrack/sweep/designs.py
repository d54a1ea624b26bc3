"""The designs of a study: values of the parameters that vary, any part of them at a time.

A row depends on its number alone, so that a study can be computed in any order and taken up again anywhere.
"""

from __future__ import annotations

import warnings
from abc import abstractmethod
from dataclasses import dataclass
from functools import cached_property
from math import prod
from typing import Any, ClassVar

import numpy as np

from singletrack.errors import InputError

__all__ = ["Designs", "Variation", "make_designs"]

_LARGEST_TABLE = 50_000_000
#: Designs of a sweep: beyond, it would take weeks and terabytes.
_MOST = 1_000_000_000
_BLOCK = 4096


@dataclass(frozen=True)
class Variation:
    """How one parameter varies.

    Attributes
    ----------
    name : str
        The parameter.
    owner : {"bicycle", "rider"}
    unit : str
    kind : {"values", "uniform", "normal"}
    numbers : tuple of float
        The values; or from, to; or mean, standard deviation. SI units.
    """

    name: str
    owner: str
    unit: str
    kind: str
    numbers: tuple[float, ...]

    def at(self, quantiles: np.ndarray) -> np.ndarray:
        """Return the values (k,) of a distribution at quantiles (k,) between 0 and 1."""
        low, high = self.numbers
        if self.kind == "uniform":
            return low + (high - low) * quantiles
        from scipy.special import ndtri  # lazy: heavy

        # Quantiles of exactly 0 have no value: the outermost half step instead.
        values: np.ndarray = low + high * ndtri(np.clip(quantiles, 2.0**-54, 1 - 2.0**-53))
        return values


@dataclass(frozen=True)
class Designs:
    """Designs by number, 0 to ``count - 1``.

    Attributes
    ----------
    variations : tuple of Variation
    count : int
    seed : int
        Of the random numbers, where there are any.
    """

    variations: tuple[Variation, ...]
    count: int
    seed: int = 0

    method: ClassVar[str] = ""

    def rows(self, start: int, stop: int) -> np.ndarray:
        """Return the values, shape (stop - start, parameters), of the designs from start to before stop, SI units."""
        quantiles = self._quantiles(start, stop)
        return np.stack([v.at(quantiles[:, i]) for i, v in enumerate(self.variations)], axis=-1)

    @abstractmethod
    def _quantiles(self, start: int, stop: int) -> np.ndarray:
        """Return numbers (stop - start, parameters) between 0 and 1."""

    def to_dict(self) -> dict[str, Any]:
        """Return what determines the designs and their numbers, as plain values; the order of [vary] counts."""
        vary = {v.name: {"kind": v.kind, "unit": v.unit, "numbers": list(v.numbers)} for v in self.variations}
        order = list(vary)
        return {"method": self.method, "count": self.count, "seed": self.seed, "order": order, "vary": vary}


class _Grid(Designs):
    """Every combination; the last parameter varies fastest."""

    method = "grid"

    def rows(self, start: int, stop: int) -> np.ndarray:
        shape = [len(v.numbers) for v in self.variations]
        positions = np.unravel_index(np.arange(start, stop), shape)
        columns = [np.array(v.numbers)[at] for v, at in zip(self.variations, positions, strict=True)]
        return np.stack(columns, axis=-1)


class _List(Designs):
    """The values side by side: design i has the i-th value of each parameter."""

    method = "list"

    def rows(self, start: int, stop: int) -> np.ndarray:
        return np.stack([np.array(v.numbers[start:stop]) for v in self.variations], axis=-1)


class _Random(Designs):
    """Independent draws, in blocks with a generator each."""

    method = "random"

    def _quantiles(self, start: int, stop: int) -> np.ndarray:
        first, last = start // _BLOCK, -(-stop // _BLOCK)
        width = len(self.variations)
        blocks = [np.random.default_rng([self.seed, block]).random((_BLOCK, width)) for block in range(first, last)]
        return np.concatenate(blocks)[start - first * _BLOCK : stop - first * _BLOCK]


class _LatinHypercube(Designs):
    method = "latin-hypercube"

    @cached_property
    def _table(self) -> np.ndarray:
        from scipy.stats import qmc  # lazy: heavy

        table: np.ndarray = qmc.LatinHypercube(len(self.variations), rng=self.seed).random(self.count)
        return table

    def _quantiles(self, start: int, stop: int) -> np.ndarray:
        return self._table[start:stop]


class _Sobol(Designs):
    """A scrambled Sobol sequence."""

    method = "sobol"

    def _quantiles(self, start: int, stop: int) -> np.ndarray:
        from scipy.stats import qmc

        sequence = qmc.Sobol(len(self.variations), scramble=True, rng=self.seed)
        if start:
            sequence.fast_forward(start)
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # a chunk need not be a power of two; the whole is, we see to that
            points: np.ndarray = sequence.random(stop - start)
        return points


_METHODS: dict[str, type[Designs]] = {c.method: c for c in (_Grid, _List, _Random, _LatinHypercube, _Sobol)}


def make_designs(
    variations: list[Variation], method: str, samples: int | None = None, seed: int = 0, where: str = "study"
) -> Designs:
    """Return the designs of a sampling method.

    Parameters
    ----------
    variations : list of Variation
    method : {"grid", "list", "random", "latin-hypercube", "sobol"}
    samples : int, optional
        Number of designs, for the methods that draw from distributions.
    seed : int
    where : str
        Name of the file, for messages.

    Raises
    ------
    InputError
        If method, samples and variations do not go together.

    Examples
    --------
    >>> trail = Variation("trail", "bicycle", "m", "values", (0.05, 0.06))
    >>> tilt = Variation("steer_axis_tilt", "bicycle", "rad", "values", (0.3, 0.4))
    >>> make_designs([trail, tilt], "grid").rows(0, 4).tolist()
    [[0.05, 0.3], [0.05, 0.4], [0.06, 0.3], [0.06, 0.4]]
    """
    listed = method in {"grid", "list"}
    for v in variations:
        if listed != (v.kind == "values"):
            found, allowed = ("a distribution", "values") if listed else ("values", "a distribution")
            raise InputError(f"{where}: sampling.method = {method!r}, but vary.{v.name} is {found}; must be {allowed}")
    if listed == (samples is not None):
        rule = "must be left out (the values of [vary] say how many)" if listed else "must be given"
        raise InputError(f"{where}: sampling.samples with method = {method!r} {rule}")
    lengths = [len(v.numbers) for v in variations]
    if method == "list" and len(set(lengths)) != 1:
        counts = ", ".join(f"{v.name} {len(v.numbers)}" for v in variations)
        raise InputError(f"{where}: sampling.method = 'list' with {counts} values; must be equally many of each")
    count = samples or (prod(lengths) if method == "grid" else lengths[0])
    if count > _MOST:
        each = " x ".join(f"{length:,}" for length in lengths)
        raise InputError(
            f"{where}: [vary] makes a grid of {each} = {count:,} designs, must be at most {_MOST:,}; take fewer values "
            "of each, or a Sobol sequence of so many samples as you need"
        )
    if method == "sobol" and count & (count - 1):
        below = 1 << (count.bit_length() - 1)
        raise InputError(
            f"{where}: sampling.samples = {count}, must be a power of two for a Sobol sequence (its balance is lost "
            f"otherwise), such as {below} or {2 * below}"
        )
    if method == "latin-hypercube" and count * len(variations) > _LARGEST_TABLE:
        raise InputError(
            f"{where}: sampling.samples = {count}, must be at most {_LARGEST_TABLE // len(variations)} for a Latin "
            "hypercube of this many parameters; a Sobol sequence has no such limit"
        )
    return _METHODS[method](tuple(variations), count, 0 if listed else seed)
