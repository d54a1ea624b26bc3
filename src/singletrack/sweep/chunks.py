"""One chunk of a sweep: from rows of parameter values to arrays, in memory."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from singletrack import linear
from singletrack.closed_form import coefficients
from singletrack.linear.quartic.solve import use_compiled
from singletrack.parameters import Bicycle, Rider
from singletrack.posture import Options
from singletrack.sweep.layout import CODES, Column, Layout, status_of

if TYPE_CHECKING:
    from singletrack.model import LinearModel
    from singletrack.sweep.study import Study

__all__ = ["Task", "chunk_size", "compute_chunk", "layout_of"]

#: Eigenvalue problems of a chunk (16 MB of eigenvalues), and designs at most (their segments take more room).
_PROBLEMS, _DESIGNS = 2**18, 4096
_CROWDED = "there are more critical speeds than a sweep has room for"


def chunk_size(speeds: int) -> int:
    """Return the number of designs of a chunk of a sweep over so many speeds.

    >>> chunk_size(101), chunk_size(1)
    (2595, 4096)
    """
    return int(np.clip(_PROBLEMS // speeds, 1, _DESIGNS))


@dataclass(frozen=True, eq=False)
class Task:
    """What a worker needs to know of a study: all but the designs' values, which come with each chunk."""

    bicycle: Bicycle
    rider: Rider | None
    options: Options
    speeds: np.ndarray
    keep: tuple[str, ...]
    names: tuple[str, ...]
    owners: tuple[str, ...]

    @classmethod
    def of(cls, study: Study) -> Task:
        """Return the task of a study."""
        variations = study.designs.variations
        names, owners = tuple(v.name for v in variations), tuple(v.owner for v in variations)
        return cls(study.bicycle, study.rider, study.options, study.speeds, study.keep, names, owners)


def compute_chunk(task: Task, rows: np.ndarray) -> tuple[dict[str, np.ndarray], dict[str, np.ndarray]]:
    """Return the arrays to keep of designs (k, parameters), by name, and the faulty designs.

    Of those, the designs (k,) that are faulty are given as a mask for each kind of fault: its text with names for the
    values, which differ from design to design. All results of a faulty design are NaN, and its status says so.

    Parameters
    ----------
    task : Task
    rows : array, shape (k, parameters)
        The values of the designs, SI units.
    """
    use_compiled()
    model = _model(task, rows)
    arrays, crowded = _results(model, task, len(rows))
    faults: dict[str, np.ndarray] = {}
    for fault in model.faults:
        faults[fault.kind] = faults.get(fault.kind, np.False_) | np.broadcast_to(np.asarray(fault.bad), (len(rows),))
    faulty = ~np.broadcast_to(model.valid, (len(rows),))
    if (crowded & ~faulty).any():
        faults[_CROWDED] = crowded & ~faulty
    faulty = faulty | crowded
    for name, values in arrays.items():
        values[faulty] = CODES[name].index("faulty") if name in CODES else np.nan
    return arrays, faults


def _model(task: Task, rows: np.ndarray) -> LinearModel:
    changes: dict[str, dict[str, np.ndarray]] = {"bicycle": {}, "rider": {}}
    for i, (name, owner) in enumerate(zip(task.names, task.owners, strict=True)):
        changes[owner][name] = np.ascontiguousarray(rows[:, i])
    bicycle = task.bicycle.replace(**changes["bicycle"])
    rider = None if task.rider is None else task.rider.replace(**changes["rider"])
    with np.errstate(all="ignore"):  # faulty designs are flagged
        return coefficients(bicycle, rider, task.options)


def _results(model: LinearModel, task: Task, count: int) -> tuple[dict[str, np.ndarray], np.ndarray]:
    """Return arrays by name, a row for each design, and which designs (k,) have more crossings than there is room."""
    arrays: dict[str, np.ndarray] = {"status": np.full(count, CODES["status"].index("computed"), dtype=np.int8)}
    told = np.ones(count, dtype=bool)

    def keep(name: str, values: np.ndarray, single: int) -> None:
        """Keep results whose part for one design has ``single`` dimensions."""
        whole = (count, *values.shape[values.ndim - single :])
        fresh = name == "eigenvalues" and values.shape == whole  # the largest: nobody else has it, no copy is needed
        arrays[name] = values if fresh else np.array(np.broadcast_to(values, whole))

    with np.errstate(all="ignore"):
        if "matrices" in task.keep:
            for name in ("M", "C1", "K0", "K2") if model.is_undamped else ("M", "C0", "C1", "S0", "K0", "K2"):
                keep(name, np.asarray(getattr(model, name)), 2)
        if "eigenvalues" in task.keep:
            keep("eigenvalues", linear.eigenvalues(model, task.speeds), 2)
        if {"critical_speeds", "stable_ranges"} & set(task.keep):
            critical = linear.critical_speeds(model)
            told = np.broadcast_to(critical.told, (count,))
            if "critical_speeds" in task.keep:
                keep("weave_speeds", critical.weave_speeds, 1)
                keep("capsize_speeds", critical.capsize_speeds, 1)
            if "stable_ranges" in task.keep:
                keep("stable_ranges", critical.ranges, 2)
    crowded = np.zeros(count, dtype=bool)
    most = 2 if model.freedoms == 2 else 4 * model.freedoms
    for name, width in (("weave_speeds", most), ("capsize_speeds", most), ("stable_ranges", most + 1)):
        if name in arrays:
            arrays[f"{name.partition('_')[0]}_status"] = status_of(arrays[name], told)
            arrays[name], more = _of_width(arrays[name], width)
            crowded |= more
    return arrays, crowded


def _of_width(values: np.ndarray, width: int) -> tuple[np.ndarray, np.ndarray]:
    """Return speeds (k, width, ...), NaN where there are fewer, and the designs (k,) that have more.

    How many columns critical speeds have depends on the designs that are computed together: not so in a store.
    """
    missing = max(0, width - values.shape[1])
    padded = np.pad(values, ((0, 0), (0, missing), *((0, 0) for _ in values.shape[2:])), constant_values=np.nan)
    more = np.isfinite(padded[:, width:]).reshape(len(values), -1).any(axis=1)
    return np.ascontiguousarray(padded[:, :width]), more


def layout_of(study: Study) -> Layout:
    """Return the arrays of a study's store: those of the results of its first design, and the parameters that vary."""
    task = Task.of(study)
    first = study.designs.rows(0, 1)
    arrays, _ = compute_chunk(task, first)
    columns = [Column.of_results(name, values[0]) for name, values in arrays.items()]
    columns.append(Column.of_results("fault", np.zeros((), dtype=np.int16)))
    columns += [Column(v.name, (), "<f8", (), {"units": v.unit, "owner": v.owner}) for v in study.designs.variations]
    used = {name for column in columns for name in column.dimensions}
    coordinates = np.array(_model(task, first).coordinates)
    labels = {"equation": coordinates, "coordinate": coordinates, "bound": np.array(["from", "to"])}
    kept = {name: values for name, values in labels.items() if name in used} | {"speed": study.speeds}
    return Layout(study.designs.count, chunk_size(len(study.speeds)), tuple(columns), kept)
