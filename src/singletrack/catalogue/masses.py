"""What the components weigh, given what the scale said: Gaussian masses conditioned on their sums, exactly."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from singletrack.errors import InputError

if TYPE_CHECKING:
    from collections.abc import Sequence

__all__ = ["GRADE", "Prior", "Weighing", "sample_masses"]

#: Relative standard deviation that all components of one bicycle share: built cheap and strong, or light.
GRADE = 0.12
#: Candidates drawn for one that is kept.
_CANDIDATES = 12
_FEWEST = 25
#: Standard deviations from its usual mass at which a weighing is odd, and refused.
_ODD, _FARTHEST = 3.0, 6.0


@dataclass(frozen=True)
class Prior:
    """Masses before weighing, of c components.

    Attributes
    ----------
    names : tuple of str
    mean, own, common : array, shape (c,)
        Mean, own standard deviation, and the one shared with the components of the same part, in kg; all but loads
        share :data:`GRADE` besides.
    parts : tuple of str
        Which components share the common one.
    choices, kinds : tuple of str
        "" for a component of no choice.
    probability : array, shape (c,)
    fitted : array, shape (c,), optional
        Of a component of a choice: probability that it is there where its kind is.
    told : array of bool, shape (c,), optional
        Loads, whose masses are told: they share no grade.
    """

    names: tuple[str, ...]
    mean: np.ndarray
    own: np.ndarray
    common: np.ndarray
    parts: tuple[str, ...]
    choices: tuple[str, ...]
    kinds: tuple[str, ...]
    probability: np.ndarray
    fitted: np.ndarray | None = None
    told: np.ndarray | None = None

    def covariance(self) -> np.ndarray:
        """Return the covariance of the masses, were all there, shape (c, c), in kg^2."""
        same = np.array([[a == b != "" for b in self.parts] for a in self.parts])
        shared = same * np.outer(self.common, self.common)
        alone = self.own**2 + np.where(np.diag(same), 0.0, self.common**2)
        grade = GRADE * (self.mean if self.told is None else np.where(self.told, 0.0, self.mean))
        covariance: np.ndarray = shared + np.diag(alone) + np.outer(grade, grade)
        return covariance


@dataclass(frozen=True)
class Weighing:
    """The mass of several components together.

    Attributes
    ----------
    name : str
        What was weighed.
    members : array, shape (k,)
        Positions of the components.
    mass, deviation : float, optional
        In kg; None where it was not weighed.
    """

    name: str
    members: np.ndarray
    mass: float | None = None
    deviation: float = 0.0


def sample_masses(
    prior: Prior, weighings: Sequence[Weighing], count: int, random: np.random.Generator
) -> tuple[np.ndarray, list[str]]:
    """Return a sample of the masses given what was weighed, and what is odd about it, in sentences.

    For each set of components that may be there, the masses are Gaussian and so are they given their sum:
    m + C 1 (M - 1.m) / (1.C 1). The sets are weighted by how probable the weighed sum is with them, and masses below
    zero are left out.

    Parameters
    ----------
    prior : Prior
        Of c components.
    weighings : sequence of Weighing
        Disjoint; together they have all components.
    count : int
    random : Generator

    Returns
    -------
    masses : array, shape (count, c)
        In kg, zero where a component is not there.
    oddities : list of str

    Raises
    ------
    InputError
        If nothing that bicycles are put together from weighs that much or little.
    """
    masses, odd = np.zeros((count, len(prior.names))), []
    for weighing in weighings:
        there = _presence(prior, weighing.members, _CANDIDATES * count, random)
        drawn, weight, usual = _conditioned(prior, weighing, there, random)
        effective = weight.sum() ** 2 / max((weight**2).sum(), 1e-300)
        if weighing.mass is not None:
            told = f"{weighing.name} = {weighing.mass:.3f} kg is odd: its parts usually weigh "
            told += f"{usual[0]:.2f} +/- {usual[1]:.2f} kg (more is mounted? Say what and where, as loads)"
            off = abs(weighing.mass - usual[0]) / usual[1]
            if effective < _FEWEST or off > _FARTHEST:
                raise InputError(told, parameters=[weighing.name], found=weighing.mass, allowed="a usual mass")
            if off > _ODD:
                odd.append(told)
        steps = (np.arange(count) + random.random()) / count
        kept = np.searchsorted(np.cumsum(weight) / weight.sum(), steps).clip(max=len(weight) - 1)
        masses[:, weighing.members] = random.permutation(drawn[kept])
    return masses, odd


def _presence(prior: Prior, members: np.ndarray, count: int, random: np.random.Generator) -> np.ndarray:
    """Return which of the members are there, shape (count, k)."""
    there: np.ndarray = random.random((count, len(members))) < prior.probability[members]
    choices = {prior.choices[i] for i in members} - {""}
    for choice in sorted(choices):
        own = [j for j, i in enumerate(members) if prior.choices[i] == choice]
        kinds = list(dict.fromkeys(prior.kinds[members[j]] for j in own))
        odds = np.array(
            [next(prior.probability[members[j]] for j in own if prior.kinds[members[j]] == k) for k in kinds]
        )
        drawn = random.choice(len(kinds), size=count, p=odds / odds.sum())
        for j in own:
            there[:, j] = drawn == kinds.index(prior.kinds[members[j]])
            if prior.fitted is not None and prior.fitted[members[j]] < 1:
                there[:, j] &= random.random(count) < prior.fitted[members[j]]
    return there


def _conditioned(
    prior: Prior, weighing: Weighing, there: np.ndarray, random: np.random.Generator
) -> tuple[np.ndarray, np.ndarray, tuple[float, float]]:
    """Return masses (n, k), weights (n,) of the candidates, and mean and deviation of the sum before weighing."""
    members = weighing.members
    covariance = prior.covariance()[np.ix_(members, members)]
    root = np.linalg.cholesky(covariance + 1e-18 * np.eye(len(members)))
    drawn = there * (prior.mean[members] + random.standard_normal(there.shape) @ root.T)
    weight = np.ones(len(there))
    along = there * (there.astype(float) @ covariance)
    variance, mean = along.sum(-1), there @ prior.mean[members]
    if weighing.mass is not None:
        noisy = variance + weighing.deviation**2 + 1e-18
        missing = weighing.mass - drawn.sum(-1) - weighing.deviation * random.standard_normal(len(there))
        drawn = drawn + along * (missing / noisy)[:, None]
        exponent = -((weighing.mass - mean) ** 2) / (2 * noisy) - np.log(noisy) / 2
        weight = np.exp(exponent - exponent.max())
    weight = np.where((drawn < 0).any(-1) | ~np.isfinite(weight), 0.0, weight)
    return drawn, weight, (float(mean.mean()), float(np.sqrt(variance.mean() + mean.var())))
