"""One stretch of a sweep: from rows of parameter values to arrays, in memory."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from singletrack import linear
from singletrack.closed_form import coefficients
from singletrack.linear.quartic.solve import use_compiled
from singletrack.sweep.study import Study  # field of a record

if TYPE_CHECKING:
    from singletrack.model import LinearModel

__all__ = ["Task", "chunk_size", "compute_chunk"]

#: Eigenvalue problems of a stretch (16 MB of eigenvalues), and designs at most (their segments take more room).
_PROBLEMS, _DESIGNS = 2**18, 4096


def chunk_size(speeds: int) -> int:
    """Return the number of designs of a stretch.

    >>> chunk_size(101), chunk_size(1)
    (2595, 4096)
    """
    return int(np.clip(_PROBLEMS // speeds, 1, _DESIGNS))


@dataclass(frozen=True, eq=False)
class Task:
    """What a worker needs to know of a study: all but the designs' values, which come with each stretch."""

    study: Study
    names: tuple[str, ...]
    owners: tuple[str, ...]

    @classmethod
    def of(cls, study: Study) -> Task:
        """Return the task of a study."""
        variations = study.designs.variations
        return cls(study, tuple(v.name for v in variations), tuple(v.owner for v in variations))


def compute_chunk(task: Task, rows: np.ndarray) -> tuple[dict[str, np.ndarray], dict[str, np.ndarray]]:
    """Return the arrays to keep of designs (k, parameters), by name, and the faulty designs.

    Of those, the designs (k,) that are faulty are given as a mask for each kind of fault: its text with names for the
    values, which differ from design to design. All results of a faulty design are NaN.
    """
    use_compiled()
    study = task.study
    changes: dict[str, dict[str, np.ndarray]] = {"bicycle": {}, "rider": {}}
    for i, (name, owner) in enumerate(zip(task.names, task.owners, strict=True)):
        changes[owner][name] = np.ascontiguousarray(rows[:, i])
    bicycle = study.bicycle.replace(**changes["bicycle"])
    rider = None if study.rider is None else study.rider.replace(**changes["rider"])
    with np.errstate(all="ignore"):  # faulty designs are flagged
        model = coefficients(bicycle, rider, study.options)
        arrays = _results(model, study, len(rows))
    faults: dict[str, np.ndarray] = {}
    for fault in model.faults:
        faults[fault.kind] = faults.get(fault.kind, np.False_) | np.broadcast_to(np.asarray(fault.bad), (len(rows),))
    for values in arrays.values():
        values[~np.broadcast_to(model.valid, (len(rows),))] = np.nan
    return arrays, faults


def _results(model: LinearModel, study: Study, count: int) -> dict[str, np.ndarray]:
    arrays: dict[str, np.ndarray] = {}
    if "matrices" in study.keep:
        for name in ("M", "C1", "K0", "K2"):
            arrays[name] = np.array(np.broadcast_to(getattr(model, name), (count, 2, 2)))
    if "eigenvalues" in study.keep:
        roots = linear.eigenvalues(model, study.speeds)
        arrays["eigenvalues"] = roots if roots.ndim == 3 else np.array(np.broadcast_to(roots, (count, *roots.shape)))
    if {"critical_speeds", "stable_ranges"} & set(study.keep):
        critical = linear.critical_speeds(model)
        if "critical_speeds" in study.keep:
            arrays["weave_speeds"] = np.array(np.broadcast_to(critical.weave_speeds, (count, 2)))
            arrays["capsize_speeds"] = np.array(np.broadcast_to(critical.capsize_speeds, (count, 2)))
        if "stable_ranges" in study.keep:
            arrays["stable_ranges"] = np.array(np.broadcast_to(critical.ranges, (count, 3, 2)))
    return arrays
