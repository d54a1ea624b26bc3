"""Global sensitivity: Sobol's indices, by SALib, of whatever a batch of designs answers."""

from __future__ import annotations

import os
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from singletrack.errors import InputError
from singletrack.linear import critical_speeds, eigenvalues

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from singletrack.analysis.designs import Design

__all__ = ["SobolIndices", "design_results", "sobol_indices"]

_CHUNK = 2048  # designs at a time: what fits in the caches of a core
_MOST_LOST = 0.0


@dataclass(frozen=True, eq=False)
class SobolIndices:
    """Shares of the variance of r results that k parameters have.

    Attributes
    ----------
    parameters, results : tuple of str
    first, total : array, shape (r, k)
        Alone, and with all their interactions.
    first_confidence, total_confidence : array, shape (r, k)
        Half-widths of the 95 % confidence intervals.
    mean, deviation : array, shape (r,)
        Of the results over the sample.
    evaluations : int
        Designs computed.
    """

    parameters: tuple[str, ...]
    results: tuple[str, ...]
    first: np.ndarray
    total: np.ndarray
    first_confidence: np.ndarray
    total_confidence: np.ndarray
    mean: np.ndarray
    deviation: np.ndarray
    evaluations: int

    def to_dict(self) -> dict[str, Any]:
        """Return everything as lists, for JSON."""
        arrays = ("first", "total", "first_confidence", "total_confidence", "mean", "deviation")
        return {
            "parameters": list(self.parameters),
            "results": list(self.results),
            **{name: getattr(self, name).tolist() for name in arrays},
            "evaluations": self.evaluations,
        }


def sobol_indices(
    function: Callable[[np.ndarray], Mapping[str, np.ndarray]],
    ranges: Mapping[str, tuple[float, float]],
    samples: int = 1024,
    seed: int = 0,
    normal: bool = False,
) -> SobolIndices:
    """Return first-order and total indices of a function of k parameters.

    Parameters
    ----------
    function : callable
        From parameters (n, k) to results by name, each (n,). Called with batches, on all cores.
    ranges : mapping of str to (float, float)
        The k parameters with their least and greatest values, or, if ``normal``, means and standard deviations.
    samples : int
        A power of two; n (k + 2) evaluations are made.
    seed : int
        The same seed draws the same designs.
    normal : bool
        Whether parameters are normally distributed, else uniformly.

    Raises
    ------
    InputError
        If SALib is not installed, ``samples`` is no power of two, or a result is not finite somewhere in the ranges.

    Notes
    -----
    Saltelli's sampling and estimators (Saltelli et al. 2010, Computer Physics Communications 181:259) as SALib has
    them.
    """
    try:
        from SALib.analyze import sobol as analyze
        from SALib.sample import sobol as sample
    except ImportError:
        raise InputError("Sobol's indices need SALib: pip install 'singletrack[sensitivity]'") from None
    if samples < 64 or samples & (samples - 1):
        raise InputError(f"samples = {samples}, must be a power of two, 64 or more")
    names = list(ranges)
    problem: dict[str, Any] = {"num_vars": len(names), "names": names, "bounds": [list(r) for r in ranges.values()]}
    if normal:
        problem["dists"] = ["norm"] * len(names)
    points = sample.sample(problem, samples, calc_second_order=False, seed=seed)
    found = _evaluated(function, points)
    analyses = []
    for name, values in found.items():
        lost = 1.0 - np.isfinite(values).mean()
        if lost > _MOST_LOST:
            raise InputError(
                f"{name}: does not exist for {100 * lost:.2g} % of the designs in these ranges, and variance has no "
                "meaning there; narrow the ranges, or ask for a result that every design has, such as a growth rate"
            )
        # Constant results have no variance to share.
        analyses.append(analyze.analyze(problem, values, calc_second_order=False, seed=seed))
    columns = {key: np.array([one[key] for one in analyses]) for key in ("S1", "ST", "S1_conf", "ST_conf")}
    return SobolIndices(
        tuple(names),
        tuple(found),
        columns["S1"],
        columns["ST"],
        columns["S1_conf"],
        columns["ST_conf"],
        np.array([values.mean() for values in found.values()]),
        np.array([values.std() for values in found.values()]),
        len(points),
    )


def _evaluated(function: Callable[[np.ndarray], Mapping[str, np.ndarray]], points: np.ndarray) -> dict[str, np.ndarray]:
    """Return the results of points (n, k), in chunks on all cores: NumPy lets go of the interpreter where it works."""
    chunks = np.array_split(points, max(1, -(-len(points) // _CHUNK)))
    with ThreadPoolExecutor(os.process_cpu_count() if hasattr(os, "process_cpu_count") else os.cpu_count()) as pool:
        parts = list(pool.map(function, chunks))
    return {name: np.concatenate([np.asarray(part[name], dtype=float) for part in parts]) for name in parts[0]}


def design_results(design: Design, names: tuple[str, ...], speed: float) -> Callable[[np.ndarray], dict[str, Any]]:
    """Return a function from parameters (n, k) to results: critical speeds, and the fastest growth at a speed.

    Parameters
    ----------
    design : Design
    names : tuple of str
        The k parameters.
    speed : float
        In m/s.

    Examples
    --------
    >>> import numpy as np
    >>> from singletrack import load_bicycle
    >>> from singletrack.analysis.designs import Design
    >>> results = design_results(Design.of(load_bicycle("benchmark")), ("trail",), 5.0)(np.array([[0.08]]))
    >>> {name: values.round(3).tolist() for name, values in results.items()}
    {'weave speed': [4.292], 'capsize speed': [6.024], 'growth at 5 m/s': [-0.323]}
    """

    def results(points: np.ndarray) -> dict[str, Any]:
        changed = design.changed({name: points[:, i] for i, name in enumerate(names)})
        model = changed.model().broadcast_to((len(points),))
        critical = critical_speeds(model)
        growth = eigenvalues(model, speed).real.max(axis=(-2, -1))
        return {
            "weave speed": critical.weave_speeds[:, 0],
            "capsize speed": critical.capsize_speeds[:, 0],
            f"growth at {speed:g} m/s": growth,
        }

    return results
